# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Displaced volume and buoyancy of every shape against the numpy twin, at random attitudes."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros.physics.buoyancy import layered_buoyancy_wrench
from fluid_sim_ros.physics.free_surface import box_cut, ellipsoid_cut, polyhedron_cut
from fluid_sim_ros.physics.volume import capsule_volume, cylinder_volume, mesh_volume
from test.support.plugin_models import (
    body_plugin,
    ellipsoid,
    explicit_force,
    free_body,
    kinetic_energy,
    load,
    text,
    world,
)

WATER, AIR, G = 1000.0, 1.2, np.array([0.0, 0.0, -9.81])
LAKE = {'density': WATER, 'density_above': AIR, 'surface': 0.7}
GEOM_POS = np.array([0.05, -0.02, 0.03])
GEOM_QUAT = np.array([0.9, 0.1, -0.3, 0.2]) / np.linalg.norm([0.9, 0.1, -0.3, 0.2])
WEDGE = np.array(
    [[0, 0, 0], [0.4, 0, 0], [0, 0.3, 0], [0, 0, 0.2], [0.4, 0, 0.2], [0, 0.3, 0.2]], dtype=float
)


def shape_model(geom, values=None, medium=None, extra=''):
    inside = f'<geom {geom} pos="{text(GEOM_POS)}" quat="{text(GEOM_QUAT)}" density="300"/>'
    return load(
        world(
            free_body(inside + body_plugin(**(values or {'volume': 'auto'}))),
            gravity=G,
            medium=medium or LAKE,
            extra=extra,
        )
    )


def pose(data, rng, spread):
    quat = rng.normal(size=4)
    data.qpos[:] = np.r_[rng.normal(size=2), 0.7 + rng.uniform(-spread, spread), quat]
    data.qpos[3:] /= np.linalg.norm(quat)


def world_frame(model, data):
    """Return rotation and centre of the geom after a position update."""
    mujoco.mj_kinematics(model, data)
    return data.geom_xmat[0].reshape(3, 3), data.geom_xpos[0]


def expected_wrench(cut, volume, center_g, rotation, position, data):
    """Return the generalized force of the free joint from a cut in geom axes."""
    center_w = position + rotation @ center_g
    wet_w = position + rotation @ cut.center_b
    force, torque = layered_buoyancy_wrench(
        WATER, AIR, volume, center_w - data.xpos[1], cut.volume, wet_w - data.xpos[1], G
    )
    return np.r_[force, data.xmat[1].reshape(3, 3).T @ torque]


CUTS = {
    'type="ellipsoid" size=".3 .2 .1"': (
        lambda up, h: ellipsoid_cut([0.3, 0.2, 0.1], up, h), 4 / 3 * np.pi * 0.006, np.zeros(3)
    ),
    'type="sphere" size=".2"': (
        lambda up, h: ellipsoid_cut([0.2] * 3, up, h), 4 / 3 * np.pi * 0.008, np.zeros(3)
    ),
    'type="box" size=".3 .2 .1"': (
        lambda up, h: box_cut([0.3, 0.2, 0.1], up, h), 8 * 0.006, np.zeros(3)
    ),
}  # fmt: skip


@pytest.mark.parametrize('geom', CUTS)
def test_cut_of_ellipsoid_sphere_and_box(geom):
    cut_of, volume, center = CUTS[geom]
    model, data = shape_model(geom)
    rng = np.random.default_rng(1)
    wet = []
    for _ in range(50):
        pose(data, rng, 0.35)
        rotation, position = world_frame(model, data)
        cut = cut_of(rotation.T @ [0, 0, 1], 0.7 - position[2])
        wet.append(float(cut.volume) / volume)
        expected = expected_wrench(cut, volume, center, rotation, position, data)
        np.testing.assert_allclose(explicit_force(model, data), expected, rtol=1e-9, atol=1e-9)
    assert 0.1 < np.mean(wet) < 0.9
    assert min(wet) < 0.01
    assert max(wet) > 0.99


def test_cut_of_a_mesh():
    asset = f'<asset><mesh name="wedge" vertex="{text(WEDGE)}"/></asset>'
    model, data = shape_model('type="mesh" mesh="wedge"', extra=asset)
    vertices = model.mesh_vert.astype(float)
    volume, center = mesh_volume(vertices, model.mesh_face)
    assert volume == pytest.approx(0.4 * 0.3 * 0.2 / 2, rel=1e-6)
    rng = np.random.default_rng(2)
    for _ in range(50):
        pose(data, rng, 0.3)
        rotation, position = world_frame(model, data)
        cut = polyhedron_cut(vertices, model.mesh_face, rotation.T @ [0, 0, 1], 0.7 - position[2])
        expected = expected_wrench(cut, volume, center, rotation, position, data)
        np.testing.assert_allclose(explicit_force(model, data), expected, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize(
    ('geom', 'volume'),
    [
        ('type="capsule" size=".1 .3"', capsule_volume(0.1, 0.3)),
        ('type="cylinder" size=".1 .3"', cylinder_volume(0.1, 0.3)),
    ],
)
def test_round_prisms_have_the_exact_volume_and_half_of_it_when_half_sunk(geom, volume):
    model, data = shape_model(geom)
    mujoco.mj_forward(model, data)
    data.qpos[2] = -5
    assert explicit_force(model, data)[2] == pytest.approx(WATER * volume * 9.81, rel=1e-12)
    rng = np.random.default_rng(3)
    for _ in range(20):  # a plane through the centre of a symmetric body halves it
        pose(data, rng, 0.1)
        data.qpos[2] += 0.7 - world_frame(model, data)[1][2]
        force = explicit_force(model, data)[2]
        assert force == pytest.approx((WATER + AIR) / 2 * volume * 9.81, rel=1e-9)


def test_a_cut_cylinder_is_near_the_round_one():
    """Upright, cut across its axis: exact; lying: the prism's segment differs by < 0.5 %."""
    radius, half, depth = 0.1, 0.3, 0.04
    inside = f'<geom type="cylinder" size="{radius} {half}" density="300"/>'
    model, data = load(
        world(free_body(inside + body_plugin(volume='auto')), gravity=G, medium=LAKE)
    )
    data.qpos[2] = 0.7 + 0.1  # upright: 0.2 m of its 0.6 m are wet
    upright = (WATER * 0.2 + AIR * 0.4) * np.pi * radius**2 * 9.81
    assert explicit_force(model, data)[2] == pytest.approx(upright, rel=1e-9)
    data.qpos[:] = [0, 0, 0.7 + radius - depth, np.sqrt(0.5), np.sqrt(0.5), 0, 0]
    angle = 2 * np.arccos(1 - depth / radius)
    segment = radius**2 / 2 * (angle - np.sin(angle)) * 2 * half
    lying = (WATER * segment + AIR * (np.pi * radius**2 * 2 * half - segment)) * 9.81
    assert explicit_force(model, data)[2] == pytest.approx(lying, rel=5e-3)


def test_stated_volume_and_centre():
    """The righting moment of a stated centre of buoyancy turns the centre up, not down."""
    values = {'volume': 0.004, 'center_of_buoyancy': [0.0, 0.0, 0.1]}
    inside = '<inertial pos="0 0 0" mass="4" diaginertia=".1 .1 .1"/>'
    model, data = load(
        world(free_body(inside + body_plugin(**values)), gravity=G, medium={'density': WATER})
    )
    angle = 0.3
    data.qpos[3:] = [np.cos(angle / 2), np.sin(angle / 2), 0, 0]  # rolled to positive x
    force = explicit_force(model, data)
    assert force[2] == pytest.approx(WATER * 0.004 * 9.81, rel=1e-12)
    assert force[3] == pytest.approx(-WATER * 0.004 * 9.81 * 0.1 * np.sin(angle), rel=1e-12)


def test_no_gravity_no_buoyancy():
    model, data = shape_model('type="sphere" size=".2"')
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_GRAVITY
    np.testing.assert_array_equal(explicit_force(model, data), 0)


def test_named_geoms_alone_displace():
    inside = (
        '<geom name="float" type="sphere" size=".1" pos="0 0 .2" density="100"/>'
        '<geom name="frame" type="box" size=".2 .2 .2" density="10"/>'
    )
    plugin = body_plugin(volume='auto', geoms='float')
    model, data = load(world(free_body(inside + plugin), gravity=G, medium={'density': WATER}))
    lift = WATER * 4 / 3 * np.pi * 0.1**3 * 9.81
    assert explicit_force(model, data)[2] == pytest.approx(lift, rel=1e-12)


def test_buoyancy_is_conservative():
    """Bobbing and rolling through the surface without drag or added mass keeps the energy."""
    model, data = shape_model('type="box" size=".3 .2 .1"')
    model.opt.timestep = 0.002
    data.qpos[:] = [0, 0, 0.75, 0.95, 0.2, 0.2, 0.1]
    data.qpos[3:] /= np.linalg.norm(data.qpos[3:])

    def energy():
        """Kinetic energy, weight, and the work against buoyancy, summed along the way."""
        return kinetic_energy(model, data)[0] - model.body_mass[1] * (G @ data.xipos[1])

    mujoco.mj_forward(model, data)
    start, work, largest = energy(), 0.0, 0.0
    force = explicit_force(model, data)
    for _ in range(1500):
        before = force, data.qpos.copy()
        mujoco.mj_step(model, data)
        mujoco.mj_kinematics(model, data)
        step = np.zeros(6)
        mujoco.mj_differentiatePos(model, step, 1.0, before[1], data.qpos)
        force = explicit_force(model, data)
        work += 0.5 * (before[0] + force) @ step
        largest = max(largest, kinetic_energy(model, data)[0])
    mujoco.mj_comPos(model, data)
    assert energy() - work == pytest.approx(start, abs=1e-3 * largest)


def test_light_sphere_entering_water_ends_at_its_share_of_the_momentum():
    """M v0 = (m + A) v: von Karman's slamming, without gravity and drag."""
    radius, mass = 0.1, 2.0
    volume = 4 / 3 * np.pi * radius**3
    inside = ellipsoid([radius] * 3, mass / volume) + body_plugin(
        added_mass='auto', drag='ellipsoid'
    )
    model, data = load(
        world(free_body(inside), timestep=1e-4, medium={'density': WATER, 'surface': 0})
    )
    data.qpos[2], data.qvel[2] = 0.2, -3.0
    energy = [kinetic_energy(model, data).sum()]
    for _ in range(40):
        mujoco.mj_step(model, data, 40)
        energy.append(kinetic_energy(model, data).sum())
    added = WATER * volume / 2
    assert data.qpos[2] < -0.1  # all wet
    assert data.qvel[2] == pytest.approx(-3 * mass / (mass + added), rel=1e-6)
    assert np.all(np.diff(energy) <= 1e-12)


def test_no_slamming_on_exit():
    """Leaving the water, the body keeps its speed while the fluid keeps its momentum."""
    inside = ellipsoid([0.1] * 3, 500) + body_plugin(added_mass='auto', drag='ellipsoid')
    model, data = load(
        world(free_body(inside), timestep=1e-4, medium={'density': WATER, 'surface': 0})
    )
    data.qpos[2], data.qvel[2] = -0.2, 3.0
    mujoco.mj_step(model, data, 2000)
    assert data.qpos[2] > 0.2
    assert data.qvel[2] == pytest.approx(3.0, rel=1e-9)
