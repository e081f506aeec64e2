# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The page on measurements: numbers with sources, gaps with reasons, with or without flights."""

import json
import sys

import pytest

from benchmarks.vehicles import validation
from benchmarks.vehicles.validation_bodies import tau95
from benchmarks.vehicles.validation_row import MEMORY, Row
from test.support.paths import DOC, ROOT

RESULT = json.loads((ROOT / 'benchmarks/results/validation.json').read_text(encoding='utf-8'))


def test_every_vehicle_that_was_measured_is_on_the_page():
    subjects = {row['subject'] for row in RESULT['rows']}
    assert subjects >= {
        'bluerov2_heavy', 'bluerov2', 'remus100', 'crazyflie', 'aerosonde', 'T200',
        'glass, 0.5 mm', 'steel, 0.8 mm', 'glass, 1.5 mm', 'plate 7.2 x 0.81 mm',
    }  # fmt: skip
    for row in RESULT['rows']:
        assert row['source'], row
        if row['difference'] is None or abs(row['difference']) > 0.05:
            assert row['why'], row


def test_a_number_from_memory_says_so_on_the_page():
    text = (DOC / 'validation.md').read_text(encoding='utf-8')
    assert sum(MEMORY in row['source'] for row in RESULT['rows']) >= 4
    assert text.count(MEMORY) >= 4


def test_differences():
    row = Row('a', 'speed', 'm/s', 2.0, 'a book', 1.0, 'why', 1.9, 'an option')
    assert row.difference == pytest.approx(-0.5)
    assert row.difference_mended == pytest.approx(-0.05)
    assert Row('a', 'speed', 'm/s', None, 'none', 1.0).difference is None
    text = validation.table({'rows': [row.as_json()], 'left_out': ['flights']})
    assert '| 2 | 1 | -50 % | 1.9 (-5 %), `an option` | why; a book |' in text
    assert 'Left out: flights.' in text


def test_it_runs_without_the_recorded_flights_and_says_what_it_leaves_out(tmp_path, monkeypatch):
    path = tmp_path / 'validation.json'
    words = ['validation', '--quick', '--json', str(path), '--flights', str(tmp_path)]
    monkeypatch.setattr(sys, 'argv', words)
    monkeypatch.setattr(validation, 'vehicles', list)  # the quick parts tell enough
    monkeypatch.setattr(validation, 'bodies', list)
    validation.main()
    result = json.loads(path.read_text(encoding='utf-8'))
    assert [row['subject'] for row in result['rows']] == ['crazyflie']
    assert 'flights of a Crazyflie' in result['left_out'][0]


def test_time_to_95_percent():
    assert tau95([0.0, 1.0, 2.0], validation.np.array([0.0, 0.5, 1.0])) == pytest.approx(1.9)
