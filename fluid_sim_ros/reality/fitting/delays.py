# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Delays of what was measured against the actuator signals, as parameters of a fit.

A delay is no part of a model: it says how long before its stamp a state was. The model is looked
at that much earlier, between its own steps. The measurements stay where they are: between two
samples the mean of both has less noise, and a fit would be drawn to delays half way between.
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.flights.flight import STATE, Flight
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.reality.parameter import Parameter
from fluid_sim_ros.reality.windows import ATTITUDE, POSITION, RATES, VELOCITY, WIDTH

#: All signals of the state together; ``delay.rates`` and so on: one of them, added to it.
ALL = 'delay'
#: Longest delay either way [s]: an estimator or radio of a vehicle that flies is not later.
LONGEST = 0.1
#: A typical delay [s]: a sample at 100 Hz.
_TYPICAL = 0.01
#: Columns of a state that each signal fills, in the order of ``STATE``.
_COLUMNS = (POSITION, ATTITUDE, VELOCITY, RATES)


def delay_parameters() -> list[Parameter]:
    """Return the delays of all signals of a state together, and of each."""
    return [
        Parameter(name, 's', 0.0, -LONGEST, LONGEST, _TYPICAL, _leave)
        for name in (ALL, *(f'{ALL}.{signal}' for signal in STATE))
    ]


def is_delay(parameter: Parameter) -> bool:
    """
    Return whether a parameter is a delay.

    Parameters
    ----------
    parameter
        It.

    """
    return parameter.name.partition('.')[0] == ALL


def delays_of(parameters: Sequence[Parameter], values: Iterable[float]) -> Array | None:
    """
    Return how late position, attitude, velocity and rates are [s], shape (4,).

    Parameters
    ----------
    parameters
        Of a fit.
    values
        Each in its unit.

    Returns
    -------
    Array
        None where no parameter is a delay.

    """
    if not any(map(is_delay, parameters)):
        return None
    late = np.zeros(len(STATE))
    for parameter, value in zip(parameters, values, strict=True):
        if parameter.name == ALL:
            late += value
        elif is_delay(parameter):
            late[STATE.index(parameter.name.partition('.')[2])] += value
    return late


def longest(names: Sequence[str], start: str) -> float:
    """
    Return the time that windows fly longer at both ends for the delays that are fitted [s].

    Parameters
    ----------
    names
        Of the parameters.
    start
        Of the task: ``free`` or ``measured``.

    Raises
    ------
    ConfigError
        If windows start as measured: what is late cannot be started from.

    """
    late = [name for name in names if name.partition('.')[0] == ALL]
    if late and start == 'measured':
        raise ConfigError(
            f"parameter '{late[0]}' needs --start free: a state that is stamped late is none to "
            'start a window at'
        )
    # `delay` and one of its own add up
    return LONGEST * ((ALL in late) + any(name != ALL for name in late))


def seen(along: Array, after: Array, late: Array, timestep: float) -> Array:
    """
    Return what signals that are late show of states, shape (w, m, 13).

    Parameters
    ----------
    along
        States at each step, the first at the begin, shape (w, n, 13).
    after
        Stamps from the begin [s], shape (m,).
    late
        Of each signal [s], shape (4,).
    timestep
        [s].

    """
    place = np.clip((after[:, None] - late) / timestep, 0, along.shape[1] - 1)
    step = np.minimum(place.astype(np.int64), along.shape[1] - 2)
    share = place - step
    out = np.empty((len(along), len(after), WIDTH))
    for i, part in enumerate(_COLUMNS):
        first, second = along[:, step[:, i], part], along[:, step[:, i] + 1, part]
        out[..., part] = first + share[None, :, i, None] * (second - first)
    return out


def in_time(flight: Flight, parameters: Sequence[Parameter], values: Iterable[float]) -> Flight:
    """
    Return a flight whose signals are stamped when they were true.

    Parameters
    ----------
    flight
        As it was logged.
    parameters, values
        What a fit found.

    """
    late = delays_of(parameters, values)
    if late is None:
        return flight
    signals = dict(flight.signals)
    for name, by in zip(STATE, late.tolist(), strict=True):
        if name in signals:
            was = signals[name]
            gaps = tuple((begin - by, end - by) for begin, end in was.gaps)
            signals[name] = replace(was, times=was.times - by, gaps=gaps)
    return replace(flight, signals=signals)


def told(parameters: Sequence[Parameter], values: Iterable[float]) -> list[str]:
    """
    Return what a reader must know of the delays that were fitted.

    Parameters
    ----------
    parameters, values
        What a fit found.

    """
    found = [
        f'{parameter.name} {1e3 * value:.3g} ms'
        for parameter, value in zip(parameters, values, strict=True)
        if is_delay(parameter)
    ]
    return [
        f'{", ".join(found)}: of the log, not of the model (--apply cannot write it); above 0 the '
        'state is stamped later than it was true, against the actuators'
    ] if found else []  # fmt: skip


def _leave(spec: mujoco.MjSpec, value: float) -> None:
    """Leave a model as it is: the log is late, not the model."""
