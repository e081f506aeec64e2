# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Each numpy term on its own against stock MuJoCo, and how far the printed formulas are off."""

import mujoco
import numpy as np
import pytest

from benchmarks.plugins import fluid_terms
from fluid_sim_ros.physics import added_mass, drag, kappa, lift
from fluid_sim_ros.physics.ellipsoid import FluidCoef, ellipsoid_wrench
from test.support import printed_formulas


@pytest.fixture(scope='module')
def errors():
    return fluid_terms.measure(fluid_terms.QUICK_CASES)


TERMS = [
    *('added_mass_force', 'added_mass_torque', 'blunt_drag', 'slender_drag'),
    *('slender_drag_to_result', 'angular_drag', 'drag_force', 'drag_torque', 'kutta', 'magnus'),
    *('viscous_force', 'viscous_torque', 'inertia_drag_force', 'inertia_drag_torque'),
    *('inertia_viscous_force', 'inertia_viscous_torque'),
]


def test_every_term_is_measured(errors):
    assert sorted(errors) == sorted(TERMS)
    assert {len(values) for values in errors.values()} == {fluid_terms.QUICK_CASES}


@pytest.mark.parametrize('term', TERMS)
def test_term_against_engine(errors, term):
    assert errors[term].max() <= fluid_terms.LIMITS[term]


def free_ellipsoid(axes, attributes=''):
    model = mujoco.MjModel.from_xml_string(
        fluid_terms.ELLIPSOID.format(size=fluid_terms.text(np.asarray(axes)))
    )
    return model, mujoco.MjData(model)


def test_sum_of_terms_is_the_whole_with_all_defaults(rng):
    for _ in range(50):
        axes = 10 ** rng.uniform(-2, -1, 3)
        model, data = free_ellipsoid(axes)
        motion = fluid_terms.place(model, data, rng)
        force, torque = fluid_terms.engine(model, data, motion.density, motion.viscosity)
        terms = ellipsoid_wrench(
            axes,
            motion.v_rel_b,
            motion.omega_b,
            density=motion.density,
            viscosity=motion.viscosity,
        )
        size = sum(np.linalg.norm(f) for f, _ in terms.values())
        twist = sum(np.linalg.norm(g) for _, g in terms.values())
        assert np.linalg.norm(sum(f for f, _ in terms.values()) - force) <= 1e-5 * size
        assert np.linalg.norm(sum(g for _, g in terms.values()) - torque) <= 1e-5 * twist


OFFSET = """
<mujoco><option gravity="0 0 0" density="50" viscosity=".2" wind="1 -2 .5"/><worldbody>
<body pos="1 2 3"><freejoint/><inertial pos=".05 0 .02" mass="1" diaginertia=".1 .1 .1"/>
<geom type="ellipsoid" size=".3 .2 .1" pos=".1 -.2 .3" quat=".5 .1 -.7 .4"
 fluidshape="ellipsoid" fluidcoef=".4 .3 1.1 .9 .8" contype="0" conaffinity="0"/></body>
</worldbody></mujoco>"""


def test_geom_off_the_body_origin_in_any_attitude(rng):
    model = mujoco.MjModel.from_xml_string(OFFSET)
    data = mujoco.MjData(model)
    quat = rng.normal(size=4)
    data.qpos[3:] = quat / np.linalg.norm(quat)
    data.qvel[:] = rng.normal(size=6)
    mujoco.mj_forward(model, data)
    rot_wb, rot_wg = data.xmat[1].reshape(3, 3), data.geom_xmat[0].reshape(3, 3)
    arm_w = data.geom_xpos[0] - data.xpos[1]
    omega_w = rot_wb @ data.qvel[3:]
    v_w = data.qvel[:3] + np.cross(omega_w, arm_w)
    # Wind is subtracted from the linear velocity only.
    terms = ellipsoid_wrench(
        [0.3, 0.2, 0.1],
        rot_wg.T @ (v_w - model.opt.wind),
        rot_wg.T @ omega_w,
        density=50.0,
        viscosity=0.2,
        coef=FluidCoef(0.4, 0.3, 1.1, 0.9, 0.8),
    )
    force_w = rot_wg @ sum(f for f, _ in terms.values())
    torque_w = rot_wg @ sum(g for _, g in terms.values())
    torque_b = rot_wb.T @ (torque_w + np.cross(arm_w, force_w))
    assert data.qfrc_fluid[:3] == pytest.approx(force_w, rel=1e-6)
    assert data.qfrc_fluid[3:] == pytest.approx(torque_b, rel=1e-6)


def test_engine_is_galilean(rng):
    model, data = free_ellipsoid([0.3, 0.2, 0.1])
    data.qvel[:] = rng.normal(size=6)
    model.opt.wind = rng.normal(size=3)
    here = fluid_terms.engine(model, data, 10.0, 0.1)
    boost = np.array([3.0, -5.0, 2.0])
    data.qvel[:3] += boost
    model.opt.wind = model.opt.wind + boost
    there = fluid_terms.engine(model, data, 10.0, 0.1)
    assert there[0] == pytest.approx(here[0], rel=1e-11)
    assert there[1] == pytest.approx(here[1], rel=1e-11)


@pytest.fixture
def fast_spin(rng):
    """Return a triaxial body in the engine with its motion, and the engine without wind."""
    axes = np.array([0.3, 0.2, 0.1])
    model, data = free_ellipsoid(axes)
    data.qvel[:] = [1.0, -2.0, 0.5, 2.0, -1.0, -3.0]
    return axes, model, data


def test_difference_1_maximal_area(fast_spin):
    axes, model, data = fast_spin
    model.geom_fluid[0, 1:] = [0, 1.0, 0, 0, 0, *np.zeros(6)]
    force = fluid_terms.engine(model, data, 1.0, 0.0)[0]
    kind = {'density': 1.0, 'c_blunt': 0.0, 'c_slender': 1.0}
    assert drag.blunt_slender_drag(axes, data.qvel[:3], **kind) == pytest.approx(force, rel=1e-12)
    printed = printed_formulas.blunt_slender_drag_as_printed(axes, data.qvel[:3], **kind)
    assert np.linalg.norm(printed - force) > 0.5 * np.linalg.norm(force)


def test_difference_2_angular_drag(fast_spin):
    axes, model, data = fast_spin
    model.geom_fluid[0, 1:] = [0, 0, 1.0, 0, 0, *np.zeros(6)]
    torque = fluid_terms.engine(model, data, 1.0, 0.0)[1]
    kind = {'density': 1.0, 'c_angular': 1.0, 'c_slender': 0.0}
    assert drag.angular_drag(axes, data.qvel[3:], **kind) == pytest.approx(torque, rel=1e-12)
    printed = printed_formulas.angular_drag_as_printed(axes, data.qvel[3:], **kind)
    assert torque @ data.qvel[3:] < 0 < printed @ data.qvel[3:]


def test_difference_3_general_form_of_the_added_torque(fast_spin):
    axes, model, data = fast_spin
    data.qvel[:3] = 0
    model.geom_fluid[0, 1:6] = 0
    torque = fluid_terms.engine(model, data, 1.0, 0.0)[1]
    a = kappa.ellipsoid_added_mass(axes, 1.0)
    zero = np.zeros(3)
    ours = added_mass.ellipsoid_added_mass_wrench(*a, zero, data.qvel[3:])[1]
    printed = printed_formulas.added_mass_coriolis_as_printed(*a, zero, data.qvel[3:])[1]
    assert ours == pytest.approx(torque, rel=1e-5)
    assert printed == pytest.approx(-torque, rel=1e-5)


def test_difference_4_viscosity_is_dynamic(fast_spin):
    # The engine's viscous force does not scale with density: beta carries Pa s.
    axes, model, data = fast_spin
    model.geom_fluid[0, 1:] = 0
    light = fluid_terms.engine(model, data, 1.0, 0.3)[0]
    heavy = fluid_terms.engine(model, data, 1000.0, 0.3)[0]
    assert np.array_equal(light, heavy)
    expected = -6 * np.pi * axes.mean() * 0.3 * data.qvel[:3]
    assert light == pytest.approx(expected, rel=1e-14)


def test_difference_5_textbook_coefficient_is_twice_the_engines():
    model, data = free_ellipsoid([0.1, 0.1, 0.1])
    data.qvel[:] = [2.0, 0, 0, 0, 0, 0]
    model.geom_fluid[0, 1:] = [0.5, 0, 0, 0, 0, *np.zeros(6)]
    force = fluid_terms.engine(model, data, 1000.0, 0.0)[0]
    textbook = -force[0] / (0.5 * 1000 * np.pi * 0.01 * 4)
    assert textbook == pytest.approx(2 * 0.5, rel=1e-14)


def test_engine_drops_the_acceleration_terms():
    # Pushed from rest in an ideal fluid the engine gives F/m, physics F/(m + m_A).
    model, data = free_ellipsoid([0.1, 0.1, 0.1])
    model.opt.density = 1000.0
    data.qfrc_applied[0] = 1.0
    mujoco.mj_forward(model, data)
    assert data.qacc[0] == pytest.approx(1 / model.body_mass[1], rel=1e-14)


@pytest.mark.parametrize('scale', [1e-1, 1e-2, 1e-3])
def test_engine_kutta_of_small_bodies(scale):
    axes = scale * np.array([1.0, 0.5, 0.1])
    model, data = free_ellipsoid(axes)
    data.qvel[:] = [1.0, 0, 0.5, 0, 0, 0]
    model.geom_fluid[0, 1:] = [0, 0, 0, 1.0, 0, *np.zeros(6)]
    force = fluid_terms.engine(model, data, 1.0, 0.0)[0]
    ours = lift.kutta_force(axes, data.qvel[:3], density=1.0, c_kutta=1.0)
    assert force == pytest.approx(ours, rel=1e-12)


def test_engine_quadrature_of_kappa_degrades_with_aspect_ratio():
    errors = []
    for axes in ([0.5, 0.2, 0.1], [1.0, 1.0, 0.01], [1.0, 1.0, 0.001]):
        model, _ = free_ellipsoid(axes)
        exact = kappa.ellipsoid_added_mass(axes, 1.0)[0]
        errors.append(np.abs(model.geom_fluid[0, 6:9] / exact - 1).max())
    assert errors[0] < 1e-6 < 1e-4 < errors[1] < 1e-3 < 0.1 < errors[2] < 0.15


def test_printed_formulas_are_off_over_random_bodies():
    found = fluid_terms.measure(100, (fluid_terms.printed_case,))
    assert found['added_mass_torque_general_form'] == pytest.approx(np.full(100, 2.0), abs=1e-3)
    assert np.median(found['drag_maximal_area']) > 0.1
    assert 0.3 < found['angular_drag_power_is_positive'].mean() < 0.7
    assert np.median(found['angular_drag_dot_product']) > 0.5
    assert found['viscosity_kinematic_factor'].max() > 100
