# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Windows of a flight: where they begin, what is measured in them, and what drives them."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fluid_sim_ros.flights.flight import STATE, Flight, FlightError
from fluid_sim_ros.flights.units import rotations
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.reality.driven import Driven
from fluid_sim_ros.reality.flow import time_in_model

#: Columns of a state: position [m], quaternion wxyz, velocity [m/s] (world), rates (body) [rad/s].
POSITION, ATTITUDE, VELOCITY, RATES = slice(0, 3), slice(3, 7), slice(7, 10), slice(10, 13)
WIDTH = 13
#: Windows begin so far apart, where the log is not sparser [s].
_APART = 0.05
_MOST_WINDOWS = 5000


@dataclass(frozen=True)
class Windows:
    """
    Windows of one flight, all of one length.

    Attributes
    ----------
    flight
        It.
    begins
        Time at which each begins [s], shape (w,).
    length
        [s].
    left_out
        How many are not used, by reason.
    parts
        Positions, then velocities, of what is in the model besides the vehicle, at the begins,
        shape (w, n): ``carried.with_parts``; None: as the model has it.

    """

    flight: Flight
    begins: Array
    length: float
    left_out: dict[str, int]
    parts: Array | None = None

    @property
    def clock(self) -> Array:
        """What the clock of a model shows at each begin [s], shape (w,)."""
        return time_in_model(self.flight, self.begins)

    def measured(self, after: float | Array) -> Array:
        """
        Return the measured states some time after each begin, shape (w, 13), or (w, m, 13).

        Parameters
        ----------
        after
            [s], a number or shape (m,).

        """
        times = self.begins[:, None] + np.atleast_1d(after)
        found = state_at(self.flight, times.ravel()).reshape(*times.shape, WIDTH)
        return found[:, 0] if np.isscalar(after) else found

    def controls(self, driven: Driven, timestep: float, before: float = 0.0) -> Array:
        """
        Return the controls at the begin of each step, as a simulation takes them, (w, steps, n).

        Parameters
        ----------
        driven
            What is driven.
        timestep
            [s].
        before
            Time before each begin that is included, in whole steps [s].

        """
        signal = self.flight.actuators
        assert signal is not None
        first = -round(before / timestep)
        steps = np.arange(first, round(self.length / timestep))
        begins = self.begins[:, None] + steps * timestep
        # a speed is measured and goes on between two samples; a command holds until the next
        taken = signal.between if driven.kind == 'rotor_speed' else signal.held
        values = taken(begins.ravel())[:, list(driven.columns)]
        return driven.controls(values).reshape(*begins.shape, len(driven.columns))


def state_at(flight: Flight, times: Array) -> Array:
    """
    Return the measured states of a flight, linear between samples, shape (n, 13).

    Parameters
    ----------
    flight
        With all of the state.
    times
        [s], shape (n,).

    """
    parts = [flight.signals[name].between(times) for name in STATE]
    parts[1] = parts[1] / np.linalg.norm(parts[1], axis=1, keepdims=True)
    return np.concatenate(parts, axis=1)


def cut(
    flight: Flight, length: float, *, begin: float = 0.0, end: float = np.inf,
    apart: float = _APART, before: float = 0.0,
) -> Windows:  # fmt: skip
    """
    Cut a flight into windows that begin at samples of the state and touch no hole or jump.

    Parameters
    ----------
    flight
        With all of the state and an actuator signal.
    length
        Of each window [s].
    begin, end
        Of the part of the flight that is used [s].
    apart
        Between two begins, where the log is not sparser [s].
    before
        Time before a begin in which the actuators must be known [s].

    Returns
    -------
    Windows
        Those that can be used.

    Raises
    ------
    FlightError
        If there is none.

    """
    actuators = flight.actuators
    assert actuators is not None
    signals = [flight.signals[name] for name in STATE]
    slowest = min(signals, key=lambda signal: signal.rate)
    low = max(begin, actuators.times[0] + before, *(signal.times[0] for signal in signals))
    last = np.inf if actuators.command else actuators.times[-1]
    high = min(end, last, *(signal.times[-1] for signal in signals)) - length
    inside = slowest.times[(slowest.times >= low - 1e-9) & (slowest.times <= high + 1e-9)]
    chosen: list[float] = []
    for time in inside:
        if not chosen or time >= chosen[-1] + apart - 1e-9:
            chosen.append(time)
    begins = np.array(chosen)[:: max(1, len(chosen) // _MOST_WINDOWS)]
    left_out: dict[str, int] = {}
    if len(begins):
        driven = np.array([actuators.covers(t - before, t + length) for t in begins])
        whole = driven & np.array([all(s.covers(t, t + length) for s in signals) for t in begins])
        calm = np.array([not _jumps(flight, t, t + length) for t in begins])
        left_out = {
            'touch a hole in the log': int((~whole).sum()),
            'hold a sample that jumps': int((whole & ~calm).sum()),
        }
        begins = begins[whole & calm]
    if not len(begins):
        raise FlightError(
            f'{flight.raw.path}: no window of {length:g} s is whole between {max(begin, 0):.3g} '
            f'and {min(end, float(slowest.times[-1])):.3g} s; give shorter windows '
            '(--horizons; of a fit --window), or another part'
        )
    return Windows(flight, begins, length, {k: v for k, v in left_out.items() if v})


def _jumps(flight: Flight, begin: float, end: float) -> bool:
    for name in STATE:
        signal = flight.signals[name]
        first, last = np.searchsorted(signal.times, (begin, end + 1e-9))
        if signal.outliers[first:last].any():
            return True
    return False


def errors(found: Array, wanted: Array) -> dict[str, Array]:
    """
    Return how far states are from measured ones.

    Parameters
    ----------
    found, wanted
        Shape (..., 13).

    Returns
    -------
    dict
        ``position_m``, ``velocity_m_s``, ``attitude_deg``, ``rates_deg_s``, shape (...) each.

    """
    flat_found, flat_wanted = found.reshape(-1, WIDTH), wanted.reshape(-1, WIDTH)
    off = rotations(flat_wanted[:, ATTITUDE]).inv() * rotations(flat_found[:, ATTITUDE])
    shape = found.shape[:-1]

    def length(part: slice) -> Array:
        norm: Array = np.linalg.norm(flat_found[:, part] - flat_wanted[:, part], axis=1)
        return norm.reshape(shape)

    return {
        'position_m': length(POSITION),
        'velocity_m_s': length(VELOCITY),
        'attitude_deg': np.degrees(off.magnitude()).reshape(shape),
        'rates_deg_s': np.degrees(length(RATES)),
    }


def held_velocity(start: Array, after: Sequence[float]) -> Array:
    """
    Return what the last velocity and rates would bring, shape (w, m, 13).

    Parameters
    ----------
    start
        Measured states, shape (w, 13).
    after
        [s], shape (m,).

    """
    found = np.repeat(start[:, None], len(after), axis=1)
    for i, seconds in enumerate(after):
        found[:, i, POSITION] += seconds * start[:, VELOCITY]
        turn = rotations(start[:, ATTITUDE])
        turned = turn * turn.from_rotvec(seconds * start[:, RATES])
        found[:, i, ATTITUDE] = np.roll(turned.as_quat(), 1, axis=1)
    return found
