"""The simulation: a commanded scene, stepped under watch; states and wrenches out."""

from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import mujoco

from fluid_sim_ros.errors import CommandError, ConfigError, listed
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.scene.schedule import Event
from fluid_sim_ros.schema.scene import ScheduledEvent
from fluid_sim_ros.simulation.actuation import CommandedWrench
from fluid_sim_ros.simulation.commanded_scene import CommandedScene
from fluid_sim_ros.simulation.engine import EnergyBalance, Largest
from fluid_sim_ros.simulation.snapshot import ForceTorque, Snapshot, VehicleState
from fluid_sim_ros.simulation.wind_and_current import SavedStreams
from fluid_sim_ros.step_clock import Pace, StepClock, exact


@dataclass(frozen=True)
class SavedState:
    """Everything that the next step depends on; made by ``Simulation.save_state``."""

    engine: Array
    streams: SavedStreams
    step: int
    wrenches: dict[str, CommandedWrench]
    added_events: tuple[Event, ...]
    gaits: tuple[str, ...] | None = None  # running ones; None: all of the scene
    pace: Pace | None = None  # None: the scene's timestep all along


class Simulation(CommandedScene):
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
        Replace what the model states; see ``Scene.compile``.

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
        self.seed = seed
        compiled = self.scene.compile(
            timestep=timestep, integrator=integrator, fluid=fluid, seed=seed
        )
        super().__init__(compiled)
        self._schedule = compiled.schedule
        self._keyframe_id = compiled.keyframe_id
        self._engine_step = self._engine.step
        self.observe = self._engine.observe

        self._timestep = float(self._model.opt.timestep)
        self._clock = StepClock(self._timestep)
        self._names = tuple(self._vehicles)
        self._index = {name: i for i, name in enumerate(self._names)}
        self.reset()

    # ---- what it is ------------------------------------------------------------------------

    @property
    def observed(self) -> mujoco.MjData:
        """The copy that the last ``observe(forces=True)`` evaluated; only to be read."""
        return self._engine.observed

    @property
    def timestep(self) -> float:
        """Timestep of the scene [s]; rates count in it, also after ``set_timestep``."""
        return self._timestep

    @property
    def step_count(self) -> int:
        """Steps since the last reset."""
        return self._step

    @property
    def next_change(self) -> int:
        """Step at which a scheduled event or a gait next takes effect (``schedule.NEVER``)."""
        return min(self._schedule.next_step, self._gaits.next_step)

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
        Take n steps; every one of them is checked.

        Raises
        ------
        DivergedError
            At the first step that ends with a number that is not finite, or that MuJoCo answers
            with one of its silent resets. The simulation then needs ``reset`` or ``load_state``.

        """
        end = self._step + n
        if self._clock.retimed:
            self._step_retimed(end)
            return
        if end > self.next_change or self._wrenches:
            self._step_with_events(end)
            return
        done = self._engine_step(n)
        self._step += done
        if done != n:
            raise self._engine.divergence()

    def _step_with_events(self, end: int) -> None:
        while self._step < end:
            self._begin_step(self._step)
            stop = min(end, self.next_change)
            if self._wrenches:
                # the axes of a commanded wrench turn with the body: hold them over one step only
                stop = self._step + 1
            n = stop - self._step
            done = self._engine_step(n)
            self._step += done
            if done != n:
                raise self._engine.divergence()

    def _step_retimed(self, end: int) -> None:
        while self._step < end:
            self._begin_step(self.tick)
            if self._engine_step(1) != 1:
                raise self._engine.divergence()
            self._step += 1

    def _begin_step(self, tick: int) -> None:
        """Apply what takes effect with the step from here."""
        for change in self._schedule.take_due(tick):
            self.apply(change)
        self._gaits.write_due(tick, self._data.ctrl)
        self._write_wrenches()

    def set_timestep(self, timestep: Fraction) -> None:
        """
        Step on with another timestep [s], for a loop that another clock drives; until ``reset``.

        Rates and the scene's events keep to the timestep of the scene: they take effect at the
        first boundary at or after their time.

        Raises
        ------
        ConfigError
            If it is not above 0, is longer than the scene's, or a gait is running.

        """
        if not 0 < timestep <= exact(self._timestep):
            raise ConfigError(
                f'timestep {float(timestep):g} s: must be above 0, and not longer than the '
                f"scene's ({self._timestep:g} s)"
            )
        if self._gaits.running:
            raise ConfigError("the scene's gait keeps the scene's timestep")
        self._clock.retime(self._step, timestep)
        self._model.opt.timestep = self._clock.timestep

    def reset(self, keyframe: str | None = None) -> None:
        """
        Go back to time 0 at a keyframe (default: the scene's), without commands.

        Raises
        ------
        CommandError
            If the model has no such keyframe.

        """
        identity = self._keyframe_id
        if keyframe is not None:
            identity = mujoco.mj_name2id(self._model, mujoco.mjtObj.mjOBJ_KEY, keyframe)
            if identity < 0:
                names = listed(self._model.key(i).name for i in range(self._model.nkey))
                raise CommandError(f"keyframe '{keyframe}' is not in the model; it has: {names}")
        self._clock.restart()
        self._model.opt.timestep = self._timestep
        self._engine.reset(identity)
        self._streams.reset()
        self._schedule.rewind(0)
        self._gaits.restart(0)
        self._step = 0
        self._wrenches.clear()

    def close(self) -> None:
        """Release nothing that Python would not; here so that every source can be closed."""

    # ---- events ----------------------------------------------------------------------------

    def schedule(self, time_ns: int, change: ScheduledEvent) -> None:
        """
        Have a change take effect at the first step boundary at or after ``time_ns`` [ns].

        Raises
        ------
        CommandError
            If the scene has no such medium; see ``set_wind``.

        """
        if change.wind is not None:
            self._streams.check('wind')
        if change.current is not None:
            self._streams.check('current')
        self._schedule.add(Event(max(self._clock.tick_at(time_ns), self.tick), change))

    def reseed(self) -> None:
        """Start turbulence and other noise anew at the present time, with this run's seed."""
        self._streams.seed(self.seed)

    # ---- observation -----------------------------------------------------------------------

    def snapshot(self) -> Snapshot:
        """Return the state of every vehicle at this step boundary, as copies."""
        rows = self.observe(forces=False).copy()
        states = {
            name: VehicleState(
                position_w=row[nat.POSITION],
                quat_wb_wxyz=row[nat.QUATERNION],
                velocity_b=row[nat.LINEAR_VELOCITY],
                omega_b=row[nat.ANGULAR_VELOCITY],
                medium_velocity_w=row[nat.MEDIUM_VELOCITY],
            )
            for name, row in zip(self._names, rows, strict=True)
        }
        return Snapshot(time=self.time, step=self._step, vehicles=states)

    def largest(self) -> Largest:
        """Return a watch for the largest speed, tilt and distance of each vehicle."""
        return Largest(self._engine)

    def energy_balance(self) -> EnergyBalance:
        """Return kinetic energy, what the integrator feeds in, and what drag takes out."""
        return self._engine.energy_balance()

    def wrench(self, vehicle: str) -> dict[str, ForceTorque]:
        """
        Return the fluid wrench on a vehicle term by term, at this step boundary.

        Keys are ``plugins.native.TERMS``; each value is (force, torque), [N] and [N m], shape (3,)
        each, base_link axes, about the base_link origin, acting on the vehicle. Terms that the
        scene does not have are zero.
        """
        self.vehicle(vehicle)
        row = self.observe(forces=True)[self._index[vehicle]].copy()
        terms = {}
        for term in nat.TERMS:
            force_torque = row[nat.term_columns(term)]
            terms[term] = (force_torque[:3], force_torque[3:])
        return terms

    # ---- save and load ---------------------------------------------------------------------

    def save_state(self) -> SavedState:
        """Return everything that the next step depends on; going on from it is bit-identical."""
        return SavedState(
            engine=self._engine.save(),
            streams=self._streams.save(),
            step=self._step,
            wrenches=dict(self._wrenches),
            added_events=self._schedule.added(),
            gaits=self._gaits.running,
            pace=self._clock.save(),
        )

    def load_state(self, state: SavedState) -> None:
        """
        Go to a saved state.

        Raises
        ------
        FluidSimError
            If the state is of another model.

        """
        self._engine.load(state.engine)
        self._streams.load(state.streams)
        self._step = state.step
        self._clock.restart()
        if state.pace is not None:
            self._clock.load(state.pace)
        self._model.opt.timestep = self._clock.timestep
        self._wrenches = dict(state.wrenches)
        self._schedule.rewind(self.tick, state.added_events)
        self._gaits.restart(self.tick, state.gaits)
