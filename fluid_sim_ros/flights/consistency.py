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
from dataclasses import dataclass

import numpy as np

from fluid_sim_ros.flights.flight import Flight, Signal
from fluid_sim_ros.flights.units import rotations
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.physics.environment.atmosphere import GRAVITY

#: Length of an interval [s], and at least so many samples of the slower signal.
_INTERVAL, _SAMPLES = {'velocity': 0.5, 'rates': 0.2, 'specific_force': 0.5}, 4
_MOST_INTERVALS = 4000
#: So many of them are looked at from the beginning on, half a day at the usual length.
_MOST_BEGINS = 1_000_000
#: Shares of the change that two signals may differ by: they agree; no other reading is better.
_AGREE, _BETTER = 0.35, 0.5
#: Less motion than this tells nothing: [m], [rad], [m/s] rms over an interval.
_LEAST = {'velocity': 0.1, 'rates': 0.02, 'specific_force': 0.1}
#: Turn over an interval [rad].
_SMALL_TURN = 0.7
#: Clock offsets that are tried [s].
_LAGS = np.arange(-0.3, 0.3001, 0.005)
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
#: Rates that are logged less often than this tell nothing of a flight [s].
_SELDOM = 1.0


@dataclass(frozen=True)
class Check:
    """
    One pair of signals.

    Attributes
    ----------
    what
        The pair in words.
    quantity
        The signal that is checked.
    error
        What of the change is not explained, as a share [-]; None: too little motion to tell.
    offset
        The checked signal's clock minus that of the other [s], where it can be told.
    finding
        What is wrong, '' where nothing is.

    """

    what: str
    quantity: str
    error: float | None
    offset: float | None
    finding: str = ''


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
    checks = [_pace(flight)] if 'rates' in signals else []
    checks += [_size(flight)] if 'specific_force' in signals else []
    for of, change, words in (
        ('velocity', 'position', 'position against velocity'),
        ('rates', 'attitude', 'attitude against rates'),
        ('specific_force', 'velocity', 'velocity against specific force'),
    ):
        needed = {of, change} | ({'attitude'} if of == 'specific_force' else set())
        if needed <= set(signals):
            checks.append(_pair(flight, of, change, words))
    driving = flight.actuators
    if driving is not None and 'specific_force' in signals:
        checks.append(_drive(driving, signals['specific_force']))
    return checks


def _pace(flight: Flight) -> Check:
    """Look at how often rates were logged: so seldom is a clock in another unit."""
    apart = float(np.median(np.diff(flight.signals['rates'].times)))
    unit = next((u for u, longest in (('us', 1e3), ('ms', _SELDOM)) if apart > longest), '')
    finding = unit and (
        f'rates: its samples are {apart:.4g} s apart; the time looks like {unit}: say time: '
        f'{{unit: {unit}}} in the mapping of a table'
    )
    return Check('pace of the rates', 'rates', None, None, finding)


def _size(flight: Flight) -> Check:
    """Look at the size of the specific force, which is about g whatever a vehicle does."""
    force = flight.signals['specific_force']
    size = float(np.median(np.linalg.norm(force.values, axis=1)))
    finding = ''
    if not 0.5 * GRAVITY < size < 2 * GRAVITY:
        like = 'g' if 0.5 < size < 2 else ''
        finding = (
            f'specific_force: its median is {size:.3g} m/s^2, about {GRAVITY:.3g} is usual'
            + (f'; it looks like {like}: say unit: {like} in the mapping' if like else '')
        )
    return Check('size of the specific force', 'specific_force', None, None, finding)


def _intervals(first: Signal, second: Signal, length: float) -> tuple[Array, Array]:
    """Return begin and end [s] of intervals that both signals cover."""
    slow = min(first.rate, second.rate)
    length = max(length, _SAMPLES / slow if slow > 0 else length)
    low = max(first.times[0], second.times[0]) + _LAGS[-1]
    high = min(first.times[-1], second.times[-1]) - _LAGS[-1]
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
        attitude = flight.signals['attitude'].between(signal.times)
        values = rotations(attitude).apply(values)
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
    summed = integral(begins, ends)
    error = _error(moving, summed, of)
    if error < _AGREE:
        return Check(words, of, error, _offset(moving, integral, begins, ends, of))
    return Check(words, of, error, None, _finding(flight, of, change, moving, summed, error))


def _error(moved: Array, summed: Array, of: str) -> float:
    """Return what of a change is not explained, as a share."""
    if of == 'specific_force':  # the bias of an accelerometer explains nothing
        summed = summed - summed.mean(axis=0)
    return float(np.sqrt(((moved - summed) ** 2).sum() / (moved**2).sum()))


def _offset(
    moved: Array, integral: Callable[[Array, Array], Array], begins: Array, ends: Array, of: str
) -> float:
    """Return the offset of the clocks at which two signals agree best [s]."""
    errors = np.array([_error(moved, integral(begins + x, ends + x), of) for x in _LAGS])
    best = int(np.argmin(errors))
    if 0 < best < len(errors) - 1:
        before, here, after = errors[best - 1 : best + 2] ** 2
        bend = before - 2 * here + after
        if bend > 0:
            return float(_LAGS[best] + 0.5 * (before - after) / bend * (_LAGS[1] - _LAGS[0]))
    return float(_LAGS[best])


def _finding(
    flight: Flight, of: str, change: str, moved: Array, summed: Array, error: float
) -> str:
    """Return the reading of the log under which two signals would agree, as a line."""
    readings = []
    for order in itertools.permutations(range(3)):
        for signs in itertools.product((1, -1), repeat=3):
            for factor, unit in ((1.0, ''), *_FACTORS[of].items()):
                turned = factor * summed[:, order] * np.array(signs)
                plain = order == (0, 1, 2) and signs == (1, 1, 1)
                axes = ' '.join(
                    f'{"-" if s < 0 else ""}{_NAMES[i]}' for s, i in zip(signs, order, strict=True)
                )
                words = [unit if ' in ' in unit else f'unit {unit}'] * bool(unit) + [
                    f'axes {axes}'
                ] * (not plain)
                # the simpler reading wins where two fit alike
                rank = _error(moved, turned, of) + 0.02 * len(words)
                readings.append((rank, ' and '.join(words)))
    best, reading = min(readings)
    if of == 'rates':
        swapped = _swapped(flight)
        if swapped < min(best, _AGREE):
            return (
                'attitude: it does not turn as the rates say, but does with the other order of '
                'its quaternions; see order: wxyz or xyzw in the mapping'
            )
    begin = f'{of}: it is not the change of {change} ({100 * error:.0f} % of it unexplained)'
    if reading and best < _BETTER * min(error, 1.0):
        return f'{begin}; it looks like {reading}: see unit and axes in the mapping'
    return f'{begin}; see unit, axes and order in the mapping'


def _swapped(flight: Flight) -> float:
    """Return the error of the rates with the quaternions read in the other order."""
    attitude, rates = flight.signals['attitude'], flight.signals['rates']
    begins, ends = _intervals(rates, attitude, _INTERVAL['rates'])
    summed = _summed(rates, rates.values)(begins, ends)
    errors = []
    for shift in (1, -1):
        rolled = Signal(**{**attitude.__dict__, 'values': np.roll(attitude.values, shift, axis=1)})
        pairs = np.stack([rolled.between(begins), rolled.between(ends)], axis=1)
        errors.append(_error(_turns(pairs), summed, 'rates'))
    return min(errors)


def _drive(driving: Signal, force: Signal) -> Check:
    """Return how far the specific force along z comes after what drives it."""
    words = f'specific force along z after {driving.quantity}'
    low = max(driving.times[0], force.times[0]) + _LAGS[-1]
    high = min(driving.times[-1], force.times[-1]) - _LAGS[-1]
    rate = min(driving.rate, force.rate, 200.0)
    if rate <= 0 or high - low < 2.0:
        return Check(words, driving.quantity, None, None)
    times = np.arange(low, min(high, low + 200_001 / rate), 1 / rate)[:200_000]
    shared = force.between(times)[:, 2]
    power = 2 if driving.quantity in ('rotor_speed', 'normalized', 'pulse') else 1
    given = (np.nan_to_num(driving.values) ** power).sum(axis=1)
    turns = [np.interp(times - x, driving.times, given) for x in _LAGS]
    if min(np.ptp(turn) for turn in turns) == 0 or np.ptp(shared) == 0:
        return Check(words, driving.quantity, None, None)
    alike = [np.corrcoef(turn, shared)[0, 1] for turn in turns]
    best = int(np.argmax(alike))
    error = float(np.sqrt(max(0.0, 1 - alike[best] ** 2)))
    return Check(words, driving.quantity, error, float(_LAGS[best]) if error < 0.8 else None)
