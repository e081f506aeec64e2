# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest
from hypothesis import given

from fluid_sim_ros.physics.buoyancy import buoyancy_wrench
from fluid_sim_ros.physics.free_surface import (
    box_cut,
    ellipsoid_cut,
    polyhedron_cut,
    wetted_volume_rate,
)
from fluid_sim_ros.physics.volume import box_mesh, box_volume, ellipsoid_volume
from test.support.strategies import axes, floats, rotation, seeds


def up_of(seed):
    return rotation(seed)[2]


def test_sphere_cap():
    r, h = 0.3, 0.1
    cut = ellipsoid_cut([r] * 3, [0, 0, 1.0], h)
    depth = r + h
    assert cut.volume == pytest.approx(np.pi * depth**2 * (3 * r - depth) / 3, rel=1e-14)
    # Centre of a cap of height d from the sphere's centre: 3 (2r - d)^2 / (4 (3r - d)) below.
    expected = -3 * (2 * r - depth) ** 2 / (4 * (3 * r - depth))
    assert cut.center_b == pytest.approx([0, 0, expected], rel=1e-14)
    assert cut.waterplane_area == pytest.approx(np.pi * (r**2 - h**2), rel=1e-14)
    assert cut.waterplane_center_b == pytest.approx([0, 0, h], rel=1e-14)


def test_half_ellipsoid():
    r = np.array([0.5, 0.3, 0.2])
    cut = ellipsoid_cut(r, [1.0, 0, 0], 0.0)
    assert cut.volume == pytest.approx(float(ellipsoid_volume(r)) / 2, rel=1e-15)
    assert cut.center_b == pytest.approx([-3 / 8 * 0.5, 0, 0], rel=1e-14)
    assert cut.waterplane_area == pytest.approx(np.pi * 0.06, rel=1e-14)


@given(axes(0.1, 1), seeds())
def test_out_of_the_water_and_under_it(r, seed):
    dry, wet = (ellipsoid_cut(r, up_of(seed), h) for h in (-1.1, 1.1))
    assert dry.volume == 0 and dry.waterplane_area == 0
    assert wet.volume == pytest.approx(float(ellipsoid_volume(r)), rel=1e-14)
    assert not wet.center_b.any() and wet.waterplane_area == 0
    assert np.isfinite(dry.center_b).all()


@given(axes(0.1, 1), seeds(), floats(-0.5, 0.5))
def test_both_sides_of_the_surface_add_up(r, seed, height):
    up = up_of(seed)
    cut, rest = ellipsoid_cut(r, up, height), ellipsoid_cut(r, -up, -height)
    whole = float(ellipsoid_volume(r))
    assert cut.volume + rest.volume == pytest.approx(whole, rel=1e-13)
    moment = cut.volume * cut.center_b + rest.volume * rest.center_b
    assert moment == pytest.approx(np.zeros(3), abs=1e-13 * whole)
    half, rest = box_cut(r, up, height), box_cut(r, -up, -height)
    whole = float(box_volume(r))
    assert half.volume + rest.volume == pytest.approx(whole, rel=1e-12)
    moment = half.volume * half.center_b + rest.volume * rest.center_b
    assert moment == pytest.approx(np.zeros(3), abs=1e-12 * whole)
    assert half.waterplane_area == pytest.approx(rest.waterplane_area, abs=1e-12)


def test_ellipsoid_cut_against_random_points():
    r, up, rng = np.array([0.5, 0.3, 0.2]), np.array([0.48, -0.6, 0.64]), np.random.default_rng(11)
    points = rng.uniform(-1, 1, (600_000, 3))
    body = points[(points**2).sum(axis=1) <= 1] * r
    wet = body @ up <= 0.1
    cut = ellipsoid_cut(r, up, 0.1)
    assert cut.volume / ellipsoid_volume(r) == pytest.approx(wet.mean(), abs=3e-3)
    assert cut.center_b == pytest.approx(body[wet].mean(axis=0), abs=2e-3)


def sphere_mesh(radius, rings=24):
    """Return a latitude-longitude mesh of a sphere: an outer check of the clip."""
    theta = np.linspace(0, np.pi, rings + 1)[1:-1]
    phi = np.arange(2 * rings) * np.pi / rings
    t, p = np.meshgrid(theta, phi, indexing='ij')
    grid = np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], -1).reshape(-1, 3)
    vertices = radius * np.vstack([grid, [0, 0, 1], [0, 0, -1]])
    n, m = len(theta), len(phi)
    top, low, faces = n * m, n * m + 1, []
    for j in range(m):
        k = (j + 1) % m
        faces += [[top, j, k], [low, (n - 1) * m + k, (n - 1) * m + j]]
        for i in range(n - 1):
            a, b = i * m, (i + 1) * m
            faces += [[a + j, b + j, b + k], [a + j, b + k, a + k]]
    return vertices, np.array(faces)


def test_mesh_of_a_sphere_tends_to_the_ellipsoid_cut():
    up, height = np.array([0.6, 0.0, 0.8]), 0.3
    exact = ellipsoid_cut([1.0] * 3, up, height)
    errors = []
    for rings in (8, 16):
        cut = polyhedron_cut(*sphere_mesh(1.0, rings), up, height)
        errors.append(abs(float(cut.volume / exact.volume) - 1))
    assert errors[1] < 0.02
    assert 3.5 < errors[0] / errors[1] < 4.5  # second order in the mesh size


def test_upright_box():
    cut = box_cut([0.5, 0.3, 0.2], [0, 0, 1.0], 0.05)
    assert cut.volume == pytest.approx(1.0 * 0.6 * 0.25, rel=1e-14)
    assert cut.center_b == pytest.approx([0, 0, -0.075], abs=1e-15)
    assert cut.waterplane_area == pytest.approx(0.6, rel=1e-14)
    assert cut.waterplane_center_b == pytest.approx([0, 0, 0.05], abs=1e-15)


def test_box_faces_in_the_surface_and_clear_of_it():
    full = box_cut([1.0, 1, 1], [0, 0, 1.0], 1.0)
    assert full.volume == pytest.approx(8.0, rel=1e-15)
    assert full.center_b == pytest.approx(np.zeros(3), abs=1e-15)
    for height in (-1.0, -5.0):
        dry = box_cut([1.0, 1, 1], [0, 0, 1.0], height)
        assert dry.volume == 0 and np.isfinite(dry.center_b).all()


def test_metacentre_of_a_box():
    # BM = I_waterplane / V: a heel of phi moves the centre of buoyancy by BM tan(phi) sideways
    # (wedges, exact while the surface crosses the sides).
    half, height, phi = np.array([2.0, 0.5, 0.4]), -0.1, 0.2
    up = np.array([0.0, np.sin(phi), np.cos(phi)])
    cut = box_cut(half, up, height * np.cos(phi))
    volume = 4.0 * 1.0 * 0.3
    assert cut.volume == pytest.approx(volume, rel=1e-13)
    bm = (4.0 * 1.0**3 / 12) / volume
    assert cut.center_b[1] == pytest.approx(-bm * np.tan(phi), rel=1e-12)
    assert cut.center_b[2] == pytest.approx(-0.25 + 0.5 * bm * np.tan(phi) ** 2, rel=1e-12)


@given(seeds(), floats(-0.3, 0.3))
def test_stiffness_in_heave_is_the_waterplane_area(seed, height):
    r, up, h = np.array([0.5, 0.4, 0.35]), up_of(seed), 1e-6
    for cut in (ellipsoid_cut, box_cut):
        slope = (cut(r, up, height + h).volume - cut(r, up, height - h).volume) / (2 * h)
        assert slope == pytest.approx(float(cut(r, up, height).waterplane_area), rel=1e-7)


@given(seeds(), floats(-0.2, 0.2))
def test_rate_of_the_wet_volume(seed, height):
    rng = np.random.default_rng(seed)
    r, up, omega, rate = np.array([0.5, 0.4, 0.35]), up_of(seed), rng.normal(size=3), rng.normal()
    h = 1e-6
    for cut in (ellipsoid_cut, box_cut):
        volumes = []
        for t in (-h, h):
            turned = up - np.cross(omega, up) * t
            volumes.append(cut(r, turned / np.linalg.norm(turned), height + rate * t).volume)
        difference = float(volumes[1] - volumes[0]) / (2 * h)
        found = wetted_volume_rate(cut(r, up, height), up, rate, omega)
        assert found == pytest.approx(difference, rel=1e-6, abs=1e-8)


@given(seeds(), floats(-0.2, 0.2))
def test_buoyancy_of_a_cut_is_conservative(seed, height):
    # Torque = slope of the potential rho g (V height - moment) under a turn: here dE = -g . dw.
    r, up = np.array([0.5, 0.4, 0.35]), up_of(seed)
    axis, h = np.random.default_rng(seed).normal(size=3), 1e-5

    def potential(cut, turn):
        turned = up - turn * np.cross(axis, up)
        turned /= np.linalg.norm(turned)
        # Energy of the displaced water, raised from below to the surface.
        found = cut(r, turned, height)
        return float(found.volume) * (height - turned @ found.center_b)

    for cut in (ellipsoid_cut, box_cut):
        here = cut(r, up, height)
        torque = buoyancy_wrench(1.0, here.volume, here.center_b, -up)[1]
        slope = (potential(cut, h) - potential(cut, -h)) / (2 * h)
        assert torque @ axis == pytest.approx(-slope, rel=1e-5, abs=1e-8)


def test_batch_of_ellipsoids(rng):
    r, height = rng.uniform(0.1, 1, (5, 3)), rng.uniform(-0.1, 0.1, 5)
    cut = ellipsoid_cut(r, [0, 0, 1.0], height)
    one = ellipsoid_cut(r[3], [0, 0, 1.0], height[3])
    assert cut.volume[3] == pytest.approx(float(one.volume))
    assert cut.center_b[3] == pytest.approx(one.center_b)


def test_box_mesh_is_a_box():
    vertices, faces = box_mesh([1.0, 2.0, 3.0])
    assert vertices.shape == (8, 3) and faces.shape == (12, 3)
