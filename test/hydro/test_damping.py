# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Statics, shadows and damping of shapes with known values."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from fluid_sim_ros.hydro.damping import damping_of, ittc_friction
from fluid_sim_ros.hydro.estimates import box_estimate, ellipsoid_estimate
from fluid_sim_ros.hydro.meshes.repair import repaired
from fluid_sim_ros.hydro.meshes.shapes import box, cylinder, ellipsoid, together
from fluid_sim_ros.hydro.meshes.surface import Surface
from fluid_sim_ros.hydro.panels import panels_of
from fluid_sim_ros.hydro.projected import projected_areas
from fluid_sim_ros.hydro.statics import righting_of, statics_of
from fluid_sim_ros.new_vehicle.design import Design
from fluid_sim_ros.physics.kappa import ellipsoid_added_mass

pytest.importorskip('manifold3d')
RHO, MU = 1000.0, 1e-3


def damped(surface, **settings):
    solid = repaired(surface)
    statics = statics_of(solid)
    fine = panels_of(solid.surface, 400).fine
    triangles = solid.frame.outward(np.concatenate([fine[:, [0, 1, 2]], fine[:, [0, 2, 3]]]))
    shadows = projected_areas(solid)
    return damping_of(triangles, statics, shadows, statics.center, RHO, MU, **settings), shadows


def test_a_box_has_the_damping_that_new_vehicle_takes():
    size = np.array([0.5, 0.4, 0.3])
    found, shadows = damped(box(size), coefficients=np.ones(3))
    np.testing.assert_allclose(shadows, [0.12, 0.15, 0.2], rtol=1e-6)
    design = Design('b', 'water', 10.0, size, 0.0, [], np.zeros(0))
    form = np.r_[[axis.form for axis in found.axes], found.quadratic[3:]]
    np.testing.assert_allclose(form[:3], design.quadratic_damping[:3], rtol=1e-6)
    # friction comes on top; so do the corners of the outermost strips
    np.testing.assert_allclose(form[3:], design.quadratic_damping[3:], rtol=0.08)
    assert (form[3:] > design.quadratic_damping[3:]).all()
    np.testing.assert_array_equal(found.low, found.quadratic)  # stated: no range


def test_a_body_of_revolution_turns_freely_about_its_axis():
    found, _ = damped(cylinder(0.1, 1.0, 'x'))
    across = found.quadratic[4]
    # strips of C_d 0.8: rho/2 C_d D int |x|^3 dx
    assert across == pytest.approx(0.5 * RHO * 0.8 * 0.2 * 2 * 0.5**4 / 4, rel=0.05)
    assert found.quadratic[3] < 2e-3 * across
    assert [axis.shape.name for axis in found.axes] == [
        'flat face of a long body', *['round body across its length'] * 2,
    ]  # fmt: skip


@pytest.mark.parametrize(
    ('shape', 'names'),
    [
        (ellipsoid((1, 1, 1), 2), ['round body'] * 3),
        (box((1, 1, 1)), ['flat face'] * 3),
        (box((2, 0.1, 0.1)), ['flat face of a long body', *['long flat face'] * 2]),
        (ellipsoid((1, 0.1, 0.1), 3), ['slender body along its axis',
                                       *['round body across its length'] * 2]),
    ],
)  # fmt: skip
def test_shapes_are_told_from_each_other(shape, names):
    found, _ = damped(shape)
    assert [axis.shape.name for axis in found.axes] == names
    assert (found.low <= found.quadratic).all()
    assert (found.quadratic <= found.high).all()
    speeds = found.top_speeds(20.0)
    assert (np.diff(speeds, axis=1) >= 0).all()
    np.testing.assert_allclose(found.quadratic[:3] * speeds[:, 1] ** 2, 20.0)


def test_friction_is_the_ittc_line():
    # 0.075/(log10 1e7 - 2)^2
    assert ittc_friction(1e7) == pytest.approx(0.003)
    assert ittc_friction(0.0) == ittc_friction(1e4)


def test_a_shadow_leaves_out_what_is_hidden_and_what_is_open():
    ring = together([
        box((0.1, 1, 0.2), (0.45, 0, 0)), box((0.1, 1, 0.2), (-0.45, 0, 0)),
        box((1, 0.1, 0.2), (0, 0.45, 0)), box((1, 0.1, 0.2), (0, -0.45, 0)),
    ])  # fmt: skip
    np.testing.assert_allclose(projected_areas(repaired(ring)), [0.2, 0.2, 1 - 0.8**2], rtol=1e-6)
    turned = Rotation.from_euler('z', 45, degrees=True).as_matrix()
    cube = box((1, 1, 1))
    np.testing.assert_allclose(
        projected_areas(repaired(Surface(cube.vertices @ turned.T, cube.faces))),
        [2**0.5, 2**0.5, 1], rtol=1e-6,
    )  # fmt: skip


def test_estimates_of_the_shapes_they_are_made_for():
    ball = statics_of(repaired(ellipsoid((0.5, 0.2, 0.1), 4)))
    mass, inertia = ellipsoid_added_mass((0.5, 0.2, 0.1), RHO)
    np.testing.assert_allclose(ellipsoid_estimate(ball, RHO), np.r_[mass, inertia], rtol=0.01)
    cube = statics_of(repaired(box((0.4, 0.4, 0.4))))
    np.testing.assert_allclose(box_estimate(cube, RHO), 0.68 * RHO * 0.064, rtol=1e-6)
    plate = statics_of(repaired(box((0.001, 0.4, 0.4))))
    assert box_estimate(plate, RHO)[0] == pytest.approx(0.579 * np.pi / 4 * RHO * 0.064, rel=0.01)


@settings(max_examples=20, deadline=None)
@given(
    st.floats(-0.2, 0.2), st.floats(-0.2, 0.2), st.floats(0.05, 0.3), st.floats(1.0, 200.0)
)  # fmt: skip
def test_it_hangs_with_the_centre_of_buoyancy_on_top(x, y, z, mass):
    statics = statics_of(repaired(box((0.5, 0.4, 0.3))))
    found = righting_of(statics, mass, np.array([-x, -y, -z]), RHO, 9.81)
    turn = Rotation.from_euler('YX', [found.pitch, found.roll], degrees=True)
    np.testing.assert_allclose(turn.apply(found.arm_b), [0, 0, np.linalg.norm(found.arm_b)],
                               atol=1e-9)  # fmt: skip
    assert found.net_buoyancy == pytest.approx(9.81 * (60.0 - mass), abs=1e-5)
    assert found.arms[-1] == pytest.approx(np.linalg.norm(found.arm_b))
