# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Whether single signals of a flight are what they can be: pace, size, what is up, what drives."""

import numpy as np

from fluid_sim_ros.flights.checks.check import LAGS, Check
from fluid_sim_ros.flights.flight import Flight, Signal
from fluid_sim_ros.flights.units import UNITS, rotations
from fluid_sim_ros.physics.environment.atmosphere import GRAVITY

#: Signals of motion that are logged less often than this tell nothing of a flight [s].
_SELDOM = 1.0
#: From this share on, the mean of a specific force is a direction that it keeps: gravity [-].
_KEPT = 0.5
_NO_GRAVITY = (
    '; it looks like an acceleration from which gravity was taken out: an accelerometer shows +g '
    'at rest; take its own columns, or specific_force: [] in the mapping'
)
#: A force that comes so long before what drives it is on another clock [s], where it is this
#: much alike [-].
_BEFORE, _ALIKE = 0.03, 0.5


def pace(flight: Flight) -> Check:
    """
    Look at how often the motion was logged: so seldom is a clock in another unit.

    Parameters
    ----------
    flight
        With rates, attitude, velocity or position.

    Returns
    -------
    Check
        With what is wrong, if anything.

    """
    quantity = next(
        q for q in ('rates', 'attitude', 'velocity', 'position') if q in flight.signals
    )
    apart = float(np.median(np.diff(flight.signals[quantity].times)))
    unit = ''
    if apart > _SELDOM:  # the unit in which samples are less than that apart, the largest first
        shorter = sorted(UNITS['s'].items(), key=lambda item: -item[1])[1:]
        unit = next((u for u, seconds in shorter if apart * seconds < _SELDOM), shorter[-1][0])
    finding = unit and (
        f'{quantity}: its samples are {apart:.4g} s apart; the time looks like {unit}: say time: '
        f'{{unit: {unit}}} in the mapping of a table'
    )
    return Check(f'pace of the {quantity}', quantity, None, None, finding)


def size(flight: Flight) -> Check:
    """
    Look at the size of the specific force, which is about g whatever a vehicle does.

    Parameters
    ----------
    flight
        With a specific force.

    Returns
    -------
    Check
        With what is wrong, if anything.

    """
    force = flight.signals['specific_force']
    lengths = np.linalg.norm(force.values, axis=1)
    usual, mean = float(np.median(lengths)), np.linalg.norm(force.values.mean(axis=0))
    finding = ''
    if not 0.5 * GRAVITY < usual < 2 * GRAVITY:
        finding = f'specific_force: its median is {usual:.3g} m/s^2, about {GRAVITY:.3g} is usual'
        if 0.5 < usual < 2 and mean > _KEPT * usual:
            finding += '; it looks like g: say unit: g in the mapping'
        elif mean < _KEPT * usual < _KEPT * GRAVITY:
            finding += _NO_GRAVITY
    return Check('size of the specific force', 'specific_force', None, None, finding)


def upright(flight: Flight) -> Check:
    """
    Look at the mean of the specific force in the world: +g up, since gravity holds on.

    Parameters
    ----------
    flight
        With a specific force and an attitude; with a velocity, its change is taken out.

    Returns
    -------
    Check
        With what is wrong, if anything.

    """
    force, attitude = flight.signals['specific_force'], flight.signals['attitude']
    mean = rotations(attitude.between(force.times)).apply(force.values).mean(axis=0)
    velocity = flight.signals.get('velocity')
    if velocity is not None and force.times[-1] > force.times[0]:
        ends = velocity.between(force.times[[0, -1]])
        mean = mean - (ends[1] - ends[0]) / (force.times[-1] - force.times[0])
    finding, half = '', 0.5 * GRAVITY
    if mean[2] < -half:
        finding = (
            'specific_force: it points down in the world, where an accelerometer at rest shows '
            '+g up; it looks like axes ned (position, velocity), ned_frd (attitude) and frd '
            '(rates, specific_force): see axes in the mapping, or a specific force of the other '
            'sign'
        )
    elif np.linalg.norm(mean) < half:
        finding = f'specific_force: its mean in the world is {mean[2]:.2g} m/s^2 up{_NO_GRAVITY}'
    elif mean[2] < half:
        finding = (
            'specific_force: it does not point up in the world; see order and axes of the '
            'attitude, and the axes of the specific force, in the mapping'
        )
    return Check('what is up', 'specific_force', None, None, finding)


def drive(driving: Signal, force: Signal) -> Check:
    """
    Return how far the specific force along z comes after what drives it.

    Parameters
    ----------
    driving
        The actuators.
    force
        The specific force.

    """
    words = f'specific force along z after {driving.quantity}'
    low = max(driving.times[0], force.times[0]) + LAGS[-1]
    high = min(driving.times[-1], force.times[-1]) - LAGS[-1]
    rate = min(driving.rate, force.rate, 200.0)
    if rate <= 0 or high - low < 2.0:
        return Check(words, driving.quantity, None, None)
    times = np.arange(low, min(high, low + 200_001 / rate), 1 / rate)[:200_000]
    shared = force.between(times)[:, 2]
    power = 2 if driving.quantity in ('rotor_speed', 'normalized', 'pulse') else 1
    given = (np.nan_to_num(driving.values) ** power).sum(axis=1)
    turns = [np.interp(times - x, driving.times, given) for x in LAGS]
    if min(np.ptp(turn) for turn in turns) == 0 or np.ptp(shared) == 0:
        return Check(words, driving.quantity, None, None, _still(driving), sure=False)
    alike = [np.corrcoef(turn, shared)[0, 1] for turn in turns]
    best = int(np.argmax(alike))
    error = float(np.sqrt(max(0.0, 1 - alike[best] ** 2)))
    late = float(LAGS[best])
    finding = ''
    if late < -max(_BEFORE, 2 / rate) and error < _ALIKE and best > 0:
        finding = (
            f'{driving.quantity}: the specific force comes {-1e3 * late:.0f} ms before it, which '
            f'drives it; their clocks differ: say offset: {late:.3g} at {driving.quantity} in the '
            'mapping'
        )
    return Check(
        words, driving.quantity, error, late if error < 0.8 else None, finding, sure=False
    )


def _still(driving: Signal) -> str:
    if np.ptp(np.nan_to_num(driving.values), axis=0).max(initial=0.0) > 0:
        return ''
    return f'{driving.quantity}: it never changes in this log: is it what drove the vehicle?'
