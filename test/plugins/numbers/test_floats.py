# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Floats whose added mass is that of their own shape, and where upright floating ends."""

import mujoco
import numpy as np
import pytest

from benchmarks.plugins.float_closed_forms import WATER, G
from fluid_sim_ros.physics.kappa import ellipsoid_added_mass, ellipsoid_volume
from test.support.oscillations import oscillation, period
from test.support.plugin_models import body_plugin, ellipsoid, free_body, load, text, world

LAKE = {'density': WATER, 'surface': 0}


@pytest.mark.parametrize('axes', [[0.2, 0.2, 0.2], [0.35, 0.25, 0.15], [0.1, 0.3, 0.4]])
def test_heave_of_a_half_sunk_ellipsoid_with_its_own_added_mass(axes):
    """omega^2 = rho g pi r_x r_y / (m + m_z/2): half of it is wet, and half of m_z moves along."""
    inside = ellipsoid(axes, WATER / 2) + body_plugin(
        added_mass='auto', volume='auto', drag='none'
    )
    model, data = load(world(free_body(inside), gravity=(0, 0, -G), timestep=0.002, medium=LAKE))
    data.qpos[2] = 1e-5
    times, height = oscillation(model, data, lambda: data.qpos[2], 10.0)
    mass = WATER / 2 * float(ellipsoid_volume(axes))
    total = mass + ellipsoid_added_mass(axes, WATER)[0][2] / 2
    stiffness = WATER * G * np.pi * axes[0] * axes[1]
    expected = 2 * np.pi * np.sqrt(total / stiffness)
    assert period(times, height) == pytest.approx(expected, rel=1e-3)


def tilted_box(half_width):
    """Return the largest roll [rad] within 20 s of a half-sunk box of half-height .1 m."""
    half = [0.3, half_width, 0.1]
    inside = f'<geom type="box" size="{text(half)}" density="{WATER / 2}"/>'
    damping = body_plugin(volume='auto', linear_damping=[50, 50, 50, 1, 1, 1])
    model, data = load(world(free_body(inside + damping), gravity=(0, 0, -G), medium=LAKE))
    roll = 0.01
    data.qpos[3:] = [np.cos(roll / 2), np.sin(roll / 2), 0, 0]
    largest = 0.0
    for _ in range(200):
        mujoco.mj_step(model, data, 10)
        largest = max(largest, 2 * np.arcsin(min(abs(data.qpos[4]), 1)))
    return largest


def test_a_box_stays_upright_exactly_when_its_metacentre_is_above_its_centre_of_mass():
    """
    GM = BM - BG with BM = (2 w)^2 / (12 T), BG = T/2 for draft T = .1 m: w^2 > 3 T^2 / 2.

    So the narrowest upright box has a half width of .12247 m.
    """
    limit = np.sqrt(1.5) * 0.1
    assert tilted_box(1.02 * limit) < 0.02
    assert tilted_box(0.98 * limit) > 0.1
