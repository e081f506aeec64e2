# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Crafted files of strangers, each for a fault that was there once."""

import json

import numpy as np
import pytest

from fluid_sim_ros.cli.main import WRONG_INPUT, main
from fluid_sim_ros.errors import ConfigError, LimitError
from fluid_sim_ros.flights.about import about_flight
from fluid_sim_ros.flights.reader import read_flight
from fluid_sim_ros.lab.results import load
from fluid_sim_ros.new_vehicle.importing.other_sources import read_source
from fluid_sim_ros.schema.limits import VARIABLE
from fluid_sim_ros.sweep.sweep_file import read_sweep
from test.support import flight_logs as logs
from test.support.hostile.foreign.settings import _chart


@pytest.mark.parametrize('name', ['../made', '/tmp/made', '..', '', 'a/b', 'x' * 300, '\x00', 5])
def test_a_chart_writes_nowhere_but_into_its_folder(name, tmp_path, capsys):
    path = tmp_path / 'a.json'
    path.write_text(json.dumps(_chart() | {'problem': name}))
    with pytest.raises(ConfigError, match="key 'problem'"):
        load(path, 'points')
    assert main(['chart', '--from', str(path), '--out', str(tmp_path / 'out')]) == WRONG_INPUT
    assert len(capsys.readouterr().err.splitlines()) == 1
    assert {p.name for p in tmp_path.iterdir()} <= {'a.json', 'out'}


def test_a_small_parquet_of_many_rows_is_refused(tmp_path):
    pa = pytest.importorskip('pyarrow')
    from pyarrow import parquet

    path = tmp_path / 'a.parquet'
    parquet.write_table(pa.table({'time': np.zeros(4_900_000), 'x': np.zeros(4_900_000)}), path)
    assert path.stat().st_size < 200_000
    with pytest.raises(LimitError, match=r'limit expansion = .* FLUID_SIM_LIMITS=expansion='):
        read_flight(path)


def test_times_that_are_years_apart(tmp_path):
    """Intervals between two samples would be made for all of the time between them."""
    flight = logs.motion(seconds=2.0, rate=50.0)
    columns = logs.table(flight)
    columns['time'] = np.where(np.arange(101) < 50, columns['time'], columns['time'] + 1e9)
    path = tmp_path / 'a.csv'
    path.write_text(logs.csv_text(columns))
    assert about_flight(read_flight(path))


def test_a_model_that_includes_what_includes_another_folder_is_not_imported(tmp_path):
    (tmp_path / 'own').mkdir()
    (tmp_path / 'secret.xml').write_text('<mujoco/>')
    path = tmp_path / 'own' / 'a.xml'
    body = '<worldbody><body name="b"><geom size=".1" mass="1"/></body></worldbody>'
    path.write_text(f'<mujoco><include file="b.xml"/>{body}</mujoco>')
    (tmp_path / 'own' / 'b.xml').write_text('<mujoco><include file="../secret.xml"/></mujoco>')
    with pytest.raises(ConfigError, match=r"include '../secret.xml' lies outside"):
        read_source(path, [], None, None)


@pytest.mark.full
def test_a_model_of_1e8_replicas_is_not_imported(tmp_path, monkeypatch):
    monkeypatch.setenv(VARIABLE, 'model_seconds=1,model_bytes=3e7')
    path = tmp_path / 'a.xml'
    path.write_text(
        '<mujoco><worldbody><replicate count="100000000" offset="1 0 0"><geom size="1"/>'
        '</replicate><body name="b"><geom size=".1" mass="1"/></body></worldbody></mujoco>'
    )
    with pytest.raises(ConfigError, match=r'limit model_\w+ = '):
        read_source(path, [], None, None)


@pytest.mark.parametrize('encoding', ['utf-8', 'utf-16'])
def test_entities_are_refused_in_any_encoding(encoding, tmp_path):
    path = tmp_path / 'a.urdf'
    text = '<!DOCTYPE r [<!ENTITY a SYSTEM "file:///etc/passwd">]><robot name="&a;"/>'
    path.write_bytes(text.encode(encoding))
    with pytest.raises(ConfigError, match='declares entities'):
        read_source(path, [], None, None)


def test_a_sweep_of_a_trillion_runs_is_refused_with_the_limit(tmp_path):
    path = tmp_path / 'a.yaml'
    path.write_text('scene: sphere\nvary: {wind.x: {linspace: [0, 1, 1000000000000]}}\n')
    with pytest.raises(ConfigError, match=r'limit sweep_runs = .* FLUID_SIM_LIMITS=sweep_runs='):
        read_sweep(path)
