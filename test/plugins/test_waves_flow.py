# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Waves of fluid_sim.medium: the numpy twin's flow and surface, and the forces that follow."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros.physics.environment.waves import regular_waves, wave_flow, wave_surface
from fluid_sim_ros.physics.free_surface import box_cut
from fluid_sim_ros.plugins.native import MEDIUM_VELOCITY, ROW_WIDTH, native
from test.support.plugin_models import (
    body_plugin,
    explicit_force,
    free_body,
    kinetic_energy,
)
from test.support.wave_models import CASES, LEVEL, MEAN, PULL, VOLUME, G, sea_model, sphere


@pytest.mark.parametrize('name', CASES)
def test_the_flow_is_that_of_the_numpy_twin(name):
    """Velocity by a linear damping of 1 N s/m, Du/Dt by rho V Du/Dt, at points in the water."""
    waves, sea = CASES[name]
    felt = sphere(linear_damping=[1, 1, 1, 0, 0, 0])
    pushed = sphere(volume='auto')
    damped, pushed = (sea_model(body, waves, weight=False) for body in (felt, pushed))
    rng = np.random.default_rng(5)
    for point, time in zip(
        rng.uniform([-80, -80, -25], [80, 80, -1.2], (30, 3)),
        rng.uniform(0, 2000, 30),
        strict=True,
    ):
        flow = wave_flow(sea, point, time)
        for model, data in (damped, pushed):
            data.qpos[:3], data.time = point + MEAN, time
            force = explicit_force(model, data)[:3]
            expected = flow.velocity if model is damped[0] else 1000 * VOLUME * flow.acceleration
            np.testing.assert_allclose(force, expected, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize('name', CASES)
def test_current_and_waves_add_up_and_carry_each_other(name):
    """Du/Dt of the sum: the current carries the waves' gradient, and the waves the profile's."""
    waves, sea = CASES[name]
    current = {'current': [0.5, -0.3, 0], 'current_profile': 'table -30 0 0 1'}
    model, data = sea_model(sphere(volume='auto'), waves, weight=False, medium=current)
    point, time = np.array([4.0, 9.0, -2.0]), 33.0
    data.qpos[:3], data.time = point + MEAN, time
    flow = wave_flow(sea, point, time)
    velocity = flow.velocity + (1 - 2 / 30) * np.array([0.5, -0.3, 0])
    gradient = flow.gradient.copy()
    gradient[:, 2] += np.array([0.5, -0.3, 0]) / 30
    expected = 1000 * VOLUME * (flow.rate + gradient @ velocity)
    np.testing.assert_allclose(explicit_force(model, data)[:3], expected, rtol=1e-9, atol=1e-9)


def box_and_cut(sea, position, quat, time, half):
    """Return the numpy cut of a box by the tangent plane over its centre, and its normal."""
    surface = wave_surface(sea, position[:2], time)
    up = np.r_[-surface.slope, 1.0]
    up /= np.linalg.norm(up)
    rotation = np.zeros(9)
    mujoco.mju_quat2Mat(rotation, quat)
    rotation = rotation.reshape(3, 3)
    above = up[2] * (LEVEL + surface.height - position[2])
    return box_cut(half, rotation.T @ up, above), rotation


@pytest.mark.parametrize('name', CASES)
def test_buoyancy_of_a_box_cut_by_the_wave(name):
    """-rho V_wet (g - Du/Dt) at the centre of the part below the tangent plane."""
    waves, sea = CASES[name]
    half, quat = np.array([0.4, 0.3, 0.2]), np.array([0.9, 0.3, -0.2, 0.25])
    quat /= np.linalg.norm(quat)
    box = '<geom type="box" size=".4 .3 .2" density="400"/>'
    model, data = sea_model(free_body(box + body_plugin(volume='auto', drag='none')), waves)
    for time in (0.0, 1.3, 3.9):
        place = np.array([2.0, -1.0, 0.0])
        place[2] = LEVEL + float(wave_surface(sea, place[:2], time).height) - 0.05
        data.qpos[:3], data.qpos[3:], data.time = place, quat, time
        cut, rotation = box_and_cut(sea, place, quat, time, half)
        flow = wave_flow(sea, place - MEAN, time)
        force = 1000 * cut.volume * (flow.acceleration - PULL)
        torque = np.cross(cut.center_b, rotation.T @ force)
        expected = np.r_[force, torque]
        np.testing.assert_allclose(explicit_force(model, data), expected, rtol=1e-9, atol=1e-9)


def test_the_wetted_share_changes_at_the_rate_that_slams():
    """-(ds/dt)+ A nu with ds/dt by difference along the motion; turning body, moving wave."""
    waves, sea = CASES['deep']
    half, mass = np.array([0.4, 0.3, 0.2]), 50.0
    box = '<geom type="box" size=".4 .3 .2" density="400"/>'
    plugin = body_plugin(added_mass=[mass] * 3 + [0] * 3, drag='none')
    model, data = sea_model(free_body(box + plugin), waves)
    rng, seen = np.random.default_rng(6), 0
    for _ in range(20):
        time, place = rng.uniform(0, 5), np.r_[rng.uniform(-5, 5, 2), 0]
        quat, velocity = rng.normal(size=4), rng.normal(size=6)
        quat /= np.linalg.norm(quat)
        place[2] = (
            LEVEL + float(wave_surface(sea, place[:2], time).height) + rng.uniform(-0.1, 0.1)
        )

        def share(step, place=place, quat=quat, velocity=velocity, time=time):
            moved = quat.copy()
            mujoco.mju_quatIntegrate(moved, velocity[3:], step)
            cut, _ = box_and_cut(sea, place + step * velocity[:3], moved, time + step, half)
            return float(cut.volume) / (8 * half.prod())

        rate = (share(1e-6) - share(-1e-6)) / 2e-6
        data.qpos[:3], data.qpos[3:], data.qvel[:], data.time = place, quat, velocity, time
        level = place - MEAN
        top = float(wave_surface(sea, place[:2], time).height)
        flow = wave_flow(sea, np.r_[level[:2], min(level[2], top)], time)
        relative = velocity[:3] - flow.velocity
        # an isotropic A: its convective terms cancel, w x v against v x w
        pushed = mass * share(0) * flow.acceleration - mass * max(rate, 0) * relative
        np.testing.assert_allclose(
            explicit_force(model, data)[:3], pushed, rtol=1e-6, atol=1e-5 * mass
        )
        seen += rate > 0
    assert 5 <= seen <= 15


def test_far_from_the_surface_a_body_is_wet_or_dry():
    """The short cut for bodies out of the waves' reach changes nothing that is felt."""
    waves, sea = CASES['short-crested']
    model, data = sea_model(sphere(volume='auto', added_mass='auto'), waves)
    reach = float(sea.amplitude.sum())
    for height, wet in [(-reach - 4, True), (reach + 4, False)]:
        data.qpos[2] = LEVEL + height
        lift = explicit_force(model, data)[2]
        flow = wave_flow(sea, [0, 0, height], 0.0)
        full = 1000 * VOLUME * (1.5 * flow.acceleration[2] + G)
        assert lift == pytest.approx(full if wet else 0.0, rel=1e-9, abs=1e-12)


def test_the_sum_of_the_terms_is_the_force_and_the_flow_has_energy():
    waves, _ = CASES['sea']
    model, data = sea_model(
        sphere(volume='auto', added_mass='auto', drag='ellipsoid'), waves, option=''
    )
    data.qpos[2] = LEVEL - 2
    mujoco.mj_forward(model, data)
    np.testing.assert_allclose(data.qfrc_fluid, explicit_force(model, data), rtol=1e-10)
    assert kinetic_energy(model, data)[1] > 0


def test_what_lies_under_a_crest_is_water_and_over_a_trough_air():
    """The medium that is published for a vehicle, between trough and crest."""
    medium = {
        'waves': 'regular 2 6', 'current': [0.4, 0, 0], 'wind': [0, 9, 0],
        'density_above': 1.2,
    }  # fmt: skip
    model, data = sea_model(sphere(volume='auto'), medium)
    scratch, bases = mujoco.MjData(model), np.array([1], dtype=np.int32)
    rows = np.zeros((1, ROW_WIDTH))
    for time, under in [(0.0, True), (3.0, False)]:
        data.qpos[2], data.time = LEVEL + 0.2 * (1 if under else -1), time
        native().observe(
            model._address, data._address, scratch._address, bases.ctypes.data, 1, 0,
            rows.ctypes.data,
        )  # fmt: skip
        velocity = rows[0, MEDIUM_VELOCITY]
        if under:
            expected = wave_flow(regular_waves(2, 6, gravity=G), [0, 0, 0.2], 0.0).velocity
            np.testing.assert_allclose(velocity, expected + np.array([0.4, 0, 0]), rtol=1e-12)
        else:
            np.testing.assert_allclose(velocity, [0, 9, 0])
