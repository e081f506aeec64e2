# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Rotations as nine floats, against the quaternion and matrix functions of SciPy."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from fluid_sim_ros.control import rotation as rot

number = st.floats(-1, 1, allow_nan=False)
quaternions = st.tuples(number, number, number, number).filter(lambda q: np.linalg.norm(q) > 0.1)
vectors = st.tuples(number, number, number)
angles = st.floats(-3.1, 3.1)


def matrix(r: rot.Rotation) -> np.ndarray:
    return np.array(r).reshape(3, 3)


def scipy_of(quat: tuple[float, ...]) -> Rotation:
    return Rotation.from_quat(quat, scalar_first=True)


@given(quaternions)
def test_from_quaternion_is_the_rotation_matrix(quat: tuple[float, ...]) -> None:
    assert np.abs(matrix(rot.from_quaternion(quat)) - scipy_of(quat).as_matrix()).max() < 1e-14


@given(quaternions, vectors)
def test_to_body_undoes_to_world(quat: tuple[float, ...], vector: rot.Vector3) -> None:
    r = rot.from_quaternion(quat)
    assert np.abs(np.array(rot.to_body(r, rot.to_world(r, vector))) - vector).max() < 1e-14
    assert np.abs(rot.to_world(r, vector) - scipy_of(quat).apply(vector)).max() < 1e-14


@given(quaternions, quaternions)
def test_error_is_the_logarithm(desired: tuple[float, ...], actual: tuple[float, ...]) -> None:
    found = np.array(rot.error(rot.from_quaternion(desired), rot.from_quaternion(actual)))
    relative = scipy_of(actual).inv() * scipy_of(desired)
    angle = relative.magnitude()
    assert abs(np.linalg.norm(found) - angle) < 1e-6
    if angle < np.pi - 1e-4:
        assert np.abs(found - relative.as_rotvec()).max() < 1e-6


def test_error_of_the_same_attitude_is_zero_and_of_a_half_turn_is_not() -> None:
    level = rot.from_yaw(0.3)
    assert rot.error(level, level) == (0.0, 0.0, 0.0)
    for axis in np.eye(3):
        turned = rot.from_quaternion((0.0, *axis))
        found = np.array(rot.error(rot.from_yaw(0.0), turned))
        assert abs(np.linalg.norm(found) - np.pi) < 1e-12
        assert abs(abs(found @ axis) - np.pi) < 1e-12


@given(vectors, angles)
def test_thrust_axis_attitude_has_that_axis_and_heading(axis: rot.Vector3, yaw: float) -> None:
    up = np.array([axis[0], axis[1], 0.2 + abs(axis[2])])
    up /= np.linalg.norm(up)
    r = matrix(rot.from_thrust_axis(tuple(up), yaw))
    assert np.abs(r.T @ r - np.eye(3)).max() < 1e-13 and np.linalg.det(r) > 0
    assert np.abs(r[:, 2] - up).max() < 1e-13
    heading = np.array([np.cos(yaw), np.sin(yaw), 0.0])
    assert abs(r[:, 1] @ heading) < 1e-13
    assert r[:, 0] @ heading > 0


@given(angles)
def test_yaw_round_trip(yaw: float) -> None:
    assert abs(rot.wrap(rot.yaw_of(rot.from_yaw(yaw)) - yaw)) < 1e-14
    assert abs(rot.wrap(yaw + 4 * np.pi) - yaw) < 1e-12
