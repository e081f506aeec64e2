# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Which effect of a model is worth its cost against a flight: rungs, integrators, timesteps."""

import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from fluid_sim_ros.errors import ConfigError, ModelError, listed
from fluid_sim_ros.flights.about import refuse_unclear, require_comparable
from fluid_sim_ros.flights.flight import Flight
from fluid_sim_ros.flights.mapping import Output
from fluid_sim_ros.output.progress import Report, silent
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.reality.airborne import airborne
from fluid_sim_ros.reality.carried import with_parts
from fluid_sim_ros.reality.charting.rungs import ladder
from fluid_sim_ros.reality.compare import fly_windows
from fluid_sim_ros.reality.driven import Driven, comparable_scene, drive
from fluid_sim_ros.reality.flying import Flyer
from fluid_sim_ros.reality.spinning import lead_in
from fluid_sim_ros.reality.windows import Windows, cut, errors, held_velocity
from fluid_sim_ros.schema.settings import RunSettings

INTEGRATORS = ('Euler', 'implicitfast', 'RK4')
TIMESTEPS = (0.02, 0.01, 0.005, 0.002, 0.001)
#: What the discretisation is held against.
_CONVERGED = ('RK4', 0.0005)
#: Windows of a chart at most; repetitions of a timing.
_MOST, _TIMED = 120, 3
#: An effect is worth its cost if it takes this share off the error.
_WORTH = 0.05
KEYS = ('position_m', 'velocity_m_s', 'attitude_deg')


@dataclass(frozen=True)
class Chosen:
    """What is charted: horizon and part of the flight [s], integrators, timesteps [s]."""

    horizon: float = 0.5
    begin: float = 0.0
    end: float = np.inf
    integrators: tuple[str, ...] = INTEGRATORS
    timesteps: tuple[float, ...] = TIMESTEPS


def chart_against(
    flight: Flight, model: str, outputs: Sequence[Output] = (), chosen: Chosen = Chosen(),
    report: Report = silent,
) -> dict[str, Any]:  # fmt: skip
    """
    Return the errors of a model's rungs to a flight, and what they cost.

    Parameters
    ----------
    flight
        That was read.
    model
        Name or path of the scene.
    outputs
        What the outputs of an autopilot drive.
    chosen
        What is charted.
    report
        Told how far it is.

    Returns
    -------
    dict
        ``points``: rung, integrator, timestep, medians of the errors to the flight, of the
        discretisation (against RK4 at 0.5 ms on the same rung), processor time.

    Raises
    ------
    FlightError, ConfigError
        If the flight lacks something, or a setting is none.

    """
    _check(chosen)
    require_comparable(flight)
    notes = refuse_unclear(flight)
    scene = comparable_scene(model)
    rungs = ladder(scene)

    def driven(edit: Any, integrator: str, step: float) -> Driven:
        settings = RunSettings.model_validate({'integrator': integrator, 'timestep': step})
        return drive(scene, flight, tuple(outputs), settings=settings, edit=edit)

    richest = driven(None, *_CONVERGED)
    if richest.kind == 'rotor_speed':  # measured: no lag to see
        rungs.pop('lag', None)
    windows = cut(flight, chosen.horizon, begin=chosen.begin, end=chosen.end,
                  before=lead_in(richest, max(chosen.timesteps)))  # fmt: skip
    windows, _ = airborne(windows, Flyer(richest))
    every = -(-len(windows.begins) // _MOST)
    windows = Windows(flight, windows.begins[::every], windows.length, windows.left_out)
    windows = with_parts(windows, richest)
    measured = windows.measured(np.array([chosen.horizon]))
    points, gaps = [], {}
    total, done = len(rungs) * (1 + len(chosen.integrators) * len(chosen.timesteps)), 0
    for name, (_, edit) in rungs.items():
        exact = fly_windows(Flyer(driven(edit, *_CONVERGED)), windows, (chosen.horizon,))
        gaps[name] = _medians(exact, measured)
        done += 1
        for integrator in chosen.integrators:
            for step in chosen.timesteps:
                report('chart', done, total)
                done += 1
                try:
                    flyer = Flyer(driven(edit, integrator, step), 1)
                    found = fly_windows(flyer, windows, (chosen.horizon,))
                except ModelError as error:
                    notes.append(f'{name}, {integrator}, {1e3 * step:g} ms: {error}')
                    continue
                points.append({
                    'rung': name, 'integrator': integrator, 'timestep_s': step,
                    'cpu_us_per_s': _cost(flyer, windows, chosen.horizon),
                    **_medians(found, measured),
                    'discretisation': _medians(found, exact),
                })  # fmt: skip
    held = held_velocity(windows.measured(0.0), (chosen.horizon,))
    return {
        'log': str(flight.raw.path), 'model': model, 'horizon_s': chosen.horizon,
        'windows': len(windows.begins), 'driven_by': richest.kind,
        'rungs': {name: {'adds': what, **gaps[name]} for name, (what, _) in rungs.items()},
        'hold_velocity': _medians(held, measured), 'points': points,
        'words': _words(gaps, points), 'notes': [*notes, *richest.notes],
    }  # fmt: skip


def _check(chosen: Chosen) -> None:
    if unknown := [i for i in chosen.integrators if i not in (*INTEGRATORS, 'implicit')]:
        raise ConfigError(
            f'--integrators: {unknown[0]} is not known here; allowed: Euler, RK4, implicit, '
            'implicitfast'
        )
    if not 0.01 <= chosen.horizon <= 60:
        raise ConfigError(f'--horizon: {chosen.horizon:g} is not within 0.01 to 60 s')
    odd = [
        f'{step:g}' for step in chosen.timesteps
        if step > chosen.horizon
        or abs(chosen.horizon / step - round(chosen.horizon / step)) > 1e-6
    ]  # fmt: skip
    if odd:
        raise ConfigError(
            f'--timesteps: {listed(odd)} s do not divide the horizon of {chosen.horizon:g} s'
        )


def _medians(found: Array, wanted: Array) -> dict[str, float | None]:
    off = errors(found, wanted)
    return {
        key: float(value) if np.isfinite(value := np.median(off[key])) else None for key in KEYS
    }


def _cost(flyer: Flyer, windows: Windows, horizon: float) -> float:
    """Return the processor time of one simulated second [us], in one thread."""
    start = windows.measured(0.0)
    controls = windows.controls(flyer.driven, flyer.timestep)[:, : round(horizon / flyer.timestep)]
    full = flyer.states(start, windows, None)
    spent = []
    for _ in range(_TIMED):
        begin = time.process_time()
        flyer.fly(full, controls, (controls.shape[1],))
        spent.append(time.process_time() - begin)
    return float(1e6 * min(spent) / (len(start) * horizon))


def _words(gaps: dict[str, Any], points: list[dict[str, Any]]) -> list[str]:
    """Return which rung is worth its cost, for people."""
    lines, last = [], None
    for name, gap in gaps.items():
        here = gap['position_m']
        if last is not None and here is not None and last[1]:
            less = 1 - here / last[1]
            verdict = 'worth it' if less > _WORTH else 'not worth its cost on this flight'
            lines.append(f'{name}: {100 * less:+.0f} % off the position error: {verdict}')
        last = (name, here)
    richest = list(gaps)[-1]
    gap = gaps[richest]['position_m'] or 0.0
    fit = [p for p in points if p['rung'] == richest
           and (p['discretisation']['position_m'] or np.inf) < 0.1 * gap]  # fmt: skip
    if fit:
        best = min(fit, key=lambda p: p['cpu_us_per_s'])
        lines.append(
            f'cheapest with a discretisation below a tenth of the gap: {best["integrator"]} at '
            f'{1e3 * best["timestep_s"]:g} ms ({best["cpu_us_per_s"]:.3g} us of processor time '
            f'for each second; discretisation {best["discretisation"]["position_m"]:.2g} m, gap '
            f'{gap:.2g} m)'
        )
    return lines
