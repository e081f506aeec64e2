# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The underwater controller, closed around the ROV model in plain MuJoCo."""

import dataclasses

import mujoco
import numpy as np
import pytest

from fluid_sim_ros.control.state import State
from fluid_sim_ros.control.underwater import DepthTarget, UnderwaterController, UnderwaterGains
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.simulation.plant import plant_of
from test.support.closed_loop import dive

PLANT, _ = plant_of('rov', '')
TIME, X, Y, Z, YAW, TILT, VX, VY = range(8)


def controller() -> UnderwaterController:
    return UnderwaterController(PLANT)


def test_rest_stays_rest_on_the_thrust_that_carries_the_weight() -> None:
    rows = dive(controller(), 2.0)
    carried = -PLANT.weight / 4  # the vertical thrusters push down when positive
    expected = np.tile([0.0] * 4 + [carried] * 4, (len(rows), 1))
    assert rows[:, 9:] == pytest.approx(expected, abs=1e-6)
    assert np.abs(rows[:, Z] + 5.0).max() < 1e-6


def test_depth_and_heading_steps_settle_level() -> None:
    rows = dive(controller(), 12.0, depth=lambda t: 4.0, heading=lambda t: 2.0)
    assert rows[:, Z].max() < -3.9 and abs(rows[-1, Z] + 4.0) < 0.005
    assert rows[:, YAW].max() < 2.1 and abs(rows[-1, YAW] - 2.0) < 0.002
    assert rows[:, TILT].max() < np.radians(2)


def test_ballast_leaves_no_depth_error() -> None:
    def ballast(data: mujoco.MjData) -> None:
        data.qfrc_applied[2] = -8.0  # 0.8 kg of it

    rows = dive(controller(), 15.0, push=ballast)
    assert 0.02 < np.abs(rows[:, Z] + 5.0).max() < 0.3
    assert abs(rows[-1, Z] + 5.0) < 0.003


def test_tether_torque_leaves_no_heading_error() -> None:
    def tether(data: mujoco.MjData) -> None:
        data.qfrc_applied[5] = 2.0

    rows = dive(controller(), 10.0, push=tether)
    assert 0.005 < np.abs(rows[:, YAW]).max() < 0.3
    assert abs(rows[-1, YAW]) < 0.002


def test_current_carries_it_off_at_first_but_not_for_long() -> None:
    rows = dive(controller(), 12.0, current=lambda t: (0.3, 0.0, 0.0))
    assert rows[:, VX].max() > 0.02
    assert abs(rows[-1, VX]) < 0.01
    assert np.abs(rows[:, Z] + 5.0).max() < 0.02


def test_place_hold_comes_back_in_a_current() -> None:
    rows = dive(controller(), 15.0, current=lambda t: (0.3, 0.2, 0.0), place_w=(0.0, 0.0))
    assert np.hypot(rows[-1, X], rows[-1, Y]) < 0.02


def test_surge_speed_is_held_along_the_heading() -> None:
    rows = dive(controller(), 20.0, heading=lambda t: np.pi / 2, speed_h=(0.4, 0.0))
    assert rows[-1, VY] == pytest.approx(0.4, abs=0.03)
    assert abs(rows[-1, VX]) < 0.02


def test_limits_hold_and_saturation_does_not_wind_up() -> None:
    rows = dive(controller(), 30.0, depth=lambda t: 9.0 if t < 12 else 5.0, place_w=(8.0, 0.0))
    low, high = PLANT.thrust_limits.T
    assert (rows[:, 9:] >= low).all() and (rows[:, 9:] <= high).all()
    assert rows[:, X].max() < 8.3
    assert abs(rows[-1, Z] + 5.0) < 0.02 and abs(rows[-1, X] - 8.0) < 0.1


def test_integrators_stand_still_while_thrusters_are_at_their_limits() -> None:
    weak = dataclasses.replace(PLANT, thrust_limits=PLANT.thrust_limits * 1e-3)
    tired = UnderwaterController(weak)
    for i in range(50):
        state = State(i * 0.02, (0, 0, -5), (1, 0, 0, 0), (0, 0, 0), (0, 0, 0))
        tired.step(state, DepthTarget(9.0, 2.0))
    assert tired._integral.value == [0, 0, 0] and tired._angular_integral.value == [0, 0, 0]


def test_a_repeated_state_gets_the_same_answer() -> None:
    held = controller()
    state = ((0.3, 0.1, -4.9), (0.99, 0.1, 0.0, 0.0), (0.2, 0.0, 0.1), (0.1, 0.2, 0.3))
    held.step(State(0.00, *state), DepthTarget(5.0, 0.0))
    first = held.step(State(0.01, *state), DepthTarget(5.0, 0.0))
    assert held.step(State(0.01, *state), DepthTarget(5.0, 0.0)) == first


def test_time_going_back_forgets_the_integrals() -> None:
    used = controller()
    dive(used, 5.0, current=lambda t: (0.3, 0.0, 0.0))
    assert (dive(used, 2.0) == dive(controller(), 2.0)).all()


def test_bad_gains_are_one_line() -> None:
    with pytest.raises(ConfigError, match="gain 'added_mass': -1"):
        UnderwaterGains(added_mass=-1)
