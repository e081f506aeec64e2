# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Errors of readings: noise, bias, rounding and saturation as functions of (seed, name, index).

The random numbers come from a counter-based generator (Philox 4x64, Salmon et al., SC 2011) keyed
by seed and sensor name: the error of reading number k is the same in whatever order readings are
taken, whatever other sensors there are, and after a saved state has been loaded.
"""

import math
from collections.abc import Sequence

import numpy as np

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.schema.sensors import Channel

#: Readings whose random numbers are drawn at once.
BLOCK = 256
#: The independent streams of one sensor; part of the generator's counter.
_WHITE, _WALK, _DITHER = range(3)


class Errors:
    """
    The errors of one sensor's readings.

    Parameters
    ----------
    channels
        What is measured: errors and number of axes.
    rate
        Readings per second [Hz].
    seed, name
        Key of the random numbers.
    dither
        Quantum per channel within which uniform noise is added either way, where there is no
        resolution that says it; empty: no dither.
    infinite_beyond
        Values beyond the range become infinite instead of the range's end.

    Attributes
    ----------
    axes
        Of each number of a reading: quantum, range (two), and what is read below and above it.

    """

    def __init__(
        self,
        channels: Sequence[tuple[Channel, int]],
        rate: float,
        seed: int,
        name: str,
        dither: Sequence[float] = (),
        infinite_beyond: bool = False,
    ) -> None:
        axes = [count for _, count in channels]

        def per_axis(values: Sequence[float]) -> Array:
            return np.repeat(np.array(values, dtype=np.float64), axes)

        stated = [channel for channel, _ in channels]
        self._width = sum(axes)
        white = [np.hypot(c.density * np.sqrt(rate), c.deviation) for c in stated]
        self._white = per_axis(white)
        self._walk = per_axis([c.bias_walk / np.sqrt(rate) for c in stated])
        quanta = [c.resolution or q for c, q in zip(stated, dither or axes, strict=True)]
        self._dither = per_axis(quanta if dither else [0.0] * len(stated))
        # plain floats: a reading has a few numbers only, for which arrays take three times as long
        limits = [c.range or (-math.inf, math.inf) for c in stated]
        self.axes = [
            (c.resolution, low, high, *((-math.inf, math.inf) if infinite_beyond else (low, high)))
            for (c, count), (low, high) in zip(channels, limits, strict=True)
            for _ in range(count)
        ]
        entropy = [seed % (1 << 64), *name.encode()]
        self._key = np.random.SeedSequence(entropy).generate_state(2, np.uint64)
        self._block = -1
        self._drawn: Array = np.empty((0, 0))
        self._added: list[list[float]] = []
        #: Bias at the begin of each block that was drawn so far.
        self._bias = [np.zeros(self._width)]

    def apply(self, index: int, values: Array) -> int:
        """
        Turn the true values of a reading into readings.

        Parameters
        ----------
        index
            Number of the reading, from 0 on.
        values
            All axes, in the units of the channels, shape (n,); changed.

        Returns
        -------
        int
            How many were beyond their range.

        """
        block, place = divmod(index, BLOCK)
        if block != self._block:
            self._draw(block)
        numbers, beyond = values.tolist(), 0
        for i, (added, axis) in enumerate(zip(self._added[place], self.axes, strict=True)):
            quantum, low, high, below, above = axis
            number = numbers[i] + added
            if quantum and -math.inf < (whole := number / quantum) < math.inf:
                number = round(whole) * quantum
            if number < low or number > high:
                number = below if number < low else above
                beyond += 1
            numbers[i] = number
        values[:] = numbers
        return beyond

    def block(self, block: int) -> Array:
        """
        Return what is added to the readings of a block.

        Parameters
        ----------
        block
            Number of the block, from 0 on.

        Returns
        -------
        Array
            In the units of the channels, shape (``BLOCK``, n); not changed afterwards.

        """
        if block != self._block:
            self._draw(block)
        return self._drawn

    def _draw(self, block: int) -> None:
        """Draw what is added to the readings of a block."""
        self._block = block
        added = np.zeros((BLOCK, self._width))
        if self._white.any():
            added += self._white * self._normals(_WHITE, block)
        if self._walk.any():
            while len(self._bias) <= block:
                last = len(self._bias) - 1
                self._bias.append(self._bias[last] + self._steps(last)[-1])
            added += self._bias[block]
            added[1:] += self._steps(block)[:-1]
        if self._dither.any():
            shape = (BLOCK, self._width)
            added += self._dither * self._generator(_DITHER, block).uniform(-1, 1, shape)
        self._drawn, self._added = added, added.tolist()

    def _steps(self, block: int) -> Array:
        """Return the bias after each reading of a block, from the block's begin."""
        steps: Array = np.cumsum(self._walk * self._normals(_WALK, block), axis=0)
        return steps

    def _normals(self, stream: int, block: int) -> Array:
        return self._generator(stream, block).standard_normal((BLOCK, self._width))

    def _generator(self, stream: int, block: int) -> np.random.Generator:
        # a block takes far fewer than the 2^64 values between two of these counters
        counter = np.array([0, 0, stream, block], dtype=np.uint64)
        return np.random.Generator(np.random.Philox(key=self._key, counter=counter))
