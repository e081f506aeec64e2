"""The page in a real browser (headless Chromium, drawing in software)."""

import time

import pytest

pytest.importorskip('viser', reason='the extra view is not installed')

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
