# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest
from hypothesis import given

from fluid_sim_ros.physics.projection import (
    max_projected_area,
    projected_area,
    projected_area_mujoco,
    section_normal,
)
from test.support.printed_formulas import max_projected_area_as_printed
from test.support.strategies import CYCLE, axes, vectors


@given(axes(), vectors())
def test_shadow_is_the_section_seen_from_the_flow(r, v):
    speed = np.linalg.norm(v)
    seen = projected_area_mujoco(r, v) * (section_normal(r, v) @ v)
    assert projected_area(r, v) * speed == pytest.approx(seen, rel=1e-12, abs=1e-15)


@given(axes())
def test_both_areas_agree_along_the_axes(r):
    for i in range(3):
        expected = np.pi * np.roll(r, -1)[i] * np.roll(r, -2)[i]
        assert projected_area(r, np.eye(3)[i]) == pytest.approx(expected, rel=1e-13)
        assert projected_area_mujoco(r, np.eye(3)[i]) == pytest.approx(expected, rel=1e-13)


def test_true_area_is_the_silhouette():
    # The shadow is an ellipse whose squared half-widths are P S^2 P^T for the plane's basis P.
    rng = np.random.default_rng(3)
    for _ in range(50):
        r, u = rng.uniform(0.05, 1, 3), rng.normal(size=3)
        u /= np.linalg.norm(u)
        plane = np.linalg.svd(u[np.newaxis])[2][1:]
        area = np.pi * np.sqrt(np.linalg.det(plane @ np.diag(r**2) @ plane.T))
        assert projected_area(r, u) == pytest.approx(area, rel=1e-12)


def test_true_area_by_counting_rays():
    r, u = np.array([3.0, 2.0, 1.0]), np.ones(3) / np.sqrt(3)
    plane = np.linalg.svd(u[np.newaxis])[2][1:]
    points = np.random.default_rng(1).uniform(-3, 3, (200_000, 2)) @ plane
    # A ray p + t u meets the ellipsoid when the discriminant of |S^-1 (p + t u)| = 1 is positive.
    a, b = u / r, points / r
    hits = (b @ a) ** 2 - (a @ a) * ((b * b).sum(-1) - 1) > 0
    assert projected_area(r, u) == pytest.approx(36 * hits.mean(), rel=0.01)


def test_lemma_is_too_large():
    one_degree = np.array([np.cos(np.pi / 180), 0.0, np.sin(np.pi / 180)])
    disc = np.array([1.0, 1.0, 0.01])
    assert projected_area_mujoco(disc, one_degree) / projected_area(disc, one_degree) > 40
    ratio = projected_area_mujoco([3.0, 2, 1], np.ones(3)) / projected_area(
        [3.0, 2, 1], np.ones(3)
    )
    assert ratio == pytest.approx(1.3, abs=0.05)


@given(axes(), vectors())
def test_lemma_is_between_true_area_and_maximum(r, v):
    true, lemma = projected_area(r, v), projected_area_mujoco(r, v)
    assert true <= lemma * (1 + 1e-12)
    assert lemma <= max_projected_area(r) * (1 + 1e-12)


@given(axes(), vectors())
def test_even_scale_free_and_relabelled(r, v):
    for area in (projected_area, projected_area_mujoco):
        assert area(r, -v) == area(r, v)
        assert area(r, 3 * v) == pytest.approx(area(r, v), rel=1e-13)
        assert area(CYCLE @ r, CYCLE @ v) == pytest.approx(area(r, v), rel=1e-13)


def test_no_direction_has_no_area():
    assert projected_area([1.0, 2, 3], np.zeros(3)) == 0
    assert projected_area_mujoco([1.0, 2, 3], np.zeros(3)) == 0
    assert not section_normal([1.0, 2, 3], np.zeros(3)).any()


def test_printed_maximum_is_no_projected_area():
    assert max_projected_area([1.0, 1, 1]) == pytest.approx(np.pi, rel=1e-15)
    assert max_projected_area_as_printed([1.0, 1, 1]) == pytest.approx(4 * np.pi, rel=1e-15)
    plate = [1.0, 1.0, 0.01]
    assert max_projected_area_as_printed(plate) < 0.05 * max_projected_area(plate)


def test_section_normal_is_the_seed_vector():
    r, v = np.array([0.5, 0.3, 0.2]), np.array([1.0, -2.0, 0.7])
    n = np.array([r[1] * r[2] / r[0], r[2] * r[0] / r[1], r[0] * r[1] / r[2]]) * v
    assert section_normal(r, v) == pytest.approx(n / np.linalg.norm(n), rel=1e-14)


def test_tiny_bodies_do_not_underflow():
    small = 1e-9 * np.array([3.0, 2, 1])
    v = np.array([1e-9, 2e-9, -1e-9])
    large = projected_area_mujoco([3.0, 2, 1], v)
    assert projected_area_mujoco(small, v) == pytest.approx(1e-18 * large, rel=1e-12)
