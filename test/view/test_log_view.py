# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A log in the live view: scrubbed, played, beside the same flight with a change."""

import numpy as np
import pytest

pytest.importorskip('viser', reason='the extra view is not installed')

from fluid_sim_ros.cli.run import run_scene
from fluid_sim_ros.cli.view.log_source import LogSource
from fluid_sim_ros.errors import CommandError, ConfigError
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.view import orders
from test.support.view_client import client
from test.support.view_pages import opened, time_of


@pytest.fixture(autouse=True)
def _a_busy_machine_loads_models_slowly(monkeypatch):
    monkeypatch.setenv('FLUID_SIM_LIMITS', 'model_seconds=150')


@pytest.fixture(scope='module')
def log(tmp_path_factory):
    path = tmp_path_factory.mktemp('log') / 'flight.mcap'
    run_scene('quadrotor', duration=1.0, hold=True, wind=[3.0, 0.0, 0.0], record=path)
    return open_log(path)


@pytest.fixture(scope='module')
def source(log):
    """Return the log as a source, opened once."""
    return LogSource(log, paused=True)


def test_a_log_is_scrubbed_over_the_pages_protocol(source):
    with opened(source) as page, client(page.url) as browser:
        browser.set('time [s]', 0.5)
        browser.wait_for(lambda page: any('t = 0.50 s' in text for text in page.texts()))
        browser.set('time [s]', 0.2)  # and back
        browser.wait_for(lambda page: any('t = 0.20 s' in text for text in page.texts()))
        browser.press('Play or pause')
        browser.wait_for(lambda page: time_of(page) > 0.25)


def test_a_frame_says_what_the_log_says(source):
    assert source.span == (0.0, 1.0)
    source.take(orders.Seek(0.7))
    frame = source.frame()
    track = source._poses.tracks['x500']
    row = int(np.searchsorted(track.times, 0.7 + 1e-9)) - 1
    assert (frame.qpos[:3] == track.position_w[row]).all()
    assert (frame.rows[0][nat.THRUST][:3] == track.wrenches['thrust'][row, 1:4]).all()
    assert frame.rows[0][nat.MEDIUM_VELOCITY].tolist() == [3.0, 0.0, 0.0]
    assert frame.control == pytest.approx(track.commands['thrust'][row, 1:])
    assert np.isnan(frame.force).all()  # a log does not say it, and nothing is made up


def test_another_flight_is_drawn_beside_it(log):
    source = LogSource(log, ['wind=0,0,0'], paused=True)
    with opened(source) as page, client(page.url) as browser:
        browser.wait_for(lambda page: any('/world/ghost_' in name for name in page.nodes))
        source.take(orders.Seek(1.0))
        frame = source.frame()
        # the commands that held it against the wind carry it away without
        assert 0.01 < np.linalg.norm(frame.ghost[:3] - frame.qpos[:3]) < 5.0


def test_what_a_log_cannot_do_is_one_line(log, source):
    with pytest.raises(CommandError, match='takes no order Thrust'):
        source.take(orders.Thrust('x500', [0.0] * 4))
    with pytest.raises(ConfigError, match='wrench'):
        LogSource(log, ['wrench=1'])
