# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A compiled simulation of a sweep: the start of a case, and the columns of its row."""

import dataclasses
from collections.abc import Mapping
from typing import Any

import numpy as np

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.simulation.batch import BatchRuns
from fluid_sim_ros.simulation.engine import Largest
from fluid_sim_ros.sweep.hold_controller import HoldController
from fluid_sim_ros.sweep.run_watch import RunWatch
from fluid_sim_ros.sweep.sweep_file import Value

#: Columns of each vehicle: its motion at the end, and the largest values (engine.Largest).
COLUMNS = (
    *(f'{axis}_m' for axis in 'xyz'), *(f'q{part}' for part in 'wxyz'),
    *(f'v{axis}_m_s' for axis in 'xyz'), *(f'w{axis}_rad_s' for axis in 'xyz'),
    'largest_speed_m_s', 'largest_tilt_rad', 'farthest_m',
)  # fmt: skip
#: The motion in an observation row.
MOTION = slice(nat.POSITION.start, nat.ANGULAR_VELOCITY.stop)

Row = dict[str, Any]


@dataclasses.dataclass
class CompiledRun:
    """
    A compiled simulation, its run in steps, and the controller in its loop.

    ``columns`` are the names of what comes out, vehicle by vehicle; ``many`` flies undisturbed
    runs together, None where they are disturbed.
    """

    simulation: Simulation
    steps: int
    period: int
    controller: HoldController | None
    largest: Largest
    watch: RunWatch
    columns: tuple[str, ...]
    many: BatchRuns | None


_FLOWS = ('wind', 'current')


def start(simulation: Simulation, values: Mapping[str, Value]) -> None:
    """
    Go to the start of a case, with what it changes at run time.

    Parameters
    ----------
    simulation
        Of the case's settings.
    values
        Of the case: wind, current [m/s] and thrust (share of its upper limit) are taken.

    Raises
    ------
    ConfigError
        If the scene cannot take one of them.

    """
    simulation.reset()
    flows: dict[str, list[float]] = {}
    for key, value in values.items():
        kind, _, name = key.partition('.')
        if kind in _FLOWS:
            flows.setdefault(kind, [0.0, 0.0, 0.0])['xyz'.index(name)] = float(value)
        elif kind == 'thrust':
            vehicle = simulation.vehicle(name)
            if not vehicle.thrusters:
                raise ConfigError(f"vary: '{key}': the vehicle has no thrusters")
            simulation.set_thrust(name, float(value) * vehicle.thrust_range[:, 1])
    for kind, velocity in flows.items():
        set_flow = simulation.set_wind if kind == 'wind' else simulation.set_current
        set_flow(velocity)


def row_begun(index: int, values: Mapping[str, Value]) -> Row:
    """
    Return the row of a run as it begins.

    Parameters
    ----------
    index
        Of the case.
    values
        Of the case.

    Returns
    -------
    dict
        The row, with status ``ok`` and at time 0 [s].

    """
    begun = {'status': 'ok', 'message': '', 'warnings': None, 'time_s': 0.0}
    return {'run': index, **values, **begun}


def columns(ready: CompiledRun, motion: Array, largest: Array) -> Row:
    """
    Return what came out, from the vehicles' motion and its largest values.

    Parameters
    ----------
    ready
        Whose columns.
    motion
        Position [m], quaternion w x y z, velocity [m/s] and rate [rad/s] in body axes; shape
        (vehicles, 13).
    largest
        Speed [m/s], tilt [rad] and distance [m] from the start; shape (vehicles, 3).

    Returns
    -------
    dict
        Number by column.

    """
    out = np.concatenate((motion, largest), axis=1).ravel().tolist()
    return dict(zip(ready.columns, out, strict=True))
