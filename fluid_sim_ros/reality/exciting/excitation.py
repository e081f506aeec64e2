# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Signals that excite a vehicle: seeded multisines, steps and pauses for free decay."""

from dataclasses import dataclass

import numpy as np

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array

#: Directions in which a target is moved: forward, left, up [m], turn [rad].
TARGETS = 4
#: Multisines of the targets and of the thrusts: lowest and highest frequency [Hz], how many.
_SLOW, _FAST = (0.05, 0.5, 6), (0.3, 5.0, 12)
#: Share of the space that a target moves within, and of the largest turn [rad].
_MOVED, _TURN = 0.5, 0.8
#: Shares of a run: multisines, then steps; the rest is free decay, for what floats.
_SINES, _STEPS = 0.6, 0.8
#: Multisines of the targets come up in so long [s].
_RAMP = 3.0
#: Length of a step of a target, and of a push before a free decay and the decay [s].
_STEP, _PUSH, _DECAY = 2.0, 1.0, 2.0


@dataclass(frozen=True)
class Limits:
    """
    What a manoeuvre keeps within.

    Attributes
    ----------
    space
        Length of each edge of the space around the begin [m].
    speed
        [m/s].
    tilt
        [rad].
    share
        Of the thrusters' reach around the command that holds the vehicle, for the multisines.

    """

    space: float = 6.0
    speed: float = 2.0
    tilt: float = np.pi / 6
    share: float = 0.15

    def checked(self) -> 'Limits':
        """Return the same; ConfigError for one that is none."""
        for name, value, low, high in (
            ('--space', self.space, 0.2, 1000.0), ('--speed', self.speed, 0.05, 100.0),
            ('--tilt', np.degrees(self.tilt), 1.0, 80.0), ('--share', self.share, 0.001, 1.0),
        ):  # fmt: skip
            if not low <= value <= high:
                raise ConfigError(f'{name}: {value:g} is not within {low:g} to {high:g}')
        return self


def multisine(rng: np.random.Generator, times: Array, band: tuple[float, float, int]) -> Array:
    """
    Return a sum of sines of equal power and random phases, largest value 1, shape (n,).

    Frequencies are spread evenly on a logarithmic scale and shifted a little, so that those of
    several signals differ (Schroeder's low crest factor is not needed: it is scaled by its peak).

    Parameters
    ----------
    rng
        Draws.
    times
        [s], shape (n,).
    band
        Lowest and highest frequency [Hz], and how many.

    """
    low, high, count = band
    frequencies = np.geomspace(low, high, count) * rng.uniform(0.9, 1.1, count)
    phases = rng.uniform(0, 2 * np.pi, count)
    found: Array = np.sin(2 * np.pi * np.outer(times, frequencies) + phases).sum(axis=1)
    size: Array = found / np.abs(found).max()
    return size


@dataclass(frozen=True)
class Plan:
    """
    What is done at each time of a manoeuvre.

    Attributes
    ----------
    times
        Of the commands [s], shape (n,).
    targets
        Forward, left, up [m] and turn [rad] of the target from the begin, shape (n, 4).
    thrusts
        Added to each thruster, as a share of its reach, shape (n, t).
    free
        Whether the thrusters are off, shape (n,).
    words
        The parts, for people.

    """

    times: Array
    targets: Array
    thrusts: Array
    free: Array
    words: str


def plan(seed: int, times: Array, thrusters: int, limits: Limits, floats: bool) -> Plan:
    """
    Return a manoeuvre: multisines, then steps, then free decay for what floats.

    Parameters
    ----------
    seed
        Of all draws.
    times
        Of the commands [s], shape (n,), evenly apart.
    thrusters
        How many.
    limits
        Of the manoeuvre.
    floats
        Whether the vehicle may be left without thrust.

    Returns
    -------
    Plan
        Scaled to the limits; how the vehicle answers is for a flight to see.

    """
    rng = np.random.default_rng(seed)
    span = float(times[-1])
    reach = np.array([*3 * [0.5 * _MOVED * limits.space], _TURN])
    targets = np.stack([multisine(rng, times, _SLOW) for _ in range(TARGETS)], axis=1) * reach
    targets *= np.minimum(times / _RAMP, 1.0)[:, None]
    thrusts = np.stack([multisine(rng, times, _FAST) for _ in range(thrusters)], axis=1)
    steps_end = _STEPS if floats else 1.0
    stepping = (times >= _SINES * span) & (times < steps_end * span)
    number = (times / _STEP).astype(int)
    chosen = rng.choice((-0.7, 0.7), (number[-1] + 1, TARGETS)) * reach
    chosen *= np.eye(TARGETS)[rng.permutation(np.arange(number[-1] + 1) % TARGETS)]
    targets[stepping] = chosen[number[stepping]]
    thrusts[stepping] *= 0.5
    free = np.zeros(len(times), dtype=np.bool_)
    if floats:
        last = times >= steps_end * span
        round_ = min(_PUSH + _DECAY, (1 - steps_end) * span)
        into = (times - steps_end * span) % round_
        free = last & (into >= round_ * _PUSH / (_PUSH + _DECAY))
        pushes = ((times - steps_end * span) / round_).astype(int).clip(0)
        kicks = rng.choice((-2.0, 2.0), (pushes[-1] + 1, thrusters))
        pushing = last & ~free
        thrusts[pushing] = kicks[pushes[pushing]]
        targets[last] = 0.0
    words = 'multisines, steps of the target' + (', pushes with free decay' if floats else '')
    return Plan(times, targets, limits.share * thrusts, free.astype(np.float64), words)
