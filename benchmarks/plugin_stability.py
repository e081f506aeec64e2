"""
Energy of a tumbling body in an ideal or a braking fluid, over the added-mass ratio.

An ellipsoid .5/.2/.1 m of falling density, so that the largest added mass is 0 to 100 times its
mass; kinetic energy of body and fluid, which an ideal fluid keeps and drag only lowers. Beside it
the lagged method of other simulators, which subtracts A times the acceleration of the step before:
it diverges once the added mass exceeds the mass, whatever the timestep.
Run: ``python benchmarks/plugin_stability.py [--quick] [--json PATH]``.
"""

from contextlib import chdir
from tempfile import TemporaryDirectory
from typing import Any

import matplotlib as mpl
import mujoco
import numpy as np
from plugin_common import (
    FIRST_ORDER,
    RESULTS,
    Array,
    arguments,
    body_plugin,
    ellipsoid,
    free_body,
    kinetic_energy,
    load,
    world,
    write,
)

from fluid_sim_ros.physics.kappa import ellipsoid_added_mass, ellipsoid_volume

AXES, WATER = np.array([0.5, 0.2, 0.1]), 1000.0
START = (1.0, 0.5, 0.3, 1.0, 2.0, 1.5)  # [m/s], [rad/s]
RATIOS = (0.0, 0.5, 1.0, 2.0, 10.0, 100.0)
DAMPING = (20.0, 60.0, 120.0, 2.0, 8.0, 8.0)  # quadratic, of the size of its drag [kg/m], [kg m^2]


def body(ratio: float, **values: Any) -> str:
    """Return the body with max(m_A)/m = ratio; without added mass for ratio 0."""
    mass_a = ellipsoid_added_mass(AXES, WATER)[0].max()
    density = mass_a / max(ratio, 1.0) / ellipsoid_volume(AXES)
    if ratio > 0:
        density = mass_a / ratio / ellipsoid_volume(AXES)
        values['added_mass'] = 'auto'
    else:
        values['added_mass'] = np.zeros(6)
    return free_body(ellipsoid(AXES, float(density)) + body_plugin(drag='none', **values))


def energies(
    ratio: float, integrator: str, timestep: float, duration: float, **values: Any
) -> Array:
    """Return T/T0 about 200 times along a run; it ends early where it is no longer finite."""
    model, data = load(
        world(
            body(ratio, **values), integrator=integrator, timestep=timestep,
            medium={'density': WATER},
        )  # fmt: skip
    )
    scratch = mujoco.MjData(model)
    data.qvel[:] = START
    start = kinetic_energy(model, data, scratch).sum()
    every = max(1, round(duration / timestep / 200))
    out = [1.0]
    for _ in range(round(duration / timestep / every)):
        mujoco.mj_step(model, data, every)
        if any(data.warning[i].number for i in BAD) or not np.isfinite(data.qvel).all():
            out.append(np.inf)  # MuJoCo has reset the state without a word
            break
        out.append(float(kinetic_energy(model, data, scratch).sum() / start))
    return np.array(out)


BAD = (
    mujoco.mjtWarning.mjWARN_BADQPOS, mujoco.mjtWarning.mjWARN_BADQVEL,
    mujoco.mjtWarning.mjWARN_BADQACC,
)  # fmt: skip


def lagged_steps(ratio: float, timestep: float, limit: int) -> int:
    """
    Return the steps until the lagged method exceeds 1e3 times the start's energy, or ``limit``.

    Stock MuJoCo with its convective forces, and -A a of the step before as an applied force.
    """
    mass_a, inertia_a = ellipsoid_added_mass(AXES, WATER)
    density = mass_a.max() / ratio / ellipsoid_volume(AXES)
    model, data = load(
        world(
            free_body(ellipsoid(AXES, float(density))), integrator='Euler', timestep=timestep,
            option=f'density="{WATER}"',
        )  # fmt: skip
    )
    data.qvel[:] = START
    start = float(np.sum(data.qvel**2))
    for step in range(limit):
        rotation = np.zeros(9)
        mujoco.mju_quat2Mat(rotation, data.qpos[3:7])
        rotation = rotation.reshape(3, 3)
        data.qfrc_applied[:3] = -rotation @ (mass_a * (rotation.T @ data.qacc[:3]))
        data.qfrc_applied[3:] = -inertia_a * data.qacc[3:]
        mujoco.mj_step(model, data)
        if not float(np.sum(data.qvel**2)) < 1e3 * start or data.time < timestep * step:
            return step + 1
    return limit


def growth(ratio: float, integrator: str) -> dict[str, Any]:
    """Return the worst |T/T0 - 1| of undamped motion at 10 ms and when T first doubles [s]."""
    energy = energies(ratio, integrator, 0.01, 60.0)
    doubled = np.flatnonzero(~(energy < 2))
    finite = energy[np.isfinite(energy)]
    return {
        'worst_drift': float(np.max(np.abs(finite - 1))),
        'diverged': len(finite) < len(energy),
        'doubles_after_s': float(doubled[0] * 0.3) if len(doubled) else None,
    }


def measure(ratios: tuple[float, ...]) -> dict[str, Any]:
    """Return all numbers."""
    result: dict[str, Any] = {'undamped': {}, 'damped_largest_rise': {}, 'lagged': {}}
    for integrator in ('RK4', *FIRST_ORDER):
        result['undamped'][integrator] = {f'{r:g}': growth(r, integrator) for r in ratios}
    for integrator in FIRST_ORDER:
        rises = {}
        for ratio in ratios:
            energy = energies(ratio, integrator, 0.01, 60.0, quadratic_damping=DAMPING)
            rises[f'{ratio:g}'] = {
                'above_start': float(max(energy.max() - 1, 0)),
                'between_samples': float(max(np.diff(energy).max(), 0)),
            }
        result['damped_largest_rise'][integrator] = rises
    for ratio in (0.5, 0.9, 1.1, 1.62, 10.0):
        result['lagged'][f'{ratio:g}'] = {
            f'{h * 1000:g} ms': lagged_steps(ratio, h, 1000) for h in (0.01, 0.001, 0.0001)
        }
    return result


def draw() -> None:
    """Draw energy against time for ratio 10."""
    mpl.use('Agg')
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(1, 3, figsize=(12, 3.8), layout='constrained', sharey=True)
    for axis, ratio in zip(axes, (1.0, 10.0, 100.0), strict=True):
        for integrator in ('RK4', *FIRST_ORDER):
            energy = energies(ratio, integrator, 0.01, 60.0)
            times = np.linspace(0, 0.3 * (len(energy) - 1), len(energy))
            axis.semilogy(times, np.minimum(energy, 1e4), label=f'{integrator}, undamped')
        energy = energies(ratio, 'implicitfast', 0.01, 60.0, quadratic_damping=DAMPING)
        times = np.linspace(0, 0.3 * (len(energy) - 1), len(energy))
        axis.semilogy(times, energy, 'k--', label='implicitfast, plugin drag')
        axis.set(
            title=f'$m_A/m$ = {ratio:g} (lagged method: '
            f'{lagged_steps(max(ratio, 1.01), 0.01, 1000)} steps)',
            xlabel='time [s]', ylim=(1e-6, 1e4),
        )  # fmt: skip
        axis.grid(alpha=0.3)
    axes[0].set_ylabel('kinetic energy / start')
    axes[0].legend(fontsize=7)
    figure.savefig(RESULTS / 'plugin_stability.png', dpi=80)


def main() -> None:
    """Measure, print, write JSON and picture."""
    options = arguments(__doc__ or '', 'plugin_stability')
    options.json = options.json.resolve()
    with TemporaryDirectory() as folder, chdir(folder):  # MuJoCo logs its warnings there
        result = measure((1.0, 10.0) if options.quick else RATIOS)
        if not options.quick:
            draw()
    for integrator, values in result['undamped'].items():
        for ratio, value in values.items():
            print(f'{integrator:13} m_A/m {ratio:>4}: drift {value["worst_drift"]:.2e}, '
                  f'diverged {value["diverged"]}, doubles after {value["doubles_after_s"]} s')  # fmt: skip
    for integrator, values in result['damped_largest_rise'].items():
        print(f'{integrator:13} with drag, largest rise of T: {values}')
    print('lagged method, steps to diverge:', result['lagged'])
    write(options.json, result)


if __name__ == '__main__':
    main()
