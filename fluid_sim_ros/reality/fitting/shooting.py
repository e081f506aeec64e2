# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Multiple shooting: windows of flights that each start at a state of their own.

The unknowns are the parameters, shared, and the state at each window's begin. The begin is
measured with noise like everything else: a window that had to start there would take the noise
for a force. For given parameters the states of the windows do not touch each other, so that they
are taken out of the normal equations window by window (a Schur complement), and only the
parameters are left.
"""

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

import numpy as np

from fluid_sim_ros.flights.flight import Flags
from fluid_sim_ros.flights.units import rotations
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.reality.driven import Driven
from fluid_sim_ros.reality.fitting.delays import seen
from fluid_sim_ros.reality.flying import Flyer
from fluid_sim_ros.reality.spinning import first_speeds
from fluid_sim_ros.reality.windows import ATTITUDE, POSITION, RATES, VELOCITY, Windows

#: Numbers of a state's error: position, rotation vector, velocity, rates.
SIZE = 12
#: Steps of the differences: of a parameter in its scale; of a state [m], [rad], [m/s], [rad/s].
_STEP = 1e-4
_STATE_STEPS = np.repeat([1e-5, 1e-5, 1e-4, 1e-4], 3)


def error_vectors(found: Array, wanted: Array) -> Array:
    """
    Return errors as vectors, shape (..., 12).

    Parameters
    ----------
    found, wanted
        States, shape (..., 13).

    """
    turn = rotations(wanted[..., ATTITUDE].reshape(-1, 4)).inv()
    off = (turn * rotations(found[..., ATTITUDE].reshape(-1, 4))).as_rotvec()
    return np.concatenate([
        found[..., POSITION] - wanted[..., POSITION], off.reshape(*found.shape[:-1], 3),
        found[..., VELOCITY] - wanted[..., VELOCITY], found[..., RATES] - wanted[..., RATES],
    ], axis=-1)  # fmt: skip


def moved(states: Array, by: Array) -> Array:
    """
    Return states moved by error vectors, shape (w, 13).

    Parameters
    ----------
    states
        Shape (w, 13).
    by
        Shape (w, 12) or (12,).

    """
    out = states.copy()
    by = np.broadcast_to(by, (len(states), SIZE)).copy()
    out[:, POSITION] += by[:, :3]
    turn = rotations(states[:, ATTITUDE])
    turned = turn * turn.from_rotvec(by[:, 3:6])
    out[:, ATTITUDE] = np.roll(turned.as_quat(), 1, axis=1)
    out[:, VELOCITY] += by[:, 6:9]
    out[:, RATES] += by[:, 9:12]
    return out


@dataclass(frozen=True)
class Trial:
    """
    What values of the parameters make of a flight.

    Attributes
    ----------
    driven
        The model, with its parameters.
    late
        How late position, attitude, velocity and rates are [s], shape (4,); None: not at all.
    touched
        Which windows differ from those of the other trial, shape (w,); None: all.

    """

    driven: Driven
    late: Array | None = None
    touched: Flags | None = None


@dataclass
class Shots:
    """
    The windows of one flight in a fit.

    Attributes
    ----------
    windows
        They.
    after
        Times in a window at which the state is compared [s], shape (m,); the first is at 0, but
        where signals may be late.
    wanted
        Measured then, shape (w, m, 13).
    start
        The states that the windows start at, shape (w, 13).

    """

    windows: Windows
    after: Array
    wanted: Array
    start: Array

    @classmethod
    def of(cls, windows: Windows, sample: float, spare: float = 0.0) -> 'Shots':
        """
        Return the shots of windows, starting at the measured states.

        Parameters
        ----------
        windows
            Of a flight.
        sample
            Distance of the compared states [s].
        spare
            Time at both ends of a window that is flown and not compared [s].

        """
        count = max(1, int((windows.length - 2 * spare) / sample + 1e-9))
        after = spare + np.arange(count + 1, dtype=np.float64) * sample
        wanted = windows.measured(after)
        start = windows.measured(0.0) if spare else wanted[:, 0].copy()
        return cls(windows, after, wanted, start)

    def part(self, chosen: Flags) -> 'Shots':
        """
        Return some of the windows.

        Parameters
        ----------
        chosen
            Which, shape (w,).

        """
        parts = None if self.windows.parts is None else self.windows.parts[chosen]
        windows = replace(self.windows, begins=self.windows.begins[chosen], parts=parts)
        return Shots(windows, self.after, self.wanted[chosen], self.start[chosen])


@dataclass(frozen=True)
class Linear:
    """Residuals of one flight's windows, and their derivatives: (w, n), (w, n, p), (w, n, 12)."""

    residual: Array
    by_parameter: Array
    by_state: Array


class Shooter:
    """
    One flight flown for a fit, in one thread.

    Parameters
    ----------
    shots
        Its windows.
    weights
        1/sigma of the 12 errors.
    free
        Whether the states at the begins are unknown; else they are as measured.

    """

    def __init__(self, shots: Shots, weights: Array, free: bool = True) -> None:
        self.shots, self.weights, self.free = shots, weights, free
        #: Of each window, shape (w, 1): one that runs away says little of the parameters.
        self.trust: Array = np.ones((len(shots.start), 1))
        self._by_state: Array | None = None
        self._spun: Array | None = None

    def residual(self, trial: Trial, start: Array | None = None) -> Array:
        """
        Return weighted errors of all windows, shape (w, n).

        Parameters
        ----------
        trial
            The model, with its parameters.
        start
            States at the begins; None: those of the shots.

        """
        flyer = Flyer(trial.driven, 1)
        start = self.shots.start if start is None else start
        return self._fly(flyer, trial.late, start, self._spin(flyer))

    def linear(
        self, trial: Trial, others: Sequence[Trial], steps: Sequence[float], fresh: bool,
        pool: ThreadPoolExecutor,
    ) -> Linear:  # fmt: skip
        """
        Return residuals and their derivatives.

        Parameters
        ----------
        trial
            The model at the present parameters.
        others
            At each parameter moved by its step.
        steps
            They.
        fresh
            Whether the derivatives by the states are taken anew.
        pool
            Threads; each model is flown in one.

        Returns
        -------
        Linear
            Of this flight.

        """
        start = self.shots.start
        flyer = Flyer(trial.driven, 1)
        spun = self._spin(flyer)
        base = self._fly(flyer, trial.late, start, spun)
        later = [pool.submit(self._moved, other, base) for other in others]
        if not self.free:
            self._by_state = np.zeros((*base.shape, SIZE))
        elif fresh or self._by_state is None:

            def along(i: int) -> Array:
                by = np.zeros(SIZE)
                by[i] = _STATE_STEPS[i]
                flown = Flyer(trial.driven, 1)
                found = self._fly(flown, trial.late, moved(start, by), spun)
                change: Array = (found - base) / _STATE_STEPS[i]
                return change

            self._by_state = np.stack(list(pool.map(along, range(SIZE))), axis=2)
        columns = [(f.result() - base) / step for f, step in zip(later, steps, strict=True)]
        by_parameter = np.stack(columns, axis=2) if columns else np.zeros((*base.shape, 0))
        return Linear(base, by_parameter, self._by_state)

    def _moved(self, trial: Trial, base: Array) -> Array:
        """Return residuals of a trial, flown only where it differs from the base."""
        if trial.touched is None:
            return self.residual(trial)
        found = base.copy()
        if trial.touched.any():
            part = Shooter(self.shots.part(trial.touched), self.weights, self.free)
            part.trust = self.trust[trial.touched]
            found[trial.touched] = part.residual(trial)
        return found

    def _spin(self, flyer: Flyer) -> Array | None:
        return first_speeds(flyer, self.shots.windows, self.shots.start)

    def _fly(self, flyer: Flyer, late: Array | None, start: Array, spun: Array | None) -> Array:
        shots, step = self.shots, flyer.timestep
        every = [max(1, round(seconds / step)) for seconds in shots.after[1:]]
        if late is not None:
            every = list(range(1, round(shots.windows.length / step) + 1))
        controls = shots.windows.controls(flyer.driven, step)[:, : every[-1]]
        full = flyer.states(start, shots.windows, spun)
        found = np.concatenate([start[:, None], flyer.fly(full, controls, every)], axis=1)
        if late is not None:
            found = seen(found, shots.after, late, step)
        off: Array = np.nan_to_num(error_vectors(found, shots.wanted) * self.weights, nan=1e6)
        return off.reshape(len(start), -1) * self.trust
