# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The suite: rates, latency, saved states, and that sensors do not disturb each other."""

import numpy as np
import pytest

from fluid_sim_ros.errors import CommandError
from fluid_sim_ros.sensors import SensorSuite

NOISY = {'density': 1e-3, 'bias_walk': 1e-3, 'resolution': 1e-5}


def test_rates_in_steps(brick, readings):
    _, times = readings(brick(imu={'rate': 125}), 'imu', 10)
    assert times == [(8_000_000 * k, 8_000_000 * k) for k in range(10)]


@pytest.mark.parametrize('latency_steps', [1, 4, 5, 13])
def test_latency_in_steps(brick, readings, latency_steps):
    imu = {'rate': 125, 'latency': latency_steps * 2 / 1000}
    simulation = brick(imu=imu, gravity=0)
    simulation.data.qvel[:] = (0, 0, 0, 1, 2, 3)
    late, times = readings(simulation, 'imu', 10)
    assert times == [(8_000_000 * k + 2_000_000 * latency_steps, 8_000_000 * k) for k in range(10)]
    simulation.reset()
    simulation.data.qvel[:] = (0, 0, 0, 1, 2, 3)
    sensors = simulation.vehicles['brick'].sensors
    prompt = sensors.model_copy(update={'imu': sensors.imu.model_copy(update={'latency': 0.0})})
    exact, _ = readings(simulation, 'imu', 10, config=prompt)
    np.testing.assert_array_equal(late, exact)


def test_a_second_update_at_a_step_changes_nothing(brick):
    simulation = brick(imu={'rate': 125, 'latency': 0.004, 'gyroscope': NOISY})
    suite = SensorSuite(simulation, 'brick')
    for _ in range(3):
        suite.update()
        first = (suite.imu.fresh, suite.imu.time_ns, suite.imu.values.copy())
        suite.update()
        assert (suite.imu.fresh, suite.imu.time_ns) == first[:2]
        np.testing.assert_array_equal(suite.imu.values, first[2])
        simulation.step(suite.period)


def test_saved_states_go_on_bit_identically(brick):
    imu = {'rate': 125, 'latency': 0.026, 'gyroscope': NOISY, 'accelerometer': NOISY}

    def go_on(simulation, suite):
        kept = []
        for _ in range(400):
            simulation.step(suite.period)
            suite.update()
            kept.append((suite.imu.fresh, suite.imu.time_ns, *suite.imu.values))
        return kept

    simulation = brick(imu=imu)
    simulation.data.qvel[:] = 0.3
    suite = SensorSuite(simulation, 'brick')
    for _ in range(211):
        suite.update()
        simulation.step(suite.period)
    saved, readings = simulation.save_state(), suite.save_state()
    straight = go_on(simulation, suite)
    simulation.load_state(saved)
    suite.load_state(readings)
    assert go_on(simulation, suite) == straight
    simulation.load_state(saved)
    other = SensorSuite(simulation, 'brick')
    other.load_state(readings)
    assert go_on(simulation, other) == straight


def test_after_a_reset_everything_comes_again(brick):
    simulation = brick(imu={'rate': 125, 'latency': 0.01, 'gyroscope': NOISY})
    suite = SensorSuite(simulation, 'brick')

    def flight():
        kept = []
        for _ in range(60):
            suite.update()
            kept.append((suite.imu.fresh, suite.imu.time_ns, *suite.imu.values))
            simulation.step(suite.period)
        return kept

    first = flight()
    simulation.reset()
    assert flight() == first
    assert first[0][:2] == (False, -1)


def test_seeds(brick, readings):
    runs = [
        readings(brick(imu={'rate': 125, 'gyroscope': NOISY}, seed=s), 'imu', 5)[0]
        for s in (3, 3, -4)
    ]
    np.testing.assert_array_equal(runs[0], runs[1])
    assert (runs[0][:, 3:] != runs[2][:, 3:]).all()
    own, _ = readings(brick(imu={'rate': 125, 'gyroscope': NOISY}, seed=9), 'imu', 5, seed=3)
    np.testing.assert_array_equal(own, runs[0])


def test_a_vehicle_without_sensors(brick):
    simulation = brick()
    suite = SensorSuite(simulation, 'brick')
    suite.update()
    assert suite.imu is None
    assert suite.sensors == ()
    assert suite.period > 1e9


def test_unknown_vehicle(brick):
    line = r"vehicle 'bric' is not in the scene; did you mean 'brick'\? it has: brick"
    with pytest.raises(CommandError, match=line):
        SensorSuite(brick(), 'bric')


def test_readings_do_not_depend_on_other_sensors(brick, readings):
    imu = {'rate': 125, 'gyroscope': NOISY, 'accelerometer': NOISY}
    alone, _ = readings(brick(imu=imu), 'imu', 300)
    others = {kind: {'rate': 250, 'latency': 0.006} for kind in ('barometer', 'gnss')}
    among, _ = readings(brick(imu=imu, magnetometer={'rate': 500}, **others), 'imu', 300)
    np.testing.assert_array_equal(alone, among)


def test_a_pause_leaves_no_old_reading_behind(brick):
    simulation = brick(imu={'rate': 125, 'latency': 0.02})
    suite = SensorSuite(simulation, 'brick')
    suite.update()
    simulation.step(100)  # nobody listens
    suite.update()
    for _ in range(5):
        assert not suite.imu.fresh
        simulation.step(suite.period)
        suite.update()
    assert (suite.imu.fresh, suite.imu.time_ns) == (True, 200_000_000)
