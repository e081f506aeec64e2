# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The fixed-wing controller, closed around the Aerosonde in plain MuJoCo."""

import numpy as np
import pytest

from fluid_sim_ros.control import rotation as rot
from fluid_sim_ros.control.fixed_wing import FixedWingController, FixedWingGains, FlightTarget
from fluid_sim_ros.control.state import State
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.simulation.plant import plant_of
from test.support.closed_loop import cruise

PLANT, _ = plant_of('aerosonde', '')
LIMITS, MAX_DEFLECTION = PLANT.thrust_limits[0], 0.44
HEIGHT, YAW, ROLL, SPEED = 3, 4, 5, 6


def law(**gains: float) -> FixedWingController:
    return FixedWingController(PLANT, MAX_DEFLECTION, FixedWingGains(**gains))


def test_stays_in_level_flight() -> None:
    rows = cruise(law(), 10.0)
    assert np.abs(rows[:, HEIGHT] - 100).max() < 0.05
    assert np.abs(rows[:, SPEED] - 25).max() < 0.01
    assert np.abs(rows[:, YAW]).max() < 0.005


def test_climbs_at_its_limit_and_keeps_its_airspeed() -> None:
    rows = cruise(law(), 30.0, altitude=120.0)
    climb = np.diff(rows[:, HEIGHT]) / 0.01
    assert climb.max() < 2.5 * 1.1
    assert rows[:, HEIGHT].max() < 120.5
    assert np.abs(rows[:, SPEED] - 25).max() < 0.4
    assert rows[-1, HEIGHT] == pytest.approx(120, abs=0.4)


@pytest.mark.parametrize('airspeed', [20.0, 30.0])
def test_changes_its_airspeed_and_returns_to_its_altitude(airspeed: float) -> None:
    rows = cruise(law(), 30.0, airspeed=airspeed)
    assert rows[-1, SPEED] == pytest.approx(airspeed, abs=0.1)
    assert rows[-1, HEIGHT] == pytest.approx(100, abs=0.3)
    assert np.abs(rows[:, HEIGHT] - 100).max() < 5.0


@pytest.mark.parametrize('heading', [-2.5, 1.5])
def test_turns_the_short_way_without_losing_height(heading: float) -> None:
    rows = cruise(law(), 20.0, heading=heading)
    assert rows[-1, YAW] == pytest.approx(heading, abs=0.01)
    assert np.abs(rows[:, ROLL]).max() < 0.8
    assert np.abs(rows[:, HEIGHT] - 100).max() < 2.0
    assert rows[10:, YAW].min() > -2.8 if heading < 0 else rows[:, YAW].max() < 1.7


def test_a_side_wind_all_at_once_leaves_no_error() -> None:
    rows = cruise(law(), 25.0, wind=lambda t: (0.0, 6.0, 0.0) if t >= 2 else (0.0, 0.0, 0.0))
    assert 0.05 < np.abs(rows[:, YAW]).max() < 0.3
    assert np.abs(rows[:, HEIGHT] - 100).max() < 1.0
    end = rows[-500:]
    assert np.abs(end[:, YAW]).max() < 0.005
    assert np.abs(end[:, HEIGHT] - 100).max() < 0.05
    assert np.abs(end[:, SPEED] - 25).max() < 0.05
    assert rows[-1, 2] > 100  # it drifts: the heading is held, not the track


def test_comes_back_from_a_gust_ahead_and_one_from_below() -> None:
    def wind(t: float) -> tuple[float, float, float]:
        return (-6.0 if t >= 2 else 0.0, 0.0, 2.0 if 15 <= t < 18 else 0.0)

    rows = cruise(law(), 40.0, wind=wind)
    assert np.abs(rows[:, HEIGHT] - 100).max() < 6.0
    end = rows[-500:]
    assert np.abs(end[:, HEIGHT] - 100).max() < 0.5
    assert np.abs(end[:, SPEED] - 25).max() < 0.1


def test_follows_a_line_over_ground_in_a_side_wind() -> None:
    rows = cruise(law(), 35.0, line=(0.0, 30.0, 0.0), wind=lambda t: (0.0, -6.0, 0.0))
    assert np.abs(rows[-500:, 2] - 30).max() < 0.3
    crab = np.arcsin(6 / 25)  # the nose points into the wind
    assert rows[-1, YAW] == pytest.approx(crab, abs=0.01)


STATE = (
    (3.0, -2.0, 99.0), (0.99, 0.05, -0.03, 0.1), (25.0, 0.4, 1.0), (0.02, -0.01, 0.03),
    (1.0, -2.0, 0.5),
)  # fmt: skip


def test_a_repeated_state_gets_the_same_answer() -> None:
    controller = law()
    controller.step(State(0.00, *STATE), FlightTarget(100.0, 0.5, 25.0))
    first = controller.step(State(0.01, *STATE), FlightTarget(100.0, 0.5, 25.0))
    assert controller.step(State(0.01, *STATE), FlightTarget(100.0, 0.5, 25.0)) == first


def test_time_going_back_starts_anew() -> None:
    used = law()
    expected = cruise(law(), 2.0, altitude=101.0)
    cruise(used, 5.0, altitude=110.0, heading=0.5)
    np.testing.assert_array_equal(cruise(used, 2.0, altitude=101.0), expected)


@pytest.mark.parametrize('line', [None, (10.0, -5.0, 0.0)])
def test_same_commands_whichever_way_the_world_is_turned(
    line: tuple[float, float, float] | None,
) -> None:
    expected = law().step(State(0.0, *STATE), FlightTarget(100.0, 0.5, 25.0, line))
    turn = 1.1
    r, half = rot.from_yaw(turn), turn / 2
    w, x, y, z = STATE[1]
    c, s = np.cos(half), np.sin(half)
    quat = (c * w - s * z, c * x - s * y, c * y + s * x, c * z + s * w)
    found = law().step(
        State(
            0.0, rot.to_world(r, STATE[0]), quat, STATE[2], STATE[3], rot.to_world(r, STATE[4])
        ),
        FlightTarget(
            100.0, 0.5 + turn, 25.0, None if line is None else rot.to_world(r, line)
        ),
    )  # fmt: skip
    assert found == pytest.approx(expected, abs=1e-12)


def test_integrals_stand_still_while_the_altitude_is_far() -> None:
    controller = law()
    for i in range(300):
        command = controller.step(State(i * 0.01, *STATE), FlightTarget(500.0, 0.1, 25.0))
    again = controller.step(State(3.0, *STATE), FlightTarget(500.0, 0.1, 25.0))
    assert again.thrust == command.thrust
    assert LIMITS[0] < command.thrust <= LIMITS[1]


def test_commands_stay_within_their_limits_in_any_attitude() -> None:
    rng = np.random.default_rng(5)
    for _ in range(200):
        quat = rng.normal(size=4)
        command = law().step(
            State(
                0.0, rng.normal(size=3) * 100, quat / np.linalg.norm(quat),
                rng.normal(size=3) * 20, rng.normal(size=3) * 3, rng.normal(size=3) * 10,
            ),
            FlightTarget(100.0, 1.0, 40.0),
        )  # fmt: skip
        assert np.isfinite(command).all()
        assert 20.0 <= command.thrust <= LIMITS[1]
        assert np.abs(command[1:]).max() <= MAX_DEFLECTION


@pytest.mark.parametrize(
    ('gains', 'message'),
    [
        ({'energy': 0.0}, "gain 'energy': 0.0; must be above 0"),
        ({'max_bank': 1.6}, "gain 'max_bank': 1.6; must be below pi/2 rad"),
        ({'cruise_thrust': 90.0}, "gain 'cruise_thrust': 90 N; must lie between 20 and 88.07"),
    ],
)
def test_bad_gains_are_one_line(gains: dict[str, float], message: str) -> None:
    with pytest.raises(ConfigError, match=message):
        law(**gains)


def test_a_vehicle_with_several_thrusters_is_refused() -> None:
    with pytest.raises(ConfigError, match='8 thrusters; this controller needs one propeller'):
        FixedWingController(plant_of('rov', '')[0], MAX_DEFLECTION)
