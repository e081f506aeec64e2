"""Commands and programs of README.md and doc/ run, with no more than ``make demo`` installs."""

import os
import re
import shlex
import shutil
import signal
import socket
import subprocess
import sys
import time

import pytest

from test.support.doc_blocks import blocks
from test.support.egg_info import sections
from test.support.paths import ROOT

#: Modules that the tests have and ``make demo`` does not install.
BLOCKED = ('ray', 'warp', 'mujoco_warp', 'rosbags', 'mcap_ros2', 'jsbsim', 'rotorpy', 'hypothesis')
_BLOCKER = f"""
import sys
class Blocker:
    def find_spec(self, name, path=None, target=None):
        if name.partition('.')[0] in {BLOCKED}:
            raise ModuleNotFoundError(f'No module named {{name!r}}', name=name)
sys.meta_path.insert(0, Blocker())
"""
#: What is not run, by its beginning, and why.
NOT_RUN = {
    'make demo': 'is run by .ci/run, on a clean checkout',
    'make test': 'is what runs this test',
    'source /opt/ros/jazzy/setup.bash': 'needs an installed ROS 2',
    'python3.12 -m venv': 'needs an installed ROS 2',
    ".venv/bin/pip install 'setuptools": 'needs an installed ROS 2',
    '.venv/bin/python -m colcon build': 'is run by .ci/colcon',
    'ros2 launch': 'needs an installed ROS 2',
    'build/sitl/bin/arducopter': 'needs ArduPilot',
    'Tools/autotest/sim_vehicle.py': 'needs ArduPilot',
    "fluid_sim run x500_ground --autopilot ardupilot --exec '": 'needs ArduPilot',
    'PX4_SYS_AUTOSTART=10016': 'needs PX4',
    "fluid_sim run x500_ground --autopilot px4 --exec '": 'needs PX4',
    "fluid_sim run my_fleet.yaml --exec '": 'needs PX4',
    '.venv/bin/pip install': 'changes the environment',
    'make wheel': 'is run by .ci/run',
    'python3 -m venv flights': 'is run by .ci/wheel, with the two lines after it',
    'flights/bin/': 'is run by .ci/wheel',
    'pipx run': 'needs pipx',
    'uvx': 'needs uv',
    'fluid_sim sweep config/sweeps/x500_gust.yaml --ray local': 'needs the extra sweep, as said',
    'fluid_sim sweep FILE.yaml --device cuda:0': 'needs a GPU and the extra warp, as said',
    'fluid_sim info flight.ulg': 'has no log of a real flight; see test/flights and test/cli',
    'fluid_sim info bag/': 'has no log of a real flight',
    'fluid_sim compare flight.ulg': 'has no log of a real flight',
    'fluid_sim fit a.usd': 'has no log of a real flight',
    'fluid_sim repair broken.mcap whole.mcap': 'has no damaged file; see test_recorder.py',
}
#: What goes on until it is ended, by a part of it.
ENDLESS = ('fluid_sim_node', '_controller', '--autopilot')
#: Options that keep a command short here, by its beginning; in `make test-full` it runs as shown.
SHORTER = {
    'fluid_sim run rov --current': '--duration 2',
    'fluid_sim run bee/bee.yaml': '--duration 2',
    'fluid_sim run rov --advised': '--duration 2',
    'fluid_sim run amphibious': '--duration 2',
    'fluid_sim run quadrotor --record': '--duration 1',
    'fluid_sim advise': '--budget 3',
    'fluid_sim hydro': '--panels 60',
    'fluid_sim import': '--panels 60',
    'fluid_sim chart kirchhoff': '--timesteps 0.01 0.005 --rounds 1 --integrators RK4',
    'fluid_sim chart --from out/chart/kirchhoff.json --time-again': '--rounds 1',
    'fluid_sim stability drag': '--cells 2',
    'fluid_sim stability kirchhoff': '--cells 2',
    'fluid_sim stability my_scene.yaml': '--integrators RK4',
    'fluid_sim chart my_scene.yaml': '--integrators RK4 --rounds 1',
    'fluid_sim render': '--fps 5 --size 160 120',
    'fluid_sim replay flight.mcap': '--rate 4',
    'fluid_sim sweep config/sweeps/x500_gust.yaml': None,  # takes no shorter form
}
#: Files that another block of the page makes, or the reader.
EARLIER = {
    'flight.mcap': 'fluid_sim run quadrotor --duration 1 --record flight.mcap',
    'bee/bee.yaml': 'fluid_sim new-vehicle bee --medium air --mass 1.6 --size .35 .35 .1 '
    '--thrusters quad',
    'small_quad/small_quad.yaml': 'fluid_sim import models/examples/small_quad.urdf --answers '
    'models/examples/small_quad_answers.yaml',
    'frame_rov/frame_rov.yaml': 'fluid_sim import models/examples/frame_rov.urdf --answers '
    'models/examples/frame_rov_answers.yaml --panels 60',
    'my_scene.yaml': 'cp config/scenes/sphere.yaml my_scene.yaml',
}
MAKERS = ('--record flight.mcap', 'new-vehicle bee', 'fluid_sim import')
#: Run by `make test-full`, and by .ci/run in a step of their own.
SHELL = [
    pytest.param(block, id=f'{block.page}:{block.line}', marks=pytest.mark.full)
    for block in blocks(shell=True)
]
PYTHON = [pytest.param(block, id=f'{block.page}:{block.line}') for block in blocks(shell=False)]
#: Blocks of Python that are a part of a program of the reader's.
EXCERPTS = {'doc/weather.md': 'uses arrays of the reader'}


def plain(command):
    """Return a command as it reads where the environment is active."""
    return command.replace('.venv/bin/fluid_sim', 'fluid_sim').replace(
        '.venv/bin/rov_controller', 'rov_controller'
    )


def reason(command):
    """Return why a command is not run, or None."""
    found = [NOT_RUN[start] for start in NOT_RUN if plain(command).startswith(start)]
    return found[0] if found else None


@pytest.fixture
def checkout(tmp_path, egg_info):
    """Return a folder as a checkout after ``make demo``, and the environment to use in it."""
    programs = tmp_path / '.venv' / 'bin'
    programs.mkdir(parents=True)
    scripts = sections((egg_info / 'entry_points.txt').read_text())['console_scripts']
    for line in scripts:
        name, value = (part.strip() for part in line.split('='))
        module, function = value.split(':')
        code = f'import sys; sys.argv[0] = {name!r}; from {module} import {function} as run; '
        call = shlex.join([sys.executable, '-c', f'{code}sys.exit(run())'])
        (programs / name).write_text(f'#!/bin/sh\nexec {call} "$@"\n')
        (programs / name).chmod(0o755)
    for folder in ('config', 'models'):
        shutil.copytree(ROOT / folder, tmp_path / folder)
    blocker = tmp_path / 'blocker'
    blocker.mkdir()
    (blocker / 'sitecustomize.py').write_text(_BLOCKER)
    environment = dict(
        os.environ, PYTHONPATH=f'{blocker}:{ROOT}', PATH=f'{programs}:{os.environ["PATH"]}',
        COLUMNS='80',
    )  # fmt: skip
    return tmp_path, environment


def free_port():
    """Return a port that nobody listens on."""
    with socket.socket() as probe:
        probe.bind(('127.0.0.1', 0))
        return probe.getsockname()[1]


def end(process, seconds=20.0):
    """End a process that goes on, as Ctrl-C does; return what it wrote."""
    if process.poll() is not None:
        return ''
    process.send_signal(signal.SIGINT)
    try:
        return process.communicate(timeout=seconds)[0]
    finally:
        process.kill()


@pytest.mark.ros
@pytest.mark.timeout(900)
@pytest.mark.parametrize('block', SHELL)
def test_each_command_block_runs_right_after_make_demo(block, checkout):
    folder, environment = checkout
    for file, command in EARLIER.items():
        if file in block.text and not any(start in block.text for start in MAKERS):
            subprocess.run(command, shell=True, cwd=folder, env=environment, check=True)
    going = []
    try:
        run_all(block.commands, folder, environment, going)
    finally:
        outputs = [(command, end(process), process) for command, process in going]
    for command, output, process in outputs:
        assert 'Traceback' not in output, command
        assert process.returncode == 0, (command, output)


def run_all(commands, folder, environment, going):
    """Run commands one after another; those that go on are added to ``going``."""
    for command in commands:
        if reason(command):
            continue
        text = command
        if any(part in command for part in ENDLESS):
            if 'fluid_sim run' in text:
                text = f'{text} --port {free_port()}'
            elif 'px4' in text:
                text = f'{text} -p autopilot.port:={free_port()}'
            process = subprocess.Popen(
                f'exec {text}', shell=True, cwd=folder, env=environment, text=True,
                stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            )  # fmt: skip
            time.sleep(4.0)
            going.append((command, process))
            assert process.poll() is None, process.communicate()[0]
            continue
        short = [SHORTER[start] for start in SHORTER if plain(command).startswith(start)]
        if short and not os.environ.get('FLUID_SIM_FULL'):
            if short[0] is None:
                continue
            text = f'{command} {short[0]}'
        done = subprocess.run(
            text, shell=True, cwd=folder, env=environment, capture_output=True, text=True,
            check=False,
        )  # fmt: skip
        # advice may find nothing within so little time (1)
        allowed = (0, 1) if 'fluid_sim advise' in text and text != command else (0,)
        assert done.returncode in allowed, (text, done.stdout, done.stderr)
        assert 'not installed' not in done.stderr


@pytest.mark.parametrize('block', PYTHON)
def test_each_python_block_runs(block, checkout):
    if block.page in EXCERPTS:
        return
    folder, environment = checkout
    done = subprocess.run(
        [sys.executable, '-c', block.text], cwd=folder, env=environment, capture_output=True,
        text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr


def test_the_python_example_of_the_readme_prints_no_zeros(checkout):
    folder, environment = checkout
    (text,) = [block.text for block in blocks(shell=False) if block.page == 'README.md']
    done = subprocess.run(
        [sys.executable, '-c', text], cwd=folder, env=environment, capture_output=True, text=True,
        check=True,
    )  # fmt: skip
    numbers = [float(word) for word in re.findall(r'-?\d+\.?\d*(?:e[+-]\d+)?', done.stdout)]
    assert len(numbers) >= 6
    assert sum(abs(number) > 1e-6 for number in numbers) >= 3


def test_what_is_not_run_is_still_shown_and_says_why():
    shown = [plain(command) for block in blocks(shell=True) for command in block.commands]
    for start, why in [*NOT_RUN.items(), *((start, 'short') for start in SHORTER)]:
        assert any(command.startswith(start) for command in shown), start
        assert start in SHORTER or why
    pages = {block.page for block in blocks(shell=False)}
    assert set(EXCERPTS) <= pages
