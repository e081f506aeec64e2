# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Logs of fleets: every model once, and the same flight to the bit."""

import json

import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.recording.description import MODEL, RUN
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.recording.replay.resimulate import resimulate
from test.support.log_files import rewritten
from test.support.recorded_flights import record_flight


@pytest.fixture(scope='module')
def mixed(tmp_path_factory):
    path = tmp_path_factory.mktemp('logs') / 'mixed.mcap'
    record_flight(path, 'fleet_mixed', seconds=0.5, seed=4)
    return path


def test_a_composed_model_is_packed_and_repeats_to_the_bit(mixed):
    outcome = resimulate(open_log(mixed))
    assert outcome.difference is None and not outcome.largest and not outcome.notes
    assert outcome.commands >= 3 * 25 and outcome.compared > 1000


def test_each_model_is_in_the_log_once(mixed):
    names = [name.removeprefix(MODEL) for name in open_log(mixed).attachments if MODEL in name]
    assert sorted(name for name in names if name.startswith('fleet')) == [
        'fleet0/parts/meadow.xml', 'fleet0/parts/x500.xml', 'fleet0/parts/x500_drive.xml',
        'fleet0/x500.xml', 'fleet1/bluerov2.xml', 'fleet1/parts/bluerov2.xml',
        'fleet1/parts/bluerov2_drive.xml', 'fleet1/parts/seabed.xml',
        'fleet1/parts/underwater.xml',
    ]  # fmt: skip
    stated = json.loads(open_log(mixed).attachments[RUN])['scene']['fleet']
    assert [v['model'] for v in stated['members'].values()] == [
        'fleet0/x500.xml', 'fleet0/x500.xml', 'fleet1/bluerov2.xml'
    ]  # fmt: skip


def test_a_log_of_a_replayed_scene_repeats_too(mixed, tmp_path):
    scene = open_log(mixed).description().scene()
    assert Simulation(scene).vehicles['one'].kind == 'x500'
    record_flight(tmp_path / 'again.mcap', scene, seconds=0.2)
    assert resimulate(open_log(tmp_path / 'again.mcap')).difference is None


@pytest.mark.parametrize(
    ('change', 'line'),
    [
        ({'members': {}}, "missing key 'taken_out'"),
        ({'members': {'../x': {'model': 'a'}}, 'taken_out': []}, 'members'),
        ({'members': {'x': {'model': '/etc/passwd'}}, 'taken_out': []}, "passwd' is not there"),
        ({'members': {'x': {'model': '../../x'}}, 'taken_out': []}, "'../../x' is not there"),
        (
            {'members': {f'v{i}': {'model': 'a'} for i in range(1001)}, 'taken_out': []},
            'limit fleet_vehicles = 1000',
        ),
        (
            {'members': {'x': {'model': 'fleet0/x500.xml', 'yaw': 1e999}}, 'taken_out': []},
            'yaw|no JSON',
        ),
        ('x', 'fleet'),
    ],
)
def test_a_fleet_that_none_of_ours_can_be_is_one_line(mixed, tmp_path, change, line):
    path = rewritten(mixed, tmp_path / 'bad.mcap', scene={'fleet': change})
    with pytest.raises(FluidSimError, match=line) as caught:
        open_log(path).description().scene()
    assert '\n' not in str(caught.value)
