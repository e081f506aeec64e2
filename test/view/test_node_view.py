# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A running node in the live view, over DDS and over the page's protocol."""

import re
import time

import pytest

pytest.importorskip('viser', reason='the extra view is not installed')
pytest.importorskip('rclpy', reason='ROS is not here')

from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from websockets.sync.client import connect

from test.support.ros_processes import NODE, Forked, Peer, controller, wait_until
from test.support.view_client import client
from test.support.view_pages import time_of

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]


def url_of(view):
    """Return the address that a view prints, once it does."""
    for _ in range(600):
        found = re.search(r'http://\S+', view.output)
        if found:
            return found[0]
        assert view.alive, view.output
        time.sleep(0.05)
    raise AssertionError(view.output)


def test_a_node_is_seen_paused_stepped_and_commanded():
    with Forked(NODE, scene='rov') as node, Forked(
        'fluid_sim_ros.cli', 'view', '--node', '--port', '0'
    ) as view:  # fmt: skip
        with client(url_of(view)) as browser:
            browser.wait_for(lambda page: time_of(page) > 0.1)
            browser.set('t1', 20.0)  # repeated, so that it does not go stale
            browser.wait_for(lambda page: forces(page).get('thrust', 0.0) > 10.0)
            browser.click('Pause')
            browser.wait_for(lambda page: page.controls['Pause']['props']['label'] == 'Play')
            at = time_of(browser)
            browser.click('Step')
            browser.wait_for(lambda page: time_of(page) >= at)
            browser.click('Reset')
            browser.wait_for(lambda page: time_of(page) < at)
        assert node.alive


@pytest.mark.full
def test_keys_steer_a_node_whose_controller_follows_cmd_vel():
    with Forked(NODE, scene='rov') as node, Forked(
        'fluid_sim_ros.cli', 'view', '--node', '--port', '0'
    ) as view, Peer() as peer:  # fmt: skip
        odometry = peer.collect(Odometry, 'bluerov2_heavy/odom')
        url = url_of(view)
        with client(url) as browser, keys_of(url) as keys:
            browser.wait_for(lambda page: time_of(page) > 0.1)
            keys.send('[0, 0, 1, 0]')
            browser.wait_for(lambda page: any('nobody follows' in t for t in page.texts()))
            keys.send('[0, 0, 0, 0]')
            with controller('rov', vehicle='bluerov2_heavy') as flown:
                wait_until(lambda: 'bluerov2_heavy' in flown.output or len(odometry) > 300, 'it')
                wait_until(lambda: odometry, 'odometry')
                start = odometry[-1].pose.pose.position.z
                seen = peer.collect(Twist, 'bluerov2_heavy/cmd_vel')

                def rises():
                    keys.send('[0, 0, 1, 0]')  # again: the controller subscribes in its own time
                    time.sleep(0.1)
                    return odometry[-1].pose.pose.position.z > start + 0.4

                wait_until(rises, 'a rise')
                assert seen[-1].linear.z == pytest.approx(0.4)
                keys.send('[0, 0, 0, 0]')  # on release it holds
                wait_until(lambda: seen[-1].linear.z == 0.0, 'the release')
        assert node.alive


def keys_of(url):
    """Return a connection of the page's script for keys."""
    return connect(url.replace('http', 'ws', 1) + 'steer', origin=url.rstrip('/'))


def forces(page):
    """Return the forces that the page's table shows, term -> [N]."""
    text = next((text for text in page.texts() if '<table' in text), '')
    rows = re.findall(r'</span> ([a-z ]+)</td><td[^>]*>([-+.e0-9]+) N', text)
    return {name: float(value) for name, value in rows}


@pytest.mark.full
def test_a_node_that_is_not_there_is_one_line():
    with Forked('fluid_sim_ros.cli', 'view', '--node', '/nobody', '--port', '0') as view:
        assert view.wait() == 2
    assert 'no such node' in view.output and 'Traceback' not in view.output
