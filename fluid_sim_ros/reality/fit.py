# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Fits parameters of a model to flights, with honest errors.

Own Gauss-Newton steps with damping, not ``mujoco.sysid`` or SciPy's ``least_squares``: both would
see the states of hundreds of windows as ordinary unknowns, and neither gives the covariance of
clustered residuals. The errors of a real model are no white noise: within a window they go
together. So the covariance is the sandwich by windows (Liang and Zeger 1986), which holds for
white noise too, each window's residuals as they would be without it in the fit (jackknife by
clusters, CR3 of Bell and McCaffrey 2002): a fit bends towards its few windows.
"""

import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.special import stdtrit

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.flights.about import refuse_unclear, require_comparable
from fluid_sim_ros.flights.flight import STATE, Flight
from fluid_sim_ros.flights.sparse import sparse_lines
from fluid_sim_ros.output.progress import Report, silent
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.reality.airborne import airborne
from fluid_sim_ros.reality.carried import with_parts
from fluid_sim_ros.reality.driven import comparable_scene, drive
from fluid_sim_ros.reality.fitting.delays import longest, told
from fluid_sim_ros.reality.fitting.disturbance import Knot
from fluid_sim_ros.reality.fitting.disturbance import told as told_of_knots
from fluid_sim_ros.reality.fitting.doubt import doubts
from fluid_sim_ros.reality.fitting.normal import sandwich
from fluid_sim_ros.reality.fitting.shooting import Shots
from fluid_sim_ros.reality.fitting.solver import Solver, Task
from fluid_sim_ros.reality.flying import Flyer
from fluid_sim_ros.reality.parameter import Parameter
from fluid_sim_ros.reality.parameters import find_parameters
from fluid_sim_ros.reality.spinning import lead_in
from fluid_sim_ros.reality.windows import cut

#: Least standard deviations: [m], [rad], [m/s], [rad/s]; a log rounds.
_LEAST_SIGMA = (1e-4, 1e-4, 1e-3, 1e-3)
#: Two parameters are not told apart beyond this correlation; one is not felt beyond this error.
_ALIKE, _UNFELT = 0.95, 1.0
#: With so many windows standard errors are those of a normal distribution.
_MANY = 30


@dataclass(frozen=True)
class Fitted:
    """
    What came out.

    Attributes
    ----------
    parameters
        They.
    values, errors
        And their standard errors, each in its unit, shape (p,).
    correlations
        Shape (p, p).
    rms
        Weighted residuals before and after.
    sigmas
        Of position, attitude, velocity, rates [m], [rad], [m/s], [rad/s].
    windows, steps
        How many.
    lines
        What a reader must know.

    """

    parameters: tuple[Parameter, ...]
    values: Array
    errors: Array
    correlations: Array
    rms: tuple[float, float]
    sigmas: Array
    windows: int
    steps: int
    lines: tuple[str, ...]

    def numbers(self) -> dict[str, Any]:
        """Return what ``--json`` writes."""
        return {
            'parameters': {
                p.name: {'value': float(v), 'standard_error': float(e), 'before': p.value,
                         'unit': p.unit}
                for p, v, e in zip(self.parameters, self.values, self.errors, strict=True)
            },
            'correlations': self.correlations.tolist(),
            'residual_rms': {'before': self.rms[0], 'after': self.rms[1]},
            'sigmas': dict(zip(STATE, self.sigmas.tolist(), strict=True)),
            'windows': self.windows, 'steps': self.steps, 'lines': list(self.lines),
        }  # fmt: skip


def fit(
    flights: Sequence[Flight], task: Task, report: Report = silent,
    keep: Callable[[dict[str, float]], None] = lambda _: None,
) -> Fitted:  # fmt: skip
    """
    Fit parameters to flights by multiple shooting.

    Parameters
    ----------
    flights
        That drive the model.
    task
        What is fitted.
    report
        Told how far it is.
    keep
        Given the values after each step, to go on from them later.

    Returns
    -------
    Fitted
        Values with errors.

    Raises
    ------
    FlightError, ConfigError
        If a flight cannot be used, or a parameter is not in the model.

    """
    if not task.parameters:
        raise ConfigError('--parameters: name at least one')
    scene = comparable_scene(task.model)
    chosen = find_parameters(scene, task.parameters)
    shots, lines = cut_shots(flights, task)
    sigmas = _sigmas(shots)
    solver = Solver(flights, task, chosen, shots, sigmas)
    chosen = solver.chosen
    values = np.array([task.values.get(p.name, p.value) for p in chosen])
    solver.require_felt(values)
    if task.start == 'measured':  # what noise alone would weigh is far below what is left over
        sigmas = np.maximum(solver.left_over(values), sigmas)
        solver.weigh(sigmas)
        solver.distrust(values)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for last in (False, True):
            values, count, first = solver.solve(values, pool, report, keep)
            if not last:  # what a model cannot follow counts less: weights by what is left over
                before = first
                sigmas = np.maximum(solver.left_over(values), sigmas)
                solver.weigh(sigmas)
                if task.start == 'measured':
                    solver.distrust(values)
        lines += doubts(flights, [each.windows for each in shots], task, chosen, values)
        return _result(solver, values, pool, before, count, lines)


def cut_shots(flights: Sequence[Flight], task: Task) -> tuple[list[Shots], list[str]]:
    """
    Cut flights into the windows of a fit.

    Parameters
    ----------
    flights
        That drive the model.
    task
        What is fitted.

    Returns
    -------
    shots, lines
        One for each flight, and what a reader must know.

    """
    scene = comparable_scene(task.model)
    shots, lines = [], []
    spare = longest(task.parameters, task.start)
    for flight in flights:
        require_comparable(flight)
        lines += refuse_unclear(flight)
        driven = drive(scene, flight, task.outputs, settings=task.settings)
        flyer = Flyer(driven, 1)
        windows = cut(flight, task.length + 2 * spare, begin=task.begin, end=task.end,
                      apart=task.length, before=lead_in(driven, flyer.timestep))  # fmt: skip
        windows, left = airborne(windows, flyer)
        windows = with_parts(windows, driven)
        lines += [f'{flight.name}: {n} windows {why}' for why, n in left.items()]
        lines += [f'{flight.name}: {note}' for note in (*driven.notes, *sparse_lines(flight))]
        step = max(1, round(task.sample / flyer.timestep)) * flyer.timestep
        shots.append(Shots.of(windows, step, spare))
    return shots, lines


def _sigmas(shots: Sequence[Shots]) -> Array:
    """Return the noise of position, attitude, velocity and rates, by third differences."""
    found = []
    for name, least in zip(STATE, _LEAST_SIGMA, strict=True):
        rough = []
        for shot in shots:
            signal = shot.windows.flight.signals[name]
            values = signal.values * (2.0 if name == 'attitude' else 1.0)
            third = np.diff(values, 3, axis=0)
            if len(third):
                rough.append(float(np.sqrt((third**2).mean() / 20.0)))
        found.append(max(least, float(np.median(rough)) if rough else least))
    return np.array(found)


def _result(
    solver: Solver, values: Array, pool: ThreadPoolExecutor, before: float, count: int,
        lines: list[str],
    ) -> Fitted:  # fmt: skip
    linear = solver.linear(values, True, pool)
    walked = solver.walked()
    curved, score, windows = sandwich(linear, solver.scales, walked)
    inverse = np.linalg.pinv(curved, rcond=1e-12, hermitian=True)
    covariance = inverse @ score @ inverse
    # what the flights do not touch has no curvature: no error that means anything
    touched = np.diag(curved) > 1e-9 * np.diag(curved).max()
    errors = np.sqrt(np.maximum(np.diag(covariance), 0.0))
    errors[~touched] = np.inf
    size = np.where(errors > 0, errors, 1.0)
    correlations = covariance / np.outer(size, size)
    knots = np.array([isinstance(p, Knot) for p in solver.chosen])
    # few windows touch a knot: their scatter alone may be small by chance
    least = np.sqrt(np.maximum(np.diag(inverse), 0.0))
    errors[knots] = np.maximum(errors, least)[knots]
    after = sum(float((each.residual**2).sum()) for each in linear)
    number = sum(each.residual.size for each in linear)
    rms = (float(np.sqrt(before / number)), float(np.sqrt(after / number)))
    lines = [*lines, *told(solver.chosen, values)]
    lines += told_of_knots(solver.chosen, values, errors * solver.scales)
    lines += _judged(solver.chosen, values, errors * solver.scales, correlations)
    lines += _few(windows)
    finite = np.where(np.isfinite(errors), errors * solver.scales, 0.0)
    return Fitted(tuple(solver.chosen), values, finite, np.nan_to_num(correlations), rms,
                      solver.sigmas, windows, count, tuple(lines))  # fmt: skip


def _few(windows: int) -> list[str]:
    """Return what few windows say of the errors themselves: those of Student's t."""
    if windows >= _MANY or windows < 3:
        return []
    within = float(stdtrit(windows - 1, 0.975))
    scatter = 100.0 / np.sqrt(2.0 * (windows - 1))
    return [
        f'{windows} windows: standard errors are themselves known to {scatter:.0f} %; 95 % of '
        f'fits lie within {within:.2f} of them, not 1.96: fly longer, or shorten --window'
    ]


def _judged(
    chosen: list[Parameter], values: Array, errors: Array, correlations: Array
) -> list[str]:
    """Return what the flights cannot tell, and which manoeuvre would."""
    lines = []
    for i, parameter in enumerate(chosen):
        size = max(abs(values[i]), 1e-3 * parameter.scale)
        if not np.isfinite(errors[i]):
            lines.append(f'{parameter.name}: the flights do not touch it; {parameter.manoeuvre}')
        elif errors[i] > _UNFELT * size and not isinstance(parameter, Knot):  # may well be 0
            lines.append(
                f'{parameter.name}: {values[i]:.3g} +- {errors[i]:.2g} {parameter.unit}, not told '
                f'from noise; what would tell: {parameter.manoeuvre}'
            )
        if values[i] in (parameter.low, parameter.high):
            lines.append(f'{parameter.name}: stands at its bound {values[i]:.4g}')
        for j in range(i):
            if isinstance(parameter, Knot) and isinstance(chosen[j], Knot):
                continue  # neighbours go together: they walk
            if abs(correlations[i, j]) > _ALIKE and np.isfinite(errors[[i, j]]).all():
                lines.append(
                    f'{chosen[j].name} and {parameter.name} are not told apart (correlation '
                    f'{correlations[i, j]:+.3f}); what would: {parameter.manoeuvre}'
                )
    return lines
