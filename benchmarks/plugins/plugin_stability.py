# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Energy of a tumbling body in an ideal or a braking fluid, over the added-mass ratio.

An ellipsoid .5/.2/.1 m of falling density, so that the largest added mass is 0 to 100 times its
mass. T is the kinetic energy of body and fluid: an ideal fluid keeps it, drag only lowers it.
Each run is judged at every step. Beside it the lagged method of other simulators, which applies
-A times the acceleration of the step before: its error grows m_A/m-fold with every step, so it
diverges once the added mass exceeds the mass, whatever the timestep. Writes JSON
and a picture.
Run: ``python -m benchmarks.plugins.plugin_stability [--quick] [--json PATH]``.
"""

import itertools
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib as mpl
import mujoco
import numpy as np

from benchmarks.common import RESULTS, arguments, write
from fluid_sim_ros.physics.kappa import ellipsoid_added_mass, ellipsoid_volume
from test.support.plugin_models import (
    FIRST_ORDER,
    Array,
    body_plugin,
    ellipsoid,
    free_body,
    kinetic_energy,
    load,
    world,
)

AXES, WATER = np.array([0.5, 0.2, 0.1]), 1000.0
MASS_A, INERTIA_A = ellipsoid_added_mass(AXES, WATER)
START = (1.0, 0.5, 0.3, 1.0, 2.0, 1.5)  # [m/s], [rad/s]
STEP, DURATION = 0.01, 60.0  # [s]
RATIOS = (0.0, 0.5, 1.0, 2.0, 10.0, 100.0)
DAMPING = (20.0, 60.0, 120.0, 2.0, 8.0, 8.0)  # quadratic, of the size of its drag [kg/m], [kg m^2]
#: What brakes: attributes of fluid_sim.body, and fluidcoef of the geom (MuJoCo's defaults).
DRAGS: dict[str, dict[str, Any]] = {
    'quadratic damping': {'quadratic_damping': DAMPING},
    'ellipsoid drag': {'drag': 'ellipsoid', 'coef': (0.5, 0.25, 1.5, 1.0, 1.0)},
}
SHARES = (1.0, 0.3, 0.1, 0.03, 0.01)  # of DAMPING
LAGGED_RATIOS = (0.5, 0.9, 1.0, 1.1, 1.62, 2.0, 10.0, 100.0)
LAGGED_STEPS = (0.01, 0.001, 0.0001)  # [s]
BAD = (
    mujoco.mjtWarning.mjWARN_BADQPOS, mujoco.mjtWarning.mjWARN_BADQVEL,
    mujoco.mjtWarning.mjWARN_BADQACC,
)  # fmt: skip


class Summary(NamedTuple):
    """What became of T/T0 in one run."""

    largest: float  # over all steps before it diverged
    worst_drift: float  # largest |T/T0 - 1|
    largest_rise: float  # from one step to the next
    doubles_after_s: float | None  # None: never
    diverged: bool  # MuJoCo reset a state that was no longer finite


def density_for(ratio: float) -> float:
    """Return the density [kg/m^3] with max(m_A)/m = ratio; for 0 that of ratio 1."""
    return float(MASS_A.max() / (ratio or 1.0) / ellipsoid_volume(AXES))


def body(ratio: float, coef: Any = (0, 0, 0, 0, 0), **values: Any) -> str:
    """Return the body with max(m_A)/m = ratio; without added mass for ratio 0."""
    added: Any = 'auto' if ratio > 0 else np.zeros(6)
    plugin = body_plugin(**{'drag': 'none', 'added_mass': added} | values)
    return free_body(ellipsoid(AXES, density_for(ratio), coef) + plugin)


def failed(data: mujoco.MjData) -> bool:
    """Return whether MuJoCo has reset the state without a word."""
    return any(data.warning[kind].number for kind in BAD)


def energies(
    ratio: float, integrator: str, timestep: float, duration: float, **values: Any
) -> Array:
    """Return T/T0 at every step; a run that is no longer finite ends early, with inf."""
    model, data = load(
        world(
            body(ratio, **values), integrator=integrator, timestep=timestep,
            medium={'density': WATER},
        )
    )  # fmt: skip
    scratch = mujoco.MjData(model)
    data.qvel[:] = START
    start = kinetic_energy(model, data, scratch).sum()
    out = [1.0]
    for _ in range(round(duration / timestep)):
        mujoco.mj_step(model, data)
        if failed(data):
            out.append(np.inf)
            break
        out.append(float(kinetic_energy(model, data, scratch).sum() / start))
    return np.array(out)


def lagged(ratio: float, timestep: float) -> Iterator[float]:
    """
    Yield T/T0 of the lagged method at every step, inf at last.

    Stock MuJoCo with its convective forces and, as an applied force, -A dnu/dt with the
    acceleration of the step before, nu in body axes: dv/dt = R'a - w x v.
    """
    model, data = load(
        world(
            free_body(ellipsoid(AXES, density_for(ratio))), integrator='Euler',
            timestep=timestep, option=f'density="{WATER}"',
        )
    )  # fmt: skip
    total = np.r_[model.body_mass[1] + MASS_A, model.body_inertia[1] + INERTIA_A]
    data.qvel[:] = START
    start = total @ np.square(START)
    matrix = np.zeros(9)
    while True:
        mujoco.mju_quat2Mat(matrix, data.qpos[3:7])
        to_world = matrix.reshape(3, 3)
        v, omega = to_world.T @ data.qvel[:3], data.qvel[3:]
        yield float(total @ np.square(np.r_[v, omega]) / start)
        rate = to_world.T @ data.qacc[:3] - np.cross(omega, v)
        # at the first step there is no acceleration yet, nor a force by it
        push = -MASS_A * rate if data.time > 0 else np.zeros(3)
        data.qfrc_applied[:3] = to_world @ push
        data.qfrc_applied[3:] = -INERTIA_A * data.qacc[3:]
        mujoco.mj_step(model, data)
        if failed(data):
            yield np.inf
            return


def lagged_steps(ratio: float, timestep: float, limit: int) -> int:
    """Return the steps until the lagged method exceeds 1e3 times the start's energy, or limit."""
    for step, energy in enumerate(itertools.islice(lagged(ratio, timestep), limit)):
        if not energy < 1e3:
            return step
    return limit


def summary(energy: Array, timestep: float = STEP) -> Summary:
    """Return the summary of a run."""
    finite = energy[np.isfinite(energy)]
    doubled = np.flatnonzero(~(energy < 2))
    return Summary(
        float(finite.max()), float(np.abs(finite - 1).max()), float(np.diff(finite).max()),
        float(doubled[0] * timestep) if doubled.size else None, bool(finite.size < energy.size),
    )  # fmt: skip


def over(ratios: tuple[float, ...], run: Callable[[float], Array]) -> dict[str, Any]:
    """Return ratio -> summary."""
    return {f'{ratio:g}': summary(run(ratio))._asdict() for ratio in ratios}


def measure(ratios: tuple[float, ...], duration: float = DURATION) -> dict[str, Any]:
    """Return all numbers."""
    result: dict[str, Any] = {'timestep_s': STEP, 'duration_s': duration}
    result['undamped'] = {
        kind: over(ratios, lambda r, k=kind: energies(r, k, STEP, duration))
        for kind in ('RK4', *FIRST_ORDER)
    }
    result['with_drag'] = {
        name: {
            kind: over(ratios, lambda r, k=kind, v=values: energies(r, k, STEP, duration, **v))
            for kind in FIRST_ORDER
        }
        for name, values in DRAGS.items()
    }
    result['weak_damping_implicitfast'] = {
        f'{share:g}': over(
            tuple(r for r in ratios if r > 0),
            lambda r, s=share: energies(
                r, 'implicitfast', STEP, duration, quadratic_damping=s * np.array(DAMPING)
            ),
        )
        for share in SHARES
    }
    result['lagged_steps_to_1000_T0'] = {
        f'{ratio:g}': {f'{h * 1000:g} ms': lagged_steps(ratio, h, 5000) for h in LAGGED_STEPS}
        for ratio in LAGGED_RATIOS
    }
    return result


def fate(run: dict[str, Any]) -> str:
    """Return what the table says of an undamped run."""
    if run['doubles_after_s'] is not None:
        return f'doubles in {run["doubles_after_s"]:.1f} s'
    return f'off by {run["worst_drift"]:.1g}'


def table(result: dict[str, Any]) -> str:
    """Return the undamped, the damped and the lagged runs over m_A/m, in Markdown."""
    kinds = list(result['undamped'])
    heads = [*kinds, 'first-order with drag: largest T/T0', 'lagged: steps to 1000 T0']
    lines = [
        f'T/T0 over {result["duration_s"]:g} s at {1000 * result["timestep_s"]:g} ms, no drag; '
        'then the largest T/T0 of all first-order integrators with drag, and the lagged method.',
        '',
        '| m_A/m | ' + ' | '.join(heads) + ' |',
        '|---' * (len(heads) + 1) + '|',
    ]
    for ratio in result['undamped']['RK4']:
        damped = max(
            runs[ratio]['largest']
            for group in result['with_drag'].values()
            for runs in group.values()
        )
        steps = result['lagged_steps_to_1000_T0'].get(ratio, {}).get('10 ms')
        slow = 'bounded' if steps == 5000 else steps
        cells = [fate(result['undamped'][kind][ratio]) for kind in kinds]
        cells += [f'{damped:.6g}', '' if steps is None else f'{slow}']
        lines.append(f'| {ratio} | ' + ' | '.join(cells) + ' |')
    return '\n'.join(lines) + '\n'


def draw(path: Path = RESULTS / 'plugin_stability.png') -> None:
    """Draw energy against time for m_A/m = 10, and the time to double it over m_A/m."""
    mpl.use('Agg')
    from matplotlib import pyplot as plt

    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.4), layout='constrained')
    ratios = np.geomspace(0.1, 100, 16)
    styles = dict(zip(('RK4', *FIRST_ORDER), ('C0-', 'C1-', 'C2-', 'C4--', 'C5:'), strict=True))
    for kind, style in styles.items():
        energy = energies(10.0, kind, STEP, DURATION)
        left.loglog(STEP * np.arange(1, energy.size), energy[1:], style, label=kind)
        runs = [summary(energies(ratio, kind, STEP, DURATION)) for ratio in ratios]
        after = [run.doubles_after_s or DURATION for run in runs]
        right.loglog(ratios, after, style, marker='.', label=kind)
    energy = energies(10.0, 'implicitfast', STEP, DURATION, **DRAGS['ellipsoid drag'])
    left.loglog(STEP * np.arange(1, energy.size), energy[1:], 'k-', label='implicitfast, drag')
    energy = np.fromiter(itertools.islice(lagged(10.0, STEP), 6000), dtype=float)
    left.loglog(STEP * np.arange(1, energy.size), energy[1:], 'C3-', label='lagged method')
    after = [
        summary(np.fromiter(itertools.islice(lagged(ratio, STEP), 6000), dtype=float))
        for ratio in ratios
    ]
    right.loglog(
        ratios, [run.doubles_after_s or DURATION for run in after], 'C3-', marker='.',
        label='lagged method',
    )  # fmt: skip
    left.set(
        xlabel='time [s]', ylabel='kinetic energy / start', ylim=(1e-4, 1e4),
        title='$m_A/m$ = 10, 10 ms, no drag where not said',
    )  # fmt: skip
    left.legend(fontsize=8, loc='lower left')
    right.axhline(DURATION, color='0.7', lw=6, zorder=0)
    right.text(100, 45, 'grey: not within the 60 s of the run', fontsize=8, ha='right', va='top')
    right.set(xlabel='$m_A/m$', ylabel='[s]', title='Energy has doubled after (10 ms, no drag)')
    for axis in (left, right):
        axis.grid(alpha=0.3)
    figure.savefig(path, dpi=80)


def main() -> None:
    """Measure, print, write JSON and picture."""
    options = arguments(__doc__, 'plugin_stability')
    result = measure(*(((1.0, 10.0), 20.0) if options.quick else (RATIOS, DURATION)))
    print(table(result))
    for share, runs in result['weak_damping_implicitfast'].items():
        print(f'{share} of the damping, largest T/T0:',
              {ratio: run['largest'] for ratio, run in runs.items()})  # fmt: skip
    print('lagged method, steps to 1000 T0:', result['lagged_steps_to_1000_T0'])
    write(options.json, result)
    if not options.quick:
        draw()


if __name__ == '__main__':
    main()
