"""The simulation: MuJoCo stepped under watch, commands in, states and wrenches out."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from types import MappingProxyType

import mujoco
import numpy as np
from numpy.typing import NDArray

from fluid_sim_ros.commands import CommandedWrench, finite, write_controls
from fluid_sim_ros.engine import EnergyBalance, Engine
from fluid_sim_ros.environment import Event, exact
from fluid_sim_ros.errors import CommandError, ConfigError, listed
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.scene_schema import ScheduledEvent
from fluid_sim_ros.snapshot import ForceTorque, Snapshot, VehicleState
from fluid_sim_ros.step_clock import Pace, StepClock
from fluid_sim_ros.streams import SavedStreams, Streams
from fluid_sim_ros.vehicle import Vehicle

Array = NDArray[np.float64]


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
        self._vehicles = compiled.vehicles
        self._schedule = compiled.schedule
        self._gaits = compiled.gaits
        self._keyframe_id = compiled.keyframe_id
        self._engine = Engine(compiled.model, [v.body_id for v in self._vehicles.values()])
        self._streams = Streams(self._engine, compiled.streams)
        self._engine_step = self._engine.step
        self._model, self._data = self._engine.model, self._engine.data
        self.observe = self._engine.observe

        self._timestep = float(self._model.opt.timestep)
        self._clock = StepClock(self._timestep)
        self._names = tuple(self._vehicles)
        self._index = {name: i for i, name in enumerate(self._names)}
        self.reset()

    # ---- what it is ------------------------------------------------------------------------

    @property
    def model(self) -> mujoco.MjModel:
        """The MuJoCo model; change it only between steps."""
        return self._model

    @property
    def data(self) -> mujoco.MjData:
        """The MuJoCo data that is stepped."""
        return self._data

    @property
    def observed(self) -> mujoco.MjData:
        """The copy that the last ``observe(forces=True)`` evaluated; only to be read."""
        return self._engine.observed

    @property
    def streams(self) -> tuple[str, ...]:
        """Which of wind and current the scene has."""
        return self._streams.available

    @property
    def flow_road(self) -> str:
        """
        How wind and current reach the bodies.

        ``opt.wind``: one velocity for the whole scene. ``fluid_sim.medium``: each body meets its
        own, by place and time.
        """
        return self._streams.road

    @property
    def vehicles(self) -> Mapping[str, Vehicle]:
        """Vehicles by name."""
        return MappingProxyType(self._vehicles)

    @property
    def timestep(self) -> float:
        """Timestep of the scene [s]; rates count in it, also after ``set_timestep``."""
        return self._timestep

    @property
    def step_count(self) -> int:
        """Steps since the last reset."""
        return self._step

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
        if end > min(self._schedule.next_step, self._gaits.next_step) or self._wrenches:
            self._step_with_events(end)
            return
        done = self._engine_step(n)
        self._step += done
        if done != n:
            raise self._engine.divergence()

    def _step_with_events(self, end: int) -> None:
        while self._step < end:
            self._begin_step(self._step)
            stop = min(end, self._schedule.next_step, self._gaits.next_step)
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
            self._apply(change)
        self._gaits.write_due(tick, self._data.ctrl)
        for name, wrench in self._wrenches.items():
            wrench.write(self._vehicles[name], self._data)

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
        self._wrenches: dict[str, CommandedWrench] = {}

    def close(self) -> None:
        """Release nothing that Python would not; here so that every source can be closed."""

    # ---- commands --------------------------------------------------------------------------

    def vehicle(self, name: str) -> Vehicle:
        """Return a vehicle by name, or raise CommandError with the names that exist."""
        try:
            return self._vehicles[name]
        except KeyError:
            raise CommandError(
                f"vehicle '{name}' is not in the scene; it has: {listed(self._vehicles)}"
            ) from None

    def set_thrust(self, vehicle: str, values: Sequence[float] | Array) -> int:
        """
        Command the thrusters of a vehicle.

        Parameters
        ----------
        vehicle
            Vehicle name.
        values
            One command per thruster in the order of ``vehicles[name].thrusters`` [N].

        Returns
        -------
        int
            How many values were beyond the thrusters' range and therefore saturated.

        Raises
        ------
        CommandError
            Unknown vehicle, wrong length, or a value that is not finite.

        """
        target = self.vehicle(vehicle)
        return write_controls(self._data.ctrl,
            f"thrust of '{vehicle}'", values, target.thrusters, target.thruster_ids,
            target.thrust_range,
        )  # fmt: skip

    def set_joints(self, vehicle: str, values: Mapping[str, float] | Sequence[float]) -> int:
        """
        Command the joint actuators of a vehicle, by name or all in order; as ``set_thrust``.

        A mapping may name some of them; the others keep their commands. It ends the scene's gait
        of this vehicle until the next reset.
        """
        target = self.vehicle(vehicle)
        what = f"joints of '{vehicle}'"
        if isinstance(values, Mapping):
            unknown = [name for name in values if name not in target.joints]
            if unknown:
                raise CommandError(
                    f"{what}: '{unknown[0]}' is not one of them: {listed(target.joints)}"
                )
            held = dict(zip(target.joints, self._data.ctrl[target.joint_ids], strict=True))
            values = [{**held, **values}[name] for name in target.joints]
        saturated = write_controls(
            self._data.ctrl, what, values, target.joints, target.joint_ids, target.joint_range
        )
        self._gaits.end(vehicle)
        return saturated

    def set_wind(self, velocity: Sequence[float] | Array) -> None:
        """
        Set the wind [m/s, world axes, the direction that the air moves to].

        Raises
        ------
        CommandError
            Wrong length, not finite, or a scene without air.

        """
        self._streams.set('wind', finite('wind', velocity, 3))

    def set_current(self, velocity: Sequence[float] | Array) -> None:
        """Set the current of the water; as ``set_wind``."""
        self._streams.set('current', finite('current', velocity, 3))

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

    def enable_wind(self, enabled: bool) -> None:
        """Switch wind and current on or off, gusts included; commanded velocities are kept."""
        self._streams.enable(enabled)

    def set_wrench(
        self,
        vehicle: str,
        force: Sequence[float] | Array,
        torque: Sequence[float] | Array,
        frame: str = 'base_link',
    ) -> None:
        """
        Apply a wrench at a vehicle's base_link origin, on top of its thrust.

        Parameters
        ----------
        vehicle
            Vehicle name.
        force, torque
            [N] and [N m], shape (3,); zeros end it.
        frame
            Axes of both: ``base_link`` (they turn with the vehicle, step by step) or ``map``.

        Raises
        ------
        CommandError
            Unknown vehicle or frame, wrong length, not finite, or a base without a free joint.

        """
        target = self.vehicle(vehicle)
        wrench = CommandedWrench.checked(target, force, torque, frame)
        if not wrench.is_zero():
            self._wrenches[vehicle] = wrench
        elif self._wrenches.pop(vehicle, None):
            self._data.qfrc_applied[target.dof_address : target.dof_address + 6] = 0

    def _apply(self, change: ScheduledEvent) -> None:
        if change.wind is not None:
            self.set_wind(change.wind)
        if change.current is not None:
            self.set_current(change.current)
        for vehicle, values in change.thrust.items():
            self.set_thrust(vehicle, values)
        for vehicle, wrench in change.wrench.items():
            self.set_wrench(vehicle, wrench.force, wrench.torque, wrench.frame)

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
