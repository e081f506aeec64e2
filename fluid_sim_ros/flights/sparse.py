# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What a log that is written seldom leaves open: signals are straight between two samples."""

import numpy as np

from fluid_sim_ros.flights.flight import QUANTITIES, STATE, Flight, Signal
from fluid_sim_ros.physics.arrays import Array

#: Signals of the state and the actuators that come more often need no word [Hz].
_OFTEN = 50.0
#: What a straight line may be off by without a word: [m], [-], [m/s], [rad/s]; others: this share
#: of what the signal changes by.
_SMALL = {'position': 1e-3, 'attitude': 1e-3, 'velocity': 0.01, 'rates': 0.02}
_SMALL_SHARE = 0.01
#: A part of a quaternion is half an angle; shown in degrees.
_DEGREES = 2.0 * 180.0 / np.pi


def sparse_lines(flight: Flight) -> list[str]:
    """
    Return one line where signals are so sparse that what lies between two samples counts.

    How far a straight line is off is measured by leaving out every other sample: over twice the
    distance it is off four times as much.

    Parameters
    ----------
    flight
        What was read.

    Returns
    -------
    list
        A line with rate and size of each such signal, or nothing.

    """
    parts = []
    actuators = flight.actuators
    names = [*STATE, *([actuators.quantity] if actuators is not None else [])]
    for name in names:
        signal = flight.signals.get(name)
        if signal is None or signal.command or len(signal.times) < 5 or signal.rate >= _OFTEN:
            continue
        off = straight_error(signal)
        small = _SMALL.get(name, _SMALL_SHARE * float(np.ptp(signal.values, axis=0).max()))
        if off <= small:
            continue
        size, unit = (
            (_DEGREES * off, 'deg') if name == 'attitude' else (off, QUANTITIES[name].unit)
        )
        parts.append(f'{name} {signal.rate:.3g} Hz (about {size:.2g} {unit} off)')
    if not parts:
        return []
    return [
        f'sparse, and straight between two samples: {", ".join(parts)}; what happened in between '
        'is not in the log, and errors hold it: log at 100 Hz or more'
    ]


def straight_error(signal: Signal) -> float:
    """
    Return by how much a straight line between two samples is off, nine of ten times, in its unit.

    Parameters
    ----------
    signal
        With five samples or more.

    """
    times, values = signal.times, signal.values
    share = (times[1:-1] - times[:-2]) / (times[2:] - times[:-2])
    between: Array = values[:-2] + share[:, None] * (values[2:] - values[:-2])
    off = np.linalg.norm(values[1:-1] - between, axis=1) / 4.0
    return float(np.percentile(off, 90))
