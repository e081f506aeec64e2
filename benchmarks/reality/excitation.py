# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Whether a fit of an excited flight gives back the truth, with errors that hold.

``truth``: 60 s of ``fluid_sim excite``, fitted from values up to 20 % off: without noise, and with
noise of position 2 mm, attitude 2 mrad, velocity 1 cm/s, rates 5 mrad/s; processor and wall time.
``coverage``: a flight with fresh noise for each of 100 seeds; how often the truth lies within 1,
2, 3 standard errors of a fit.
Run: ``python -m benchmarks.reality.excitation [--quick] [--json PATH] [--only PART]``.
"""

import json
import time
from dataclasses import replace
from typing import Any

import numpy as np

from benchmarks.common import arguments, write
from fluid_sim_ros.flights.flight import Flight
from fluid_sim_ros.reality.driven import comparable_scene
from fluid_sim_ros.reality.exciting.excitation import Limits
from fluid_sim_ros.reality.exciting.excited_flight import excite
from fluid_sim_ros.reality.exciting.foreseen import NOISE
from fluid_sim_ros.reality.fit import Fitted, fit
from fluid_sim_ros.reality.fitting.solver import Task
from fluid_sim_ros.reality.parameters import find_parameters

DOFS = ('surge', 'sway', 'heave', 'roll', 'pitch', 'yaw')
#: What flights can tell: a mass is weighed, and of a body in water tells no more than added mass.
PARAMETERS: dict[str, tuple[str, ...]] = {
    'x500': ('thrust_coefficient', 'torque_ratio', 'time_constant', 'time_constant_down',
             'rotor_drag', 'inertia.x', 'inertia.y', 'inertia.z', 'com.x', 'com.y'),
    'bluerov2_heavy': (
        'time_constant', *(f'added_mass.{d}' for d in DOFS),
        'linear_damping.surge', 'linear_damping.heave', 'linear_damping.pitch',
        *(f'quadratic_damping.{d}' for d in DOFS),
        'volume', 'center_of_buoyancy.z',
    ),
}  # fmt: skip
LIMITS = {
    'x500': Limits(space=20.0, speed=6.0, tilt=0.6, share=0.15),
    'bluerov2_heavy': Limits(space=10.0, speed=2.0, tilt=1.2, share=0.3),
}
#: Parameters of the fits for the coverage, and their flight [s].
COVERED = ('thrust_coefficient', 'rotor_drag', 'inertia.x', 'time_constant')
COVERED_SECONDS, SEEDS = 10.0, 100


def noisy(flight: Flight, seed: int) -> Flight:
    """Return a flight with the noise of sensors."""
    rng = np.random.default_rng(seed)
    signals = dict(flight.signals)
    names = ('position', 'attitude', 'velocity', 'rates')
    for name, sigma in zip(names, NOISE, strict=True):
        signal = signals[name]
        size = 0.5 * sigma if name == 'attitude' else sigma  # of a quaternion's three parts
        values = signal.values + rng.normal(0, size, signal.values.shape)
        signals[name] = replace(signal, values=values)
    return replace(flight, signals=signals)


def judged(found: Fitted) -> dict[str, Any]:
    """Return how far a fit is from the truth, in shares and in standard errors."""
    rows = {}
    for p, value, error in zip(found.parameters, found.values, found.errors, strict=True):
        off = float(value - p.value)
        size = abs(p.value) or p.scale
        rows[p.name] = {
            'truth': p.value, 'value': float(value), 'share': abs(off) / size,
            'standard_errors': abs(off) / float(error) if error > 0 else None,
        }  # fmt: skip
    return rows


def truth(name: str, seconds: float) -> dict[str, Any]:
    """Return fits of one vehicle without and with noise."""
    flown = excite(name, seconds, 0, LIMITS[name])
    chosen = PARAMETERS[name]
    rng = np.random.default_rng(7)
    wrong = {}
    for p in find_parameters(comparable_scene(name), chosen):
        # inertias stay those of a body: those about x and y grow, that about z shrinks
        side = {'inertia.x': 1, 'inertia.y': 1, 'inertia.z': -1}.get(p.name, 0)
        by = float(rng.uniform(*((0, 1), (-1, 1), (-1, 0))[1 - side]))
        wrong[p.name] = p.value + 0.2 * (abs(p.value) or p.scale) * by
    result: dict[str, Any] = {'seconds': seconds, 'scale': flown.scale, 'seen': flown.seen}
    for kind, flight in (('clean', flown.flight), ('noisy', noisy(flown.flight, 1))):
        wall, processor = time.perf_counter(), time.process_time()
        clean = fit([flight], Task(name, chosen, values=wrong))
        rows = judged(clean)
        result[kind] = {
            'parameters': rows, 'count': len(chosen), 'steps': clean.steps,
            'wall_s': time.perf_counter() - wall,
            'processor_s': time.process_time() - processor,
            'worst_share': max(r['share'] for r in rows.values()),
            'worst_standard_errors': max(r['standard_errors'] or 0.0 for r in rows.values()),
            'lines': list(clean.lines),
        }  # fmt: skip
    return result


def coverage(seeds: int) -> dict[str, Any]:
    """Return how often the truth lies within standard errors, over fresh noise."""
    flown = excite('x500', COVERED_SECONDS, 3, LIMITS['x500'])
    off = []
    for seed in range(seeds):
        found = fit([noisy(flown.flight, 1000 + seed)], Task('x500', COVERED))
        off.append([(v - p.value) / e for p, v, e in
                    zip(found.parameters, found.values, found.errors, strict=True)])  # fmt: skip
    table = np.array(off)
    return {
        'seeds': seeds, 'parameters': list(COVERED), 'seconds': COVERED_SECONDS,
        'within': {str(k): float((np.abs(table) < k).mean()) for k in (1, 2, 3)},
        'within_by_parameter': {
            name: {str(k): float((np.abs(column) < k).mean()) for k in (1, 2, 3)}
            for name, column in zip(COVERED, table.T, strict=True)
        },
        'expected': {'1': 0.683, '2': 0.954, '3': 0.997},
        'spread': table.std(axis=0).tolist(), 'mean': table.mean(axis=0).tolist(),
    }  # fmt: skip


def main() -> None:
    """Measure, and write the result."""
    chosen = arguments(__doc__, 'excitation', ('truth', 'coverage'))
    only = chosen.only or ['truth', 'coverage']
    result: dict[str, Any] = {}
    if chosen.only and chosen.json.exists():
        old = json.loads(chosen.json.read_text(encoding='utf-8'))
        result = {part: old[part] for part in ('truth', 'coverage') if part in old}
    if 'truth' in only:
        seconds = 15.0 if chosen.quick else 60.0
        result['truth'] = {name: truth(name, seconds) for name in PARAMETERS}
    if 'coverage' in only:
        result['coverage'] = coverage(5 if chosen.quick else SEEDS)
    write(chosen.json, result)


if __name__ == '__main__':
    main()
