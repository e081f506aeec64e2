# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Thrust allocation: exact within limits, within limits always, important groups first."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from fluid_sim_ros.control.allocation import Allocator
from fluid_sim_ros.control.multirotor import PRIORITY as MULTIROTOR
from fluid_sim_ros.control.underwater import PRIORITY as UNDERWATER
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.simulation.plant import plant_of

ROV, _ = plant_of('rov', '')
QUAD, _ = plant_of('quadrotor', '')
wrenches = arrays(float, 6, elements=st.floats(-200, 200))


def rov() -> Allocator:
    return Allocator(ROV.thruster_matrix, ROV.thrust_limits, UNDERWATER)


def quad() -> Allocator:
    return Allocator(QUAD.thruster_matrix, QUAD.thrust_limits, MULTIROTOR)


@given(wrenches)
def test_within_limits_the_wrench_is_exact_and_of_least_norm(wrench: np.ndarray) -> None:
    allocator, small = rov(), wrench / 50
    thrusts = np.array(allocator.allocate(small))
    assert allocator.scale == 1.0
    assert np.abs(ROV.thruster_matrix @ thrusts - small).max() < 1e-9
    assert np.abs(thrusts - np.linalg.pinv(ROV.thruster_matrix) @ small).max() < 1e-9


@given(wrenches)
def test_limits_hold_whatever_is_asked(wrench: np.ndarray) -> None:
    for allocator in (rov(), quad()):
        thrusts = np.array(allocator.allocate(wrench))
        low, high = allocator.limits.T
        assert (thrusts >= low).all() and (thrusts <= high).all()
        assert 0 <= allocator.scale <= 1


@given(wrenches)
def test_each_axis_keeps_its_sign_and_never_exceeds_what_was_asked(wrench: np.ndarray) -> None:
    allocator = rov()
    got = ROV.thruster_matrix @ allocator.allocate(wrench)
    assert (got * wrench >= -1e-9).all()
    assert (np.abs(got) <= np.abs(wrench) + 1e-9).all()


def test_yaw_gives_way_to_roll_and_thrust() -> None:
    allocator = quad()
    got = QUAD.thruster_matrix @ allocator.allocate([0, 0, 20.0, 1.0, 0.0, 5.0])
    assert got[2] == pytest.approx(20.0) and got[3] == pytest.approx(1.0)
    assert 0 < got[5] < 5.0
    assert allocator.scale < 1


def test_sway_gives_way_to_heave_and_attitude() -> None:
    allocator = rov()
    got = ROV.thruster_matrix @ allocator.allocate([0, 500.0, 40.0, 2.0, 1.0, 3.0])
    assert got[2:] == pytest.approx([40.0, 2.0, 1.0, 3.0], abs=1e-9)
    assert 0 < got[1] < 500


def test_uncommanded_axes_do_not_bend_the_solution() -> None:
    # thrusters that push forward also pitch; an allocator that commands fx alone ignores that
    matrix = np.array([[1.0], [0], [0], [0], [0.3], [0]])
    thrusts = Allocator(matrix, [[-5, 5]], (('fx',),)).allocate([2.0, 0, 0, 0, 9.0, 0])
    assert thrusts == pytest.approx([2.0])


@pytest.mark.parametrize(
    ('arguments', 'message'),
    [
        ((np.ones((5, 2)), [[0, 1]] * 2), 'must be (6, n)'),
        ((np.full((6, 2), np.nan), [[0, 1]] * 2), 'finite'),
        ((np.ones((6, 2)), [[0, 1]]), 'must be (2, 2)'),
        ((np.ones((6, 2)), [[1, 2], [0, 1]]), '0 N must lie within'),
        ((np.ones((6, 2)), [[0, 1]] * 2, (('fx', 'up'),)), "'up'; allowed: fx"),
        ((np.ones((6, 2)), [[0, 1]] * 2, (('fx',), ('fx',))), 'stands twice'),
    ],
)
def test_bad_input_is_one_line(arguments: tuple[object, ...], message: str) -> None:
    with pytest.raises(ConfigError) as caught:
        Allocator(*arguments)
    assert message in str(caught.value) and '\n' not in str(caught.value)
