# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import json
import os
import subprocess
import sys

import pytest

from fluid_sim_ros import plugins
from fluid_sim_ros.cli import doctor
from fluid_sim_ros.cli.doctor.optional import EXTRAS
from test.support.egg_info import sections
from test.support.volumes import quick

BASE = ('Python', 'MuJoCo', 'plugin library', 'scenes')


def run_doctor(**environment):
    """Run ``fluid_sim doctor`` in a process of its own; return exit code and rows by name."""
    done = subprocess.run(
        [sys.executable, '-m', 'fluid_sim_ros.cli', 'doctor', '--json', '-'],
        capture_output=True, text=True, check=False, timeout=120,
        env={**os.environ, **environment},
    )  # fmt: skip
    assert done.stderr == ''
    return done.returncode, {row['name']: row for row in json.loads(done.stdout)}


def test_what_is_installed_for_the_tests_works():
    code, rows = run_doctor(ROS_DOMAIN_ID='7')
    assert code == 0
    for name in (*BASE, 'ROS 2', 'ROS messages', 'ROS_DOMAIN_ID', 'extra charts', 'extra test'):
        assert rows[name]['state'] == 'ok', rows[name]
    assert rows['publishing']['found'].startswith('compiled')
    assert all(row['remedy'] for row in rows.values() if row['state'] != 'ok')


@pytest.mark.parametrize('domain', quick(['233', '-1', 'seven', '1.5'], '233', 'seven'))
def test_an_invalid_domain_is_broken(domain):
    code, rows = run_doctor(ROS_DOMAIN_ID=domain)
    assert code == 1
    assert rows['ROS_DOMAIN_ID']['state'] == 'broken'
    assert '0 to 232' in rows['ROS_DOMAIN_ID']['found']


def test_an_unknown_middleware_is_broken_and_does_not_end_the_doctor():
    code, rows = run_doctor(RMW_IMPLEMENTATION='rmw_of_nobody')
    assert code == 1
    assert rows['ROS 2']['state'] == 'broken'
    assert 'RMW_IMPLEMENTATION' in rows['ROS 2']['remedy']
    assert rows['shared memory']['name'] == 'shared memory'


def test_an_unknown_discovery_range_is_broken():
    code, rows = run_doctor(ROS_AUTOMATIC_DISCOVERY_RANGE='EVERYWHERE')
    assert code == 1
    assert rows['ROS discovery']['state'] == 'broken'


def test_a_missing_compiler_is_no_fault_of_the_base(tmp_path):
    code, rows = run_doctor(PATH=str(tmp_path), CXX='')
    assert code == 0
    assert rows['C++ compiler']['state'] == 'absent'
    assert 'apt-get install g++' in rows['C++ compiler']['remedy']


def test_a_missing_library_is_broken(monkeypatch, tmp_path):
    monkeypatch.setattr(plugins, '_LIBRARY', tmp_path / 'libfluid_sim.so')
    plugins.load_plugins.cache_clear()

    rows = {row.name: row for row in doctor.examine()}

    assert rows['plugin library'].state == 'broken'
    assert 'is not built' in rows['plugin library'].found
    assert not doctor.works(list(rows.values()))


def test_doctor_lists_every_optional_part_with_what_it_brings_and_what_to_type(egg_info):
    declared = set(sections((egg_info / 'requires.txt').read_text())) - {''}
    assert set(EXTRAS) == declared
    _, rows = run_doctor()
    for name, part in EXTRAS.items():
        row = rows['ROS 2' if name == 'ros' else f'extra {name}']
        assert row['state'] == 'ok' or f'[{name}]' in row['remedy']
        assert name == 'ros' or part.brings in row['found']


def test_the_table_shows_every_row():
    rows = [doctor.Row('a', 'ok', 'b'), doctor.Row('c', 'broken', '[d]', 'e')]
    assert doctor.table(rows).row_count == 2
