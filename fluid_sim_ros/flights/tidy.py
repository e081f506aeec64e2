# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What of a signal can be used: rising times, finite numbers; holes and jumps are marked."""

import numpy as np

from fluid_sim_ros.flights.flight import Flags
from fluid_sim_ros.physics.arrays import Array

#: Samples farther apart than so many usual distances are a gap.
_GAP = 5.0
#: ... and than this [s]: streams that are written on change have none below it.
_LEAST_GAP = 0.02
#: A sample that is off from the median of five by so many robust deviations is an outlier.
_JUMP = 20.0
#: ... and by this much, in the unit of its quantity: estimators correct themselves by less.
_LEAST_JUMP = {
    'position': 0.05, 'attitude': 0.05, 'velocity': 0.3, 'rates': 1.0, 'specific_force': 5.0,
}  # fmt: skip


def usable(times: Array, values: Array) -> tuple[Flags, dict[str, int]]:
    """
    Return which samples are used, and how many are not by reason.

    Parameters
    ----------
    times
        [s], shape (n,).
    values
        Shape (n, size).

    """
    finite = np.isfinite(times) & np.isfinite(values).all(axis=1)
    before = np.maximum.accumulate(np.where(np.isfinite(times), times, -np.inf))
    rises = np.ones(len(times), dtype=np.bool_)
    rises[1:] = times[1:] > before[:-1]
    again = np.zeros(len(times), dtype=np.bool_)
    again[1:] = times[1:] == before[:-1]
    counts = {
        'not finite': int((~finite).sum()),
        'at a time that goes back': int((finite & ~rises & ~again).sum()),
        'at the time of the sample before': int((finite & again).sum()),
    }
    return finite & rises, {reason: count for reason, count in counts.items() if count}


def find_gaps(times: Array) -> tuple[tuple[float, float], ...]:
    """
    Return the (begin, end) of each hole [s].

    Parameters
    ----------
    times
        Rising [s], shape (n,).

    """
    if len(times) < 3:
        return ()
    apart = np.diff(times)
    wide = np.flatnonzero(apart > max(_LEAST_GAP, _GAP * float(np.median(apart))))
    return tuple((float(times[i]), float(times[i + 1])) for i in wide)


def missing_share(times: Array) -> float:
    """
    Return the share of samples that a steady log would have and this one has not.

    Parameters
    ----------
    times
        Rising [s], shape (n,).

    """
    if len(times) < 10:
        return 0.0
    apart = np.diff(times)
    steady = np.rint(apart / np.median(apart))
    # of a stream that is written on change, the distances are of any length
    if float(np.mean(np.abs(apart / np.median(apart) - steady) < 0.1)) < 0.8:
        return 0.0
    return float(1.0 - len(apart) / np.maximum(steady, 1.0).sum())


def find_outliers(quantity: str, values: Array) -> Flags:
    """
    Return which samples jump away from both neighbours.

    Parameters
    ----------
    quantity
        A key of ``QUANTITIES``.
    values
        In its unit, shape (n, size).

    """
    count = len(values)
    if count < 5:
        return np.zeros(count, dtype=np.bool_)
    padded = np.pad(values, ((2, 2), (0, 0)), mode='edge')
    middle = np.median(np.stack([padded[i : i + count] for i in range(5)]), axis=0)
    off = np.abs(values - middle)
    # the usual distance from the median; a signal that is constant for long has none of it
    scale = np.maximum(1.4826 * np.median(off, axis=0), off.mean(axis=0))
    floor = _LEAST_JUMP.get(quantity, np.inf)
    flags: Flags = (off > np.maximum(_JUMP * scale, floor)).any(axis=1)
    return flags
