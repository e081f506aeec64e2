# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Steps of a fit towards the least squares: Gauss-Newton with damping, states taken out."""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace

import numpy as np

from fluid_sim_ros.errors import ModelError
from fluid_sim_ros.flights.flight import Flight
from fluid_sim_ros.flights.mapping import Output
from fluid_sim_ros.output.progress import Report
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.reality.driven import comparable_scene, drive
from fluid_sim_ros.reality.fitting.delays import delays_of
from fluid_sim_ros.reality.fitting.disturbance import (
    Knot,
    require_felt,
    touched_by,
    walks,
    with_flow,
    with_knots,
)
from fluid_sim_ros.reality.fitting.normal import step_of
from fluid_sim_ros.reality.fitting.shooting import Linear, Shooter, Shots, Trial, moved
from fluid_sim_ros.reality.parameter import Parameter
from fluid_sim_ros.reality.parameters import edit_of
from fluid_sim_ros.schema.settings import RunSettings

_MOST_STEPS = 20
#: Fitted when no parameter moves by more than this share of its scale, or the sum of squares not.
_SETTLED, _STILL = 1e-4, 1e-6
#: Longest step of a parameter, in its scale, where windows start as measured.
_LEAP = 0.3
#: Step of the differences by a parameter, in its scale.
_STEP = 1e-4


@dataclass(frozen=True)
class Task:
    """
    What is fitted, and how: window length and distance of compared states [s].

    ``start``: ``free`` (states at the begins are unknown, too) or ``measured`` (a window starts
    where the log says, as in a comparison: best prediction, with a response that is too weak
    where the signals are noisy). ``knots``: longest time between those of a slow wind or current
    [s]; ``walk``: how strongly it walks at random [m/s per square root of a second].
    """

    model: str
    parameters: tuple[str, ...]
    length: float = 0.5
    sample: float = 0.02
    begin: float = 0.0
    end: float = np.inf
    settings: RunSettings = field(default_factory=RunSettings)
    outputs: tuple[Output, ...] = ()
    values: dict[str, float] = field(default_factory=dict)
    start: str = 'free'
    knots: float = 5.0
    walk: float = 0.1


class Solver:
    """
    Steps towards the least squares.

    Parameters
    ----------
    flights
        That drive the model.
    task
        What is fitted, and how.
    chosen
        The parameters.
    shots
        Windows of each flight.
    sigmas
        Of position, attitude, velocity and rates [m], [rad], [m/s], [rad/s].

    """

    def __init__(
        self, flights: Sequence[Flight], task: Task, chosen: list[Parameter],
        shots: list[Shots], sigmas: Array,
    ) -> None:  # fmt: skip
        self.flights, self.task, self.shots = flights, task, shots
        self.chosen = with_knots(chosen, [shot.windows for shot in shots], task.knots)
        chosen = self.chosen
        #: Makes residuals of steps from knot to knot of the values.
        self.walks = walks(chosen, task.walk)
        self.scales = np.array([p.scale for p in chosen])
        self.low = np.array([p.low for p in chosen])
        self.high = np.array([p.high for p in chosen])
        self.scene = comparable_scene(task.model)
        self.weigh(sigmas)

    def weigh(self, sigmas: Array) -> None:
        """
        Weigh errors anew.

        Parameters
        ----------
        sigmas
            Of position, attitude, velocity and rates [m], [rad], [m/s], [rad/s].

        """
        self.sigmas = sigmas
        weights = 1.0 / np.repeat(sigmas, 3)
        free = self.task.start == 'free'
        self.shooters = [Shooter(shot, weights, free) for shot in self.shots]

    def _trial(self, flight: Flight, values: Array) -> Trial:
        task = self.task
        edit = edit_of(self.chosen, values)
        if task.settings.fluid != 'none':  # as with a recorded flow
            edit = with_flow(edit, flight, self.chosen, values)
        driven = drive(self.scene, flight, task.outputs, settings=task.settings, edit=edit)
        return Trial(driven, delays_of(self.chosen, values))

    def _cost(self, values: Array, starts: list[Array]) -> float:
        total = float(((self.walks @ values) ** 2).sum())
        for flight, shooter, start in zip(self.flights, self.shooters, starts, strict=True):
            total += float((shooter.residual(self._trial(flight, values), start) ** 2).sum())
        return total

    def linear(self, values: Array, fresh: bool, pool: ThreadPoolExecutor) -> list[Linear]:
        """
        Return residuals and derivatives of each flight.

        Parameters
        ----------
        values
            Of the parameters, shape (p,).
        fresh
            Whether the derivatives by the states are taken anew.
        pool
            Threads.

        """
        steps = _STEP * self.scales
        steps = np.where(values + steps > self.high, -steps, steps)
        found = []
        for flight, shooter in zip(self.flights, self.shooters, strict=True):
            trial = self._trial(flight, values)
            others = []
            for i, step in enumerate(steps):
                near = touched_by(self.chosen, i, flight, shooter.shots.windows)
                if near is not None and not near.any():  # of another flight: nothing is flown
                    others.append(replace(trial, touched=near))
                    continue
                shifted = values.copy()
                shifted[i] += step
                others.append(replace(self._trial(flight, shifted), touched=near))
            found.append(shooter.linear(trial, others, steps.tolist(), fresh, pool))
        return found

    def solve(
        self, values: Array, pool: ThreadPoolExecutor, report: Report,
        keep: Callable[[dict[str, float]], None],
    ) -> tuple[Array, int, float]:  # fmt: skip
        """
        Go to the least squares.

        Parameters
        ----------
        values
            To begin at, shape (p,).
        pool
            Threads.
        report
            Told how far it is.
        keep
            Given the values after each step.

        Returns
        -------
        values, steps, first
            Those found, how many steps it took, and the sum of squares at the begin.

        """
        damping, first = 1e-6, 0.0
        for count in range(_MOST_STEPS):
            report('fit', count, _MOST_STEPS)
            linear = self.linear(values, count < 2, pool)
            steps = self.walks @ values
            cost = sum(float((each.residual**2).sum()) for each in linear)
            cost += float((steps**2).sum())
            if count == 0:
                first = cost
            for _ in range(8):
                step, moves = step_of(linear, self.scales, damping, self.walks, steps)
                if self.task.start == 'measured':  # windows grow away from the log: no leaps
                    step *= min(1.0, _LEAP / np.abs(step / self.scales).max())
                trial = np.clip(values + step, self.low, self.high)
                starts = [
                    moved(shot.start, move) for shot, move in zip(self.shots, moves, strict=True)
                ]
                try:
                    new = self._cost(trial, starts)
                except ModelError:  # no such body: an inertia beyond the sum of the others
                    new = np.inf
                if new < cost * (1 + 1e-12):
                    break
                damping = max(damping * 30, 1e-4)
            else:
                return values, count, first
            damping = max(damping / 10, 1e-9)
            change = np.abs(trial - values) / self.scales
            values = trial
            for shot, start in zip(self.shots, starts, strict=True):
                shot.start = start
            keep(dict(zip((p.name for p in self.chosen), values.tolist(), strict=True)))
            if change.max() < _SETTLED or cost - new < _STILL * cost:
                return values, count + 1, first
        return values, _MOST_STEPS, first

    def walked(self) -> Array:
        """Return the curvature that steps from knot to knot add, in scales, shape (p, p)."""
        steps = self.walks * self.scales
        curved: Array = steps.T @ steps
        return curved

    def require_felt(self, values: Array) -> None:
        """
        Refuse a slow wind or current that nothing feels.

        Parameters
        ----------
        values
            Of the parameters, shape (p,).

        Raises
        ------
        ConfigError
            Naming it.

        """
        for name in dict.fromkeys(p.of for p in self.chosen if isinstance(p, Knot)):
            by = [float(isinstance(p, Knot) and p.of == name) for p in self.chosen]
            off, still = (
                np.concatenate(
                    [
                        shooter.residual(self._trial(flight, each)).ravel()
                        for flight, shooter in zip(self.flights, self.shooters, strict=True)
                    ]
                )
                for each in (values + by, values)
            )
            require_felt(name, off, still)

    def distrust(self, values: Array) -> None:
        """
        Count windows less that are farther off than most (Huber's weights, by window).

        Parameters
        ----------
        values
            Of the parameters, shape (p,).

        """
        for flight, shooter in zip(self.flights, self.shooters, strict=True):
            shooter.trust[:] = 1.0
            off = shooter.residual(self._trial(flight, values))
            size = np.sqrt((off**2).mean(axis=1, keepdims=True))
            shooter.trust = np.minimum(1.0, 1.5 * np.median(size) / np.maximum(size, 1e-300))

    def left_over(self, values: Array) -> Array:
        """
        Return the rms of what is left of position, attitude, velocity and rates.

        Parameters
        ----------
        values
            Of the parameters, shape (p,).

        """
        squares, number = np.zeros(4), 0
        for flight, shooter in zip(self.flights, self.shooters, strict=True):
            off = shooter.residual(self._trial(flight, values)).reshape(-1, 4, 3)
            squares += (off**2).mean(axis=2).sum(axis=0)
            number += len(off)
        left: Array = np.sqrt(squares / number) * self.sigmas
        return left
