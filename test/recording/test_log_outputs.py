# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What is made of a log reads well: times, axes, what-if pictures, and no empty folders."""

import csv
import json
import re

import matplotlib.pyplot as plt
import numpy as np
import pytest

from fluid_sim_ros.cli.main import main
from fluid_sim_ros.recording.pictures import plots
from fluid_sim_ros.recording.pictures.report import write_report
from fluid_sim_ros.recording.pictures.tracks import Track, Tracks
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.recording.replay.what_if import compare_flights
from test.support import log_files as mcap
from test.support.recorded_flights import record_flight


@pytest.fixture(scope='module')
def log(tmp_path_factory):
    path = tmp_path_factory.mktemp('log') / 'a.mcap'
    record_flight(path, 'rov', seconds=1.0, piloted=False)
    return path


def test_times_in_tables_have_no_rounding_errors(log, tmp_path):
    """0.98 s is 0.98, not 0.9800000000000001."""
    assert main(['export', str(log), '--csv', str(tmp_path)]) == 0
    seen = set()
    for path in tmp_path.glob('*.csv'):
        with path.open(newline='') as file:
            seen |= {row['log_time_s'] for row in csv.DictReader(file)}
    assert '0.98' in seen
    assert max(map(len, seen)) <= len('0.005')
    assert {float(text) for text in seen} >= {step / 100 for step in range(101)}


def still(turns=(0.0, 0.0), noise=1e-16) -> Track:
    """Return a vehicle at rest, but for rounding errors, and a steady yaw in turns."""
    times = np.linspace(0, 1, 50)
    rng = np.random.default_rng(1)
    yaw = np.pi * np.linspace(*turns, 50)
    quat = np.column_stack([np.cos(yaw), 0 * yaw, 0 * yaw, np.sin(yaw)])
    wrench = {'total': np.column_stack([times, *(noise * rng.normal(size=(6, 50)))])}
    return Track(
        'a', times, noise * rng.normal(size=(50, 3)), quat, noise * rng.normal(size=(50, 3)),
        noise * rng.normal(size=(50, 3)), wrench,
    )  # fmt: skip


def drawn(monkeypatch, draw):
    """Return the axes of a picture by their titles, before it is closed."""
    kept = {}

    def save(figure, path):
        figure.draw_without_rendering()
        kept.update({axes.get_title('left') or axes.get_title(): axes for axes in figure.axes})
        kept['figure'] = figure
        return path

    monkeypatch.setattr(plots, '_save', save)
    draw()
    plt.close('all')
    return kept


def test_axes_have_a_physical_floor(monkeypatch, tmp_path):
    """No curve of 1e-16 m fills a picture."""
    track = still()
    tracks = Tracks([track], np.array([[0.0, 1.0], [1.0, 1.0]]))
    axes = drawn(monkeypatch, lambda: plots.overview(track, tracks, tmp_path / 'a.png'))
    for title, least in (
        ('position [m]', 1e-3), ('attitude [deg]', 0.1), ('velocity, body axes [m/s]', 1e-3),
        ('fluid force by term [N]', 1e-6), ('fluid torque by term [N m]', 1e-8),
    ):  # fmt: skip
        low, high = axes[title].get_ylim()
        assert high - low >= 0.999 * least
    axes = drawn(monkeypatch, lambda: plots.both_flights(track, track, 'x', tmp_path / 'a.png'))
    assert np.ptp(axes['up z, position [m]'].get_ylim()) >= 0.999e-3
    assert np.ptp(axes['roll, attitude [deg]'].get_ylim()) >= 0.0999
    # and a motion that is one keeps its own scale
    moved = still(noise=0.01)
    axes = drawn(monkeypatch, lambda: plots.overview(moved, tracks, tmp_path / 'a.png'))
    assert np.ptp(axes['position [m]'].get_ylim()) < 0.2


def test_the_page_has_the_same_floors(tmp_path):
    track = still()
    tracks = Tracks([track], np.array([[0.0, 1.0], [1.0, 1.0]]))
    text = write_report(tracks, [], tmp_path / 'a.html').read_text()
    data = json.loads(re.search(r'application/json">(.*?)</script>', text)[1])
    least = {plot['title']: plot['least'] for plot in data['vehicles'][0]['plots']}
    assert least['position [m]'] == 1e-3
    assert least['size of each torque [N m]'] == 1e-8
    assert 'this.plot.least' in text


def test_what_if_titles_and_legends_are_wrapped(monkeypatch, tmp_path):
    change = ', '.join(f'{key}=value_of_it' for key in ('integrator', 'timestep', 'wind', 'seed'))
    track = still()
    kept = drawn(
        monkeypatch,
        lambda: plots.both_flights(track, track, f'{change}, {change}', tmp_path / 'a.png'),
    )
    figure = kept['figure']
    assert figure._suptitle.get_window_extent().width < figure.bbox.width
    legend = kept['east x, position [m]'].get_legend()
    inside = kept['east x, position [m]'].get_window_extent()
    assert legend.get_window_extent().width < inside.width


def test_what_if_angles_do_not_jump_by_whole_turns(monkeypatch, tmp_path):
    """A start near half a turn: -179 deg beside 181 deg are two degrees apart."""
    recorded, changed = still((0.497, 0.6)), still((-0.497, -0.4))  # in turns
    axes = drawn(monkeypatch, lambda: plots.both_flights(recorded, changed, 'x', tmp_path / 'a'))
    old, new = (line.get_ydata() for line in axes['yaw, attitude [deg]'].get_lines())
    assert abs(new[0] - old[0]) == pytest.approx(2.16)
    assert np.abs(np.diff(new)).max() < 10 and np.abs(np.diff(old)).max() < 10


def test_a_what_if_of_a_log_is_drawn(log, tmp_path):
    changes = ['timestep=0.005', 'current=0.2,0,0', 'integrator=implicitfast']
    result = compare_flights(open_log(log), changes, tmp_path / 'a.png')
    assert (tmp_path / 'a.png').stat().st_size > 20_000
    assert result['differences']['bluerov2_heavy']['apart_at_end_m'] > 0


@pytest.mark.parametrize(
    'command',
    [
        ['export', '{log}', '--csv', '{out}'],
        ['export', '{log}', '--parquet', '{out}'],
        ['plot', '{log}', '--out', '{out}'],
        ['render', '{log}', '--out', '{out}/a.mp4'],
        ['repair', '{log}', '{out}'],
    ],
)
def test_a_failed_export_leaves_no_empty_folder(tmp_path, capsys, command):
    """Nothing that can be read, no odometry, or a message that does not fit its definition."""
    empty = tmp_path / 'no.mcap'
    empty.write_bytes(b'no log')
    out = tmp_path / 'new' / 'out'
    assert main([word.format(log=empty, out=out) for word in command]) == 2
    assert 'not an MCAP file' in capsys.readouterr().err
    assert not out.parent.exists()


@pytest.mark.parametrize('kind', ['csv', 'parquet'])
def test_an_export_that_fails_on_the_way_leaves_no_empty_folder(tmp_path, capsys, kind):
    head = mcap.schema(1, 'std_msgs/msg/Float64', 'float64 data') + mcap.channel(1, 1, '/a')
    log = tmp_path / 'short.mcap'
    log.write_bytes(mcap.log_of([mcap.chunk(head + mcap.message(1, 0, 0, b'\x00\x01\x00\x00'))]))
    out = tmp_path / 'new' / 'out'
    assert main(['export', str(log), f'--{kind}', str(out)]) == 2
    assert 'a message is shorter' in capsys.readouterr().err
    assert not out.parent.exists()


@pytest.mark.parametrize('options', [['--camera', 'moon'], ['--at', '99', '--out', '{out}/a.png']])
def test_a_film_that_cannot_be_made_leaves_no_empty_folder(log, tmp_path, capsys, options):
    out = tmp_path / 'new' / 'out'
    words = [word.format(out=out) for word in options]
    where = [] if '--out' in words else ['--out', str(out / 'a.mp4')]
    assert main(['render', str(log), *words, *where]) == 2
    assert 'render: ' in capsys.readouterr().err
    assert not out.parent.exists()


def test_a_film_of_no_size_is_refused_before_anything_is_made(log, tmp_path, capsys):
    out = tmp_path / 'new' / 'out'
    with pytest.raises(SystemExit) as ended:
        main(['render', str(log), '--size', '0', '0', '--out', str(out / 'a.mp4')])
    assert ended.value.code == 2
    assert '--size: must be above 0' in capsys.readouterr().err
    assert not out.parent.exists()


def test_a_recording_that_cannot_begin_leaves_nothing(tmp_path, capsys):
    out = tmp_path / 'new' / 'a.mcap'
    arguments = ['run', 'rov', '--duration', '0.1', '--record', str(out)]
    assert main([*arguments, '--record-topics', 'no_such_topic']) == 2
    assert 'no_such_topic' in capsys.readouterr().err
    assert not out.parent.exists()
