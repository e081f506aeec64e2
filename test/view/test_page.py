# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The page of the live view, over its real protocol."""

import time
from contextlib import contextmanager

import numpy as np
import pytest

pytest.importorskip('viser', reason='the extra view is not installed')

from websockets.sync.client import connect

from fluid_sim_ros import Simulation
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.view.simulated import SimulatedSource, ViewOptions
from fluid_sim_ros.view.web.page import Page
from test.support.view_client import client
from test.support.view_pages import opened, time_of


@contextmanager
def viewed(scene, **options):
    """Give a source and a client that looks at it."""
    source = SimulatedSource(scene, options=ViewOptions(**options))
    with opened(source) as page, client(page.url) as browser:
        yield source, browser


def test_a_slider_moves_and_the_command_arrives():
    with viewed('quadrotor') as (source, browser):
        browser.set('m2', 6.5)
        browser.wait_for(lambda page: source.simulation.data.ctrl[1] == 6.5)
        assert 'x500' not in source.frame().steered  # the law has let go
        browser.set('east', 4.0)
        browser.wait_for(lambda page: source.simulation.model.opt.wind[0] == 4.0)


def test_pause_step_reset_and_speed():
    with viewed('quadrotor') as (source, browser):
        browser.wait_for(lambda page: source.simulation.time > 0.05)
        browser.click('Pause')
        browser.wait_for(lambda page: page.controls['Pause']['props']['label'] == 'Play')
        at = source.simulation.step_count
        browser.click('Step')
        browser.wait_for(lambda page: source.simulation.step_count == at + 10)  # 20 ms
        browser.click('Reset')
        browser.wait_for(lambda page: source.simulation.step_count == 0)
        browser.wait_for(lambda page: time_of(page) == 0.0)  # it stays paused, and is shown
        browser.set('speed', '50 x')
        browser.wait_for(lambda page: source.pace == 50.0)
        browser.press('Play or pause')
        browser.wait_for(lambda page: source.simulation.time > 0.0)


def test_a_term_can_be_left_out_and_the_flight_begins_anew():
    with viewed('quadrotor', paused=True) as (source, browser):
        browser.set('fluid', 'none')
        browser.wait_for(lambda page: source.generation == 1)
        browser.wait_for(lambda page: page.controls['fluid']['value'] == 'none')
        assert source.terms['x500'] == ()
        browser.set('fluid', 'as the scene states')
        browser.wait_for(lambda page: source.generation == 2)
        assert 'drag' in source.terms['x500']


def test_what_a_browser_sends_is_checked():
    with viewed('quadrotor', paused=True) as (source, browser):
        browser.set('speed', '../../etc/passwd')
        browser.wait_for(lambda page: any('none of the choices' in t for t in page.texts()))
        browser.set('m1', float('nan'))
        browser.wait_for(lambda page: any('not a finite number' in t for t in page.texts()))
        assert source.pace == 1.0
        assert np.isfinite(source.simulation.data.ctrl).all()


def test_the_view_does_not_change_the_trajectory():
    alone = Simulation('quadrotor')
    with viewed('quadrotor', pace=0.0, hold=False) as (source, browser):
        browser.wait_for(lambda page: source.simulation.time > 1.0 and len(page.moved_at) > 5)
        browser.click('Pause')
        browser.wait_for(lambda page: page.controls['Pause']['props']['label'] == 'Play')
        alone.step(source.simulation.step_count)
        assert source.simulation.data.qpos.tobytes() == alone.data.qpos.tobytes()
        assert source.simulation.data.qvel.tobytes() == alone.data.qvel.tobytes()


def test_keys_steer_a_vehicle_that_is_held_and_on_release_it_holds():
    with viewed('rov', pace=10.0) as (source, browser):
        helm = source._helmsman._held['bluerov2_heavy'][1]
        depth = helm.target.depth
        address = browser.url.replace('http', 'ws', 1) + 'steer'
        with connect(address, origin=browser.url.rstrip('/')) as keys:
            keys.send('[0, 0, 1, 0]')  # up
            browser.wait_for(lambda page: helm.target.depth < depth - 0.5)
            keys.send('[0, 0, 0, 0]')
            browser.wait_for(lambda page: not any(moves(source)))
            keys.send('[1, 0, 0, 0]')
            browser.wait_for(lambda page: any(moves(source)))
            keys.send('["../x", 0, 0, 0]')
            keys.send('[2, 0, 0, 0]')
            browser.wait_for(lambda page: any('allowed is -1 to 1' in t for t in page.texts()))
        # the page is closed while a key is down: the vehicle holds
        browser.wait_for(lambda page: not any(moves(source)))
        held = helm.target
        browser.set('t1', 5.0)
        browser.wait_for(lambda page: 'bluerov2_heavy' not in source.frame().steered)
        browser.wait_for(lambda page: page.controls['hold and steer']['value'] is False)
        browser.set('hold and steer', True)
        browser.wait_for(lambda page: 'bluerov2_heavy' in source.frame().steered)
        assert source._helmsman._held['bluerov2_heavy'][1].target != held


def moves(source):
    return source._helmsman._moving.get('bluerov2_heavy', ())


def test_two_browsers_and_a_lost_one():
    source = SimulatedSource('wave_buoy')
    with opened(source) as page:
        with client(page.url) as one, client(page.url) as two:
            for browser in (one, two):
                browser.wait_for(lambda page: '/world/water' in page.nodes)
        seen = source.simulation.time
        time.sleep(0.1)
        assert source.simulation.time > seen
        with client(page.url) as again:
            again.wait_for(lambda page: len(page.moved_at) > 3)


def test_a_port_in_use_is_one_line():
    source = SimulatedSource('quadrotor', options=ViewOptions(paused=True))
    with opened(source) as page, pytest.raises(ConfigError, match='another --port'):
        Page(source, '127.0.0.1', int(page.url.rstrip('/').rpartition(':')[2]))


def test_a_divergence_is_shown_and_reset_begins_anew():
    with viewed('quadrotor', hold=False) as (source, browser):
        browser.wait_for(lambda page: source.simulation.time > 0.1)
        source._requests.call(lambda: source.simulation.data.qvel.fill(1e200), 5.0)
        browser.wait_for(lambda page: any('diverged' in text for text in page.texts()))
        browser.click('Reset')
        browser.wait_for(lambda page: source.simulation.time > 0.0 and not source.frame().note)
