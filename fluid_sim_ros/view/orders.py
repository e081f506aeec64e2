# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What a user of the view may ask of a source; checked here, whatever a browser sends."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from fluid_sim_ros.errors import CommandError

#: Slowest and fastest pace [simulated seconds per second].
SLOWEST, FASTEST = 0.1, 50.0
#: No velocity of wind or current above it is taken from a page [m/s].
FASTEST_FLOW = 100.0


@dataclass(frozen=True)
class Pause:
    """Let simulated time stand still, or go on."""

    paused: bool


@dataclass(frozen=True)
class Step:
    """Take one picture's time of steps, while paused."""


@dataclass(frozen=True)
class Reset:
    """Go back to the beginning."""


@dataclass(frozen=True)
class Pace:
    """
    How fast simulated time passes.

    Attributes
    ----------
    factor
        Simulated seconds per second; 0: as fast as it goes.

    """

    factor: float

    def __post_init__(self) -> None:
        if self.factor != 0 and not SLOWEST <= number(self.factor, 'speed') <= FASTEST:
            raise CommandError(f'speed {self.factor:g}: allowed is {SLOWEST:g} to {FASTEST:g}')


@dataclass(frozen=True)
class Seek:
    """
    Show another moment of a log.

    Attributes
    ----------
    time
        Simulated time [s].

    """

    time: float

    def __post_init__(self) -> None:
        number(self.time, 'time')


@dataclass(frozen=True)
class Thrust:
    """
    Command all thrusters of a vehicle; no law holds it any longer.

    Attributes
    ----------
    vehicle
        Its name.
    values
        [N], in the order of its thrusters.

    """

    vehicle: str
    values: Sequence[float]

    def __post_init__(self) -> None:
        for value in self.values:
            number(value, f"thrust of '{self.vehicle}'")


@dataclass(frozen=True)
class Joint:
    """
    Command one joint; no law holds its vehicle any longer.

    Attributes
    ----------
    vehicle, joint
        Names.
    value
        In the unit of its actuator.

    """

    vehicle: str
    joint: str
    value: float

    def __post_init__(self) -> None:
        number(self.value, f"joint '{self.joint}'")


@dataclass(frozen=True)
class Flow:
    """
    Set the wind or the current.

    Attributes
    ----------
    stream
        ``wind`` or ``current``.
    velocity
        [m/s], world axes, shape (3,).

    """

    stream: str
    velocity: Sequence[float]

    def __post_init__(self) -> None:
        if len(self.velocity) != 3:
            raise CommandError(f'{self.stream}: {len(self.velocity)} numbers instead of 3')
        for value in self.velocity:
            if abs(number(value, self.stream)) > FASTEST_FLOW:
                raise CommandError(
                    f'{self.stream}: {value:g} m/s; allowed is up to {FASTEST_FLOW:g} m/s'
                )


@dataclass(frozen=True)
class Rung:
    """
    Begin anew with another fluid model.

    Attributes
    ----------
    fluid
        One of ``FLUID_RUNGS``; empty: what the scene has.

    """

    fluid: str


@dataclass(frozen=True)
class Hold:
    """
    Have a vehicle held where it is by the law of its kind, or leave it to the sliders.

    Attributes
    ----------
    vehicle
        Its name.
    held
        Whether it is held.

    """

    vehicle: str
    held: bool


@dataclass(frozen=True)
class Steer:
    """
    Move the target of a vehicle that is held, until the next order.

    Attributes
    ----------
    vehicle
        Its name.
    forward, left, up, turn
        Shares of the fastest, -1 to 1; zeros hold.

    """

    vehicle: str
    forward: float = 0.0
    left: float = 0.0
    up: float = 0.0
    turn: float = 0.0

    def __post_init__(self) -> None:
        for value in (self.forward, self.left, self.up, self.turn):
            if abs(number(value, 'steering')) > 1.0:
                raise CommandError(f'steering: {value:g}; allowed is -1 to 1')


Order = Pause | Step | Reset | Pace | Seek | Thrust | Joint | Flow | Rung | Hold | Steer


def number(value: object, what: str) -> float:
    """
    Return a number that a browser sent.

    Parameters
    ----------
    value
        Whatever came.
    what
        It is for, for the error.

    Returns
    -------
    float
        Finite.

    Raises
    ------
    CommandError
        If it is none.

    """
    if isinstance(value, int | float) and math.isfinite(value):
        return float(value)
    raise CommandError(f'{what}: {value!r} is not a finite number')
