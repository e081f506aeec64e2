# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The readings of a log under which two of its signals would agree: units and axes.

A signal is tried with its columns in every order and sign, each times the factors that a wrong
unit makes, summed up over intervals along the axes of the world or of the body.
"""

import itertools
from collections.abc import Callable, Iterator

import numpy as np

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.physics.environment.atmosphere import GRAVITY

#: Factors that a wrong unit makes, and the unit that then stands in the log.
_FACTORS = {
    'rates': {np.pi / 180: 'deg/s', 180 / np.pi: 'rad/s, not deg/s'},
    'specific_force': {GRAVITY: 'g', 1 / GRAVITY: 'm/s^2, not g'},
    'velocity': {
        0.01: 'cm/s',
        0.001: 'mm/s',
        1 / 3.6: 'km/h',
        0.514444: 'kn',
        0.3048: 'ft/s',
        100.0: 'position in cm',
        1000.0: 'position in mm',
        1 / 0.3048: 'position in ft',
    },
}
_NAMES = 'xyz'
_PLAIN = ((0, 1, 2), (1, 1, 1))
#: Orders and signs that have a name, in the world and in the body; their quantities.
_NAMED: dict[str, dict[tuple[tuple[int, ...], tuple[int, ...]], str]] = {
    'velocity': {((1, 0, 2), (1, 1, -1)): 'axes y x -z (ned, of one of them)'},
    'rates': {((0, 1, 2), (1, -1, -1)): 'axes x -y -z (frd, of one of them)'},
    'specific_force': {((0, 1, 2), (1, -1, -1)): 'axes x -y -z (frd, of one of them)'},
}
#: A reading is better where it leaves this share of what is unexplained [-].
_BETTER = 0.5
#: What each further word of a reading costs: the simpler one wins where two fit alike [-].
_WORD = 0.02

#: (change, sum of a signal) -> share of the change that is not explained.
Error = Callable[[Array, Array], float]


def best_reading(of: str, moved: Array, parts: Array, error: float, error_of: Error) -> str:
    """
    Return the reading of a signal that explains the change of another best.

    Parameters
    ----------
    of
        ``velocity``, ``rates`` or ``specific_force``.
    moved
        What the other changed by, over n intervals, shape (n, 3).
    parts
        Each column of the signal (last index) summed up along each axis (second to last) over the
        intervals, shape (n, 3, 3, 3).
    error
        Of the log as it is read now.
    error_of
        How far a sum is off.

    Returns
    -------
    str
        Such as ``unit deg/s and axes y x -z``; '' where none is clearly better.

    """
    readings = []
    for (order, signs), (factor, unit) in itertools.product(
        _orders(), ((1.0, ''), *_FACTORS[of].items())
    ):
        turned = sum(factor * sign * parts[:, :, k, j]
                     for k, (j, sign) in enumerate(zip(order, signs, strict=True)))  # fmt: skip
        words = [unit if ' in ' in unit else f'unit {unit}'] * bool(unit)
        if (order, signs) != _PLAIN:
            words.append(_NAMED[of].get((order, signs)) or _axes(order, signs))
        readings.append((error_of(moved, np.asarray(turned)) + _WORD * len(words), words))
    best, words = min(readings)
    return ' and '.join(words) if best < _BETTER * min(error, 1.0) else ''


def other_axes(moved: Array, sums: dict[str, Array], error: float, error_of: Error) -> str:
    """
    Return the axes in which a velocity explains the change of the position clearly better.

    Parameters
    ----------
    moved
        What the position changed by, shape (n, 3).
    sums
        Each of the other axes -> the velocity summed up as if it were in them, shape (n, 3).
    error
        Of the log as it is read now.
    error_of
        How far a sum is off.

    Returns
    -------
    str
        Such as ``flu``; '' where none is clearly better.

    """
    found = {axes: error_of(moved, summed) for axes, summed in sums.items()}
    best = min(found, key=found.__getitem__)
    return best if found[best] < _BETTER * min(error, 1.0) else ''


def _orders() -> Iterator[tuple[tuple[int, ...], tuple[int, ...]]]:
    return itertools.product(
        itertools.permutations(range(3)), itertools.product((1, -1), repeat=3)
    )


def _axes(order: tuple[int, ...], signs: tuple[int, ...]) -> str:
    return 'axes ' + ' '.join(
        f'{"-" if sign < 0 else ""}{_NAMES[i]}' for sign, i in zip(signs, order, strict=True)
    )
