# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Airy waves: dispersion, surface, flow; closed forms and derivatives."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.environment.wave_dispersion import (
    breaking_height,
    dispersion_wavenumber,
)
from fluid_sim_ros.physics.environment.wave_spectrum import jonswap_waves
from fluid_sim_ros.physics.environment.waves import regular_waves, wave_flow, wave_surface
from test.support.strategies import floats

G = 9.81
DEEP = regular_waves(1.2, 5.0, [3.0, 4.0])
SHALLOW = regular_waves(0.4, 4.0, [1.0, -2.0], depth=3.0)
CROSSED = jonswap_waves(1.0, 6.0, spreading=8, components=12, seed=4, depth=9.0)
SEAS = {'deep': DEEP, 'shallow': SHALLOW, 'short-crested': CROSSED}


@given(floats(-3, 3), floats(-2, 4))
def test_dispersion(log_omega, log_depth):
    omega, depth = 10**log_omega, 10**log_depth
    k = dispersion_wavenumber(omega, depth, G)
    assert G * k * np.tanh(k * depth) == pytest.approx(omega**2, rel=4e-15)


def test_dispersion_in_its_limits():
    omega = np.array([0.3, 1.0, 5.0])
    np.testing.assert_array_equal(dispersion_wavenumber(omega, np.inf, G), omega**2 / G)
    np.testing.assert_allclose(dispersion_wavenumber(omega, 1e4, G), omega**2 / G, rtol=1e-15)
    # long waves run at sqrt(g h), whatever their length
    np.testing.assert_allclose(
        1e-4 / dispersion_wavenumber(1e-4, 2.0, G), np.sqrt(2.0 * G), rtol=1e-8
    )
    # k h = 1 exactly
    assert dispersion_wavenumber(np.sqrt(G * np.tanh(1.0)), 1.0, G) == pytest.approx(1, rel=1e-15)


def test_waves_break_at_a_seventh_of_their_length_or_at_a_share_of_the_depth():
    length = G * 5.0**2 / (2 * np.pi)
    assert breaking_height(5.0, np.inf, G) == pytest.approx(0.142 * length, rel=1e-12)
    # long waves: .142 2 pi h = .892 h
    assert breaking_height(1000.0, 2.0, G) == pytest.approx(0.142 * 2 * np.pi * 2.0, rel=1e-4)
    assert regular_waves(0.999 * 0.142 * length, 5.0).amplitude.shape == (1,)


def test_surface_of_regular_waves():
    along, k = np.array([0.6, 0.8]), (2 * np.pi / 5.0) ** 2 / G
    length, speed = 2 * np.pi / k, 5.0 * G / (2 * np.pi)
    for count in (0, 1, -3):
        assert wave_surface(DEEP, count * length * along, 0.0).height == pytest.approx(0.6)
    crest = wave_surface(DEEP, speed * 1.7 * along, 1.7)
    np.testing.assert_allclose(crest.height, 0.6)
    np.testing.assert_allclose([*crest.slope, crest.rate], 0, atol=1e-12)
    steep = wave_surface(DEEP, 0.25 * length * along, 0.0)
    np.testing.assert_allclose(steep.slope, -0.6 * k * along, rtol=1e-12)


def test_deep_water_flow_is_the_textbook_orbit():
    """U = a omega e^kz (cos, sin) along and up: circles of radius a e^kz, clockwise on the way."""
    k, omega = (2 * np.pi / 5.0) ** 2 / G, 2 * np.pi / 5.0
    for z in (0.0, -0.7, -4.0):
        for time in (0.0, 0.8, 3.3):
            flow = wave_flow(DEEP, [1.0, -2.0, z], time)
            theta = k * (0.6 - 1.6) - omega * time
            speed = 0.6 * omega * np.exp(k * z)
            expected = speed * np.array([0.6 * np.cos(theta), 0.8 * np.cos(theta), np.sin(theta)])
            np.testing.assert_allclose(flow.velocity, expected, rtol=1e-12)
            # (u.grad)u of one deep-water wave is k |u|^2, straight up
            lift = flow.acceleration - flow.rate
            np.testing.assert_allclose(lift, [0, 0, k * speed**2], atol=1e-13)


def test_shallow_water_flow_ends_at_the_bed():
    bed = wave_flow(SHALLOW, [0.3, 0.2, -3.0], 1.1)
    assert bed.velocity[2] == pytest.approx(0, abs=1e-16)
    assert np.linalg.norm(bed.velocity) > 0.02
    below = wave_flow(SHALLOW, [0.3, 0.2, -5.0], 1.1)
    np.testing.assert_array_equal(below.velocity, bed.velocity)
    np.testing.assert_array_equal(below.gradient[:, 2], 0)


@pytest.mark.parametrize('name', SEAS)
def test_the_surface_moves_with_the_water_at_the_mean_level(name):
    """The kinematic condition of the linear problem: d eta/dt = w at z = 0."""
    points = np.random.default_rng(1).uniform(-20, 20, (30, 2))
    times = np.linspace(0, 40, 30)
    rise = wave_flow(SEAS[name], np.c_[points, np.zeros(30)], times).velocity[:, 2]
    np.testing.assert_allclose(
        wave_surface(SEAS[name], points, times).rate, rise, rtol=1e-12, atol=1e-13
    )


@pytest.mark.parametrize('name', SEAS)
def test_the_pressure_of_the_waves_is_the_weight_of_the_crest(name):
    """The dynamic condition at z = 0 as Euler's equation along the surface: du/dt = -g slope."""
    points = np.random.default_rng(2).uniform(-20, 20, (30, 2))
    rate = wave_flow(SEAS[name], np.c_[points, np.zeros(30)], 7.0).rate[:, :2]
    slope = wave_surface(SEAS[name], points, 7.0).slope
    np.testing.assert_allclose(rate, -G * slope, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize('name', SEAS)
def test_no_divergence_and_no_rotation_in_the_water(name):
    points = np.random.default_rng(3).uniform([-9, -9, -3], [9, 9, 0], (50, 3))
    gradient = wave_flow(SEAS[name], points, 2.0).gradient
    np.testing.assert_allclose(np.trace(gradient, axis1=1, axis2=2), 0, atol=1e-15)
    np.testing.assert_allclose(gradient, np.swapaxes(gradient, 1, 2), atol=1e-15)


@pytest.mark.parametrize('name', SEAS)
@settings(max_examples=25)
@given(st.tuples(floats(-30, 30), floats(-30, 30), floats(-2.5, 1.5)), floats(0, 50))
def test_derivatives_are_those_of_the_signal(name, point, time):
    sea, h = SEAS[name], 1e-5
    point = np.array([*point[:2], point[2] if abs(point[2]) > 1e-3 else 0.5])
    flow = wave_flow(sea, point, time)
    steps = h * np.eye(3)
    by_place = (
        wave_flow(sea, point + steps, time).velocity - wave_flow(sea, point - steps, time).velocity
    ).T / (2 * h)
    by_time = (
        wave_flow(sea, point, time + h).velocity - wave_flow(sea, point, time - h).velocity
    ) / (2 * h)
    np.testing.assert_allclose(flow.gradient, by_place, atol=1e-8)
    np.testing.assert_allclose(flow.rate, by_time, atol=1e-8)

    surface, place = wave_surface(sea, point[:2], time), point[:2]
    sides = [wave_surface(sea, place + s, time) for s in (*steps[:2, :2], *-steps[:2, :2])]
    late, early = (wave_surface(sea, place, time + s) for s in (h, -h))
    for axis in range(2):
        up, down = sides[axis], sides[2 + axis]
        assert surface.slope[axis] == pytest.approx((up.height - down.height) / 2 / h, abs=1e-8)
        np.testing.assert_allclose(
            surface.curvature[axis], (up.slope - down.slope) / (2 * h), atol=1e-8
        )
    assert surface.rate == pytest.approx((late.height - early.height) / (2 * h), abs=1e-8)
    np.testing.assert_allclose(surface.slope_rate, (late.slope - early.slope) / (2 * h), atol=1e-8)


@pytest.mark.parametrize('name', SEAS)
def test_velocity_and_acceleration_are_continuous_at_the_mean_level(name):
    low, high = (wave_flow(SEAS[name], [2.0, 1.0, z], 3.0) for z in (-1e-9, 1e-9))
    np.testing.assert_allclose(low.velocity, high.velocity, atol=1e-8)
    np.testing.assert_allclose(low.acceleration, high.acceleration, atol=1e-8)


def test_above_the_mean_level_the_profile_is_its_tangent():
    at, above = (wave_flow(DEEP, [1.0, 1.0, z], 0.4) for z in (0.0, 0.5))
    np.testing.assert_allclose(above.velocity, at.velocity + 0.5 * at.gradient[:, 2], rtol=1e-12)


def test_the_energy_of_a_wave_travels_with_the_group():
    """Mean kinetic and potential energy per area are equal, rho g a^2/4 each; flux by c_g."""
    k, omega, a, h = SHALLOW.wavenumber[0], SHALLOW.omega[0], 0.2, 3.0
    times = np.arange(32) / 32 * 4.0
    nodes, weights = np.polynomial.legendre.leggauss(12)
    z = 0.5 * h * (nodes - 1)
    flow = wave_flow(SHALLOW, np.array([[[0.0, 0.0, level]] for level in z]), times)
    kinetic = 0.5 * (flow.velocity**2).sum(axis=-1).mean(axis=1) @ weights * 0.5 * h
    potential = 0.5 * G * (wave_surface(SHALLOW, [0.0, 0.0], times).height ** 2).mean()
    assert kinetic == pytest.approx(G * a**2 / 4, rel=1e-12)
    assert potential == pytest.approx(G * a**2 / 4, rel=1e-12)
    # flux = mean of p u, with p/rho = (omega/k) u_along of a progressive wave
    along = flow.velocity[..., :2] @ SHALLOW.direction[0]
    flux = omega / k * (along**2).mean(axis=1) @ weights * 0.5 * h
    group = 0.5 * omega / k * (1 + 2 * k * h / np.sinh(2 * k * h))
    assert flux == pytest.approx(2 * (G * a**2 / 4) * group, rel=1e-12)


@pytest.mark.parametrize(
    ('call', 'words'),
    [
        (lambda: regular_waves(1, 0), 'period'),
        (lambda: regular_waves(-1, 5), 'height: -1 m; allowed: 0 to 5'),
        (lambda: regular_waves(1, 2), 'height: 1 m; allowed: 0 to 0.886'),
        (lambda: regular_waves(np.nan, 5), 'height: nan'),
        (lambda: jonswap_waves(2.0, 8.0, depth=1.0), 'height: 2.0 m'),
        (lambda: regular_waves(1, 5, [0, 0]), 'direction'),
        (lambda: regular_waves(1, 5, depth=0.0), 'depth'),
        (lambda: dispersion_wavenumber(1.0, 5.0, 0.0), 'gravity'),
    ],
)
def test_wrong_numbers_are_one_line(call, words):
    with pytest.raises(ConfigError, match=words) as caught:
        call()
    assert '\n' not in str(caught.value)
