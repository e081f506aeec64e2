# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Where nothing can be drawn, every attempt in a process is refused in one line."""

import os
import subprocess
import sys

import pytest

from test.support.paths import ROOT
from test.support.recorded_flights import record_flight
from test.support.volumes import quick

#: MuJoCo chooses how it draws when it is imported; here it finds no OpenGL at all.
SCRIPT = """\
import sys
from pathlib import Path
import mujoco
from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.recording.pictures.render import FilmOptions, render
from fluid_sim_ros.recording.reader import open_log
for _ in range(3):
    try:
        render(open_log(sys.argv[1]), Path(sys.argv[2]), FilmOptions(), lambda done: None)
    except FluidSimError as error:
        print(error)
"""


@pytest.mark.parametrize('chosen', quick(['off', ''], 'off'))
def test_a_second_picture_without_opengl_is_refused_like_the_first(chosen, tmp_path):
    log = tmp_path / 'a.mcap'
    record_flight(log, 'quadrotor', seconds=0.1, seed=1)
    environment = {
        key: value
        for key, value in os.environ.items()
        if key not in ('MUJOCO_GL', 'DISPLAY', 'WAYLAND_DISPLAY', 'PYOPENGL_PLATFORM')
    } | {'MUJOCO_GL': chosen, 'PYTHONPATH': str(ROOT)}
    done = subprocess.run(
        [sys.executable, '-c', SCRIPT, str(log), str(tmp_path / 'a.png')],
        env=environment, capture_output=True, text=True, timeout=60, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr[-2000:]
    lines = done.stdout.splitlines()
    assert len(lines) == 3
    assert len(set(lines)) == 1
    assert 'can be drawn here' in lines[0]
    assert lines[0].startswith('render: ')  # it is no fault of the log
    assert 'MUJOCO_GL=egl' in lines[0]
