# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Services on the simulation as a whole: its features, its state, steps and resets."""

from typing import Any

from fluid_sim_ros.errors import CommandError, FluidSimError
from fluid_sim_ros.ros.session import Session
from fluid_sim_ros.ros.standard.answers import Services, UnsupportedError, WrongStateError

#: What there is, by the names of SimulatorFeatures.
FEATURES = (
    'ENTITY_STATE_GETTING', 'ENTITY_STATE_SETTING', 'SIMULATION_RESET',
    'SIMULATION_STATE_GETTING', 'SIMULATION_STATE_SETTING', 'SIMULATION_STATE_PAUSE',
    'STEP_SIMULATION_SINGLE', 'STEP_SIMULATION_MULTIPLE',
)  # fmt: skip
INFO = (
    'fluid_sim_ros: a model is compiled when the node is configured, so entities are neither '
    'spawned nor deleted; a reset sets back time and state together'
)
#: Steps that the stepping thread takes at one request, so that others are heard in between.
_PORTION = 500


class SimulationServices(Services):
    """Features, reset, steps, and the state of the simulation."""

    def get_simulator_features(self, request: Any, response: Any) -> None:
        """
        List the features.

        Parameters
        ----------
        request, response
            Of the service.

        """
        known = self._messages.SimulatorFeatures
        numbers = [getattr(known, name) for name in FEATURES if hasattr(known, name)]
        response.features.features = numbers
        response.features.custom_info = INFO

    def reset_simulation(self, request: Any, response: Any) -> None:
        """
        Go back to the keyframe at time 0.

        Parameters
        ----------
        request, response
            Of the service.

        """
        kinds = self._services.ResetSimulation.Request
        scope = getattr(request, 'scope', 0)
        both = kinds.SCOPE_TIME | kinds.SCOPE_STATE
        if scope == kinds.SCOPE_SPAWNED:
            return  # nothing can be
        if scope != kinds.SCOPE_DEFAULT and scope & both != both:
            raise UnsupportedError('time and state are reset together: scope 0, 255, or both')
        self._on_session(lambda session: session.reset())

    def step_simulation(self, request: Any, response: Any) -> None:
        """
        Step while paused.

        Parameters
        ----------
        request, response
            Of the service.

        """

        def advance(session: Session) -> str:
            if not session.runner.paused:
                raise WrongStateError('the simulation is not paused; set it to STATE_PAUSED')
            return session.step(min(left, _PORTION))

        left = int(request.steps)
        if left < 1:
            raise CommandError('steps: must be 1 or more')
        while left > 0:
            self._on_session(advance)
            left -= _PORTION

    def get_simulation_state(self, request: Any, response: Any) -> None:
        """
        Tell whether it plays.

        Parameters
        ----------
        request, response
            Of the service.

        """
        response.state.state = self._state()

    def set_simulation_state(self, request: Any, response: Any) -> None:
        """
        Play, pause, stop (pause at time 0) or quit.

        Parameters
        ----------
        request, response
            Of the service.

        """
        states, wanted = self._messages.SimulationState, request.state.state
        now = self._state()
        if wanted == now:
            response.result.result = type(response).ALREADY_IN_TARGET_STATE
            response.result.error_message = 'it is in this state'
        elif wanted == states.STATE_QUITTING:
            self._end()
        elif now == getattr(states, 'STATE_INITIALIZING', None):
            raise WrongStateError('the node is not configured and active')
        elif wanted == states.STATE_PLAYING:
            self._on_session(lambda session: session.pause(False))
        elif wanted == states.STATE_PAUSED:
            self._on_session(lambda session: session.pause(True))
        elif wanted == states.STATE_STOPPED:
            self._on_session(lambda session: session.pause(True) and session.reset())
        else:
            raise UnsupportedError(f'state {wanted} cannot be set')

    def _state(self) -> int:
        states, found = self._messages.SimulationState, []

        def look(session: Session) -> str:
            at_start = session.simulation.step_count == 0
            paused = states.STATE_STOPPED if at_start else states.STATE_PAUSED
            stands = session.runner.paused or session.runner.stopped
            found.append(paused if stands else states.STATE_PLAYING)
            return ''

        try:
            self._on_session(look)
        except FluidSimError:  # not configured
            return int(getattr(states, 'STATE_INITIALIZING', states.STATE_STOPPED))
        return int(found[0])
