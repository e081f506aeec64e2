# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""MuJoCo's desktop viewer with the plugins and the arrows, on a display of its own."""

import json
import os
import shutil
import subprocess
import sys

import pytest

from test.support.paths import ROOT

XVFB = shutil.which('xvfb-run')


@pytest.mark.skipif(XVFB is None, reason='needs xvfb-run (apt-get install xvfb)')
@pytest.mark.full
@pytest.mark.parametrize('scene', ['rov', 'wave_buoy'])
def test_the_desktop_viewer_draws_the_forces(scene):
    view = [sys.executable, '-m', 'fluid_sim_ros.cli', 'view', scene, '--native',
            '--end-after', '3', '--json', '-']  # fmt: skip
    done = subprocess.run(
        [XVFB, '-a', *view], cwd=ROOT, capture_output=True, text=True, check=False, timeout=60
    )
    assert done.returncode == 0, done.stderr
    result = json.loads(done.stdout)
    assert result['pictures'] > 5 and result['time_s'] > 0.5
    assert result['arrows'] >= 2  # buoyancy and weight at least


def test_without_a_display_it_is_one_line():
    environment = {k: v for k, v in os.environ.items() if k not in ('DISPLAY', 'WAYLAND_DISPLAY')}
    view = [sys.executable, '-m', 'fluid_sim_ros.cli', 'view', 'quadrotor', '--native']
    done = subprocess.run(
        view, cwd=ROOT, capture_output=True, text=True, check=False, env=environment, timeout=120
    )
    assert done.returncode == 2
    assert 'no window can be opened here' in done.stderr and 'Traceback' not in done.stderr
