# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Turbulence and noise of fluid_sim.medium against their numpy twins."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros.physics.environment.coloured_noise import (
    NoiseFilter,
    between_ticks,
    noise_samples,
    noise_stream,
)
from fluid_sim_ros.physics.environment.turbulence import turbulence_filters
from fluid_sim_ros.physics.environment.turbulence_scales import turbulence_intensity
from test.support.plugin_models import (
    body_plugin,
    ellipsoid,
    explicit_force,
    free_body,
    load,
    world,
)
from test.support.weather_models import AIR, DRYDEN, PROBE, at, flow, rows_of, weather


@pytest.mark.parametrize('kind', ['dryden', 'von_karman'])
@pytest.mark.parametrize('span', [None, 2.0])
def test_turbulence_is_that_of_the_numpy_twin(kind, span):
    medium = DRYDEN | {'turbulence': kind} | ({'turbulence_span': [span]} if span else {})
    model, data = weather(medium, timestep=0.004)
    model.body_mass[1] = 1e9
    outputs = 6 if span else 3
    samples = noise_samples(
        turbulence_filters(kind, [60, 50, 20], 12.0, span),
        outputs,
        0.01,
        5,
        noise_stream('hull'),
        90,
    )
    for k, row in enumerate(rows_of(model, data, 200)):
        value, rate = between_ticks(samples, 0.01, k * 0.004)
        sigma = np.array([1.5, 1.2, 0.8])
        np.testing.assert_allclose(row[:3], [6, 0, 0] + sigma * value[:3], atol=2e-10)
        np.testing.assert_allclose(row[3:6], sigma * rate[:3], atol=1e-7)
        if span:
            np.testing.assert_allclose(row[6:], np.array([0.8, 0.8, 1.2]) * value[3:], atol=2e-10)


def test_gauss_markov_is_that_of_the_numpy_twin():
    medium = {'density': 1000, 'current_gauss_markov': [0.3, 0.2, 0.1, 40], 'current_tick': [0.2]}
    model, data = weather(medium | {'seed': [11]}, timestep=0.05)
    model.body_mass[1] = 1e9
    one = [
        NoiseFilter(np.array([[-1 / 40]]), np.sqrt([2 / 40]), {i: np.array([sigma])})
        for i, sigma in enumerate((0.3, 0.2, 0.1))
    ]
    samples = noise_samples(one, 3, 0.2, 11, 0, 30)
    for k, row in enumerate(rows_of(model, data, 80)):
        value, rate = between_ticks(samples, 0.2, k * 0.05 + 1e-12)
        np.testing.assert_allclose(row[:3], value, atol=1e-10)
        np.testing.assert_allclose(row[3:6], rate, atol=1e-8)


@pytest.mark.parametrize('timestep', [0.001, 0.0025, 0.01, 0.02, 0.05])
def test_the_same_gusts_whatever_the_timestep(timestep):
    fine = weather(DRYDEN, timestep=0.0005)
    coarse = weather(DRYDEN, timestep=timestep)
    for model, data in (fine, coarse):
        model.body_mass[1] = 1e9
        mujoco.mj_step(model, data, round(0.5 / model.opt.timestep))
    a, b = (np.concatenate(at(*run, 0.5001)) for run in (fine, coarse))
    np.testing.assert_array_equal(a, b)


def test_another_vehicle_changes_nothing_for_the_first():
    alone = weather(DRYDEN)
    model, data = load(world(PROBE.replace('hull', 'other') + PROBE, medium=DRYDEN))
    mujoco.mj_forward(model, data)
    np.testing.assert_array_equal(flow(model, data, body=2)[0], flow(*alone)[0])


def test_vehicles_meet_gusts_of_their_own_and_static_bodies_none():
    bodies = PROBE + PROBE.replace('hull', 'other') + '<body name="mast"><geom size=".1"/></body>'
    model, data = load(world(bodies, medium=DRYDEN))
    mujoco.mj_forward(model, data)
    first, second, mast = (flow(model, data, body=i)[0] for i in (1, 2, 3))
    assert np.abs(first - second).min() > 1e-3
    np.testing.assert_array_equal(mast, [6, 0, 0])


def test_intensity_goes_with_the_height_and_its_gradient_with_the_vertical_wind():
    medium = {k: v for k, v in DRYDEN.items() if k != 'turbulence_sigma'}
    medium |= {'turbulence_wind_6m': [9], 'turbulence_ground': [-3]}
    model, data = weather(medium)
    unit = weather(medium | {'wind': [0, 0, 0]})
    for z in (2.0, 30.0, 280.0, 450.0, 3000.0):
        sigma, slope = turbulence_intensity(z + 3, 9.0)
        (u, du, _), (v, dv, _) = flow(model, data, [0, 0, z]), flow(*unit, [0, 0, z])
        xi = v / sigma
        np.testing.assert_allclose(u, np.add([6, 0, 0], v), rtol=1e-12)
        base = flow(*unit, [0, 0, 2.0])
        sigma_2 = turbulence_intensity(5.0, 9.0)[0]
        np.testing.assert_allclose(xi, base[0] / sigma_2, rtol=1e-11)
        # Du/Dt = sigma xi' + u_z sigma' xi
        slope_2 = turbulence_intensity(5.0, 9.0)[1]
        xi_rate = (base[1] - base[0][2] * slope_2 * xi) / sigma_2
        np.testing.assert_allclose(dv, sigma * xi_rate + v[2] * slope * xi, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(du, dv, rtol=1e-12)


def test_the_axis_is_the_mean_wind_or_a_stated_direction():
    along = weather(DRYDEN | {'wind': [0, 2, 0]})
    stated = weather(DRYDEN | {'wind': [0, 0, 0], 'turbulence_direction': [0, 1, 0]})
    x_axis = weather(DRYDEN | {'wind': [0, 0, 0]})
    u = flow(*x_axis)[0]
    np.testing.assert_allclose(flow(*along)[0], [-u[1], 2 + u[0], u[2]], atol=1e-14)
    np.testing.assert_allclose(flow(*stated)[0], [-u[1], u[0], u[2]], atol=1e-14)


def test_turbulence_with_a_span_rotates_the_air_about_the_vehicle():
    model, data = weather(DRYDEN | {'turbulence_span': [2.0]})
    data.qpos[:3] = [3, 1, 2]
    mujoco.mj_forward(model, data)
    u, _, spin = flow(model, data, [3, 1, 2])
    assert np.abs(spin).min() > 1e-4
    arm = np.array([0.3, -0.5, 0.2])
    np.testing.assert_allclose(
        flow(model, data, np.array([3, 1, 2]) + arm)[0], u + np.cross(spin, arm), rtol=1e-12
    )


def test_half_the_curl_of_a_shear_turns_a_body():
    """A free ball in u = (z, 0, 0): the flow turns with half the curl, (0, 1/2, 0)."""
    medium = AIR | {
        'wind': [10, 0, 0], 'wind_profile': 'table 0 0 10 1', 'rotational_gust': 'curl'
    }  # fmt: skip
    ball = free_body(
        ellipsoid([0.2] * 3, 500) + body_plugin(linear_damping=[1, 1, 1, 0.3, 0.3, 0.3])
    )
    model, data = load(world(ball, medium=medium))
    np.testing.assert_allclose(flow(model, data, [0, 0, 5])[2], [0, 0.5, 0], atol=1e-15)
    data.qpos[2] = 5
    np.testing.assert_allclose(explicit_force(model, data), [5, 0, 0, 0, 0.15, 0], atol=1e-14)
    data.qvel[:] = [5, 0, 0, 0, 0.5, 0]  # moves and turns with the air
    np.testing.assert_allclose(explicit_force(model, data), 0, atol=1e-14)


@pytest.mark.parametrize('shape', ['', 'fluidshape="ellipsoid" fluidcoef=".5 .3 1.2 0 0"'])
def test_stock_drag_sees_the_air_turn(shape):
    """At rest in turning air as turning the other way in air that does not."""
    body = free_body(f'<geom type="ellipsoid" size=".3 .2 .1" density="500" {shape}/>')
    option = 'density="1.2" viscosity="1.8e-5"'
    shear = {'wind': [10, 0, 0], 'wind_profile': 'table 0 0 10 1', 'rotational_gust': 'curl'}
    model, data = load(world(body, option=option, medium=shear))
    plain, turning = load(world(body, option=option + ' wind="5 0 0"'))
    for copy in (data, turning):
        copy.qpos[:] = [1, 2, 5, 0.8, 0, 0, 0.6]
    turning.qvel[3:] = [-0.5 * 0.96, -0.5 * 0.28, 0]  # (0, -1/2, 0) in the body's axes
    mujoco.mj_forward(model, data)
    mujoco.mj_forward(plain, turning)
    torque = turning.qfrc_fluid[3:].copy()
    if shape:  # less the convection of its added mass, which the turning air does not cause
        terms = np.zeros(plain.nv)
        turning.qvel[3:] *= -1
        mujoco.mj_forward(plain, turning)
        terms[3:] = (torque + turning.qfrc_fluid[3:]) / 2  # even in the rotation
        turning.qvel[3:] = 0
        mujoco.mj_forward(plain, turning)
        torque += turning.qfrc_fluid[3:] - terms[3:]
    np.testing.assert_allclose(data.qfrc_fluid[3:], torque, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(explicit_force(model, data), data.qfrc_fluid, rtol=1e-10)
