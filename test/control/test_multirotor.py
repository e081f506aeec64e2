# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The multirotor controller, closed around the quadrotor model in plain MuJoCo."""

import dataclasses

import numpy as np
import pytest

from fluid_sim_ros.control import rotation as rot
from fluid_sim_ros.control.multirotor import MultirotorController, MultirotorGains, PoseTarget
from fluid_sim_ros.control.state import State
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.simulation.plant import plant_of
from test.support.closed_loop import Loop, run_closed_loop

PLANT, _ = plant_of('quadrotor', '')
HOME = (0.0, 0.0, 1.5)


def error(rows: np.ndarray, target: tuple[float, float, float]) -> np.ndarray:
    return np.linalg.norm(rows[:, 1:4] - target, axis=1)


def test_plant_is_the_x500() -> None:
    assert PLANT.mass == pytest.approx(2.06432)
    assert PLANT.inertia == pytest.approx((0.0238384, 0.0238384, 0.0438947), rel=1e-6)
    assert PLANT.weight == pytest.approx(2.06432 * 9.81, rel=1e-9)
    # m1 front right, counter-clockwise; lever arms about the centre of mass
    assert PLANT.thruster_matrix[:, 0] == pytest.approx([0, 0, 1, -0.174, -0.174, -0.016])


def test_hovers_at_its_target_without_moving() -> None:
    rows = run_closed_loop(MultirotorController(PLANT), 3.0, target=lambda t: HOME)
    assert error(rows, HOME).max() < 1e-9
    assert rows[-1, 5:] == pytest.approx(np.full(4, PLANT.weight / 4), rel=1e-6)


def test_step_response_settles_without_overshoot() -> None:
    target = (2.0, 1.0, 2.0)
    rows = run_closed_loop(MultirotorController(PLANT), 8.0, target=lambda t: target)
    distance = error(rows, target)
    assert distance[rows[:, 0] > 3.0].max() < 0.2
    assert distance[-1] < 0.02
    for axis, end in enumerate(target):
        assert rows[:, 1 + axis].max() < end + 0.05


def test_yaw_step_turns_the_short_way_and_keeps_the_place() -> None:
    rows = run_closed_loop(MultirotorController(PLANT), 8.0, target=lambda t: HOME, yaw=-2.5)
    assert rows[-1, 4] == pytest.approx(-2.5, abs=1e-3)
    assert rows[:, 4].max() < 1e-3
    assert error(rows, HOME).max() < 0.02


def test_steady_wind_leaves_no_error() -> None:
    rows = run_closed_loop(
        MultirotorController(PLANT), 20.0, target=lambda t: HOME,
        wind=lambda t: (6.0, -2.0, 0.0) if t >= 1.0 else (0.0, 0.0, 0.0),
    )  # fmt: skip
    distance = error(rows, HOME)
    assert 0.01 < distance.max() < 0.15
    assert distance[-1] < 1e-3


def test_without_the_integrator_the_wind_leaves_an_error() -> None:
    gains = MultirotorGains(integral=0.0)
    rows = run_closed_loop(
        MultirotorController(PLANT, gains), 10.0, target=lambda t: HOME,
        wind=lambda t: (6.0, 0.0, 0.0),
    )  # fmt: skip
    # drag / (m K_v K_p), the balance of the proportional loops
    loop = Loop('quadrotor', 100.0, 'wind')
    loop.advance([PLANT.weight / 4] * 4, (6.0, 0.0, 0.0))
    expected = loop.data.qfrc_fluid[0] / (PLANT.mass * gains.velocity * gains.position)
    assert rows[-1, 1] == pytest.approx(expected, rel=0.05)


def test_recovers_from_a_knife_edge_attitude() -> None:
    rows = run_closed_loop(
        MultirotorController(PLANT), 8.0, target=lambda t: (0.0, 0.0, 8.0),
        quat=(0.72, 0.69, 0.0, 0.1),
    )  # fmt: skip
    assert rows[:, 3].min() > 0.3  # does not hit the ground
    assert error(rows, (0.0, 0.0, 8.0))[-1] < 0.2


def test_thrusts_stay_within_limits_and_a_far_target_does_not_wind_up() -> None:
    far = (60.0, 0.0, 1.5)
    controller = MultirotorController(PLANT)
    rows = run_closed_loop(controller, 25.0, target=lambda t: far)
    low, high = PLANT.thrust_limits.T
    assert (rows[:, 5:] >= low).all() and (rows[:, 5:] <= high).all()
    assert rows[:, 1].max() < 60.5  # 1 % overshoot at most after a long way at full speed
    assert error(rows, far)[-1] < 0.1


def test_integrator_stands_still_while_a_limit_binds() -> None:
    controller = MultirotorController(PLANT)
    for i in range(100):  # pushed back: the speed error asks for more than the largest tilt
        velocity_b = (-9.0 if i else 0.0, 0.0, 0.0)
        state = State(i * 0.01, (0, 0, 1.5), (1, 0, 0, 0), velocity_b, (0, 0, 0))
        controller.step(state, PoseTarget((90.0, 0, 1.5)))
    assert controller.integral_w == (0.0, 0.0, 0.0)


def test_a_repeated_state_gets_the_same_answer() -> None:
    controller = MultirotorController(PLANT)
    state = ((0.3, 0.1, 1.4), (0.99, 0.1, 0.0, 0.0), (0.2, 0.0, 0.1), (0.1, 0.2, 0.3))
    controller.step(State(0.00, *state), PoseTarget(HOME))
    first = controller.step(State(0.01, *state), PoseTarget(HOME))
    assert controller.step(State(0.01, *state), PoseTarget(HOME)) == first


def test_time_going_back_forgets_the_integral() -> None:
    fresh, used = MultirotorController(PLANT), MultirotorController(PLANT)
    run_closed_loop(used, 5.0, target=lambda t: HOME, wind=lambda t: (6.0, 0.0, 0.0))
    assert abs(used.integral_w[0]) > 0.1
    a = run_closed_loop(used, 2.0, target=lambda t: HOME)
    b = run_closed_loop(fresh, 2.0, target=lambda t: HOME)
    assert (a == b).all()


def test_same_commands_whichever_way_the_world_is_turned() -> None:
    # turning world, state and target about the vertical leaves the thrusts as they are
    state = ((0.3, 0.1, 1.4), (0.99, 0.1, -0.05, 0.0), (0.2, 0.0, 0.1), (0.1, 0.2, 0.3))
    target, yaw = (1.0, -0.5, 2.0), 0.4
    expected = MultirotorController(PLANT).step(State(0.0, *state), PoseTarget(target, yaw))
    turn = 1.1
    r, half = rot.from_yaw(turn), turn / 2
    w, x, y, z = state[1]
    c, s = np.cos(half), np.sin(half)
    quat = (c * w - s * z, c * x - s * y, c * y + s * x, c * z + s * w)
    turned = (rot.to_world(r, state[0]), quat, state[2], state[3])
    found = MultirotorController(PLANT).step(
        State(0.0, *turned), PoseTarget(rot.to_world(r, target), yaw + turn)
    )
    assert found == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize(
    ('gains', 'message'),
    [
        ({'position': -1.0}, "'position'"),
        ({'rate': float('nan')}, "'rate'"),
        ({'max_tilt': 1.6}, 'pi/2'),
        ({'thrust_margin': 0.5}, 'below 0.5'),
    ],
)
def test_bad_gains_are_one_line(gains: dict[str, float], message: str) -> None:
    with pytest.raises(ConfigError, match=message):
        MultirotorGains(**gains)


def test_a_vehicle_too_heavy_for_its_thrusters_is_refused() -> None:
    heavy = dataclasses.replace(PLANT, weight=40.0)
    with pytest.raises(ConfigError, match=r'lift 34\.19 N at most; the vehicle weighs 40\.00 N'):
        MultirotorController(heavy)
