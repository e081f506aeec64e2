# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
A wind or current that varies slowly, as parameters of a fit: knots in time, joined linearly.

Each flight has knots of its own. They walk at random (Wiener): the difference of two, over
``walk * sqrt(time between them)``, counts as a residual more. The strength is stated, not found.
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields
from itertools import pairwise
from typing import Any

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.flights.flight import Flags, Flight
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins.config import MEDIUM
from fluid_sim_ros.reality.driven import Edit
from fluid_sim_ros.reality.flow import time_in_model
from fluid_sim_ros.reality.parameter import Parameter, text_of, words_of
from fluid_sim_ros.reality.windows import Windows

#: ``slow_wind.x``, ``slow_current.y``: east and north, in the world.
PREFIX = 'slow_'
_AXES = 'xy'
#: Rows of a series from knot to knot: the medium joins rows by cubics; so many are straight.
_ROWS = 8
#: The cubics look two rows ahead: a knot is felt so far beyond the next, in their distance.
_SPARE = 2.0 / _ROWS
#: Bound and typical size [m/s], those of a constant wind or current.
_MOST, _TYPICAL = 50.0, 0.5
#: What 1 m/s must move, over its noise: below, thousands of samples do not tell 1 m/s from none.
_FELT = 0.01


@dataclass(frozen=True)
class Knot(Parameter):
    """
    A component of a slow wind or current of one flight at one time.

    Attributes
    ----------
    of
        The parameter that was asked for, such as ``slow_wind.x``.
    flight
        Whose it is.
    time
        Of the flight [s].

    """

    of: str
    flight: Flight
    time: float


def slow_parameters(streams: Sequence[str]) -> list[Parameter]:
    """
    Return a slowly varying wind or current as parameters that knots take the place of.

    Parameters
    ----------
    streams
        Which of wind and current the scene has.

    """
    return [
        Parameter(f'{PREFIX}{stream}.{axis}', 'm/s', 0.0, -_MOST, _MOST, _TYPICAL, _leave)
        for stream in streams
        for axis in _AXES
    ]


def with_knots(
    chosen: Sequence[Parameter], windows: Sequence[Windows], apart: float
) -> list[Parameter]:
    """
    Return parameters with the knots of each flight in place of a slow wind or current.

    Parameters
    ----------
    chosen
        As they were asked for.
    windows
        Of each flight.
    apart
        Longest time between two knots [s].

    Raises
    ------
    ConfigError
        If a constant is asked for beside knots that hold it.

    """
    names = {parameter.name for parameter in chosen}
    found: list[Parameter] = []
    for parameter in chosen:
        if not parameter.name.startswith(PREFIX):
            found.append(parameter)
            continue
        constant = parameter.name.removeprefix(PREFIX)
        if constant in names:
            raise ConfigError(
                f"'{parameter.name}' and '{constant}': the knots hold the constant, too; give one"
            )
        shared = {f.name: getattr(parameter, f.name) for f in fields(parameter)}
        for number, part in enumerate(windows, 1):
            first, last = part.begins[0], part.begins[-1] + part.length
            count = 1 + max(1, int(np.ceil((last - first) / apart - 1e-9)))
            for time in np.linspace(first, last, count).tolist():
                own = shared | {'name': f'{parameter.name}.{number}@{time:.6g}s'}
                found.append(Knot(**own, of=parameter.name, flight=part.flight, time=time))
    return found


def walks(chosen: Sequence[Parameter], strength: float) -> Array:
    """
    Return what makes residuals of the steps from knot to knot of values, shape (s, p).

    Parameters
    ----------
    chosen
        The parameters, with knots.
    strength
        Of the random walk [m/s per square root of a second].

    """
    rows = []
    for i, (one, other) in enumerate(pairwise(chosen)):
        if not (isinstance(one, Knot) and isinstance(other, Knot)):
            continue
        if one.of == other.of and one.flight is other.flight:
            row = np.zeros(len(chosen))
            row[i + 1] = 1.0 / (strength * np.sqrt(other.time - one.time))
            row[i] = -row[i + 1]
            rows.append(row)
    return np.array(rows).reshape(len(rows), len(chosen))


def touched_by(
    chosen: Sequence[Parameter], place: int, flight: Flight, windows: Windows
) -> Flags | None:
    """
    Return which windows of a flight a parameter can touch, shape (w,); None: all.

    Parameters
    ----------
    chosen, place
        The parameters, with knots, and which of them.
    flight, windows
        The flight, and its windows.

    """
    knot = chosen[place]
    if not isinstance(knot, Knot):
        return None
    if knot.flight is not flight:
        return np.zeros(len(windows.begins), dtype=np.bool_)
    begin, end = -np.inf, np.inf  # beyond the last knots the wind holds
    for other in (p for p in chosen if isinstance(p, Knot)):
        if other.of != knot.of or other.flight is not flight:
            continue
        spare = _SPARE * abs(knot.time - other.time)
        if other.time < knot.time:
            begin = max(begin, other.time - spare)
        elif other.time > knot.time:
            end = min(end, other.time + spare)
    last = windows.begins + windows.length
    touched: Flags = (last >= begin) & (windows.begins <= end)
    return touched


def with_flow(edit: Edit, flight: Flight, chosen: Sequence[Parameter], values: Array) -> Edit:
    """
    Return an edit that also lets the knots of a flight act, beside what moves there already.

    Parameters
    ----------
    edit
        Of the other parameters.
    flight
        That drives the model.
    chosen, values
        The parameters, and their values.

    """
    knots: dict[str, list[tuple[float, float]]] = {}
    for parameter, value in zip(chosen, values.tolist(), strict=True):
        if isinstance(parameter, Knot) and parameter.flight is flight:
            knots.setdefault(parameter.of, []).append((parameter.time, value))
    if not knots:
        return edit

    def change(spec: mujoco.MjSpec) -> None:
        edit(spec)
        for name, pairs in knots.items():
            stream, _, axis = name.removeprefix(PREFIX).partition('.')
            times, speeds = np.array(pairs).T
            share = np.arange(_ROWS * (len(times) - 1) + 1) / _ROWS
            fine = np.interp(share, np.arange(len(times)), times)
            rows = np.zeros((len(fine), 4))
            rows[:, 0] = time_in_model(flight, fine)
            rows[:, 1 + _AXES.index(axis)] = np.interp(fine, times, speeds)
            # as the text keeps them: times of two components are then the same number
            rows = np.reshape([float(word) for word in text_of(rows.ravel()).split()], (-1, 4))
            for plugin in _media(spec, stream):
                there = np.reshape(words_of(plugin.config, f'{stream}_series'), (-1, 4))
                text = text_of(_sum(rows, there).ravel())
                plugin.config = {**plugin.config, f'{stream}_series': text}

    return change


def require_felt(name: str, off: Array, still: Array) -> None:
    """
    Refuse a slow wind or current that hardly anything in the model feels.

    Parameters
    ----------
    name
        As it was asked for.
    off, still
        Residuals, over their noise, with 1 m/s of it and without it.

    Raises
    ------
    ConfigError
        If they are the same, but for what noise hides.

    """
    moved = float(np.abs(off - still).max())
    if moved < _FELT:
        raise ConfigError(
            f"parameter '{name}': 1 m/s of it moves what is compared by {moved:.2g} of its noise; "
            'the model has no drag that feels it (rotor_drag, damping, fluid of a body): add one, '
            'or leave it out'
        )


def told(chosen: Sequence[Parameter], values: Array, errors: Array) -> list[str]:
    """
    Return what a reader must know of slow winds and currents that were fitted.

    Parameters
    ----------
    chosen, values, errors
        What a fit found.

    """
    lines = {}
    for parameter in chosen:
        if isinstance(parameter, Knot):
            mine = [i for i, p in enumerate(chosen)
                    if isinstance(p, Knot) and p.of == parameter.of
                    and p.flight is parameter.flight]  # fmt: skip
            name = parameter.name.partition('@')[0]
            lines[name] = (
                f'{name} ({parameter.flight.name}): {len(mine)} knots, '
                f'{values[mine].min():.3g} to {values[mine].max():.3g} m/s, each within '
                f'{errors[mine].max():.2g} if it is straight between them and walks as '
                'strongly as stated; of this flight '
                'alone: not in --apply, nor in errors of flights that were left out'
            )
    return list(lines.values())


def _media(spec: mujoco.MjSpec, stream: str) -> list[Any]:
    media: list[Any] = [p for p in spec.plugins if p.plugin_name == MEDIUM]
    if not media:
        spec.activate_plugin(MEDIUM)
        media = [spec.add_plugin(name='disturbed', plugin_name=MEDIUM, active=True)]
        media[0].config = {stream: text_of(spec.option.wind)}
        spec.option.wind = np.zeros(3)
    return media


def _sum(rows: Array, there: Array) -> Array:
    """Return two series t x y z as one; outside of each its last row holds."""
    if not len(there):
        return rows
    times = np.union1d(rows[:, 0], there[:, 0])
    both = [
        sum(np.interp(times, part[:, 0], part[:, i]) for part in (rows, there))
        for i in (1, 2, 3)
    ]  # fmt: skip
    return np.column_stack([times, *both])


def _leave(spec: mujoco.MjSpec, value: float) -> None:
    """Leave a model as it is: knots are of a flight, and act by ``with_flow``."""
