# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Sine waves on joints: the travelling wave of a swimmer, the beat of a pair of wings."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from fluid_sim_ros.errors import ConfigError


@dataclass(frozen=True)
class JointWave:
    """
    Joint angles q_i = b_i + r(t) A_i sin(2 pi f t + phi_i).

    The ramp r rises smoothly from 0 to 1, r = (1 - cos(pi t / T)) / 2, so the start has no jolt.

    Attributes
    ----------
    frequency
        f [Hz].
    amplitudes
        A_i [rad].
    phases
        phi_i [rad].
    offsets
        b_i [rad]; empty means zeros.
    ramp
        T [s]; 0 means full amplitude from the start.

    """

    frequency: float
    amplitudes: tuple[float, ...]
    phases: tuple[float, ...]
    offsets: tuple[float, ...] = ()
    ramp: float = 0.0

    def __post_init__(self) -> None:
        n = len(self.amplitudes)
        if len(self.phases) != n or len(self.offsets) not in (0, n):
            raise ConfigError(
                f'joint wave: {n} amplitudes, {len(self.phases)} phases, '
                f'{len(self.offsets)} offsets; all must be as many (offsets may be absent)'
            )
        numbers = (self.frequency, self.ramp, *self.amplitudes, *self.phases, *self.offsets)
        if not all(map(math.isfinite, numbers)) or self.frequency < 0 or self.ramp < 0:
            raise ConfigError('joint wave: all numbers must be finite, frequency and ramp >= 0')

    def angles(self, time: float) -> list[float]:
        """
        Return the joint angles at a time from the start.

        Parameters
        ----------
        time
            [s].

        Returns
        -------
        list
            Angles [rad], one per joint.

        """
        rise = 1.0
        if time < self.ramp:
            rise = 0.5 * (1.0 - math.cos(math.pi * max(time, 0.0) / self.ramp))
        turn = math.tau * self.frequency * time
        offsets = self.offsets or (0.0,) * len(self.amplitudes)
        return [
            offset + rise * amplitude * math.sin(turn + phase)
            for offset, amplitude, phase in zip(offsets, self.amplitudes, self.phases, strict=True)
        ]


def travelling_wave(
    joints: int, *, amplitude: float, frequency: float, lag: float, ramp: float = 1.0
) -> JointWave:
    """
    Return a wave that runs from the first joint to the last.

    Parameters
    ----------
    joints
        Number of joints, head to tail.
    amplitude
        Of each joint [rad].
    frequency
        [Hz].
    lag
        Phase by which each joint follows the one before it [rad]; 2 pi over the number of links
        puts one wave on the body.
    ramp
        Time of the smooth start [s].

    """
    phases = tuple(-lag * i for i in range(joints))
    return JointWave(frequency, (amplitude,) * joints, phases, ramp=ramp)


def wing_beat(*, stroke: float, pitch: float, frequency: float, ramp: float = 0.1) -> JointWave:
    """
    Return a hovering beat for (stroke left, stroke right, pitch left, pitch right).

    The stroke is a sine, the pitch a quarter period ahead of it: the wing meets the air at the
    angle ``pitch`` in mid-stroke, either way, and flat at the turning points (normal hovering,
    Weis-Fogh 1973, J. Exp. Biol. 59).

    Parameters
    ----------
    stroke, pitch
        Amplitudes [rad].
    frequency
        Wingbeats per second [Hz].
    ramp
        Time of the smooth start [s].

    """
    quarter = math.pi / 2
    amplitudes: Sequence[float] = (stroke, stroke, pitch, pitch)
    return JointWave(frequency, tuple(amplitudes), (0.0, 0.0, quarter, quarter), ramp=ramp)
