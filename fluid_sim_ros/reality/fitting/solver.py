"""Steps of a fit towards the least squares: Gauss-Newton with damping, states taken out."""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field

import numpy as np

from fluid_sim_ros.errors import ModelError
from fluid_sim_ros.flights.flight import Flight
from fluid_sim_ros.flights.mapping import Output
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.reality.driven import comparable_scene, drive
from fluid_sim_ros.reality.fitting.delays import delays_of
from fluid_sim_ros.reality.fitting.shooting import Linear, Shooter, Shots, Trial, moved
from fluid_sim_ros.reality.parameter import Parameter
from fluid_sim_ros.reality.parameters import edit_of
from fluid_sim_ros.schema.settings import RunSettings

Report = Callable[[str, int, int], None]

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
    where the signals are noisy).
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
        self.flights, self.task, self.chosen, self.shots = flights, task, chosen, shots
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
        edit, task = edit_of(self.chosen, values), self.task
        driven = drive(self.scene, flight, task.outputs, settings=task.settings, edit=edit)
        return Trial(driven, delays_of(self.chosen, values))

    def _cost(self, values: Array, starts: list[Array]) -> float:
        total = 0.0
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
            others = []
            for i, step in enumerate(steps):
                shifted = values.copy()
                shifted[i] += step
                others.append(self._trial(flight, shifted))
            trial = self._trial(flight, values)
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
            cost = sum(float((each.residual**2).sum()) for each in linear)
            if count == 0:
                first = cost
            for _ in range(8):
                step, moves = _step(linear, self.scales, damping)
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


def _reduced(each: Linear, scales: Array) -> tuple[Array, Array, Array, Array]:
    """Return derivatives with the states taken out, by window, and what the states need."""
    jx, jp = each.by_state, each.by_parameter * scales
    inner = np.einsum('wni,wnj->wij', jx, jx) + 1e-9 * np.eye(jx.shape[2])
    cross = np.linalg.solve(inner, np.einsum('wni,wnp->wip', jx, jp))
    rest = np.linalg.solve(inner, np.einsum('wni,wn->wi', jx, each.residual)[..., None])[..., 0]
    jp_free = jp - np.einsum('wni,wip->wnp', jx, cross)
    r_free = each.residual - np.einsum('wni,wi->wn', jx, rest)
    return jp_free, r_free, cross, rest


def _step(linear: list[Linear], scales: Array, damping: float) -> tuple[Array, list[Array]]:
    """Return the step of the parameters, and of each flight's states."""
    parts = [_reduced(each, scales) for each in linear]
    curved = sum(np.einsum('wnp,wnq->pq', jp, jp) for jp, _, _, _ in parts)
    slope = sum(np.einsum('wnp,wn->p', jp, r) for jp, r, _, _ in parts)
    curved = np.asarray(curved)
    ridge = damping * np.diag(np.maximum(np.diag(curved), 1e-12 * np.diag(curved).max()))
    step = -np.linalg.lstsq(curved + ridge, np.asarray(slope), rcond=1e-13)[0]
    moves = [-rest - np.einsum('wip,p->wi', cross, step) for _, _, cross, rest in parts]
    return step * scales, moves


def sandwich(linear: list[Linear], scales: Array) -> tuple[Array, Array, int]:
    """
    Return curvature and the scatter of the windows' scores, in scales; and their number.

    Parameters
    ----------
    linear
        At the least squares.
    scales
        Of the parameters, shape (p,).

    """
    count = len(scales)
    curved, score, windows = np.zeros((count, count)), np.zeros((count, count)), 0
    for each in linear:
        jp, r, _, _ = _reduced(each, scales)
        curved += np.einsum('wnp,wnq->pq', jp, jp)
        each_score = np.einsum('wnp,wn->wp', jp, r)
        score += each_score.T @ each_score
        windows += len(r)
    return curved, score, windows
