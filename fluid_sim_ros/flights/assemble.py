# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Makes the one form of a flight of the streams of a log, as a mapping says."""

from collections.abc import Sequence

import numpy as np

from fluid_sim_ros.errors import listed, printable
from fluid_sim_ros.flights.flight import ACTUATORS, QUANTITIES, Flight, FlightError, RawLog, Signal
from fluid_sim_ros.flights.mapping import FlightMap, SignalMap
from fluid_sim_ros.flights.tidy import find_gaps, find_outliers, missing_share, usable
from fluid_sim_ros.flights.units import (
    BODY,
    UNITS,
    columns_of,
    rotations,
    to_enu,
    to_flu,
    to_quaternions,
)
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.schema.limits import check_limit

#: More of the samples going back in time than this is no log of one flight.
_MOST_BACK = 0.1
#: Quaternions of a log are this near to length 1; others are something else.
_UNIT_LENGTH = 0.05
#: Fewer missing samples need no word [-].
_MISSING = 0.02


def flight_of(raw: RawLog, mapping: FlightMap, named: frozenset[str] = frozenset()) -> Flight:
    """
    Return streams as a flight.

    Parameters
    ----------
    raw
        What a reader found.
    mapping
        Which columns are which quantity.
    named
        Quantities that must be there: the user named them.

    Returns
    -------
    Flight
        In the one form.

    Raises
    ------
    FlightError
        If a named quantity is not there, or a signal cannot be used.

    """
    found: dict[str, Signal] = {}
    notes: list[str] = []
    for quantity, places in mapping.signals.items():
        place = next((each for each in places if _has(raw, each, mapping.vehicle)), None)
        if place is None:
            if quantity in named and places:
                raise FlightError(_lacks(raw, quantity, places[0], mapping.vehicle))
            continue
        signal = _signal(raw, quantity, place, mapping, notes)
        if len(signal.times) > 1:
            found[quantity] = signal
        else:
            count, dropped = len(signal.times), sum(signal.dropped.values())
            notes.append(f'{quantity}: {count} of {count + dropped} samples can be used')
    notes = _together(notes)
    if not found and notes:
        raise FlightError(f'{raw.path}: too few samples: {"; ".join(notes)}')
    if not any(len(stream.times) for stream in raw.streams.values()):
        raise FlightError(f'{raw.path}: has no samples')
    if not found:
        raise FlightError(
            f'{raw.path}: none of the quantities is in it; name columns in a mapping '
            f'(--mapping FILE); streams: {listed(raw.streams)}'
        )
    begin = min(float(signal.times[0]) for signal in found.values())
    found = {name: _shifted(signal, begin) for name, signal in found.items()}
    velocity = found.get('velocity')
    if velocity is not None and velocity.stated.rpartition(' ')[2] in BODY:
        if 'attitude' not in found:
            raise FlightError(f'{raw.path}: velocity in body axes needs an attitude')
        turned = rotations(_unit(found['attitude'].between(velocity.times))).apply(velocity.values)
        found['velocity'] = _with(velocity, turned)
    return Flight(raw, found, begin, mapping.vehicle, tuple(notes))


def _together(notes: list[str]) -> list[str]:
    """Return notes with those of several quantities that say the same as one."""
    same: dict[str, list[str]] = {}
    for note in notes:
        quantity, _, text = note.partition(': ')
        same.setdefault(text, []).append(quantity)
    return [f'{", ".join(quantities)}: {text}' for text, quantities in same.items()]


def _unit(wxyz: Array) -> Array:
    unit: Array = wxyz / np.linalg.norm(wxyz, axis=1, keepdims=True)
    return unit


def _with(signal: Signal, values: Array) -> Signal:
    return Signal(**{**signal.__dict__, 'values': values})


def _shifted(signal: Signal, begin: float) -> Signal:
    times = signal.times - begin
    gaps = () if signal.command else find_gaps(times)
    return Signal(**{**signal.__dict__, 'times': times, 'gaps': gaps})


def _streams(raw: RawLog, name: str, vehicle: str) -> list[str]:
    """Return the streams of a type (``type:NAME``) or end (``*END``), the vehicle's own first."""
    if name.startswith('*'):
        found = [t for t in raw.streams if t.endswith(name[1:])]
    elif name.startswith('type:'):
        kind = name.removeprefix('type:')
        found = [t for t in raw.streams if raw.about.get(f'type of {t}') == kind]
    else:
        return [name]
    return [t for t in found if vehicle and f'/{vehicle}/' in t] or found


def _stream(raw: RawLog, name: str, vehicle: str) -> str:
    return next(iter(_streams(raw, name, vehicle)), '')


def _of_several(raw: RawLog, name: str, vehicle: str) -> str:
    """Return what is said where more than one stream would do."""
    found = _streams(raw, name, vehicle)
    if len(found) < 2:
        return ''
    return (
        f'{len(found)} topics would do ({listed(found)}): {printable(found[0])} is taken; if it '
        'is that of another vehicle, say vehicle: NAME, or the stream, in the mapping'
    )


def _columns(raw: RawLog, place: SignalMap, vehicle: str) -> list[str]:
    columns = raw.streams[_stream(raw, place.stream, vehicle)].columns
    names: list[str] = []
    for name in place.columns:
        if '*' in name:
            before, _, after = name.partition('*')
            names += [c for c in columns if c.startswith(before) and c.endswith(after)]
        else:
            names.append(name)
    return names


def _has(raw: RawLog, place: SignalMap, vehicle: str) -> bool:
    stream = _stream(raw, place.stream, vehicle)
    if stream not in raw.streams or not len(raw.streams[stream].times):
        return False
    names = _columns(raw, place, vehicle)
    return bool(names) and all(name in raw.streams[stream].columns for name in names)


def _lacks(raw: RawLog, quantity: str, place: SignalMap, vehicle: str) -> str:
    stream = _stream(raw, place.stream, vehicle)
    if stream not in raw.streams:
        return (
            f"{raw.path}: {quantity}: stream '{printable(place.stream)}' is not in it; "
            f'it has: {listed(raw.streams)}'
        )
    columns = raw.streams[stream].columns
    lost = [name for name in place.columns if name not in columns]
    return (
        f"{raw.path}: {quantity}: column '{printable(listed(lost))}' is not in {stream}; "
        f'it has: {listed(columns)}'
    )


def _signal(
    raw: RawLog, quantity: str, place: SignalMap, mapping: FlightMap, notes: list[str]
) -> Signal:
    name = _stream(raw, place.stream, mapping.vehicle)
    stream, names = raw.streams[name], _columns(raw, place, mapping.vehicle)
    several = _of_several(raw, place.stream, mapping.vehicle)
    notes += [f'{quantity}: {several}'] * bool(several)
    values = np.stack([stream.columns[column] for column in names], axis=1)
    if quantity in ACTUATORS:
        chosen, thrusters = _thrusters(values, names, mapping)
        values, names = values[:, chosen], [names[i] for i in chosen]
    else:
        thrusters = ()
    times = stream.times + place.offset
    check_limit('flight_samples', len(values), f'{raw.path}: samples of {name}')
    used, dropped = usable(times, values)
    back = dropped.get('at a time that goes back', 0)
    if back > _MOST_BACK * len(times):
        raise FlightError(
            f'{raw.path}: time goes back at {back} of {len(times)} samples of {name}: '
            'not the log of one flight'
        )
    source = f'{name}: {columns_of(names)}'
    notes += [f'{quantity}: {n} samples of {name} {why}: left out' for why, n in dropped.items()]
    times, values = times[used], values[used]
    lost = 0.0 if place.command else missing_share(times)
    if lost > _MISSING:
        notes.append(f'{quantity}: {100 * lost:.0f} % of the samples of {name} are missing')
    values, stated = _converted(raw, quantity, place, values)
    outliers = find_outliers(quantity, values)
    return Signal(
        quantity, times, values, source, thrusters, stated, place.truth, place.command,
        () if place.command else find_gaps(times), outliers, dropped,
    )  # fmt: skip


def _thrusters(
    values: Array, names: Sequence[str], mapping: FlightMap
) -> tuple[list[int], tuple[str, ...]]:
    """Return the columns of actuators that are used, and the thruster of each."""
    if mapping.actuators:
        driven = sorted(mapping.actuators, key=lambda output: output.output)
        places = [output.output - 1 for output in driven]
        if places[-1] >= len(names):
            raise FlightError(f'actuators: output {places[-1] + 1}; the log has {len(names)}')
        return places, tuple(output.thruster for output in driven)
    # what is never a number, or never changes, is not connected
    used = [i for i in range(len(names)) if np.ptp(np.nan_to_num(values[:, i])) > 0]
    used = used or list(range(len(names)))
    if mapping.thrusters:
        if len(mapping.thrusters) > len(names):
            raise FlightError(
                f'thrusters: {len(mapping.thrusters)} named, the log has {len(names)} columns'
            )
        return list(range(len(mapping.thrusters))), tuple(mapping.thrusters)
    inside = [name.partition('[')[2].rstrip(']') for name in names]
    named = all(text and not text.isdigit() for text in inside)
    return (list(range(len(names))), tuple(inside)) if named else (used, ())


def _converted(raw: RawLog, quantity: str, place: SignalMap, values: Array) -> tuple[Array, str]:
    """Return values in our unit and axes, and what the log has."""
    facts = QUANTITIES[quantity]
    if quantity == 'attitude':
        axes = place.axes or 'enu_flu'
        if place.order == 'rpy':
            values = values * UNITS['rad'][place.unit or 'rad']
        else:
            length = np.linalg.norm(values, axis=1)
            if np.median(np.abs(length - 1.0)) > _UNIT_LENGTH:
                raise FlightError(
                    f'{raw.path}: attitude: {columns_of(place.columns)} are no unit quaternions '
                    f'(length {np.median(length):.3g}); say order: rpy, or other columns'
                )
        return to_quaternions(values, place.order, axes), f'{place.order} {axes}'
    unit = place.unit or facts.unit
    values = values * UNITS[facts.unit][unit]
    axes = place.axes or {'world': 'enu', 'body': 'flu'}.get(facts.axes, '')
    if axes in BODY:
        values = to_flu(values, axes)
    elif axes:
        values = to_enu(values, axes)
    asked = '' if place.unit else '?'
    return values, f'{unit}{asked} {axes}'.strip()
