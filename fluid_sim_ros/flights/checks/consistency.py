# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Whether the signals of a flight agree: units, axes, order of quaternions, and clocks.

A velocity is the change of a position, a rate that of an attitude, a specific force that of a
velocity. Each pair is compared by what one changes over an interval and the other adds up to,
which needs no derivative of a noisy signal.
"""

import itertools
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from fluid_sim_ros.flights.checks.check import LAGS, Check
from fluid_sim_ros.flights.checks.plausible import drive, pace, size, upright
from fluid_sim_ros.flights.checks.readings import best_reading, other_axes
from fluid_sim_ros.flights.flight import STATE, Flight, Signal
from fluid_sim_ros.flights.units import BODY, WORLD, rotations, to_enu, to_flu
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.physics.environment.atmosphere import GRAVITY

if TYPE_CHECKING:
    from scipy.spatial.transform import Rotation

#: Length of an interval [s], and at least so many samples of the slower signal.
_INTERVAL, _SAMPLES = {'velocity': 0.5, 'rates': 0.2, 'specific_force': 0.5}, 4
_MOST_INTERVALS = 4000
#: So many of them are looked at from the beginning on, half a day at the usual length.
_MOST_BEGINS = 1_000_000
#: Shares of the change that two signals may differ by: they agree; without a doubt [-].
_AGREE, _DOUBTFUL = 0.35, 0.03
#: Less motion than this tells nothing: [m], [rad], [m/s] rms over an interval.
_LEAST = {'velocity': 0.1, 'rates': 0.02, 'specific_force': 0.1}
#: Turn over an interval [rad].
_SMALL_TURN = 0.7


def check_flight(flight: Flight) -> list[Check]:
    """
    Compare the signals of a flight with each other.

    Parameters
    ----------
    flight
        In any state: what is not there is not compared.

    Returns
    -------
    list
        One entry per pair that could be compared.

    """
    signals = flight.signals
    checks = [pace(flight)] if set(STATE) & set(signals) else []
    checks += [size(flight)] if 'specific_force' in signals else []
    for of, change, words in (
        ('velocity', 'position', 'position against velocity'),
        ('rates', 'attitude', 'attitude against rates'),
        ('specific_force', 'velocity', 'velocity against specific force'),
    ):
        needed = {of, change} | ({'attitude'} if of == 'specific_force' else set())
        if needed <= set(signals):
            checks.append(_pair(flight, of, change, words))
    if {'specific_force', 'attitude'} <= set(signals) and not any(c.finding for c in checks):
        checks.append(upright(flight))
    driving = flight.actuators
    if driving is not None and 'specific_force' in signals:
        checks.append(drive(driving, signals['specific_force']))
    return checks


def _intervals(first: Signal, second: Signal, length: float) -> tuple[Array, Array]:
    """Return begin and end [s] of intervals that both signals cover."""
    slow = min(first.rate, second.rate)
    length = max(length, _SAMPLES / slow if slow > 0 else length)
    low = max(first.times[0], second.times[0]) + LAGS[-1]
    high = min(first.times[-1], second.times[-1]) - LAGS[-1]
    most = low + _MOST_BEGINS * length / 2  # times of a log may be far apart
    begins = np.arange(low, min(high - length, most), length / 2)
    begins = begins[:: max(1, len(begins) // _MOST_INTERVALS)]
    whole = np.ones(len(begins), dtype=np.bool_)
    for start, stop in (*first.gaps, *second.gaps):
        whole &= (begins + length < start) | (begins > stop)
    for signal in (first, second):  # a blow or a glitch is no change of unit
        jumps = signal.times[signal.outliers] if len(signal.outliers) else np.zeros(0)
        inside = np.searchsorted(jumps, begins + length) > np.searchsorted(jumps, begins)
        whole &= ~inside
    return begins[whole], begins[whole] + length


def _summed(signal: Signal, values: Array) -> Callable[[Array, Array], Array]:
    """Return the function (begins, ends) -> integral of a signal."""
    steps = 0.5 * (values[1:] + values[:-1]) * np.diff(signal.times)[:, None]
    total = np.concatenate([np.zeros((1, values.shape[1])), np.cumsum(steps, axis=0)])

    def integral(begins: Array, ends: Array) -> Array:
        columns = [
            np.interp(ends, signal.times, c) - np.interp(begins, signal.times, c) for c in total.T
        ]
        return np.stack(columns, axis=1)

    return integral


def _turns(wxyz: Array) -> Array:
    """Return rotation vectors from first to second attitudes (n, 2, 4), body axes."""
    turned = rotations(wxyz[:, 0]).inv() * rotations(wxyz[:, 1])
    vectors: Array = turned.as_rotvec()
    return vectors


def _change(flight: Flight, of: str, change: str, begins: Array, ends: Array) -> Array:
    signal = flight.signals[change]
    first, last = signal.between(begins), signal.between(ends)
    if change == 'attitude':
        return _turns(np.stack([first, last], axis=1))
    moved = last - first
    if of == 'specific_force':
        moved[:, 2] += GRAVITY * (ends - begins)
    return moved


def _pair(flight: Flight, of: str, change: str, words: str) -> Check:
    signal, other = flight.signals[of], flight.signals[change]
    begins, ends = _intervals(signal, other, _INTERVAL[of])
    if len(begins) < 10:
        return Check(words, of, None, None)
    values = signal.values
    if of == 'specific_force':
        values = _to_world(flight, signal.times).apply(values)
    integral = _summed(signal, values)
    moved = _change(flight, of, change, begins, ends)
    if of == 'rates':  # the sum of rates is a rotation vector for small turns only
        small = np.linalg.norm(moved, axis=1) < _SMALL_TURN
        if small.sum() < 10:
            return Check(words, of, None, None)
        begins, ends, moved = begins[small], ends[small], moved[small]
    moving = moved - moved.mean(axis=0) if of == 'specific_force' else moved
    if float(np.sqrt((moving**2).sum(axis=1).mean())) < _LEAST[of]:
        return Check(words, of, None, None)
    error = _error(moving, integral(begins, ends), of)
    finding = ''
    if of == 'velocity' and error > _DOUBTFUL:
        finding = _other_axes(flight, moving, begins, ends, error)
    offset = _offset(moving, integral, begins, ends, of)
    if error >= _AGREE:
        there = _error(moving, integral(begins + offset, ends + offset), of)
        if not finding and there < _AGREE and abs(offset) < LAGS[-1]:
            finding = (
                f'{of}: it is the change of {change} {1e3 * abs(offset):.0f} ms '
                f'{"later" if offset > 0 else "earlier"}; their clocks differ: say offset: '
                f'{-offset:.3g} at {of}, or {offset:.3g} at {change}, in the mapping'
            )
        finding = finding or _finding(flight, of, change, (moving, begins, ends), error)
    return Check(words, of, error, None if finding else offset, finding)


def _to_world(flight: Flight, times: Array) -> 'Rotation':
    return rotations(flight.signals['attitude'].between(times))


def _other_axes(flight: Flight, moved: Array, begins: Array, ends: Array, error: float) -> str:
    """Return what is said of a velocity that fits better in the body's axes, or the world's."""
    signal = flight.signals['velocity']
    if 'attitude' not in flight.signals:
        return ''
    world, stated = _to_world(flight, signal.times), signal.stated.rpartition(' ')[2]
    if stated in BODY:  # it was turned: as it stands in the log
        raw = to_flu(world.inv().apply(signal.values), stated)
        tried = {axes: to_enu(raw, axes) for axes in WORLD}
    else:
        raw = to_enu(signal.values, stated)
        tried = {axes: world.apply(to_flu(raw, axes)) for axes in BODY}
    sums = {axes: _summed(signal, values)(begins, ends) for axes, values in tried.items()}
    axes = other_axes(moved, sums, error, lambda m, s: _error(m, s, 'velocity'))
    if not axes:
        return ''
    of = 'body' if axes in BODY else 'world'
    return (
        f'velocity: {100 * error:.0f} % of the change of position is unexplained; it looks like '
        f'a velocity along the axes of the {of}: say axes: {axes} at velocity in the mapping'
    )


def _finding(
    flight: Flight, of: str, change: str, intervals: tuple[Array, Array, Array], error: float
) -> str:
    """Return the reading of the log under which two signals would agree, as a line."""
    moved, begins, ends = intervals
    parts = _parts(flight, of, begins, ends)
    reading = best_reading(of, moved, parts, error, lambda m, s: _error(m, s, of))
    other = _other_attitude(flight) if of == 'rates' else ''
    if other:
        return f'attitude: it does not turn as the rates say, but does {other}'
    begin = f'{of}: it is not the change of {change} ({100 * error:.0f} % of it unexplained)'
    if reading:
        return f'{begin}; it looks like {reading}: see unit and axes in the mapping'
    return f'{begin}; see unit, axes and order in the mapping'


def _error(moved: Array, summed: Array, of: str) -> float:
    """Return what of a change is not explained, as a share."""
    if of == 'specific_force':  # the bias of an accelerometer explains nothing
        summed = summed - summed.mean(axis=0)
    return float(np.sqrt(((moved - summed) ** 2).sum() / (moved**2).sum()))


def _offset(
    moved: Array, integral: Callable[[Array, Array], Array], begins: Array, ends: Array, of: str
) -> float:
    """Return the offset of the clocks at which two signals agree best [s]."""
    errors = np.array([_error(moved, integral(begins + x, ends + x), of) for x in LAGS])
    best = int(np.argmin(errors))
    if 0 < best < len(errors) - 1:
        before, here, after = errors[best - 1 : best + 2] ** 2
        bend = before - 2 * here + after
        if bend > 0:
            return float(LAGS[best] + 0.5 * (before - after) / bend * (LAGS[1] - LAGS[0]))
    return float(LAGS[best])


def _parts(flight: Flight, of: str, begins: Array, ends: Array) -> Array:
    """Return each column of a signal summed up along each of its axes, shape (n, 3, 3, 3)."""
    signal = flight.signals[of]
    parts = np.zeros((len(begins), 3, 3, 3))
    if of != 'specific_force':
        summed = _summed(signal, signal.values)(begins, ends)
        for k in range(3):
            parts[:, k, k] = summed
        return parts
    axes = _to_world(flight, signal.times).as_matrix()
    for k, j in itertools.product(range(3), repeat=2):
        parts[:, :, k, j] = _summed(signal, axes[:, :, k] * signal.values[:, j : j + 1])(
            begins, ends
        )
    return parts


def _other_attitude(flight: Flight) -> str:
    """Return with which other reading of the quaternions the attitude turns as the rates say."""
    attitude, rates = flight.signals['attitude'], flight.signals['rates']
    begins, ends = _intervals(rates, attitude, _INTERVAL['rates'])
    summed = _summed(rates, rates.values)(begins, ends)
    swapped = 'with the other order of its quaternions; see order: wxyz or xyzw in the mapping'
    inverse = 'as the inverse, of the world in the body: conjugate its quaternions'
    tried = (
        (np.roll(attitude.values, 1, axis=1), swapped),
        (np.roll(attitude.values, -1, axis=1), swapped),
        (attitude.values * np.array([1.0, -1.0, -1.0, -1.0]), inverse),
    )
    errors = []
    for values, words in tried:
        other = Signal(**{**attitude.__dict__, 'values': values})
        pairs = np.stack([other.between(begins), other.between(ends)], axis=1)
        errors.append((_error(_turns(pairs), summed, 'rates'), words))
    least, words = min(errors)
    return words if least < _AGREE else ''
