# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A disk that is full: each command that writes says so in one line, and leaves no half a file."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from fluid_sim_ros.lab.advisor.scene_settings import keep
from test.support.paths import ROOT
from test.support.recorded_flights import record_flight
from test.support.volumes import quick

NO_SPACE = 'No space left on device'
#: What writes results of its own; those with logs and pictures take long.
QUICK = [
    ['repair', 'f.mcap', '{full}/r.mcap'],
    ['repair', 'f.mcap', '{full}/bag'],
    ['export', 'f.mcap', '--csv', '{full}/csv'],
    ['layout', 'sphere', '--out', '{full}/x.json'],
    ['urdf', 'sphere', '--out', '{full}/x.urdf'],
    ['info', 'f.mcap', '--json', '{full}/i.json'],
]
SLOW = [
    ['plot', 'f.mcap', '--out', '{full}/p'],
    ['render', 'f.mcap', '--out', '{full}/a.png'],
    ['render', 'f.mcap', '--out', '{full}/a.mp4', '--fps', '5'],
    ['render', 'f.mcap', '--out', '{full}/a.gif', '--fps', '5'],
    ['export', 'f.mcap', '--parquet', '{full}/pq'],
    ['replay', 'f.mcap', '--with', 'timestep=0.001', '--out', '{full}/w.png'],
    ['chart', 'stokes', '--timesteps', '.01', '.005', '--rounds', '1', '--out', '{full}/c'],
    ['excite', 'rov', '--duration', '5', '--out', '{full}/e'],
    ['compare', 'f.mcap', '--model', 'quadrotor', '--out', '{full}/cmp'],
    ['new-vehicle', 'abc', '--medium', 'air', '--mass', '1', '--size', '.3', '.3', '.1',
     '--thrusters', 'quad', '--out', '{full}/v'],
]  # fmt: skip
#: These begin with a file, or several, that stay: a later call says that they are there.
MAY_LEAVE = ('info', 'new-vehicle')


@pytest.mark.skipif(os.geteuid() != 0, reason='only root makes a disk')
@pytest.mark.parametrize('which', quick(['quick', 'slow'], 'quick'))
def test_a_full_disk_is_one_line_of_each_command_that_writes(tmp_path, which):
    record_flight(tmp_path / 'f.mcap', 'quadrotor', seconds=0.5, seed=1)
    commands = QUICK if which == 'quick' else SLOW
    (tmp_path / 'full').mkdir()
    done = subprocess.run(
        ['unshare', '--mount', sys.executable, '-m', 'test.support.full_disk',
         str(tmp_path / 'full')],
        input=json.dumps(commands), capture_output=True, text=True, timeout=600, check=False,
        cwd=tmp_path, env=os.environ | {'PYTHONPATH': str(ROOT), 'MUJOCO_GL': 'egl'},
    )  # fmt: skip
    assert done.returncode == 0, done.stderr[-2000:]
    assert 'ffmpeg' not in done.stderr.lower()  # it says nothing beside us
    for words, answer in zip(commands, json.loads(done.stdout), strict=True):
        *progress, line = answer['said'].splitlines()
        assert answer['code'] == 2, (words, answer)
        assert NO_SPACE in line and line.startswith('fluid_sim: '), (words, answer)
        assert '/full/' in line and 'f.mcap: ' not in line, (words, answer)  # the log is sound
        assert all(': 0 of ' in each for each in progress), (words, answer)
        assert not answer['left'] or words[0] in MAY_LEAVE, (words, answer)


def program(words, **settings):
    code = (
        'from fluid_sim_ros.interruption import begin, leave; begin("fluid_sim"); '
        'from fluid_sim_ros.cli import main; leave(main())'
    )
    return subprocess.Popen(
        [sys.executable, '-c', code, *words.split()], stderr=subprocess.PIPE, text=True, **settings
    )


@pytest.mark.parametrize('words', quick(['urdf sphere', 'scenes', 'run --help'], 'urdf sphere'))
def test_output_onto_a_full_device_is_one_line(words):
    with Path('/dev/full').open('w') as full:
        process = program(words, stdout=full)
        assert process.communicate(timeout=60)[1] == f'fluid_sim: {NO_SPACE}\n'
    assert process.returncode == 2


@pytest.mark.parametrize('words', quick(['urdf sphere', 'scenes'], 'scenes'))
def test_output_that_nobody_reads_any_more_is_no_fault(words):
    read, write = os.pipe()
    os.close(read)
    process = program(words, stdout=write)
    os.close(write)
    assert process.communicate(timeout=60)[1] == ''
    assert process.returncode == 141


@pytest.mark.skipif(os.geteuid() != 0, reason='only root makes a disk')
def test_advised_settings_on_a_full_disk_leave_the_scene_as_it_was(tmp_path):
    """A scene that was cut off for want of space would be lost."""
    text = 'model: sphere\ntimestep: 0.01  # mine\n'
    code = (
        'import sys; from pathlib import Path; from fluid_sim_ros.errors import FluidSimError\n'
        f'from {keep.__module__} import keep\n'
        'path = Path(sys.argv[1]) / "mine.yaml"\n'
        f'path.write_text({text!r})\n'
        '(path.parent / "filler").write_bytes(bytes(4096))\n'
        'try: keep(str(path), {"timestep": 0.001, "integrator": "RK4"})\n'
        'except FluidSimError as error: print(error)\n'
        f'assert path.read_text() == {text!r}\n'
    )
    mount = f'mount -t tmpfs -o size=8k none {tmp_path} && exec "$@"'
    done = subprocess.run(
        ['unshare', '--mount', 'sh', '-c', mount, 'sh', sys.executable, '-c', code, str(tmp_path)],
        capture_output=True, text=True, timeout=60, check=False, cwd=ROOT,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr[-2000:]
    assert done.stdout.strip().endswith(f'mine.yaml: cannot be written ({NO_SPACE})')
