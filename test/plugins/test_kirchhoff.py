# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Added mass against Kirchhoff's equations (a small part of plugin_kirchhoff.py)."""

import mujoco
import numpy as np
import pytest

from benchmarks.plugins import plugin_kirchhoff as bench
from test.support.plugin_models import FIRST_ORDER, ellipsoid, free_body, load, world

STILL = np.zeros(3)
CASES = [bench.ellipsoid_case(0), bench.ellipsoid_case(1), bench.full_case(0)]


@pytest.fixture(scope='module')
def exact():
    return [bench.reference(case, bench.DURATION) for case in CASES]


def distance(state, reference):
    return np.linalg.norm(state[:3] - reference[:3])


@pytest.mark.parametrize('i', range(len(CASES)))
def test_rk4_follows_kirchhoff(exact, i):
    state = bench.simulate(CASES[i], 'RK4', 0.01, bench.DURATION, STILL)
    assert distance(state, exact[i]) <= 1e-5
    assert bench.attitude_error(state, exact[i]) <= 1e-4
    drift = bench.drifts(CASES[i], state, bench.DURATION)
    assert drift['energy'] <= 1e-6
    assert drift['linear_impulse'] <= 1e-5
    assert drift['angular_impulse'] <= 1e-5


def test_rk4_is_of_fourth_order(exact):
    errors = [
        np.median(
            [
                distance(bench.simulate(case, 'RK4', h, bench.DURATION, STILL), reference)
                for case, reference in zip(CASES, exact, strict=True)
            ]
        )
        for h in (0.005, 0.0025)
    ]
    assert 3.6 <= np.log2(errors[0] / errors[1]) <= 4.4


@pytest.mark.parametrize('integrator', FIRST_ORDER)
def test_first_order_integrators_are_of_first_order(integrator):
    case = CASES[2]
    reference = bench.reference(case, 0.5)
    errors = [
        distance(bench.simulate(case, integrator, h, 0.5, STILL), reference)
        for h in (0.001, 0.0005)
    ]
    assert abs(np.log2(errors[0] / errors[1]) - 1) <= 0.1


@pytest.mark.parametrize('integrator', ['RK4', 'implicitfast', 'Euler'])
def test_a_uniform_current_only_carries_the_body_along(integrator):
    flow = np.array([0.4, -0.3, 0.2])
    for case in CASES:
        moving = bench.simulate(case, integrator, 0.005, 1.0, flow)
        still = bench.simulate(case, integrator, 0.005, 1.0, STILL)
        np.testing.assert_allclose(moving[:3] - flow, still[:3], atol=1e-9)
        np.testing.assert_allclose(moving[3:7], still[3:7], atol=1e-9)


def test_stock_mujoco_misses_the_added_inertia():
    case = bench.ellipsoid_case(0)
    stock = bench.stock_error(case, bench.reference(case, bench.DURATION))
    assert stock > 0.1  # metres in five seconds: why the plugin exists


def test_builtin_and_local_drag_bodies_move_alike_without_drag():
    """Convection by MuJoCo plus ours for the rest, or all of it ours: the same motion."""
    axes = [0.5, 0.2, 0.1]
    states = []
    for drag, option, medium in (
        ('builtin', 'density="1000"', None),
        ('ellipsoid', '', {'density': 1000}),
    ):
        plugin = bench.body_plugin(added_mass='auto', drag=drag)
        inside = ellipsoid(axes, 700) + plugin
        model, data = load(world(free_body(inside), option=option, medium=medium))
        data.qvel[:] = [1, 0.5, 0.3, 1, 2, 1.5]
        mujoco.mj_step(model, data, 200)
        states.append(data.qpos.copy())
    np.testing.assert_allclose(states[0], states[1], atol=1e-12)
