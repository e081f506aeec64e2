# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The slender part of MuJoCo's angular drag, and the plugin's drag without it; doc/limits.md."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros.physics.drag import angular_drag
from test.support.plugin_models import (
    body_plugin,
    ellipsoid,
    explicit_force,
    free_body,
    load,
    world,
)

COEF = (0.5, 0.25, 1.5, 1.0, 1.0)  # MuJoCo's defaults
HULL, DISC = (0.5, 0.1, 0.1), (0.1, 0.1, 0.0001)
WATER = 1000.0
BAD = (mujoco.mjtWarning.mjWARN_BADQVEL, mujoco.mjtWarning.mjWARN_BADQACC)


def ours(size, **options):
    settings = {'integrator': 'Euler', 'timestep': 1e-4} | options
    keys = {'drag': 'ellipsoid', 'drag_angular': settings.pop('drag_angular', 'slender')}
    inside = ellipsoid(size, WATER, COEF) + body_plugin(**keys)
    return load(world(free_body(inside), medium={'density': WATER}, **settings))


def stock(size, coef=COEF, **options):
    body = free_body(ellipsoid(size, WATER, coef))
    return load(world(body, option=f'density="{WATER}"', integrator='Euler', **options))


@pytest.mark.parametrize('word', ['slender', 'swept'])
@pytest.mark.parametrize('size', [HULL, DISC, (0.3, 0.2, 0.1), (0.2, 0.2, 0.2)])
def test_angular_drag_with_and_without_the_slender_part_is_the_numpy_twins(word, size):
    model, data = ours(size, drag_angular=word)
    slender = COEF[1] if word == 'slender' else 0.0
    rng = np.random.default_rng(2)
    for _ in range(5):
        data.qvel[3:] = rng.normal(0, 3, 3)
        expected = angular_drag(
            size, data.qvel[3:], density=WATER, c_angular=COEF[2], c_slender=slender
        )
        np.testing.assert_allclose(explicit_force(model, data)[3:], expected, rtol=1e-12)
    data.qvel[:] = np.r_[
        rng.normal(size=3), 0, 0, 0
    ]  # the drag along the way keeps its slender part
    other, twin = ours(size)
    twin.qvel[:3] = data.qvel[:3]
    force, expected = explicit_force(model, data)[:3], explicit_force(other, twin)[:3]
    np.testing.assert_allclose(force, expected, rtol=1e-12)


def test_the_slender_part_brakes_the_roll_of_a_5_to_1_hull_21_times_as_strongly():
    torque = {}
    for word in ('slender', 'swept'):
        model, data = ours(HULL, drag_angular=word)
        data.qvel[3] = 1
        torque[word] = explicit_force(model, data)[3]
    assert torque['slender'] == pytest.approx(-2.72, abs=0.005)
    assert torque['swept'] == pytest.approx(-0.126, abs=0.0005)
    assert torque['slender'] / torque['swept'] - 1 == pytest.approx(20.7, abs=0.05)
    model, data = stock(HULL, timestep=1e-4)
    data.qvel[3] = 1
    mujoco.mj_forward(model, data)
    assert data.qfrc_passive[3] == pytest.approx(torque['slender'], rel=1e-12)


def diverges(model, data, spin, steps):
    """Return whether MuJoCo gives up within some steps, and the largest spin seen."""
    data.qvel[3:] = spin
    largest = 0.0
    for _ in range(steps):
        mujoco.mj_step(model, data)
        if any(data.warning[kind].number for kind in BAD):
            return True, np.inf
        largest = max(largest, float(np.abs(data.qvel[3:]).max()))
    return False, largest


TUMBLING, SPINNING = (20, 0, 0), (0, 0, 20)
#: spin, timestep, slender part, whether MuJoCo's own drag diverges with Euler
PLATES = [
    (TUMBLING, 1e-4, True, True), (TUMBLING, 1e-4, False, True), (TUMBLING, 2e-5, True, False),
    (SPINNING, 1e-3, True, True), (SPINNING, 1e-3, False, False), (SPINNING, 1e-4, True, False),
]  # fmt: skip


@pytest.mark.parametrize(('spin', 'timestep', 'slender', 'expected'), PLATES)
def test_a_thin_plate_at_20_rad_s_blows_up_under_explicit_angular_drag(
    spin, timestep, slender, expected, capfd
):
    coef = COEF if slender else (COEF[0], 0.0, *COEF[2:])
    assert diverges(*stock(DISC, coef, timestep=timestep), spin, 20)[0] == expected


@pytest.mark.parametrize('timestep', [1e-4, 1e-3, 1e-2])
@pytest.mark.parametrize('spin', [TUMBLING, SPINNING, (14, 0, 14)])
@pytest.mark.parametrize('integrator', ['Euler', 'implicitfast'])
@pytest.mark.parametrize('word', ['slender', 'swept'])
def test_the_plugins_drag_of_a_thin_plate_is_stable_with_first_order_integrators(
    timestep, spin, integrator, word
):
    model, data = ours(DISC, integrator=integrator, timestep=timestep, drag_angular=word)
    bad, largest = diverges(model, data, spin, 200)
    assert not bad
    assert largest <= 20 * (1 + 1e-9)


def test_the_option_needs_the_ellipsoids_drag():
    inside = ellipsoid(HULL, WATER, COEF)
    for keys in ({'drag': 'none', 'volume': 'auto'}, {'drag': 'inertia_box'}):
        body = free_body(inside + body_plugin(drag_angular='swept', **keys))
        with pytest.raises(ValueError, match='drag_angular needs drag="ellipsoid"'):
            load(world(body, medium={'density': WATER}))
