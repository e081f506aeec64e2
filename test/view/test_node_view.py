"""A running node in the live view, over DDS and over the page's protocol."""

import re
import time

import pytest

pytest.importorskip('viser', reason='the extra view is not installed')
pytest.importorskip('rclpy', reason='ROS is not here')

from test.support.ros_processes import NODE, Process
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
    with Process(NODE, scene='rov') as node, Process(
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


def forces(page):
    """Return the forces that the page's table shows, term -> [N]."""
    text = next((text for text in page.texts() if '<table' in text), '')
    rows = re.findall(r'</span> ([a-z ]+)</td><td[^>]*>([-+.e0-9]+) N', text)
    return {name: float(value) for name, value in rows}


@pytest.mark.full
def test_a_node_that_is_not_there_is_one_line():
    with Process('fluid_sim_ros.cli', 'view', '--node', '/nobody', '--port', '0') as view:
        assert view.wait() == 2
    assert 'no such node' in view.output and 'Traceback' not in view.output
