# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A simulation at one step boundary: what it shows of itself, and what it can go back to."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.scene.schedule import Event
from fluid_sim_ros.simulation.actuation import CommandedWrench
from fluid_sim_ros.simulation.wind_and_current import SavedStreams
from fluid_sim_ros.step_clock import Pace


@dataclass(frozen=True)
class VehicleState:
    """
    State of one vehicle's base_link.

    Attributes
    ----------
    position_w
        Position of the base_link origin in the world (ENU) [m], shape (3,).
    quat_wb_wxyz
        Rotation from base_link (FLU) to world, unit quaternion, scalar first, shape (4,).
    velocity_b, omega_b
        Velocity of the origin [m/s] and angular velocity [rad/s], base_link axes, shape (3,).
    medium_velocity_w
        Velocity of the undisturbed medium at the origin, world axes [m/s], shape (3,).

    """

    position_w: Array
    quat_wb_wxyz: Array
    velocity_b: Array
    omega_b: Array
    medium_velocity_w: Array


@dataclass(frozen=True)
class Snapshot:
    """
    The simulation at one step boundary; its arrays are copies.

    Attributes
    ----------
    time
        Simulated time, step count times timestep [s].
    step
        Steps since the last reset.
    vehicles
        State per vehicle name.

    """

    time: float
    step: int
    vehicles: Mapping[str, VehicleState]

    @classmethod
    def of(cls, time: float, step: int, names: Iterable[str], rows: Array) -> 'Snapshot':
        """
        Return the snapshot that observed rows are; they are copied.

        Parameters
        ----------
        time, step
            Simulated time [s], and steps since the last reset.
        names
            Of the vehicles.
        rows
            One per vehicle, with the columns of ``plugins.native``.

        Returns
        -------
        Snapshot
            Of all vehicles.

        """
        states = {
            name: VehicleState(
                position_w=row[nat.POSITION],
                quat_wb_wxyz=row[nat.QUATERNION],
                velocity_b=row[nat.LINEAR_VELOCITY],
                omega_b=row[nat.ANGULAR_VELOCITY],
                medium_velocity_w=row[nat.MEDIUM_VELOCITY],
            )
            for name, row in zip(names, rows.copy(), strict=True)
        }
        return cls(time, step, states)


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
