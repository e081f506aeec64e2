# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Bodies in an ideal fluid against Kirchhoff's equations integrated by DOP853 at 1e-12.

24 random triaxial ellipsoids (semi-axes .1 to .5 m, |v| 1 m/s, |w| 2 rad/s, added mass up to 6
times the mass) and 12 bodies with a full random 6x6 added mass about a point off the centre of
mass. Writes position and attitude errors, drift of energy and both impulses, orders of
convergence, Galilean invariance, and the error of stock MuJoCo beside it.
Run: ``python -m benchmarks.plugins.plugin_kirchhoff [--quick] [--json PATH]``.
"""

from itertools import pairwise
from typing import Any, NamedTuple

import matplotlib as mpl
import mujoco
import numpy as np

from benchmarks.common import RESULTS, arguments, write
from fluid_sim_ros.lab import motion_errors as norms
from fluid_sim_ros.physics.kappa import ellipsoid_added_mass
from fluid_sim_ros.physics.kirchhoff import (
    impulses,
    kinetic_energy,
    kirchhoff_motion,
    kirchhoff_rhs,
    rigid_body_matrix,
    rotation_wb,
)
from test.support.plugin_models import (
    FIRST_ORDER,
    Array,
    body_plugin,
    ellipsoid,
    free_body,
    load,
    text,
    world,
)

DENSITY = 1000.0  # fresh water [kg/m^3]
DURATION, SHORT = 5.0, 1.0  # [s] RK4, first-order integrators
RK4_STEPS = (0.01, 0.005, 0.0025, 0.00125, 0.000625)  # [s]
FIRST_STEPS = (0.001, 0.0005, 0.00025, 0.000125)  # [s]


class Case(NamedTuple):
    """One body, its 6x6 matrix of body and fluid about O, and O in body axes."""

    inside: str  # MJCF of the body
    matrix: Array
    point_b: Array
    nu: Array  # start velocity of O, body axes


def unit(rng: np.random.Generator) -> Array:
    """Return a random direction."""
    vector = rng.normal(size=3)
    return vector / np.linalg.norm(vector)


def ellipsoid_case(seed: int) -> Case:
    """Return a random triaxial ellipsoid, at its centre."""
    rng = np.random.default_rng([2026, seed])
    axes = rng.uniform(0.1, 0.5, size=3)
    mass_a, inertia_a = ellipsoid_added_mass(axes, DENSITY)
    mass = mass_a.max() / rng.uniform(0.5, 6.0)
    volume = 4 / 3 * np.pi * axes.prod()
    inertia = mass / 5 * ((axes**2).sum() - axes**2)
    inside = ellipsoid(axes, mass / volume) + body_plugin(added_mass='auto')
    matrix = rigid_body_matrix(mass, inertia, np.zeros(3)) + np.diag(np.r_[mass_a, inertia_a])
    return Case(inside, matrix, np.zeros(3), np.r_[unit(rng), 2 * unit(rng)])


def full_case(seed: int) -> Case:
    """Return a body with a full random added mass about a point off its centre of mass."""
    rng = np.random.default_rng([2027, seed])
    mass, inertia = rng.uniform(5, 20), rng.uniform(0.3, 0.5, size=3)
    point, center = rng.uniform(-0.2, 0.2, size=(2, 3))
    root = rng.normal(size=(6, 6)) * np.r_[1, 1, 1, 0.3, 0.3, 0.3][:, None]
    added = mass / 3 * root @ root.T
    inside = (
        f'<inertial pos="{text(center)}" mass="{text(mass)}" diaginertia="{text(inertia)}"/>'
        '<geom size=".1" contype="0" conaffinity="0"/>'
        + body_plugin(added_mass=added, reference_point=point, drag='none')
    )
    matrix = rigid_body_matrix(mass, np.diag(inertia), center - point) + added
    return Case(inside, matrix, point, np.r_[unit(rng), 2 * unit(rng)])


def model_of(
    case: Case, integrator: str, timestep: float, flow_w: Array
) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Return the body in its start state, at rest relative axes, O at the world origin."""
    option = f'wind="{text(flow_w)}" density="{DENSITY if "auto" in case.inside else 0}"'
    model, data = load(
        world(free_body(case.inside), integrator=integrator, timestep=timestep, option=option)
    )
    if 'diaginertia' in case.inside:  # MuJoCo sorts the axes; the case wants its own
        numbers = case.inside.split('diaginertia="')[1].split('"')[0]
        model.body_inertia[1] = np.array(numbers.split(), dtype=float)
        model.body_iquat[1] = [1, 0, 0, 0]
        mujoco.mj_setConst(model, data)
        mujoco.mj_resetData(model, data)
    data.qpos[:3] = -case.point_b
    data.qvel[:3] = case.nu[:3] - np.cross(case.nu[3:], case.point_b) + flow_w
    data.qvel[3:] = case.nu[3:]
    return model, data


def state_of(data: mujoco.MjData, case: Case) -> Array:
    """Return the state of the reference point as kirchhoff.py counts it, shape (13,)."""
    rotation = rotation_wb(data.qpos[3:7])
    omega = data.qvel[3:6]
    position = data.qpos[:3] + rotation @ case.point_b
    velocity = rotation.T @ data.qvel[:3] + np.cross(omega, case.point_b)
    return np.r_[position, data.qpos[3:7], velocity, omega]


def simulate(
    case: Case, integrator: str, timestep: float, duration: float, flow_w: Array
) -> Array:
    """Return the state after ``duration``."""
    model, data = model_of(case, integrator, timestep, flow_w)
    mujoco.mj_step(model, data, round(duration / timestep))
    return state_of(data, case)


def reference(case: Case, duration: float) -> Array:
    """Return Kirchhoff's solution in still fluid."""
    start = np.r_[np.zeros(3), 1, 0, 0, 0, case.nu]
    return kirchhoff_motion(start, [0.0, duration], case.matrix)[-1]


def attitude_error(state: Array, exact: Array) -> float:
    """Return the angle between two attitudes [rad]."""
    return float(norms.attitude_error(state[None], exact[None]))


def drifts(case: Case, state: Array, duration: float) -> dict[str, float]:
    """Return relative drifts of energy and impulses from the start."""
    start = np.r_[np.zeros(3), 1, 0, 0, 0, case.nu]
    energy = kinetic_energy(start, case.matrix)
    before, after = (impulses(t, s, case.matrix) for t, s in ((0, start), (duration, state)))
    return {
        'energy': abs(kinetic_energy(state, case.matrix) / energy - 1),
        'linear_impulse': float(np.linalg.norm(after[0] - before[0]) / np.linalg.norm(before[0])),
        'angular_impulse': float(np.linalg.norm(after[1] - before[1]) / np.linalg.norm(before[1])),
    }


def orders(medians: list[float]) -> list[float]:
    """Return log2 of successive ratios (each step is half of the one before)."""
    return [float(np.log2(a / b)) for a, b in pairwise(medians)]


def errors_of(cases: list[Case], exact: list[Array], integrator: str, steps: tuple[float, ...],
              duration: float) -> dict[str, Any]:  # fmt: skip
    """Return error statistics of an ensemble for each timestep."""
    still = np.zeros(3)
    out: dict[str, Any] = {}
    for timestep in steps:
        states = [simulate(case, integrator, timestep, duration, still) for case in cases]
        position = [
            float(np.linalg.norm(s[:3] - e[:3])) for s, e in zip(states, exact, strict=True)
        ]
        attitude = [attitude_error(s, e) for s, e in zip(states, exact, strict=True)]
        drift = [drifts(c, s, duration) for c, s in zip(cases, states, strict=True)]
        out[f'{timestep * 1000:g} ms'] = {
            'position_median_m': float(np.median(position)),
            'position_max_m': max(position),
            'attitude_median_rad': float(np.median(attitude)),
            'attitude_max_rad': max(attitude),
            **{f'{key}_median': float(np.median([d[key] for d in drift])) for key in drift[0]},
            **{f'{key}_max': max(d[key] for d in drift) for key in drift[0]},
        }
    for key in ('position_median_m', 'attitude_median_rad', 'energy_median',
                'linear_impulse_median', 'angular_impulse_median'):  # fmt: skip
        out[f'order_{key.split("_median")[0]}'] = orders(
            [out[f'{h * 1000:g} ms'][key] for h in steps if h < 0.01]
        )
    return out


def galilean(cases: list[Case], timestep: float = 0.005) -> float:
    """Return the largest deviation [m] between a run in a current and one in still fluid."""
    flow = np.array([0.4, -0.3, 0.2])
    worst = 0.0
    for case in cases:
        moving = simulate(case, 'RK4', timestep, DURATION, flow)
        still = simulate(case, 'RK4', timestep, DURATION, np.zeros(3))
        worst = max(worst, float(np.linalg.norm(moving[:3] - flow * DURATION - still[:3])))
    return worst


def stock_error(case: Case, exact: Array) -> float:
    """Return the position error [m] of stock MuJoCo (no plugin) for the same ellipsoid."""
    inside = case.inside.split('<plugin')[0]
    model, data = load(world(free_body(inside), timestep=0.005, option=f'density="{DENSITY}"'))
    data.qvel[:] = case.nu
    mujoco.mj_step(model, data, round(DURATION / 0.005))
    return float(np.linalg.norm(data.qpos[:3] - exact[:3]))


def textbook_rk4(
    cases: list[Case], exact: list[Array], timestep: float = 0.01
) -> dict[str, float]:
    """Return the largest errors of plain RK4 on Kirchhoff's own equations at the same timestep."""
    position, attitude = 0.0, 0.0
    for case, end in zip(cases, exact, strict=True):
        state = np.r_[np.zeros(3), 1, 0, 0, 0, case.nu]
        for _ in range(round(DURATION / timestep)):
            k1 = kirchhoff_rhs(0, state, case.matrix)
            k2 = kirchhoff_rhs(0, state + timestep / 2 * k1, case.matrix)
            k3 = kirchhoff_rhs(0, state + timestep / 2 * k2, case.matrix)
            k4 = kirchhoff_rhs(0, state + timestep * k3, case.matrix)
            state = state + timestep / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        position = max(position, float(np.linalg.norm(state[:3] - end[:3])))
        attitude = max(attitude, attitude_error(state, end))
    return {'position_max_m': position, 'attitude_max_rad': attitude}


def measure(ellipsoids: int, full: int) -> dict[str, Any]:
    """Return all numbers of this benchmark."""
    groups = {
        'ellipsoids': [ellipsoid_case(seed) for seed in range(ellipsoids)],
        'full_6x6': [full_case(seed) for seed in range(full)],
    }
    result: dict[str, Any] = {'cases': {name: len(cases) for name, cases in groups.items()}}
    for name, cases in groups.items():
        exact = [reference(case, DURATION) for case in cases]
        short = [reference(case, SHORT) for case in cases]
        result[name] = {
            'RK4': errors_of(cases, exact, 'RK4', RK4_STEPS, DURATION),
            **{kind: errors_of(cases, short, kind, FIRST_STEPS, SHORT) for kind in FIRST_ORDER},
        }
        result[name]['textbook_RK4_10_ms'] = textbook_rk4(cases, exact)
        if name == 'ellipsoids':
            stock = [stock_error(case, e) for case, e in zip(cases, exact, strict=True)]
            result['stock_position_error_m'] = {
                'median': float(np.median(stock)), 'max': max(stock),
            }  # fmt: skip
    result['galilean_m'] = galilean([*groups['ellipsoids'], *groups['full_6x6']])
    return result


def draw(result: dict[str, Any]) -> None:
    """Draw error against timestep."""
    mpl.use('Agg')
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(1, 2, figsize=(10, 4.2), sharey=True, layout='constrained')
    for axis, name, title in zip(
        axes,
        ('ellipsoids', 'full_6x6'),
        ('random ellipsoids', 'full 6x6, off centre'),
        strict=True,
    ):
        for kind in ('RK4', *FIRST_ORDER):
            values = result[name][kind]
            steps = [key for key in values if key.endswith(' ms')]
            h = [float(key.split()[0]) for key in steps]
            span = '5 s' if kind == 'RK4' else '1 s'
            axis.loglog(
                h, [values[key]['position_median_m'] for key in steps],
                marker='o', label=f'{kind}, after {span}',
            )  # fmt: skip
        axis.set(title=title, xlabel='timestep [ms]')
        axis.grid(alpha=0.3, which='both')
    axes[0].axhline(
        result['stock_position_error_m']['median'], color='k', ls='--', label='stock MuJoCo, 5 s'
    )
    axes[0].set_ylabel('median position error [m]')
    axes[0].legend(fontsize=8)
    axes[1].legend(fontsize=8)
    figure.suptitle("Bodies in an ideal fluid against Kirchhoff's equations")
    figure.savefig(RESULTS / 'plugin_kirchhoff.png', dpi=80)


def main() -> None:
    """Measure, print the main numbers, write JSON and picture."""
    options = arguments(__doc__ or '', 'plugin_kirchhoff')
    result = measure(*((4, 3) if options.quick else (24, 12)))
    for name in ('ellipsoids', 'full_6x6'):
        ten = result[name]['RK4']['10 ms']
        print(name, f'RK4 10 ms: median {ten["position_median_m"]:.2g} m, '
              f'max {ten["position_max_m"]:.2g} m, {ten["attitude_max_rad"]:.2g} rad')  # fmt: skip
        print(f'  textbook RK4: {result[name]["textbook_RK4_10_ms"]}')
        for kind in ('RK4', *FIRST_ORDER):
            values = result[name][kind]
            print('  order', kind, np.round(values['order_position'], 3))
    print(f'Galilean invariance {result["galilean_m"]:.2g} m; '
          f'stock {result["stock_position_error_m"]}')  # fmt: skip
    write(options.json, result)
    if not options.quick:
        draw(result)


if __name__ == '__main__':
    main()
