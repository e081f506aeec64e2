# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Durations in whole steps."""

from fractions import Fraction
from functools import lru_cache

from fluid_sim_ros.errors import ConfigError

#: A step number that no run reaches.
NEVER = 1 << 62


def exact(value: float | Fraction) -> Fraction:
    """
    Return the decimal number that a person wrote, exactly (``0.002`` -> 1/500).

    Parameters
    ----------
    value
        A number as a person wrote it, any unit.

    """
    return value if isinstance(value, Fraction) else _exact(float(value))


@lru_cache(maxsize=64)
def _exact(value: float) -> Fraction:
    return Fraction(repr(value))


def whole_steps(seconds: float, timestep: float, what: str) -> int:
    """
    Return how many steps a duration takes.

    Parameters
    ----------
    seconds
        Duration [s].
    timestep
        [s].
    what
        Beginning of the error's message: which duration it is.

    Returns
    -------
    int
        Number of timesteps.

    Raises
    ------
    ConfigError
        If the duration is not a whole number of timesteps.

    """
    steps = exact(seconds) / exact(timestep)
    if steps.denominator != 1:
        raise ConfigError(
            f'{what}: {seconds:g} s is not a whole number of timesteps of {timestep:g} s'
        )
    return steps.numerator


def rounded_steps(seconds: float, timestep: float, what: str) -> tuple[int, str]:
    """
    Return the number of steps nearest to a duration.

    Parameters
    ----------
    seconds
        Duration [s], 0 or more.
    timestep
        [s].
    what
        Beginning of the line: which duration it is.

    Returns
    -------
    tuple
        The steps; and a line that says so where the duration was rounded, or ''.

    """
    steps = exact(seconds) / exact(timestep)
    nearest = round(steps)
    if steps.denominator == 1:
        return nearest, ''
    return nearest, (
        f'{what}: {seconds:g} s is not a whole number of timesteps of {timestep:g} s; rounded to '
        f'{nearest} steps, {nearest * timestep:.9g} s'
    )


def rounded_duration(seconds: float, timestep: float) -> tuple[int, str]:
    """
    Return the step nearest to the end of a run; 0 s means never.

    Parameters
    ----------
    seconds
        Duration [s].
    timestep
        [s].

    Returns
    -------
    tuple
        The step, 1 at least; and a line that says so where the duration was rounded, or ''.

    """
    if not seconds:
        return NEVER, ''
    nearest, line = rounded_steps(seconds, timestep, 'duration')
    return (nearest, line) if nearest else (1, f'duration: {seconds:g} s: rounded to one step')


def duration_steps(seconds: float, timestep: float) -> int:
    """
    Return the step at which a run of ``seconds`` ends; 0 s means never.

    Parameters
    ----------
    seconds
        Duration [s].
    timestep
        [s].

    Raises
    ------
    ConfigError
        If the duration is not a whole number of timesteps.

    """
    return whole_steps(seconds, timestep, 'duration') if seconds else NEVER
