# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Which pacing the node's parameters choose, and what lockstep does without an answer."""

import time
from collections.abc import Callable, Mapping
from typing import Any

from fluid_sim_ros.errors import ConfigError, FluidSimError
from fluid_sim_ros.loop.autopilot_pacing import AutopilotPacing
from fluid_sim_ros.loop.autopilot_port import Exchange
from fluid_sim_ros.loop.pacing import Lockstep, Pacing, RealTime
from fluid_sim_ros.ros.autopilot import check_pacing
from fluid_sim_ros.ros.inputs import Inputs
from fluid_sim_ros.ros.outputs import Outputs
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import Beat, exact

#: Wall time between two publications of the present state while held in lockstep [s].
_HOLD_PERIOD = 0.1
#: Real-time pacing looks at its clock and its commands at least this often [Hz, simulated].
_REALTIME_TICK_RATE = 100.0


class Pacings:
    """
    Makes the pacing of a session.

    Parameters
    ----------
    simulation, inputs, outputs
        What is paced, waited for, and published again while it waits.
    settings
        Values of the node's parameters; ``pacing`` and ``realtime.factor`` may change.
    exchange
        What simulated time waits for with autopilots, or None.
    report
        Takes (key, line): a fault to log.

    """

    def __init__(
        self,
        simulation: Simulation,
        settings: Mapping[str, Any],
        inputs: Inputs,
        outputs: Outputs,
        exchange: Exchange | None,
        report: Callable[[str, str], None],
    ) -> None:
        self._simulation, self._settings = simulation, settings
        self._inputs, self._outputs = inputs, outputs
        self._exchange, self._report = exchange, report

    def chosen(self) -> Pacing:
        """
        Return the pacing that the parameters choose now.

        Returns
        -------
        Pacing
            Made for the simulation's timestep.

        Raises
        ------
        ConfigError
            If the parameters do not go with each other.

        """
        if self._exchange is not None:
            check_pacing(self._settings)
            return AutopilotPacing(self._exchange, self._clock())
        return self._lockstep() if self._settings['pacing'] == 'lockstep' else self._clock()

    def _clock(self) -> Pacing:
        settings, timestep = self._settings, self._simulation.timestep
        if settings['pacing'] == 'free':
            return Pacing()
        tick = max(1, round(1.0 / (_REALTIME_TICK_RATE * timestep)))
        return RealTime(factor=settings['realtime.factor'], tick=tick)

    def _lockstep(self) -> Lockstep:
        settings, timestep = self._settings, self._simulation.timestep
        self._inputs.check_awaited()
        period, rate = exact(settings['lockstep.period']), exact(settings['odom.rate'])
        if (period * rate).denominator != 1:
            raise ConfigError(
                f"parameter 'lockstep.period': {settings['lockstep.period']:g} s is not a "
                f'multiple of the odometry period {1 / settings["odom.rate"]:g} s, so some states '
                'that must be answered would not be published'
            )
        rule = settings['lockstep.on_timeout']
        on_timeout = {'hold': self._hold, 'continue': self._go_on, 'stop': self._give_up}[rule]
        patience = _HOLD_PERIOD if rule == 'hold' else settings['lockstep.timeout']
        beat = Beat.at_rate(1 / period, timestep, "parameter 'lockstep.period'")
        return Lockstep(beat=beat, on_timeout=on_timeout, patience=patience)

    def _hold(self, simulation: Simulation) -> bool:
        self._outputs.repeat(simulation)
        self._outputs.show(simulation, time.monotonic(), stands=True)
        return False

    def _go_on(self, simulation: Simulation) -> bool:
        self._report('lockstep', self._no_answer() + ': going on, not deterministic')
        return True

    def _give_up(self, simulation: Simulation) -> bool:
        raise FluidSimError(self._no_answer() + ": stopped, as 'lockstep.on_timeout' says")

    def _no_answer(self) -> str:
        topics = ', '.join(self._inputs.awaited())
        return f'no answer on {topics} within {self._settings["lockstep.timeout"]:g} s'
