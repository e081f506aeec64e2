# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The simulation: a scene that is stepped under watch; commands in, states and wrenches out."""

from fractions import Fraction
from pathlib import Path
from types import MappingProxyType

from fluid_sim_ros.errors import CommandError, ConfigError
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.schema.scene import ScheduledEvent
from fluid_sim_ros.schema.settings import RunSettings
from fluid_sim_ros.simulation.commands import Commands
from fluid_sim_ros.simulation.engine import Engine
from fluid_sim_ros.simulation.events import Events
from fluid_sim_ros.simulation.fluid_terms import FluidTerms, check_flows, no_flow_line
from fluid_sim_ros.simulation.snapshot import SavedState, Snapshot
from fluid_sim_ros.simulation.vehicle_wrenches import VehicleWrenches
from fluid_sim_ros.simulation.warning_log import WarningLog
from fluid_sim_ros.step_clock import StepClock


class Simulation:
    """
    A scene that runs.

    Commands set by ``set_*`` take effect at the next step and hold until changed. World frame is
    ENU, body frame FLU, SI units. One thread at a time may use a Simulation.

    Parameters
    ----------
    scene
        Name of a scene, path of an MJCF or scene file, or a ``Scene``.
    seed
        Seed of everything random in the scene.
    timestep, integrator, fluid
        Replace what the scene or its model states; see ``RunSettings``.

    Attributes
    ----------
    scene
        What was loaded.
    settings, seed
        The ``RunSettings`` that hold (those given, or else the scene's), and their seed.
    model, data
        MuJoCo's model and the data that is stepped; change them only between steps.
    observed
        The copy that the last ``observe(forces=True)`` evaluated; only to be read.
    timestep
        Of the scene [s]; rates count in it, also after ``set_timestep``.
    vehicles
        Vehicles by name; ``vehicle`` returns one, or says which there are.
    streams, flow_source
        Which of wind and current the scene has, and how they reach the bodies. ``opt.wind``: one
        velocity for all. ``fluid_sim.medium``: each meets its own, by place and time.
    set_thrust, set_joints, set_wrench, set_wind, set_current, enable_wind, apply
        Methods that command; see ``Commands``.
    terms
        Vehicle name -> names of the fluid terms that can act on it.
    warnings
        The ``WarningLog`` of the run: what was found at load, and by watchdogs.
    observe_addresses, control_ports
        What ``observe`` hands to the library, and where that writes an autopilot's commands.
    observe, largest, energy_balance
        Methods that return the vehicles as rows of numbers, a watch of their largest values, and
        what the integrator does to the energy; see ``Engine``.
    stages
        Method that returns what of MuJoCo's step the next steps take; see ``Stages``.
    wrench
        Method that returns the fluid wrench on a vehicle; see ``VehicleWrenches``.

    Raises
    ------
    ConfigError, ModelError
        If the scene or an option is wrong.

    """

    def __init__(
        self,
        scene: str | Path | Scene,
        *,
        seed: int = 0,
        timestep: float | None = None,
        integrator: str | None = None,
        fluid: str | None = None,
    ) -> None:
        self.scene = Scene.load(scene)
        given = RunSettings.checked(
            timestep=timestep, integrator=integrator, fluid=fluid, seed=seed
        )
        self.settings = given.over(self.scene.settings)
        self.seed = self.settings.seed
        compiled = self.scene.compile(self.settings)
        self.vehicles = MappingProxyType(compiled.vehicles)

        self._engine = engine = Engine(
            compiled.model, [vehicle.body_id for vehicle in compiled.vehicles.values()]
        )
        self.model, self.data, self.observed = engine.model, engine.data, engine.observed
        self._engine_step, self.observe = engine.step, engine.observe
        self.energy_balance, self.largest = engine.energy_balance, engine.largest
        self.stages = engine.stages
        self.wrench = VehicleWrenches(engine, tuple(compiled.vehicles)).wrench
        self.timestep = float(self.model.opt.timestep)
        self._clock = StepClock(self.timestep)

        terms = FluidTerms(engine.model, engine.data, compiled.vehicles)
        self.terms = terms.of_vehicles
        self.warnings = WarningLog((*compiled.warnings, *terms.warnings()))
        unfelt = None if terms.feel_flow else self._refuse_flow
        self._commands = commands = Commands(engine, compiled, unfelt)
        self._events = Events(compiled, commands)
        self._streams, self._in_steps = commands.streams, commands.in_steps
        self.streams, self.flow_source = self._streams.available, self._streams.source
        self.vehicle, self.apply = commands.vehicle, commands.apply
        self.observe_addresses, self.control_ports = engine.observe_addresses, commands.ports
        self.set_thrust, self.set_joints = commands.set_thrust, commands.set_joints
        self.set_wind, self.set_current = commands.set_wind, commands.set_current
        self.enable_wind, self.set_wrench = commands.enable_wind, commands.set_wrench
        if unfelt is not None:
            check_flows(self.scene, unfelt)
        self.reset()

    def _refuse_flow(self, stream: str) -> None:
        line = f'{stream}: {no_flow_line(stream)}'
        if self.settings.fluid != 'none':
            raise CommandError(line)
        self.warnings.add(f"{stream}: no effect, since the setting 'fluid' is none")

    # ---- time ------------------------------------------------------------------------------

    @property
    def step_count(self) -> int:
        """Steps since the last reset."""
        return self._step

    @property
    def next_change(self) -> int:
        """Step at which a scheduled event or a gait next takes effect (``NEVER``)."""
        return self._events.next_change(self.tick)

    @property
    def tick(self) -> int:
        """Whole timesteps of the scene since the last reset: the step count, unless retimed."""
        return self._clock.tick(self._step)

    @property
    def time(self) -> float:
        """Simulated time [s]: steps times timestep, free of summation error."""
        return self._clock.time(self._step)

    @property
    def time_ns(self) -> int:
        """Simulated time in whole nanoseconds, rounded once from the exact product [ns]."""
        return self._clock.time_ns(self._step)

    # ---- stepping --------------------------------------------------------------------------

    def step(self, n: int = 1) -> None:
        """
        Take steps; every one of them is checked.

        Parameters
        ----------
        n
            How many.

        Raises
        ------
        DivergedError
            At the first step that ends with a number that is not finite, or in a silent reset of
            MuJoCo's. The simulation then needs ``reset`` or ``load_state``.

        """
        end, clock, events = self._step + n, self._clock, self._events
        while self._step < end:
            stop = end
            if clock.retimed or end > events.next_stop:
                events.begin_step(self.tick)
                stop = min(end, clock.step_at(events.next_stop))
            steps = stop - self._step
            done = self._engine_step(steps, self._step)
            self._step += done
            if done != steps:
                raise self._engine.divergence()

    def set_timestep(self, timestep: Fraction) -> None:
        """
        Step on with another timestep until ``reset``, for a loop that another clock drives.

        Rates and events keep to the scene's: they take effect at the next boundary.

        Parameters
        ----------
        timestep
            [s], not above the scene's.

        Raises
        ------
        ConfigError
            If it is not above 0, is longer than the scene's, or a gait is running.

        """
        if self._in_steps.gaits.running:
            raise ConfigError("the scene's gait keeps the scene's timestep")
        self._clock.retime(self._step, timestep)
        self.model.opt.timestep = self._clock.timestep

    def reset(self, keyframe: str | None = None) -> None:
        """
        Go back to time 0, without commands.

        Parameters
        ----------
        keyframe
            Where to begin; None: at the scene's keyframe, or as the model stands.

        Raises
        ------
        CommandError
            If the model has no such keyframe.

        """
        self._engine.reset(self.scene.first_keyframe if keyframe is None else keyframe)
        self._clock.restart()
        self.model.opt.timestep = self.timestep
        self._streams.reset()
        self._step = 0
        self._in_steps.hold_wrenches({})
        self._events.restart(0, (), None)

    def close(self) -> None:
        """Release nothing that Python would not; here so that every source can be closed."""

    def schedule(self, time_ns: int, change: ScheduledEvent) -> None:
        """
        Have a change take effect at the first step boundary at or after a time.

        Parameters
        ----------
        time_ns
            Simulated time [ns].
        change
            What changes.

        Raises
        ------
        CommandError
            If the scene has no such medium; see ``set_wind``.

        """
        self._events.add(max(self._clock.tick_at(time_ns), self.tick), change)

    def reseed(self) -> None:
        """Start turbulence and other noise anew at the present time, with this run's seed."""
        self._streams.seed(self.seed)

    # ---- observation -----------------------------------------------------------------------

    def snapshot(self) -> Snapshot:
        """Return the state of every vehicle at this step boundary, as copies."""
        return Snapshot.of(self.time, self._step, self.vehicles, self.observe(forces=False))

    # ---- save and load ---------------------------------------------------------------------

    def save_state(self) -> SavedState:
        """Return everything that the next step depends on; going on from it is bit-identical."""
        return SavedState(
            engine=self._engine.save(),
            streams=self._streams.save(),
            step=self._step,
            wrenches=dict(self._in_steps.wrenches),
            added_events=self._events.schedule.added(),
            gaits=self._in_steps.gaits.running,
            pace=self._clock.save(),
        )

    def load_state(self, state: SavedState) -> None:
        """
        Go to a saved state.

        Parameters
        ----------
        state
            Of the same scene and settings.

        Raises
        ------
        FluidSimError
            If the state is of another model.

        """
        self._engine.load(state.engine)
        self._streams.load(state.streams)
        self._step = state.step
        self._clock.load(state.pace)
        self.model.opt.timestep = self._clock.timestep
        self._in_steps.hold_wrenches(state.wrenches)
        self._events.restart(self.tick, state.added_events, state.gaits)
