# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Meshes of strangers become one closed solid, with a word for each repair, or are refused."""

import numpy as np
import pytest

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.hydro.meshes.repair import repaired
from fluid_sim_ros.hydro.meshes.shapes import box, cylinder, ellipsoid, together
from fluid_sim_ros.hydro.meshes.surface import Surface, volume_and_center

CUBE = box((1, 1, 1), (5, 6, 7))
BALL = ellipsoid((1, 1, 1), 2)


def soup(surface):
    """Return a mesh as STL has it: three corners of its own for each triangle."""
    corners = surface.triangles.reshape(-1, 3)
    return Surface(corners, np.arange(len(corners)).reshape(-1, 3))


def without(surface, *faces):
    return Surface(surface.vertices, np.delete(surface.faces, faces, axis=0))


def turned(surface, faces=slice(None)):
    changed = surface.faces.copy()
    changed[faces] = changed[faces][:, ::-1]
    return Surface(surface.vertices, changed)


def volume(surface):
    return volume_and_center(surface.triangles)[0]


def shaken(surface, size):
    loose = soup(surface)
    noise = np.random.default_rng(1).normal(size=loose.vertices.shape)
    return Surface(loose.vertices + size * noise, loose.faces)


@pytest.mark.parametrize(
    ('surface', 'expected', 'words'),
    [
        (soup(CUBE), 1.0, ''),
        (turned(CUBE), 1.0, 'inside out: turned'),
        (turned(BALL, slice(3, 60)), volume(BALL), '57 faces turned'),
        (without(CUBE, 0), 1.0, 'a hole'),
        (without(cylinder(0.5, 2), *range(64, 96)), volume(cylinder(0.5, 2)), 'a hole'),
        (without(BALL, *range(0, 300, 17)), volume(BALL), '18 holes'),
        (together([BALL, turned(ellipsoid((0.5, 0.5, 0.5), 2))]), volume(BALL), 'cavity'),
        (together([BALL, ellipsoid((0.5, 0.5, 0.5), 2)]), volume(BALL), '2 parts united into 1'),
        (together([CUBE, box((1, 1, 1), (5.5, 6.3, 7.2))]), 1.72, 'overlapped by 14'),
        (together([CUBE, box((1, 1, 1), (6, 6, 7))]), 2.0, ''),
        (together([CUBE, box((1, 0.5, 0.5), (6, 6, 7))]), 1.25, '2 parts united into 1'),
        (together([CUBE, box((1, 1, 1), (6, 7, 7))]), 2.0, ''),
        (together([CUBE, box((1, 1, 1), (8, 6, 7))]), 2.0, ''),
        (together([CUBE, CUBE]), 1.0, ''),
        (shaken(BALL, 1e-6), volume(BALL), 'cracks'),
        (together([CUBE, Surface(CUBE.vertices[:3] + 3, np.array([[0, 1, 2]]))]), 1.0, 'dropped'),
    ],
)
def test_it_is_repaired_with_a_word(surface, expected, words):
    solid = repaired(surface)
    found = volume_and_center(solid.in_mesh_axes().triangles)[0]
    assert found == pytest.approx(expected, rel=1e-5)
    said = '; '.join(solid.repairs)
    assert words in said if words else said == ''


def moebius(count=30):
    turn = np.linspace(0, 2 * np.pi, count, endpoint=False)
    points = [
        ((1 + w * np.cos(a / 2)) * np.cos(a), (1 + w * np.cos(a / 2)) * np.sin(a),
         w * np.sin(a / 2))
        for a in turn for w in (-0.2, 0.2)
    ]  # fmt: skip
    faces = []
    for k in range(count):
        a, b = 2 * k, 2 * k + 1
        c, d = (a + 2, b + 2) if k < count - 1 else (1, 0)
        faces += [(a, c, b), (b, c, d)]
    return Surface(np.array(points), np.array(faces))


def fat_torus():
    """Return a torus whose tube is thicker than its ring, so that it runs through itself."""
    n = 16
    u, v = np.meshgrid(*[2 * np.pi * np.arange(n) / n] * 2, indexing='ij')
    ring = 0.3 + 0.5 * np.cos(v)
    points = np.stack([ring * np.cos(u), ring * np.sin(u), 0.5 * np.sin(v)], axis=2)
    here = np.arange(n * n).reshape(n, n)
    a, b = here, np.roll(here, -1, axis=0)
    c, d = np.roll(b, -1, axis=1), np.roll(here, -1, axis=1)
    faces = np.concatenate([np.stack([a, b, c], 2), np.stack([a, c, d], 2)]).reshape(-1, 3)
    return Surface(points.reshape(-1, 3), faces)


#: The faces of a quarter of the ball: its rim is not flat.
QUARTER = np.flatnonzero((BALL.triangles.mean(axis=1)[:, :2] > 0).all(axis=1))
FLAT = Surface(np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float),
               np.array([[0, 1, 2], [0, 2, 3]]))  # fmt: skip


@pytest.mark.parametrize(
    ('surface', 'words'),
    [
        (FLAT, 'no volume'),
        (moebius(), 'one side only'),
        (fat_torus(), 'crosses itself'),
        (without(BALL, *QUARTER), 'no lid fits'),
        (Surface(np.full((3, 3), np.nan), np.array([[0, 1, 2]])), 'not finite'),
        (Surface(np.full((3, 3), 1e12), np.array([[0, 1, 2]])), 'farther than'),
        (Surface(np.zeros((3, 3)), np.array([[0, 1, 2]])), 'points or lines'),
        (Surface(np.zeros((3, 3)), np.empty((0, 3), dtype=int)), 'no triangles'),
        (together([box((1, 1, 1), (3 * k, 0, 0)) for k in range(4001)]), '4001 separate parts'),
    ],
)  # fmt: skip
def test_what_is_no_solid_is_refused_in_one_line(surface, words):
    with pytest.raises(ConfigError, match=words) as error:
        repaired(surface)
    assert '\n' not in str(error.value)


def test_a_fault_is_located_in_the_axes_of_the_file():
    far = fat_torus()
    with pytest.raises(ConfigError, match=r'near 99\.|near 100'):
        repaired(Surface(far.vertices + np.array([100.0, 0, 0]), far.faces))
