# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Whether fitted values are worse than those before where the fit did not look."""

from collections.abc import Sequence

import numpy as np

from fluid_sim_ros.flights.flight import Flight
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.reality.driven import comparable_scene, drive
from fluid_sim_ros.reality.fitting.disturbance import with_flow
from fluid_sim_ros.reality.fitting.solver import Task
from fluid_sim_ros.reality.flying import Flyer
from fluid_sim_ros.reality.parameter import Parameter
from fluid_sim_ros.reality.parameters import edit_of
from fluid_sim_ros.reality.residual.numbers import summary
from fluid_sim_ros.reality.residual.residuals import residuals
from fluid_sim_ros.reality.windows import Windows

#: Specific force that is off by less than this share of g needs no word, nor a growth below this
#: factor: vibration alone is of this size.
_SMALL, _WORSE = 0.05, 1.5


def doubts(
    flights: Sequence[Flight],
    windows: Sequence[Windows],
    task: Task,
    chosen: Sequence[Parameter],
    values: Array,
) -> list[str]:
    """
    Compare the specific force along z at the measured states before and after a fit.

    A window in which the model soon points elsewhere than the vehicle pulls the values to whatever
    turns it less: with too little thrust it tumbles less. Such values fit their windows, and
    nothing else. The accelerometer is no part of what is fitted, so it tells.

    Parameters
    ----------
    flights, windows
        That were fitted to, and their windows.
    task
        What was fitted.
    chosen, values
        The parameters, and what they came to, shape (p,).

    Returns
    -------
    list
        One line for each flight whose specific force is further off than before.

    """
    before = np.array([parameter.value for parameter in chosen])
    lines = []
    for flight, part in zip(flights, windows, strict=True):
        if 'specific_force' not in flight.signals:
            continue
        first, last = (_off(flight, part, task, chosen, each) for each in (before, values))
        if last > max(_SMALL, _WORSE * first):
            lines.append(
                f'{flight.name}: with the fitted values the specific force along z is '
                f'{100 * last:.0f} % of g off, with those before {100 * first:.0f} %: do not use '
                'them. The model turns otherwise than the vehicle, and these values make it turn '
                'less: fit what turns it as well (inertia.xy, com.x, com.y), begin windows as '
                'measured (--start measured), or take shorter ones (--window)'
            )
    return lines


def _off(
    flight: Flight, part: Windows, task: Task, chosen: Sequence[Parameter], values: Array
) -> float:
    """Return the rms of what the specific force along z lacks, over g."""
    scene = comparable_scene(task.model)
    edit = with_flow(edit_of(chosen, values), flight, chosen, values)
    driven = drive(scene, flight, task.outputs, settings=task.settings, edit=edit)
    found = summary(residuals(Flyer(driven, 1), part))
    return float(np.nan_to_num(found['specific_force']['z_rms_of_g'], nan=np.inf))
