# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What is in the log of a flight, and what is missing for a comparison."""

from typing import Any

from fluid_sim_ros.errors import printable
from fluid_sim_ros.flights.checks.check import Check
from fluid_sim_ros.flights.checks.consistency import check_flight
from fluid_sim_ros.flights.flight import ACTUATORS, QUANTITIES, Flight, FlightError, Signal


def about_flight(flight: Flight) -> dict[str, Any]:
    """
    Return what ``fluid_sim info`` shows of a flight.

    Parameters
    ----------
    flight
        What was read.

    Returns
    -------
    dict
        File, format, streams and signals, clock offsets [s], findings, what is missing.

    """
    checks = check_flight(flight)
    last = max(float(signal.times[-1]) for signal in flight.signals.values())
    return {
        'path': str(flight.raw.path),
        'kind': flight.raw.kind,
        'about': {printable(k): printable(v) for k, v in flight.raw.about.items()
                  if not k.startswith('type of ')},
        'duration_s': round(last, 6),
        'streams': {
            printable(name): {
                'samples': len(stream.times), 'rate_hz': _rate(stream.times),
                'columns': [printable(c, 80) for c in stream.columns],
            }
            for name, stream in flight.raw.streams.items()
        },
        'signals': {name: _signal(signal) for name, signal in flight.signals.items()},
        'clocks': [_clock(check) for check in checks if check.error is not None],
        'findings': [check.finding for check in checks if check.finding],
        'notes': [printable(line) for line in flight.notes],
        'faults': [printable(line) for line in flight.raw.faults],
        'missing': list(flight.missing),
    }  # fmt: skip


def _rate(times: Any) -> float | None:
    span = float(times[-1] - times[0]) if len(times) > 1 else 0.0
    return round((len(times) - 1) / span, 3) if span > 0 else None


def _signal(signal: Signal) -> dict[str, Any]:
    facts = QUANTITIES[signal.quantity]
    return {
        'what': facts.what, 'unit': facts.unit, 'axes': facts.axes,
        'source': printable(signal.source), 'stated': signal.stated, 'truth': signal.truth,
        'samples': len(signal.times), 'rate_hz': round(signal.rate, 3),
        'gaps': len(signal.gaps), 'longest_gap_s': round(
            max((end - begin for begin, end in signal.gaps), default=0.0), 6
        ),
        'outliers': int(signal.outliers.sum()),
        'dropped': dict(signal.dropped),
        'names': [printable(name) for name in signal.names],
    }  # fmt: skip


def _clock(check: Check) -> dict[str, Any]:
    return {
        'what': check.what,
        'offset_s': None if check.offset is None else round(check.offset, 5),
        'unexplained': None if check.error is None else round(check.error, 4),
    }


def refuse_unclear(flight: Flight) -> list[str]:
    """
    Refuse a flight whose signals contradict each other; return what is odd but stated so.

    A unit, an order or axes that the mapping states are taken as they are said; a finding on them,
    or one that may be right, is a line to show. One that nobody stated is asked about.

    Parameters
    ----------
    flight
        What was read.

    Returns
    -------
    list
        Lines to show.

    Raises
    ------
    FlightError
        With the first finding on a signal whose unit the mapping leaves open.

    """
    lines = []
    for check in check_flight(flight):
        if not check.finding:
            continue
        signal = flight.signals[check.quantity]
        asked = '?' in signal.stated or 'order' in check.finding.partition(';')[0]
        if check.sure and asked:
            raise FlightError(f'{flight.raw.path}: {check.finding}')
        lines.append(check.finding)
    return lines


def require_comparable(flight: Flight) -> None:
    """
    Refuse a flight that lacks what a comparison needs.

    Parameters
    ----------
    flight
        What was read.

    Raises
    ------
    FlightError
        With all that is missing.

    """
    if flight.missing:
        lacking = '; '.join(flight.missing)
        hint = ''
        if flight.actuators is None:
            hint = f'; without one of {", ".join(ACTUATORS)} nothing drives the model'
        raise FlightError(
            f'{flight.raw.path}: lacks {lacking}{hint}; fluid_sim info shows its streams, '
            '--mapping FILE names others'
        )
