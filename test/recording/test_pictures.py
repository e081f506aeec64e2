# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Pictures, report and tables of a log show what is in it."""

import csv
import json
import re
import shutil
import subprocess

import numpy as np
import pyarrow.parquet
import pytest

from fluid_sim_ros import cli
from fluid_sim_ros.recording.decode import columns
from fluid_sim_ros.recording.pictures.report import write_report
from fluid_sim_ros.recording.pictures.tracks import Track, Tracks, read_tracks
from fluid_sim_ros.recording.reader import open_log
from test.support.recorded_flights import record_flight


@pytest.fixture(scope='module')
def log(tmp_path_factory):
    path = tmp_path_factory.mktemp('log') / 'a.mcap'
    record_flight(path, 'quadrotor', seconds=1.0, seed=1)
    return path


@pytest.fixture(scope='module')
def plotted(log, tmp_path_factory):
    """Return the folder that ``fluid_sim plot`` wrote to."""
    folder = tmp_path_factory.mktemp('plots')
    assert cli.main(['plot', str(log), '--out', str(folder)]) == 0
    return folder


def test_tracks_hold_the_states_of_the_simulation(tmp_path):
    path = tmp_path / 'a.mcap'
    state = record_flight(path, 'rov', seconds=0.5, seed=2).snapshot().vehicles['bluerov2_heavy']
    (track,) = read_tracks(open_log(path)).vehicles
    assert track.name == 'bluerov2_heavy' and len(track.times) == 51
    np.testing.assert_array_equal(track.position_w[-1], state.position_w)
    np.testing.assert_array_equal(track.quat_wb_wxyz[-1], state.quat_wb_wxyz)
    np.testing.assert_array_equal(track.velocity_b[-1], state.velocity_b)
    np.testing.assert_array_equal(track.omega_b[-1], state.omega_b)
    total = sum(rows[:, 1:] for term, rows in track.wrenches.items() if term not in SUMS)
    np.testing.assert_allclose(track.wrenches['total'][:, 1:], total, atol=1e-9)
    assert track.commands['thrust'].shape == (50, 9)


SUMS = ('total', 'thrust')


def test_euler_angles_are_those_of_their_rotation():
    roll, pitch, yaw = 0.3, -0.7, 2.5
    cr, sr, cp, sp = np.cos(roll / 2), np.sin(roll / 2), np.cos(pitch / 2), np.sin(pitch / 2)
    cy, sy = np.cos(yaw / 2), np.sin(yaw / 2)
    quat = [
        cr * cp * cy + sr * sp * sy, sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy,
    ]  # fmt: skip
    zeros = np.zeros((1, 3))
    track = Track('a', np.zeros(1), zeros, np.array([quat]), zeros, zeros)
    np.testing.assert_allclose(track.euler[0], [roll, pitch, yaw], atol=1e-12)


def test_a_picture_and_a_report_are_written(plotted):
    picture = plotted / 'a_x500.png'
    assert picture.read_bytes().startswith(b'\x89PNG') and picture.stat().st_size > 50_000
    text = (plotted / 'a.html').read_text()
    assert 'http' not in text.replace('http-equiv', '')  # nothing beside it is needed
    data = json.loads(re.search(r'application/json">(.*?)</script>', text)[1])
    titles = [plot['title'] for plot in data['vehicles'][0]['plots']]
    assert {'position [m]', 'attitude [deg]', 'size of each force [N]', 'commands'} <= set(titles)
    height = next(p for p in data['vehicles'][0]['plots'] if p['title'] == 'position [m]')
    assert len(height['series'][2]['y']) == 101


@pytest.mark.full
def test_chromium_draws_every_plot_of_the_report(plotted):
    browser = shutil.which('chromium') or shutil.which('google-chrome')
    assert browser, 'this test needs chromium (Debian: apt-get install chromium)'
    command = [
        browser, '--headless', '--no-sandbox', '--disable-gpu', '--virtual-time-budget=3000',
        '--dump-dom', (plotted / 'a.html').as_uri(),
    ]  # fmt: skip
    page = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60).stdout
    assert 'data-drawn="10"' in page
    assert page.count('<canvas') == page.count('<figcaption') == 10


def test_no_text_of_a_log_ends_the_script(tmp_path):
    empty = Tracks([], np.empty((0, 2)))
    path = write_report(empty, [('scene', '</script><b>')], tmp_path / 'a.html')
    assert path.read_text().count('</script>') == 2


def test_tables_read_back_to_the_same_bits(log, tmp_path):
    assert cli.main(['export', str(log), '--csv', str(tmp_path)]) == 0
    opened = open_log(log)
    with (tmp_path / 'x500_odom.csv').open() as stream:
        rows = list(csv.DictReader(stream))
    messages = list(opened.messages(['/x500/odom']))
    table = columns(opened.topic('/x500/odom').definition, [m.data for m in messages])
    for name in ('pose.pose.position.x', 'twist.twist.angular.z'):
        assert [float(row[name]) for row in rows] == table[name].tolist()
    assert [int(row['step']) for row in rows] == [m.step for m in messages]
    assert rows[3]['child_frame_id'] == 'x500/base_link'


def test_parquet_holds_the_same(log, tmp_path):
    assert cli.main(['export', str(log), '--parquet', str(tmp_path)]) == 0
    opened = open_log(log)
    table = pyarrow.parquet.read_table(tmp_path / 'x500_wrench_total.parquet')
    data = [m.data for m in opened.messages(['/x500/wrench/total'])]
    expected = columns(opened.topic('/x500/wrench/total').definition, data)
    for name, values in expected.items():
        assert table[name].to_pylist() == values.tolist()


def test_euler_angles_are_exact_near_zero_and_go_on_beyond_half_a_turn():
    def euler(*quats):
        wxyz, none = np.array(quats, dtype=float), np.zeros((len(quats), 3))
        return Track('a', np.arange(len(quats)), none, wxyz, none, none).euler

    for angle in (0.0, 1e-15, 1e-9, 0.3, np.pi / 2):
        for axis in range(3):
            quat = np.r_[np.cos(angle / 2), np.sin(angle / 2) * np.eye(3)[axis]]
            np.testing.assert_allclose(euler(quat)[0], angle * np.eye(3)[axis], atol=3e-16)
    turns = np.linspace(0, 4 * np.pi, 50)
    quats = np.column_stack([np.cos(turns / 2), 0 * turns, 0 * turns, np.sin(turns / 2)])
    np.testing.assert_allclose(euler(*quats)[:, 2], turns, atol=1e-14)
    lost = euler(quats[1], np.zeros(4), np.full(4, np.nan), quats[2])
    assert np.isnan(lost[1:3]).all()
    np.testing.assert_allclose(lost[[0, 3], 2], turns[1:3], atol=1e-15)
