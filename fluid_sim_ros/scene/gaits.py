# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
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
    period
        Between two of them [s].
    wave
        What is evaluated.
    controls
        Addresses of the joints' commands in ``mjData.ctrl``, shape (n,).
    rounded
        A line where beats are no whole number of ticks apart, otherwise empty.

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
        self.controls = vehicle.joint_ids
        self.wave = JointWave(
            gait.frequency,
            tuple(gait.amplitudes),
            tuple(gait.phases),
            tuple(gait.offsets),
            gait.ramp,
        )
        self.period = float(1 / exact(gait.rate))

    def next_due(self, tick: int) -> int:
        """
        Return the first tick of an evaluation, from a tick on.

        Parameters
        ----------
        tick
            0 or more.

        """
        return tick - 1 + self.beat.until_next(tick - 1)

    def write(self, tick: int, control: Array) -> None:
        """
        Write the joint commands if the wave is evaluated at a tick.

        Parameters
        ----------
        tick
            0 or more.
        control
            ``mjData.ctrl``; changed.

        """
        if self.beat.due(tick):
            control[self.controls] = self.wave.angles(self.beat.index(tick) * self.period)


class Gaits:
    """
    The waves of all vehicles.

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
    names
        Of the vehicles that have a wave.
    running
        Names of the vehicles whose waves run.
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
        self.names = tuple(self._all)
        self.rounded = tuple(cycle.rounded for cycle in self._all.values() if cycle.rounded)
        self.running = self.names

    def cycles(self) -> list[GaitCycle]:
        """Return the waves that run."""
        return [self._all[name] for name in self.running]

    def next_due(self, tick: int) -> int:
        """
        Return the first tick, from a tick on, at which any running wave is evaluated (``NEVER``).

        Parameters
        ----------
        tick
            0 or more.

        """
        return min((cycle.next_due(tick) for cycle in self.cycles()), default=NEVER)
