# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Compares a model with a flight: open-loop windows, two baselines, residuals of accelerations."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.flights.about import refuse_unclear, require_comparable
from fluid_sim_ros.flights.checks.consistency import check_flight
from fluid_sim_ros.flights.flight import Flight
from fluid_sim_ros.flights.mapping import Output
from fluid_sim_ros.flights.sparse import sparse_lines
from fluid_sim_ros.output.progress import Report, silent
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.reality.airborne import airborne
from fluid_sim_ros.reality.carried import with_parts
from fluid_sim_ros.reality.driven import Edit, comparable_scene, drive, floats, without_air
from fluid_sim_ros.reality.flying import Flyer
from fluid_sim_ros.reality.residual.findings import words
from fluid_sim_ros.reality.residual.numbers import summary
from fluid_sim_ros.reality.residual.residuals import Residuals, residuals
from fluid_sim_ros.reality.residual.thruster_order import likely_order
from fluid_sim_ros.reality.spinning import first_speeds, lead_in
from fluid_sim_ros.reality.windows import Windows, cut, errors, held_velocity
from fluid_sim_ros.schema.settings import RunSettings

HORIZONS = (0.1, 0.25, 0.5, 1.0)
#: Passes over the windows: the model, the rigid body, the accelerations along the flight.
_PASSES = 3
#: Names of the baselines, and what they are.
BASELINES = {
    'hold_velocity': 'velocity and rates stay as they are',
    'rigid_body': 'mass, inertia and static thrust, without aero- or hydrodynamics',
}


@dataclass(frozen=True)
class Part:
    """Which part of a flight is compared, and how: times [s] and the settings of the runs."""

    begin: float = 0.0
    end: float = np.inf
    horizons: tuple[float, ...] = HORIZONS
    settings: RunSettings = field(default_factory=RunSettings)
    threads: int | None = None


@dataclass(frozen=True)
class Comparison:
    """
    What came out.

    Attributes
    ----------
    numbers
        What ``--json`` writes.
    windows, errors, baselines
        The windows, and the errors at each horizon, shape (w, m), of model and baselines.
    residuals
        Accelerations along the flight.

    """

    numbers: dict[str, Any]
    windows: Windows
    errors: dict[str, Array]
    baselines: dict[str, dict[str, Array]]
    residuals: Residuals


def compare(
    flight: Flight, model: str, outputs: Sequence[Output] = (), part: Part = Part(),
    edit: Edit | None = None, report: Report = silent,
) -> Comparison:  # fmt: skip
    """
    Fly a flight again with a model, in short windows from measured states.

    Parameters
    ----------
    flight
        That was read.
    model
        Name or path of the scene.
    outputs
        What the outputs of an autopilot drive.
    part
        Which part of it, with which horizons and settings.
    edit
        Changes the model, such as its parameters.
    report
        Is told how far it is.

    Returns
    -------
    Comparison
        Errors by horizon, beside those of two baselines, and residuals.

    Raises
    ------
    FlightError, ConfigError
        If the flight lacks something, contradicts itself, or does not fit the model.

    """
    require_comparable(flight)
    odd = refuse_unclear(flight)
    horizons = _checked(part.horizons)
    scene = comparable_scene(model)
    driven = drive(scene, flight, tuple(outputs), settings=part.settings, edit=edit)
    flyer = Flyer(driven, part.threads)
    before = lead_in(driven, flyer.timestep)
    windows = cut(flight, horizons[-1], begin=part.begin, end=part.end, before=before)
    windows, at_rest = airborne(windows, flyer)
    windows = with_parts(windows, driven)
    measured = windows.measured(np.array(horizons))
    report(f'{len(windows.begins)} windows', 0, _PASSES)
    found = {'model': errors(fly_windows(flyer, windows, horizons), measured)}
    report(f'{len(windows.begins)} windows', 1, _PASSES)
    start = windows.measured(0.0)
    found['hold_velocity'] = errors(held_velocity(start, horizons), measured)
    no_fluid = part.settings.model_copy(update={'fluid': 'none'})
    rigid = drive(
        scene, flight, tuple(outputs), settings=no_fluid, edit=_both(edit, without_air)
    )  # fmt: skip
    bare = Flyer(rigid, part.threads)
    found['rigid_body'] = errors(fly_windows(bare, windows, horizons), measured)
    report(f'{len(windows.begins)} windows', 2, _PASSES)
    along = residuals(flyer, windows)
    report(f'{len(windows.begins)} windows', _PASSES, _PASSES)
    off = summary(along, floats(driven))
    numbers: dict[str, Any] = {
        'log': str(flight.raw.path), 'kind': flight.raw.kind, 'model': model,
        'vehicle': driven.vehicle.name, 'driven_by': driven.kind,
        'timestep_s': flyer.timestep,
        'windows': {
            'used': len(windows.begins), 'left_out': windows.left_out | at_rest,
            'from_s': float(windows.begins[0]), 'to_s': float(windows.begins[-1]) + horizons[-1],
        },
        **by_horizon(horizons, found['model']),
        'baselines': {
            name: {'what': what, **by_horizon(horizons, found[name])}
            for name, what in BASELINES.items()
        },
        'residuals': off,
        'words': words(off, likely_order(along, flyer, flight)) + _against(horizons, found),
        'notes': [
            *odd, *driven.notes, *sparse_lines(flight), *flight.notes, *flight.raw.faults,
        ],
        'clocks': {
            check.what: round(check.offset, 5)
            for check in check_flight(flight) if check.offset is not None
        },
    }  # fmt: skip
    baselines = {name: found[name] for name in BASELINES}
    return Comparison(numbers, windows, found['model'], baselines, along)


def _checked(horizons: Sequence[float]) -> tuple[float, ...]:
    """Return horizons in order; ConfigError for one that is none."""
    if not horizons or min(horizons) < 0.01 or max(horizons) > 60:
        raise ConfigError('--horizons: times of 0.01 to 60 s')
    return tuple(sorted(set(horizons)))


def _both(first: Edit | None, second: Edit) -> Edit:
    def edit(spec: mujoco.MjSpec) -> None:
        if first is not None:
            first(spec)
        second(spec)

    return edit


def fly_windows(flyer: Flyer, windows: Windows, horizons: Sequence[float]) -> Array:
    """
    Fly all windows of a flight with its wind; return the states at the horizons, (w, m, 13).

    Parameters
    ----------
    flyer
        Of the driven model.
    windows
        Of the flight.
    horizons
        [s]; each becomes the nearest whole number of steps.

    Returns
    -------
    Array
        Shape (w, m, 13).

    """
    step = flyer.timestep
    every = [max(1, round(h / step)) for h in horizons]
    start = windows.measured(0.0)
    controls = windows.controls(flyer.driven, step)[:, : every[-1]]
    spun = first_speeds(flyer, windows, start)
    return flyer.fly(flyer.states(start, windows, spun), controls, every)


def by_horizon(horizons: Sequence[float], found: dict[str, Array]) -> dict[str, Any]:
    """
    Return median and 90 % of each error at each horizon.

    Parameters
    ----------
    horizons
        [s], shape (m,).
    found
        As ``windows.errors`` returns them, shape (w, m).

    Returns
    -------
    dict
        ``{'horizons': {'0.5': {'position_m': {'median': ..., 'p90': ...}, ...}}}``.

    """
    return {
        'horizons': {
            f'{horizon:g}': {
                name: {
                    'median': _finite(np.median(values[:, i])),
                    'p90': _finite(np.percentile(values[:, i], 90)),
                }
                for name, values in found.items()
            }
            for i, horizon in enumerate(horizons)
        }
    }


def _finite(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def _against(horizons: Sequence[float], found: dict[str, dict[str, Array]]) -> list[str]:
    """Return how the model stands beside the baselines, in words."""
    lines = []
    for name, words_of in (('hold_velocity', 'holding the last velocity'),
                           ('rigid_body', 'a rigid body without a fluid')):  # fmt: skip
        worse = [
            f'{horizon:g} s'
            for i, horizon in enumerate(horizons)
            if np.median(found['model']['position_m'][:, i])
            > np.median(found[name]['position_m'][:, i])
        ]
        if worse:
            lines.append(f'no better than {words_of} at {", ".join(worse)} (position)')
    return lines
