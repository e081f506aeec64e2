# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest
from hypothesis import given
from scipy.integrate import solve_ivp

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.buoyancy import (
    buoyancy_wrench,
    layered_buoyancy_wrench,
    righting_torque,
    slamming_wrench,
    wetted_share,
)
from fluid_sim_ros.physics.kappa import ellipsoid_added_mass
from fluid_sim_ros.physics.volume import (
    box_mesh,
    box_volume,
    capsule_volume,
    cylinder_volume,
    ellipsoid_volume,
    mesh_volume,
    sphere_volume,
)
from test.support.strategies import axes, floats, positive_matrix, rotation, seeds, vectors

G = np.array([0.0, 0.0, -9.81])


def test_volumes():
    assert sphere_volume(0.5) == pytest.approx(np.pi / 6, rel=1e-15)
    assert ellipsoid_volume([0.5] * 3) == pytest.approx(float(sphere_volume(0.5)), rel=1e-15)
    assert cylinder_volume(0.5, 2.0) == pytest.approx(np.pi, rel=1e-15)
    assert capsule_volume(0.5, 2.0) == pytest.approx(np.pi + np.pi / 6, rel=1e-15)
    assert box_volume([0.5, 1.0, 1.5]) == pytest.approx(6.0, rel=1e-15)


@given(axes(), vectors(), seeds())
def test_mesh_volume_of_a_moved_box(half, shift, seed):
    vertices, faces = box_mesh(half)
    volume, center = mesh_volume(vertices @ rotation(seed).T + shift, faces)
    assert volume == pytest.approx(float(box_volume(half)), rel=1e-9)
    assert center == pytest.approx(shift, abs=1e-9)


def test_mesh_volume_of_a_corner_tetrahedron():
    vertices = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    volume, center = mesh_volume(vertices, faces)
    assert volume == pytest.approx(1 / 6, rel=1e-14)
    assert center == pytest.approx([0.25] * 3, rel=1e-14)
    with pytest.raises(ConfigError, match='outward'):
        mesh_volume(vertices, np.array(faces)[:, ::-1])
    with pytest.raises(ConfigError, match='open'):
        mesh_volume(vertices, faces[:3])


def test_mesh_center_of_a_pyramid():
    # A quarter of the height, where the mean of the five corners is at a fifth.
    vertices = np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0], [0, 0, 3]])
    faces = [[0, 2, 1], [0, 3, 2], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    volume, center = mesh_volume(vertices, faces)
    assert volume == pytest.approx(4.0, rel=1e-14)
    assert center == pytest.approx([0, 0, 0.75], abs=1e-14)


def test_released_sphere_accelerates_with_its_added_mass():
    # (rho_f - rho_b) g / (rho_b + rho_f/2)
    rho_f, rho_b, r = 1000.0, 300.0, 0.1
    volume = sphere_volume(r)
    lift = buoyancy_wrench(rho_f, volume, np.zeros(3), G)[0] + rho_b * volume * G
    inertia = rho_b * volume + ellipsoid_added_mass([r] * 3, rho_f)[0][2]
    assert lift[2] / inertia == pytest.approx(700 * 9.81 / 800, rel=1e-13)


def test_neutral_body_is_weightless_and_heavy_bottom_rights():
    # Centre of volume above the centre of mass; rolled by phi: torque -m g h sin(phi) about x.
    phi, h, mass = 0.3, 0.05, 12.0
    c, s = np.cos(phi), np.sin(phi)
    gravity_b = np.array([[1, 0, 0], [0, c, s], [0, -s, c]]) @ G  # R^T g
    torque = righting_torque(mass, np.zeros(3), 1000.0, 0.012, [0, 0, h], gravity_b)
    assert torque == pytest.approx([-mass * 9.81 * h * np.sin(phi), 0, 0], rel=1e-13)
    upside_down = righting_torque(mass, [0, 0, h], 1000.0, 0.012, np.zeros(3), gravity_b)
    assert upside_down == pytest.approx(-torque, rel=1e-13)


def test_gravity_does_not_act_on_added_mass():
    # A neutral body stays: buoyancy balances weight without any part of m_A.
    force = buoyancy_wrench(1000.0, 0.01, np.zeros(3), G)[0]
    assert force + 10.0 * G == pytest.approx(np.zeros(3), abs=1e-14)


def test_layers():
    wet, whole = buoyancy_wrench(1000.0, 0.004, [0, 0, -0.1], G), 0.01
    force, torque = layered_buoyancy_wrench(
        1000.0, 0.0, whole, [0.1, 0, 0], 0.004, [0, 0, -0.1], G
    )
    assert force == pytest.approx(wet[0]) and torque == pytest.approx(wet[1])
    # Equal layers are one medium.
    force = layered_buoyancy_wrench(5.0, 5.0, whole, np.zeros(3), 0.004, [0, 0, -0.1], G)[0]
    assert force == pytest.approx(-5.0 * whole * G, rel=1e-14)


def test_negative_volume_is_refused():
    with pytest.raises(ConfigError, match='volume'):
        buoyancy_wrench(1000.0, -1.0, np.zeros(3), G)


def test_wetted_share_takes_rounding_off():
    assert wetted_share([-1e-18, 0.5, 1 + 1e-15], 1.0).tolist() == [0.0, 0.5, 1.0]


@pytest.mark.parametrize('density', [1.0, 100.0, 1000.0])
def test_entry_of_a_sphere_ends_at_m_over_m_plus_a(density):
    # (m + s A) v' = -s' A v integrates to (m + s A) v = m v0: 2/3 of the speed when neutral.
    r = 0.1
    mass = density * float(sphere_volume(r))
    added = np.diag(np.r_[ellipsoid_added_mass([r] * 3, 1000.0)])

    def fall(_, state):
        p = np.clip(-state[0] / r, -1, 1)
        share, slope = (1 + p) ** 2 * (2 - p) / 4, 0.75 * (1 - p**2) / r
        rate = -slope * state[1]
        force = slamming_wrench(added, rate, [0, 0, state[1]], np.zeros(3))[0][2]
        return [state[1], force / (mass + share * added[2, 2])]

    v0 = -2.0
    tolerance = {'method': 'DOP853', 'rtol': 1e-11, 'atol': 1e-13}

    def through(_, state):
        return state[0] + 2 * r

    through.terminal = True
    path = solve_ivp(fall, (0, 500.0), [r, v0], events=through, **tolerance)
    assert path.y_events[0][0][1] == pytest.approx(mass / (mass + added[2, 2]) * v0, rel=1e-8)
    assert (np.diff(path.y[1]) >= -1e-12).all()  # only ever slowed down


@given(seeds(), floats(0, 10), vectors(), vectors())
def test_slamming_dissipates_half_of_its_power(seed, rate, v, omega):
    a = positive_matrix(seed)
    force, torque = slamming_wrench(a, rate, v, omega)
    nu = np.r_[v, omega]
    # Power of the force plus the growth of the fluid's energy: -1/2 s' nu A nu.
    change = force @ v + torque @ omega + 0.5 * rate * (nu @ a @ nu)
    assert change == pytest.approx(-0.5 * rate * (nu @ a @ nu), rel=1e-10, abs=1e-10)
    assert change <= 0


def test_no_slamming_on_exit():
    force, torque = slamming_wrench(np.eye(6), -3.0, [1.0, 2, 3], [1.0, 0, 0])
    assert not force.any() and not torque.any()
