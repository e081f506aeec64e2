# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Changes of axes between this package and autopilots."""

import math

import mujoco
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluid_sim_ros.mavlink.ned import attitude_to_ned, enu_to_ned, euler, flu_to_frd

NED_OF_ENU = np.array([[0.0, 1, 0], [1, 0, 0], [0, 0, -1]])
FRD_OF_FLU = np.diag([1.0, -1, -1])
HALF = math.sqrt(0.5)


def rotation(quat):
    matrix = np.empty(9)
    mujoco.mju_quat2Mat(matrix, np.array(quat))
    return matrix.reshape(3, 3)


@given(st.lists(st.floats(-1, 1), min_size=4, max_size=4).filter(lambda q: np.dot(q, q) > 0.01))
def test_the_attitude_is_the_product_of_the_three_rotations(numbers):
    quat = np.array(numbers) / np.linalg.norm(numbers)
    expected = NED_OF_ENU @ rotation(quat) @ FRD_OF_FLU.T
    ned = attitude_to_ned(quat.tolist())
    assert rotation(ned) == pytest.approx(expected, abs=1e-14)
    assert np.linalg.norm(ned) == pytest.approx(1.0, abs=1e-15)
    roll, pitch, yaw = euler(ned)
    cr, sr, cp, sp, cy, sy = (f(a) for a in (roll, pitch, yaw) for f in (math.cos, math.sin))
    by_angles = (
        np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
        @ np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
        @ np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    )
    # the nose counts as straight up within 1.4e-6 rad
    assert by_angles == pytest.approx(expected, abs=3e-6)


@pytest.mark.parametrize(
    ('quat_enu_flu', 'roll', 'pitch', 'yaw'),
    [
        ((1, 0, 0, 0), 0, 0, 90),  # heads east
        ((HALF, 0, 0, HALF), 0, 0, 0),  # turned left by 90 degrees: north
        ((HALF, 0, 0, -HALF), 0, 0, 180),
        ((math.cos(0.1), math.sin(0.1), 0, 0), math.degrees(0.2), 0, 90),  # right side down
        ((math.cos(0.1), 0, -math.sin(0.1), 0), 0, math.degrees(0.2), 90),  # nose up
    ],
)
def test_attitudes_have_the_signs_of_an_autopilot(quat_enu_flu, roll, pitch, yaw):
    angles = euler(attitude_to_ned(quat_enu_flu))
    turned = [math.degrees(a) for a in angles]
    assert turned[:2] == pytest.approx([roll, pitch], abs=1e-6)
    assert math.cos(angles[2] - math.radians(yaw)) == pytest.approx(1.0, abs=1e-12)


def test_vectors():
    assert enu_to_ned((1.0, 2.0, 3.0)) == (2.0, 1.0, -3.0)
    assert flu_to_frd((1.0, 2.0, 3.0)) == (1.0, -2.0, -3.0)
