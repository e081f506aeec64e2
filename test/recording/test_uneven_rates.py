# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Timesteps that no rate divides: every topic at the nearest steps, and the flight repeats."""

import pytest

from fluid_sim_ros.cli.run import run_scene
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.recording.replay.resimulate import resimulate
from fluid_sim_ros.schema.settings import RunSettings
from test.support.recorded_flights import events_of
from test.support.volumes import quick


@pytest.mark.parametrize('timestep', quick([0.004, 0.003, 1 / 240, 0.0007], 0.003, 1 / 240))
def test_a_flight_at_any_timestep_is_recorded_and_flown_again(tmp_path, timestep):
    path = tmp_path / 'flight.mcap'
    result = run_scene(
        'rov', duration=1.0, settings=RunSettings(timestep=timestep), record=path, hold=True
    )
    log = open_log(path)
    begin_of = {'/bluerov2_heavy/odom': 0.01, '/tf': 0.02, '/bluerov2_heavy/imu/data_raw': 0.01}
    for topic, interval in begin_of.items():
        if topic not in {t.name for t in log.topics.values()}:
            continue
        stamps = [message.log_ns * 1e-9 for message in log.messages([topic])]
        assert len(stamps) in (round(1 / interval), round(1 / interval) + 1)
        for k, stamp in enumerate(stamps):
            assert abs(stamp - k * interval) <= 0.5 * timestep + 1e-9
    outcome = resimulate(log)
    assert outcome.difference is None and outcome.compared > 500
    assert result['vehicles']


def test_warnings_of_a_run_are_in_its_log_and_said_when_it_is_flown_again(tmp_path):
    path = tmp_path / 'flight.mcap'
    settings = RunSettings(timestep=0.003)
    result = run_scene('quadrotor', duration=0.1, settings=settings, record=path)
    assert any(line.startswith('schedule at ') for line in result['warnings'])
    log = open_log(path)
    events = events_of(message.data for message in log.messages(['/fluid_sim/events']))
    assert [event['warning'] for event in events if 'warning' in event] == result['warnings']
    notes = resimulate(log).notes
    assert all(f'warning: {line}' in notes for line in result['warnings'] if 'schedule' in line)
