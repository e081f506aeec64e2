"""Joint waves of a scene: what its swimmers and wings do until somebody commands their joints."""

from collections.abc import Mapping

from fluid_sim_ros.control.gait import JointWave
from fluid_sim_ros.errors import ConfigError, did_you_mean, listed
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.scene.vehicle import Vehicle
from fluid_sim_ros.schema.scene import Gait
from fluid_sim_ros.step_clock import NEVER, Beat, exact


class GaitCycle:
    """
    One vehicle's wave, evaluated at each ``beat`` and held in between.

    Parameters
    ----------
    gait
        The wave.
    vehicle
        Whose joints.
    timestep
        Of the scene [s].

    Attributes
    ----------
    beat
        At which ticks it is evaluated.
    rounded
        A line where these are no whole number of ticks apart, otherwise empty.

    Raises
    ------
    ConfigError
        If the wave does not fit the joints, or its rate is above the step rate.

    """

    def __init__(self, gait: Gait, vehicle: Vehicle, timestep: float) -> None:
        where = f"gait of '{vehicle.name}'"
        if len(gait.amplitudes) != len(vehicle.joints):
            raise ConfigError(
                f'{where}: has {len(gait.amplitudes)} amplitudes; it needs one for each of: '
                f'{listed(vehicle.joints)}'
            )
        self.beat = Beat.at_rate(gait.rate, timestep, where)
        self.rounded = (
            ''
            if self.beat.whole
            else f'{where}: rate {gait.rate:g} Hz does not divide the step rate of '
            f'{1 / timestep:g} Hz; met on average, each value at the nearest step'
        )
        self._ids = vehicle.joint_ids
        self._wave = JointWave(
            gait.frequency,
            tuple(gait.amplitudes),
            tuple(gait.phases),
            tuple(gait.offsets),
            gait.ramp,
        )
        self._tick = float(1 / exact(gait.rate))

    def write(self, step: int, control: Array) -> None:
        """
        Write the joint commands of a tick that is due.

        Parameters
        ----------
        step
            The tick.
        control
            ``mjData.ctrl``; changed.

        """
        control[self._ids] = self._wave.angles(self.beat.index(step) * self._tick)


class Gaits:
    """
    The waves of all vehicles; ``next_step`` is what the step loop looks at.

    A command on a vehicle's joints ends its wave until the next reset.

    Parameters
    ----------
    gaits
        Wave by vehicle name.
    vehicles
        Those that there are, by name.
    timestep
        Of the scene [s].
    where
        What an error begins with.

    Attributes
    ----------
    running
        Names of the vehicles whose waves run.
    next_step
        Tick of the next evaluation.
    rounded
        A line for each wave whose rate does not divide the step rate.

    Raises
    ------
    ConfigError
        If a vehicle is not in the scene, or its wave does not fit it.

    """

    def __init__(
        self,
        gaits: Mapping[str, Gait],
        vehicles: Mapping[str, Vehicle],
        timestep: float,
        where: str,
    ) -> None:
        for name in gaits:
            if name not in vehicles:
                raise ConfigError(
                    f"{where}: gait: vehicle '{name}' is not in the scene"
                    f'{did_you_mean(name, vehicles)} it has: {listed(vehicles)}'
                )
        self._all = {name: GaitCycle(g, vehicles[name], timestep) for name, g in gaits.items()}
        self.rounded = tuple(cycle.rounded for cycle in self._all.values() if cycle.rounded)
        self.running: tuple[str, ...] = ()
        self.next_step = NEVER
        self.restart(0, tuple(self._all))

    def restart(self, step: int, running: tuple[str, ...] | None = None) -> None:
        """
        Go on from a tick.

        Parameters
        ----------
        step
            The tick.
        running
            Names of the vehicles whose waves run; None: all of the scene.

        """
        self.running = tuple(self._all) if running is None else running
        self._schedule_after(step - 1)

    def end(self, vehicle: str) -> None:
        """
        End a vehicle's wave, if it has one.

        Parameters
        ----------
        vehicle
            Its name.

        """
        if vehicle in self.running:
            self.running = tuple(name for name in self.running if name != vehicle)
            self._schedule_after(self.next_step - 1)

    def write_due(self, step: int, control: Array) -> None:
        """
        Write the commands that take effect at a tick.

        Parameters
        ----------
        step
            The tick.
        control
            ``mjData.ctrl``; changed.

        """
        if step < self.next_step:
            return
        for name in self.running:
            if self._all[name].beat.due(step):
                self._all[name].write(step, control)
        self._schedule_after(step)

    def _schedule_after(self, step: int) -> None:
        beats = [self._all[name].beat for name in self.running]
        self.next_step = min((step + b.until_next(step) for b in beats), default=NEVER)
