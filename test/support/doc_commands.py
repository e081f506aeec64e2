# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Runs the command blocks of README.md and doc/ as a reader would who types them.

Nothing here needs more than ``make demo`` installs: .ci/doc_commands.py runs them in that
environment, test/packaging/test_doc_commands.py with all that the tests have besides blocked.
"""

import os
import signal
import socket
import subprocess
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from test.support.doc_blocks import Block, files_of

#: What is not run, by its beginning, and why.
NOT_RUN = {
    'fluid_sim view rov --native': 'needs a display; see test/view/test_native.py',
    'fluid_sim view --node': 'needs a node that runs; see test/view/test_node_view.py',
    'make demo': 'is run by .ci/run, on a clean checkout',
    'make test': 'is run by .ci/run',
    'source /opt/ros/jazzy/setup.bash': 'needs an installed ROS 2',
    'python3.12 -m venv': 'needs an installed ROS 2',
    ".venv/bin/pip install 'setuptools": 'needs an installed ROS 2',
    '.venv/bin/python -m colcon build': 'is run by .ci/colcon',
    'ros2 launch': 'needs an installed ROS 2',
    'build/sitl/bin/arducopter': 'needs ArduPilot',
    'Tools/autotest/sim_vehicle.py': 'needs ArduPilot',
    "fluid_sim run x500_ground --autopilot ardupilot --exec '": 'needs ArduPilot',
    'PX4_SYS_AUTOSTART=10016': 'needs PX4',
    'fluid_sim doctor --autopilot px4': 'needs PX4',
    "fluid_sim run x500_ground --autopilot px4 --exec '": 'needs PX4',
    "fluid_sim run my_fleet.yaml --exec '": 'needs PX4',
    '.venv/bin/pip install': 'changes the environment',
    'make wheel': 'is run by .ci/run',
    'python3 -m venv flights': 'is run by .ci/wheel, with the two lines after it',
    'flights/bin/': 'is run by .ci/wheel',
    'pipx run': 'needs pipx',
    'uvx': 'needs uv',
    'docker ': 'needs Docker',
    'fluid_sim sweep config/sweeps/x500_gust.yaml --ray local': 'needs the extra sweep, as said',
    'fluid_sim sweep FILE.yaml --device cuda:0': 'needs a GPU and the extra warp, as said',
    'fluid_sim info flight.ulg': 'has no log of a real flight; see test/flights and test/cli',
    'fluid_sim info bag/': 'has no log of a real flight',
    'fluid_sim chart --against flight.ulg': 'has no log of a real flight',
    'fluid_sim compare flight.ulg': 'has no log of a real flight',
    'fluid_sim fit a.usd': 'has no log of a real flight',
    'fluid_sim fit excited.mcap': 'needs the extra flights, as said; see test_excite.py',
    'fluid_sim repair broken.mcap whole.mcap': 'has no damaged file; see test_recorder.py',
}
#: What goes on until it is ended, by a part of it.
ENDLESS = ('fluid_sim_node', '_controller', '--autopilot', 'fluid_sim view')
#: Options that keep a command short here, by its beginning; in `make test-full` it runs as shown.
SHORTER = {
    'fluid_sim run rov --current': '--duration 2',
    'fluid_sim run bee/bee.yaml': '--duration 2',
    'fluid_sim run rov --advised': '--duration 2',
    'fluid_sim run amphibious': '--duration 2',
    'fluid_sim run quadrotor --record': '--duration 1',
    'fluid_sim run quadrotor --hold --pacing realtime': '--duration 1',
    'fluid_sim advise': '--budget 3',
    'fluid_sim excite': '--duration 6',
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
MAKERS = ('--record flight.mcap', 'new-vehicle bee', 'fluid_sim import', 'cp config/scenes')
#: Blocks of Python that are a part of a program of the reader's.
EXCERPTS = {'doc/weather.md': 'uses arrays of the reader'}


def plain(command: str) -> str:
    """Return a command as it reads where the environment is active."""
    return command.replace('.venv/bin/fluid_sim', 'fluid_sim').replace(
        '.venv/bin/rov_controller', 'rov_controller'
    )


def reason(command: str) -> str | None:
    """Return why a command is not run, or None."""
    found = [NOT_RUN[start] for start in NOT_RUN if plain(command).startswith(start)]
    return found[0] if found else None


def free_port() -> int:
    """Return a port that nobody listens on."""
    with socket.socket() as probe:
        probe.bind(('127.0.0.1', 0))
        return probe.getsockname()[1]


def end(process: Any, seconds: float = 20.0) -> str:
    """End a process that goes on, as Ctrl-C does; return what it wrote."""
    if process.poll() is not None:
        return ''
    process.send_signal(signal.SIGINT)
    try:
        return process.communicate(timeout=seconds)[0]
    finally:
        process.kill()


def run_block(block: Block, folder: Path, environment: Mapping[str, str]) -> None:
    """
    Run the commands of a block, after those of the page that make what it needs.

    Parameters
    ----------
    block
        Of a shell.
    folder
        A checkout, or a folder that looks like one after ``make demo``.
    environment
        What the commands get.

    Raises
    ------
    AssertionError
        If one fails, or shows a traceback.

    """
    for name, text in files_of(block.page).items():
        (folder / name).write_text(text, encoding='utf-8')
    for file, command in EARLIER.items():
        if file in block.text and not any(start in block.text for start in MAKERS):
            subprocess.run(command, shell=True, cwd=folder, env=environment, check=True)
    going: list[tuple[str, Any]] = []
    try:
        run_all(block.commands, folder, environment, going)
    finally:
        outputs = [(command, end(process), process) for command, process in going]
    for command, output, process in outputs:
        assert 'Traceback' not in output, command
        assert process.returncode == 0, (command, output)


def run_all(
    commands: list[str], folder: Path, environment: Mapping[str, str], going: list[tuple[str, Any]]
) -> None:
    """Run commands one after another; those that go on are added to ``going``."""
    for command in commands:
        if reason(command):
            continue
        text = command
        if any(part in command for part in ENDLESS):
            if 'fluid_sim run' in text or 'fluid_sim view' in text:
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
