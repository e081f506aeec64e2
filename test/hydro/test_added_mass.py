# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Added mass by panels: known bodies, turned and moved ones, planes nearby."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.hydro.added_mass import added_mass_of_body
from fluid_sim_ros.hydro.meshes.repair import repaired
from fluid_sim_ros.hydro.meshes.shapes import box, cylinder, ellipsoid, together
from fluid_sim_ros.hydro.meshes.surface import Surface
from fluid_sim_ros.hydro.planes import Plane, plane_of
from fluid_sim_ros.hydro.statics import statics_of
from fluid_sim_ros.physics.kappa import ellipsoid_added_mass
from fluid_sim_ros.physics.matrix6 import (
    added_mass_matrix,
    rotate_matrix6,
    shift_reference_point,
)
from test.support.volumes import quick

pytest.importorskip('capytaine')
RHO = 1025.0
#: Cube along a side: Sihvola et al. 2004, IEEE Trans. Antennas Propag. 52 (polarizability of a
#: cube of permittivity 0: -1.6383 of its volume).
CUBE = 0.6383
FEW = 220
FULL = pytest.mark.full


def solved(surface, coarse=FEW, planes=None):
    solid = repaired(surface)
    return added_mass_of_body(solid, RHO, planes, coarse), statics_of(solid)


@pytest.mark.parametrize(
    ('axes', 'coarse', 'bound'),
    [
        ((0.5, 0.2, 0.1), 330, 0.025),
        pytest.param((0.3, 0.3, 0.3), 330, 0.02, marks=FULL),
        pytest.param((0.3, 0.3, 0.3), 1350, 0.01, marks=FULL),
        pytest.param((0.5, 0.2, 0.1), 1350, 0.01, marks=FULL),
        pytest.param((1.0, 0.1, 0.1), 1350, 0.01, marks=FULL),
    ],
)  # fmt: skip
def test_an_ellipsoid_is_exact(axes, coarse, bound):
    found, statics = solved(ellipsoid(axes, 4 if coarse > 330 else 3), coarse)
    mass, inertia = ellipsoid_added_mass(axes, RHO)
    exact = np.diag(np.concatenate([mass, inertia]))
    # off the diagonal by the geometric mean of both entries, of a sphere by its size
    scale = np.r_[mass, np.maximum(inertia, 1e-2 * mass.max() * max(axes) ** 2)]
    miss = np.abs(found.matrix - exact) / np.sqrt(np.outer(scale, scale))
    assert miss.max() < bound
    assert np.linalg.eigvalsh(found.matrix)[0] > 0
    np.testing.assert_array_equal(added_mass_matrix(found.matrix), found.matrix)
    np.testing.assert_allclose(statics.center, 0, atol=1e-9)
    diagonal = np.diag(found.error)[:3] / mass
    assert (diagonal >= 0.0099).all()
    assert (np.abs(np.diag(found.matrix)[:3] / mass - 1) < 2 * diagonal).all()


@pytest.mark.parametrize(('coarse', 'bound'), [(FEW, 0.03), pytest.param(1350, 0.01, marks=FULL)])
def test_a_cube_and_a_cylinder_have_their_published_values(coarse, bound):
    found, _ = solved(box((0.4, 0.4, 0.4)), coarse)
    np.testing.assert_allclose(np.diag(found.matrix)[:3], CUBE * RHO * 0.064, rtol=bound)
    found, statics = solved(cylinder(0.1, 0.5, 'x', sections=32), coarse)
    share = np.diag(found.matrix)[:3] / (RHO * statics.volume)
    # DNV-RP-C205, table D-2, length over diameter 2.5, across: 0.78
    np.testing.assert_allclose(share[1:], 0.78, rtol=0.01 + bound)
    # benchmarks/hydro/revolution.py
    np.testing.assert_allclose(share, [0.24744, 0.77718, 0.77718], rtol=2 * bound)


TURN = Rotation.from_euler('xyz', [0.3, -0.7, 1.1]).as_matrix()
SHIFT = np.array([0.4, -0.2, 0.9])
BODIES = {
    'ellipsoid': ellipsoid((0.5, 0.2, 0.1), 3),
    'cylinder': cylinder(0.1, 0.5, sections=24),
    'frame': together([
        box((0.4, 0.02, 0.25), (0, 0.17, 0)), box((0.4, 0.02, 0.25), (0, -0.17, 0)),
        box((0.3, 0.36, 0.02)), cylinder(0.06, 0.3, 'x', (0.05, 0, 0.06), 24),
    ]),
}  # fmt: skip


@pytest.mark.parametrize('name', quick(BODIES, 'cylinder'))
def test_a_turned_and_moved_mesh_has_the_turned_and_moved_matrix(name):
    body = BODIES[name]
    here, statics = solved(body, 150)
    there, moved = solved(Surface(body.vertices @ TURN.T + SHIFT, body.faces), 150)
    size = np.sqrt(np.diag(there.matrix))
    turned = rotate_matrix6(here.matrix, TURN)
    np.testing.assert_allclose(
        (there.matrix - turned) / np.outer(size, size), np.zeros((6, 6)), atol=1e-9
    )
    np.testing.assert_allclose(moved.center, TURN @ statics.center + SHIFT, atol=1e-9)
    point = np.array([0.2, 0.3, -0.1])
    np.testing.assert_allclose(
        there.about(point).matrix, shift_reference_point(there.matrix, point - moved.center),
        rtol=1e-12, atol=1e-12 * size.max() ** 2,
    )  # fmt: skip
    back = there.about(point).about(moved.center)
    np.testing.assert_allclose(back.matrix, there.matrix, atol=1e-10 * size.max() ** 2)
    assert (there.about(point).error >= 0).all()


def test_single_precision_of_a_file_does_not_matter():
    body = BODIES['cylinder']
    matrices = []
    for vertices in (body.vertices, body.vertices @ TURN.T + SHIFT):
        rough = vertices.astype(np.float32).astype(float)
        matrices.append(solved(Surface(rough, body.faces), 150)[0].matrix)
    turned = rotate_matrix6(matrices[0], TURN)
    size = np.sqrt(np.diag(turned))
    assert (np.abs(matrices[1] - turned) / np.outer(size, size)).max() < 1e-6


@pytest.fixture(scope='module')
def ball_alone():
    """Return a sphere far from everything: its added mass and statics."""
    return solved(ellipsoid((1, 1, 1), 2), 330)


@pytest.mark.parametrize(('free', 'sign'), [(False, 1), (True, -1)])
def test_a_sphere_near_a_plane(free, sign, ball_alone):
    """Lamb (1932), art. 99 and 138: to first order in (a/h)^3."""
    gap = 2.0
    ball = ellipsoid((1, 1, 1), 2)
    alone, statics = ball_alone
    normal = TURN @ np.array([0, 0, 1.0])
    # fewer panels where there are images: as many as above
    near, _ = solved(ball, 470, [Plane('--bed', normal, -gap, free)])
    assert near.panels == alone.panels
    share = rotate_matrix6(near.matrix, TURN.T) / (RHO * statics.volume)
    first = sign / gap**3 * np.array([3 / 16, 3 / 16, 3 / 8])
    rise = np.diag(share)[:3] / (np.diag(alone.matrix)[:3] / (RHO * statics.volume)) - 1
    np.testing.assert_allclose(rise, first, rtol=0.08)


def test_two_planes():
    ball = ellipsoid((1, 1, 1), 2)
    bed, surface = (
        Plane('--bed', np.array([0, 0, 1.0]), -2),
        Plane('--surface', np.array([0, 0, 1.0]), 2.5, True),
    )
    wall = plane_of('--wall', [0, 3, 0], 2)
    both, _ = solved(ball, 100, [bed, surface])
    corner, _ = solved(ball, 100, [wall, surface])
    alone, _ = solved(ball, 100)
    for found in (both, corner):
        # the bed and the wall add, the surface takes off: less than one of them alone
        rise = np.diag(found.matrix)[:3] / np.diag(alone.matrix)[:3] - 1
        assert (np.abs(rise) < 0.1).all()
        assert (np.abs(rise) > 1e-4).any()
    # a mirror image far away changes nothing
    far, _ = solved(ball, 100, [Plane('--bed', np.array([0, 0, 1.0]), -50)])
    np.testing.assert_allclose(np.diag(far.matrix)[:3], np.diag(alone.matrix)[:3], rtol=0.01)


def test_planes_that_do_not_fit_are_refused():
    ball = ellipsoid((1, 1, 1), 2)
    up = np.array([0, 0, 1.0])
    for planes, words in (
        ([Plane('--surface', up, 0.7, True)], r'--surface: the body reaches 0\.3'),
        ([Plane('--bed', up, -9), Plane('--a', up, 9), Plane('--b', up, 12)], 'at most two'),
        ([Plane('--bed', up, -9), plane_of('--wall', [1, 0, 1], 9)], 'parallel or at right'),
        ([Plane('--bed', up, np.nan)], 'finite'),
    ):
        with pytest.raises(ConfigError, match=words):
            solved(ball, 40, planes)
    with pytest.raises(ConfigError, match='no direction'):
        plane_of('--wall', [0, 0, 0], 1)


def test_parts_that_touch_in_a_line_are_solved():
    # the cylinder stands on the middle of the plate, on a line through a panel's centre
    body = together([box((0.3, 0.36, 0.02)), cylinder(0.06, 0.3, 'x', (0, 0, 0.07), 24)])
    found, _ = solved(body, 150)
    assert np.linalg.eigvalsh(found.matrix)[0] > 0
