# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Films of a log: as many pictures as asked for, and the vehicle in them."""

import numpy as np
import pytest
from PIL import Image

from fluid_sim_ros.cli.main import WRONG_INPUT, main
from fluid_sim_ros.recording.pictures.render import FilmOptions, render
from fluid_sim_ros.recording.reader import open_log
from test.support.recorded_flights import record_flight


@pytest.fixture(scope='module')
def log(tmp_path_factory):
    path = tmp_path_factory.mktemp('log') / 'a.mcap'
    record_flight(path, 'quadrotor', seconds=0.5, seed=1)
    return path


def test_a_gif_has_its_pictures_and_they_move(log, tmp_path):
    out = tmp_path / 'a.gif'
    arguments = ['--out', str(out), '--fps', '10', '--size', '160', '120']
    assert main(['render', str(log), *arguments]) == 0
    with Image.open(out) as film:
        assert film.size == (160, 120) and film.n_frames == 6
        first = np.asarray(film.convert('RGB'), dtype=float)
        film.seek(5)
        last = np.asarray(film.convert('RGB'), dtype=float)
    assert np.ptp(first) > 100 and np.abs(first - last).mean() > 1.0


def test_an_mp4_is_written(log, tmp_path):
    done = []
    out = tmp_path / 'a.mp4'
    options = FilmOptions(width=160, height=128, rate=10.0)
    assert render(open_log(log), out, options, done.append) == 6
    assert b'ftyp' in out.read_bytes()[:16] and out.stat().st_size > 2000
    assert done[-1] == 1.0


def test_force_arrows_are_drawn(tmp_path):
    """The same flight with and without wrenches in the log differs by orange arrows."""
    pictures = []
    for name, topics in (('with', ('*',)), ('without', ('*/odom', '*/joint_states'))):
        path, out = tmp_path / f'{name}.mcap', tmp_path / f'{name}.png'
        record_flight(path, 'quadrotor', seconds=0.1, seed=1, topics=topics)
        assert render(open_log(path), out, FilmOptions(), lambda done: None) == 1
        pictures.append(np.asarray(Image.open(out), dtype=float))
    drawn, plain = pictures
    changed = np.abs(drawn - plain).max(axis=2) > 30
    assert 200 < np.count_nonzero(changed) < changed.size / 10
    red, _, blue = drawn[changed].mean(axis=0)
    assert red > 1.5 * blue


@pytest.mark.parametrize(
    ('arguments', 'line'),
    [
        (['--out', 'a.avi'], "'.avi' is not known; allowed: .mp4, .gif, .png"),
        (['--vehicle', 'moon', '--out', 'a.png'], "no vehicle 'moon'; it has: x500"),
        (['--camera', 'moon', '--out', 'a.png'], "camera 'moon' is not in the model"),
    ],
)
def test_a_wrong_option_is_one_line(log, tmp_path, monkeypatch, capsys, arguments, line):
    monkeypatch.chdir(tmp_path)
    assert main(['render', str(log), *arguments]) == WRONG_INPUT
    assert line in capsys.readouterr().err
