# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Panels: a partition of the surface, narrow beside sharp edges, within a number."""

import numpy as np
import pytest

from fluid_sim_ros.hydro.added_mass import _as_triangles
from fluid_sim_ros.hydro.meshes.repair import repaired
from fluid_sim_ros.hydro.meshes.shapes import box, cylinder, ellipsoid, together
from fluid_sim_ros.hydro.meshes.surface import areas, volume_and_center
from fluid_sim_ros.hydro.panels import panels_of
from fluid_sim_ros.hydro.quads import merged_to_quads, quartered, three_cornered
from fluid_sim_ros.hydro.sharp_edges import sharp_edges

pytest.importorskip('manifold3d')
SHAPES = {
    'cube': box((1, 1, 1)),
    'plate': box((1, 0.6, 0.01)),
    'cylinder': cylinder(0.5, 2.5, sections=40),
    'ball': ellipsoid((1, 0.7, 0.5), 2),
    'cross': together([box((1, 0.2, 0.2)), box((0.2, 0.2, 1), (0.1, 0, 0.1))]),
}


@pytest.mark.parametrize('name', SHAPES)
def test_panels_cover_the_body_once(name):
    surface = repaired(SHAPES[name]).surface
    panels = panels_of(surface, 400)
    assert panels.alike
    assert 60 < len(panels.coarse) <= 400
    assert len(panels.fine) == 4 * len(panels.coarse)
    volume, center = volume_and_center(surface.triangles)
    for mesh in (panels.coarse, panels.fine):
        triangles = _as_triangles(mesh)
        found, middle = volume_and_center(triangles)
        # a round body may be simplified for the sake of its edges
        bound = 0.02 if name == 'cylinder' else 1e-9
        assert found == pytest.approx(volume, rel=bound)
        assert areas(triangles).sum() == pytest.approx(areas(surface.triangles).sum(), rel=bound)
        np.testing.assert_allclose(middle, center, atol=max(bound, 1e-9))


def test_a_smooth_body_of_many_faces_gets_two_meshes_of_its_own():
    panels = panels_of(repaired(ellipsoid((1, 0.7, 0.5), 3)).surface, 200)
    assert not panels.alike
    assert len(panels.coarse) <= 200 < len(panels.fine) <= 850


def test_panels_beside_an_edge_are_narrow():
    panels = panels_of(repaired(SHAPES['cube']).surface, 1350).coarse
    sides = np.linalg.norm(np.roll(panels, -1, axis=1) - panels, axis=2)
    edge = 2 / np.sqrt(3)  # of the cube with radius 1
    assert sides[:, :2].min() < 0.02 * edge
    assert sides.max() < 0.3 * edge


def test_a_box_is_six_panels_and_twelve_sharp_edges():
    surface = repaired(SHAPES['cube']).surface
    quads = merged_to_quads(surface)
    assert len(quads) == 6
    assert not three_cornered(quads).any()
    assert len(sharp_edges(surface)) == 12
    assert len(sharp_edges(repaired(SHAPES['ball']).surface)) == 0
    assert len(quartered(quads)) == 24


def test_an_open_angle_is_no_panel():
    # an L of two boxes has concave outlines: no panel may reach over them
    surface = repaired(SHAPES['cross']).surface
    quads = merged_to_quads(surface)
    assert areas(_as_triangles(quads)).sum() == pytest.approx(areas(surface.triangles).sum())
