# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Which windows of a flight are flown, and in which something holds the vehicle up."""

from dataclasses import replace

import numpy as np

from fluid_sim_ros.flights.flight import Flags, FlightError
from fluid_sim_ros.flights.units import rotations
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.physics.environment.atmosphere import GRAVITY
from fluid_sim_ros.reality.flying import Flyer
from fluid_sim_ros.reality.residual.residuals import accelerations
from fluid_sim_ros.reality.windows import ATTITUDE, POSITION, VELOCITY, Windows, state_at

#: What a model lacks of the force upward, as a share of the weight, that only a ground, a rope or
#: a hand can give; and of a time of standing still, where that is felt.
_HELD, _MOST_OF_IT = 0.5, 0.5
#: A vehicle whose model gives less than this share of its weight does not fly [-].
_LIFTLESS = 0.3
#: A model may be this much too weak, before a flight is none [-].
_WEAKEST = 3.0
#: A vehicle stands still below these: [m/s] over a window, and at its begin.
_STILL = (0.02, 0.05)
_FEW = 5
ON_GROUND = 'stand on something that the model has not'
CARRIED = 'are carried or towed: they do not fall, with hardly any force of the model upward'


def airborne(windows: Windows, flyer: Flyer) -> tuple[Windows, dict[str, int]]:
    """
    Leave out windows in which something holds the vehicle that the model has not.

    The force upward is measured by how the velocity changes over a window, and what the model
    gives (thrust, lift, buoyancy) is taken at its middle. Where much of the weight is missing, in
    a vehicle that stands still or whose model gives next to nothing, a ground, a rope or a hand
    holds it. What floats lacks nothing, and neither does what hovers. A model that is too weak
    throughout is no ground: it is judged by what it gives in motion.

    Parameters
    ----------
    windows
        Of the flight.
    flyer
        Of the driven model.

    Returns
    -------
    windows, left_out
        Those that are left, and how many are not, by reason.

    Raises
    ------
    FlightError
        If none is left.

    """
    start, end = windows.measured(0.0), windows.measured(windows.length)
    moved = np.linalg.norm(end[:, POSITION] - start[:, POSITION], axis=1)
    still = moved < _STILL[0] * windows.length
    still &= np.linalg.norm(start[:, VELOCITY], axis=1) < _STILL[1]
    measured = 1.0 + (end[:, 9] - start[:, 9]) / windows.length / GRAVITY
    given = _given(windows, flyer)
    flying = ~still & (given > _LIFTLESS)
    weak = 1.0
    if flying.sum() >= _FEW:
        weak = float(np.clip(np.median(measured[flying] / given[flying]), 1.0, _WEAKEST))
    lacks = measured - weak * given > _HELD
    standing = still & _runs_with(still, lacks, windows.begins)
    carried = ~still & lacks & (weak * given < _LIFTLESS)
    if (standing | carried).all():
        raise FlightError(
            f'{windows.flight.raw.path}: no window flies: the vehicle stands still or is carried '
            f'throughout, while the model gives {100 * np.median(given):.0f} % of the weight. If '
            'it did fly, the model is far too weak or its commands mean something else '
            '(--mapping); if not, give --from and --to of the flight'
        )
    kept = replace(windows, begins=windows.begins[~(standing | carried)])
    left = {ON_GROUND: int(standing.sum()), CARRIED: int(carried.sum())}
    return kept, {why: count for why, count in left.items() if count}


def _given(windows: Windows, flyer: Flyer) -> Array:
    """Return the force upward that the model gives in the middle of windows, over the weight."""
    middle = windows.begins + 0.5 * windows.length
    force = accelerations(flyer, windows.flight, middle).force
    attitude = rotations(state_at(windows.flight, middle)[:, ATTITUDE])
    up: Array = attitude.apply(force)[:, 2] / GRAVITY
    return up


def _runs_with(still: Flags, lacks: Flags, begins: Array) -> Flags:
    """Return which windows belong to a time of standing still in which the ground was felt."""
    felt: Flags = np.zeros(len(still), dtype=np.bool_)
    if len(begins) > 1:
        steps = np.diff(begins)
        edges = np.flatnonzero((still[1:] != still[:-1]) | (steps > 10 * np.median(steps))) + 1
    else:
        edges = np.zeros(0, dtype=np.int64)
    for part in np.split(np.arange(len(still)), edges):
        # of a run that hovers, a moment without thrust is no ground
        felt[part] = still[part] & (lacks[part].mean() > _MOST_OF_IT)
    return felt
