# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What a simulation is told: thrust, joints, wrenches, wind and current; checked and held."""

from collections.abc import Callable, Mapping, Sequence

from fluid_sim_ros.errors import CommandError, did_you_mean, listed
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins.exchange import ControlPorts
from fluid_sim_ros.scene.scene import CompiledScene
from fluid_sim_ros.scene.vehicle import Vehicle
from fluid_sim_ros.schema.scene import ScheduledEvent
from fluid_sim_ros.simulation.actuation import CommandedWrench, Controls, finite
from fluid_sim_ros.simulation.engine import Engine
from fluid_sim_ros.simulation.step_commands import StepCommands
from fluid_sim_ros.simulation.wind_and_current import WindAndCurrent


class Commands:
    """
    The commands of a simulation: checked, written where the next step reads them, held.

    A commanded wrench turns with its vehicle, so it is written anew at each step.

    Parameters
    ----------
    engine
        Model and data.
    compiled
        Vehicles and gaits.
    on_unfelt
        See ``WindAndCurrent``.

    Attributes
    ----------
    streams
        Wind and current.
    in_steps
        What is written at each step: wrenches and gaits.

    """

    def __init__(
        self,
        engine: Engine,
        compiled: CompiledScene,
        on_unfelt: Callable[[str], None] | None = None,
    ) -> None:
        self._vehicles = compiled.vehicles
        self.streams = WindAndCurrent(engine, compiled.streams, on_unfelt)
        self.in_steps = StepCommands(engine, compiled.gaits, compiled.vehicles)
        control = engine.data.ctrl
        self._thrusts = {
            v.name: Controls(
                control,
                f"thrust of '{v.name}'",
                v.thrusters,
                v.thruster_ids,
                v.thrust_range,
                v.thrust_scale,
            )
            for v in self._vehicles.values()
        }
        self._joints = {
            v.name: Controls(
                control, f"joints of '{v.name}'", v.joints, v.joint_ids, v.joint_range
            )
            for v in self._vehicles.values()
        }

    def vehicle(self, name: str) -> Vehicle:
        """
        Return a vehicle.

        Parameters
        ----------
        name
            Vehicle name.

        Returns
        -------
        Vehicle
            With its names as ids of the model.

        Raises
        ------
        CommandError
            If the scene has no such vehicle, with the names that it has.

        """
        try:
            return self._vehicles[name]
        except KeyError:
            raise CommandError(
                f"vehicle '{name}' is not in the scene{did_you_mean(name, self._vehicles)} "
                f'it has: {listed(self._vehicles)}'
            ) from None

    def ports(self, vehicle: str) -> tuple[ControlPorts, ControlPorts]:
        """
        Return where the compiled exchange with an autopilot writes to.

        Parameters
        ----------
        vehicle
            Vehicle name; a gait of its joints is to be ended before.

        Returns
        -------
        thrusters, joints
            Valid as long as this object lives.

        """
        return self._thrusts[vehicle].ports(), self._joints[vehicle].ports()

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
        if vehicle not in self._thrusts:
            self.vehicle(vehicle)  # says which there are
        return self._thrusts[vehicle].write(values)

    def set_joints(self, vehicle: str, values: Mapping[str, float] | Sequence[float]) -> int:
        """
        Command the joint actuators of a vehicle, by name or all in order.

        It ends the scene's gait of this vehicle until the next reset.

        Parameters
        ----------
        vehicle
            Vehicle name.
        values
            Commands in the unit of each actuator [rad], [m]; a mapping may name some of the
            joints, the others keep their commands.

        Returns
        -------
        int
            How many values were beyond the actuators' range and therefore saturated.

        Raises
        ------
        CommandError
            Unknown vehicle or joint, wrong length, or a value that is not finite.

        """
        target, joints = self.vehicle(vehicle), self._joints[vehicle]
        if isinstance(values, Mapping):
            unknown = [name for name in values if name not in target.joints]
            if unknown:
                raise CommandError(
                    f"joints of '{vehicle}': '{unknown[0]}' is not one of them: "
                    f'{listed(target.joints)}'
                )
            held = dict(zip(target.joints, joints.read(), strict=True))
            values = [{**held, **values}[name] for name in target.joints]
        saturated = joints.write(values)
        self.in_steps.end_gait(vehicle)
        return saturated

    def set_wind(self, velocity: Sequence[float] | Array) -> None:
        """
        Set the wind.

        Parameters
        ----------
        velocity
            Of the air, in the direction that it moves to [m/s], world axes, shape (3,).

        Raises
        ------
        CommandError
            Wrong length, not finite, a scene without air, or no body that feels it.

        """
        self.streams.set('wind', finite('wind', velocity, 3))

    def set_current(self, velocity: Sequence[float] | Array) -> None:
        """
        Set the current.

        Parameters
        ----------
        velocity
            Of the water, in the direction that it moves to [m/s], world axes, shape (3,).

        Raises
        ------
        CommandError
            Wrong length, not finite, a scene without water, or no body that feels it.

        """
        self.streams.set('current', finite('current', velocity, 3))

    def enable_wind(self, enabled: bool) -> None:
        """
        Switch wind and current on or off, gusts included; commanded velocities are kept.

        Parameters
        ----------
        enabled
            Whether they act.

        """
        self.streams.enable(enabled)

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
        if wrench.is_zero():
            self.in_steps.end_wrench(vehicle)
        else:
            self.in_steps.hold_wrenches({**self.in_steps.wrenches, vehicle: wrench})

    def apply(self, change: ScheduledEvent) -> None:
        """
        Command all that a scheduled event changes.

        Parameters
        ----------
        change
            Its time does not matter.

        Raises
        ------
        CommandError
            As for the commands one by one.

        """
        if change.wind is not None:
            self.set_wind(change.wind)
        if change.current is not None:
            self.set_current(change.current)
        for vehicle, values in change.thrust.items():
            self.set_thrust(vehicle, values)
        for vehicle, wrench in change.wrench.items():
            self.set_wrench(vehicle, wrench.force, wrench.torque, wrench.frame)
