# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The page in a real browser (headless Chromium, drawing in software)."""

import time

import pytest

pytest.importorskip('viser', reason='the extra view is not installed')

from fluid_sim_ros.cli.run import run_scene
from fluid_sim_ros.cli.view.log_source import LogSource
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.view.simulated import SimulatedSource
from test.support.chromium import PROGRAM, browser
from test.support.view_pages import opened

pytestmark = [
    pytest.mark.full,
    pytest.mark.skipif(PROGRAM is None, reason='needs chromium (apt-get install chromium)'),
]
SCENES = ('quadrotor', 'rov', 'amphibious', 'wave_buoy', 'fleet_x500')


@pytest.mark.parametrize('scene', SCENES)
def test_the_page_is_drawn_without_an_error(scene, tmp_path):
    source = SimulatedSource(scene)
    with opened(source) as page, browser(tmp_path, page.url) as tab:
        tab.wait_for("!!document.querySelector('canvas')")
        tab.wait_for("document.body.innerText.includes('t = ')")
        drawn = page.drawn
        time.sleep(1.0)
        assert page.drawn > drawn
        tab.screenshot(tmp_path / 'page.png')
        assert (tmp_path / 'page.png').stat().st_size > 20_000
        faults = [line for line in tab.console if 'Failed to load' in line or 'TypeError' in line]
        assert faults == []


def test_a_slider_is_moved_and_time_paused_and_stepped(tmp_path):
    source = SimulatedSource('quadrotor')
    with opened(source) as page, browser(tmp_path, page.url) as tab:
        tab.wait_for("document.body.innerText.includes('m4')")
        # again where the panel has moved under the pointer while the page was being laid out
        wait_until(lambda: source.simulation.data.ctrl[1] > 7.5, lambda: tab.set_slider(1, 0.95))
        assert source.simulation.data.ctrl[0] < 7.5
        tab.press_button('Pause')
        wait_until(lambda: source.frame().paused)
        at = source.simulation.step_count
        tab.press_button('Step')
        wait_until(lambda: source.simulation.step_count == at + 10)  # 20 ms
        tab.wait_for("document.body.innerText.includes('paused')")


def test_a_log_is_scrubbed(tmp_path):
    path = tmp_path / 'flight.mcap'
    run_scene('quadrotor', duration=1.0, hold=True, record=path)
    source = LogSource(open_log(path), paused=True)
    with opened(source) as page, browser(tmp_path, page.url) as tab:
        tab.wait_for("document.body.innerText.includes('t = 0.00 s')", 90.0)
        wait_until(
            lambda: source.frame().time == pytest.approx(0.7, abs=0.06),
            lambda: tab.set_slider(0, 0.7),
        )
        tab.wait_for("document.body.innerText.includes('t = 0.7') || "
                     "document.body.innerText.includes('t = 0.6')")  # fmt: skip
        tab.screenshot(tmp_path / 'page.png')


@pytest.mark.ros
@pytest.mark.usefixtures('ros_domain')
def test_a_node_is_commanded(tmp_path):
    pytest.importorskip('rclpy', reason='ROS is not here')
    from std_msgs.msg import Float64MultiArray

    from test.support.ros_processes import NODE, Peer, Process
    from test.view.test_node_view import url_of

    with Process(NODE, scene='rov'), Process(
        'fluid_sim_ros.cli', 'view', '--node', '--port', '0'
    ) as view, Peer() as peer, browser(tmp_path, url_of(view)) as tab:  # fmt: skip
        commands = peer.collect(Float64MultiArray, 'bluerov2_heavy/cmd/thrust')
        tab.wait_for("document.body.innerText.includes('t8')", 60.0)
        wait_until(
            lambda: commands and commands[-1].data[0] > 30.0, lambda: tab.set_slider(0, 0.9)
        )
        tab.screenshot(tmp_path / 'page.png')


def wait_until(condition, act=lambda: None, timeout=60.0):
    """Return once a condition holds; a user tries again until then."""
    end = time.monotonic() + timeout
    while not condition():
        assert time.monotonic() < end
        act()
        time.sleep(0.5)


def test_a_key_steers_and_its_release_holds(tmp_path):
    source = SimulatedSource('quadrotor')
    with opened(source) as page, browser(tmp_path, page.url) as tab:
        tab.wait_for("document.body.innerText.includes('hold and steer')")
        helm = source._helmsman._held['x500'][1]
        height = helm.target.position_w[2]
        key = {'key': 'PageUp', 'code': 'PageUp', 'windowsVirtualKeyCode': 33}
        end = time.monotonic() + 30.0
        while helm.target.position_w[2] < height + 0.2:  # the script connects in its own time
            tab.call('Input.dispatchKeyEvent', type='keyDown', **key)
            time.sleep(0.2)
            assert time.monotonic() < end
        tab.call('Input.dispatchKeyEvent', type='keyUp', **key)
        end = time.monotonic() + 10.0
        while any(source._helmsman._moving['x500']):
            time.sleep(0.05)
            assert time.monotonic() < end


def test_without_webgl_the_page_says_so(tmp_path):
    source = SimulatedSource('quadrotor')
    with opened(source) as page, browser(tmp_path, page.url, webgl=False) as tab:
        tab.wait_for("document.body.innerText.includes('WebGL')")
