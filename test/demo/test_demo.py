# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The demo, shortened: two processes, a recording, plots and a summary; and what goes wrong."""

import json
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from fluid_sim_ros.demo.children import Child
from fluid_sim_ros.demo.flight import fly_demo
from fluid_sim_ros.demo.flight_log import read_recording
from fluid_sim_ros.demo.main import main
from fluid_sim_ros.errors import FluidSimError
from test.support.ros_processes import wait_until

pytestmark = pytest.mark.ros


@pytest.mark.full  # .ci/run makes the demo itself
def test_demo_writes_what_it_promises(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / 'out'
    arguments = ['--out', str(out), '--duration', '12', '--json', '-']
    assert main(arguments) == 0
    printed = capsys.readouterr()
    result = json.loads(printed.out)
    assert result == json.loads((out / 'summary.json').read_text())
    assert 'real-time factor' in printed.err and 'largest fluid force' in printed.err

    assert result['simulated_s'] == pytest.approx(12.0)
    # every state is recorded, the first one included: lockstep waits at time 0
    assert result['states'] == 1201
    assert 1 < result['states_heard'] <= 1201
    assert result['gust_m_s'] == pytest.approx(6.0)
    assert result['error_before_gust_m'] < 0.05
    assert 0.01 < result['error_in_gust_m'] < 0.1
    assert result['error_after_gust_m'] is None
    # drag of the inertia box at 6 m/s: 2 rho r_j r_k v^2, from 0.8 N along an axis
    assert 0.5 < result['largest_fluid_force_n'] < 1.2
    assert 10.0 <= result['largest_fluid_force_at_s'] <= 12.0
    # 6 state topics at 100 Hz, /tf at 50 Hz and markers at 20 Hz, every message flown again
    states = 6 * 1201 + 601 + 241
    assert result['log']['identical'] and result['log']['states_resimulated'] == states
    # a state that is published again while lockstep holds on a busy machine is answered twice
    assert 1200 <= result['log']['commands'] < 1250
    for name in ('trajectory.png', 'wrench.png', 'still.png'):
        assert (out / name).read_bytes().startswith(b'\x89PNG')
        assert (out / name).stat().st_size > 20_000


@pytest.mark.full  # slow; test_lockstep.py compares two runs in `make test`
def test_two_runs_are_the_same_to_the_bit(tmp_path: Path) -> None:
    runs = []
    for name in ('a', 'b'):
        folder = tmp_path / name
        folder.mkdir()
        fly_demo(folder, 4.0, folder / 'flight.mcap')
        runs.append(read_recording(folder / 'flight.mcap'))
    for field in ('odometry', 'fluid', 'thrust'):
        one, other = (getattr(run, field) for run in runs)
        assert one.shape == other.shape == (401, one.shape[1])
        assert (one == other).all(), field


@pytest.mark.parametrize(
    ('number', 'code'),
    [
        (signal.SIGKILL, -9),
        *(
            pytest.param(*each, marks=pytest.mark.full)
            for each in ((signal.SIGINT, 130), (signal.SIGTERM, 143))
        ),
    ],
)
def test_a_signal_ends_the_demo_and_its_children(tmp_path: Path, number: int, code: int) -> None:
    command = [sys.executable, '-m', 'fluid_sim_ros.cli', 'demo']
    command += ['--out', str(tmp_path), '--duration', '600']
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    log = tmp_path / 'quad_controller.log'
    wait_until(lambda: log.exists() and 'waiting for' in log.read_text(), 'the controller')
    children = children_of(process.pid)
    process.send_signal(number)
    assert process.wait(30) == code
    process.stderr.close()
    assert len(children) == 2
    # after SIGKILL the kernel ends them, a moment later
    wait_until(lambda: not any(map(runs, children)), 'the end of both')


def runs(pid: int) -> bool:
    try:
        state = Path(f'/proc/{pid}/stat').read_text().rpartition(')')[2].split()[0]
    except OSError:
        return False
    return state != 'Z'  # whoever inherits it may be late to reap it


def children_of(parent: int) -> list[int]:
    return [int(pid) for pid in Path(f'/proc/{parent}/task/{parent}/children').read_text().split()]


def test_a_child_that_dies_is_shown_with_its_last_words(tmp_path: Path) -> None:
    child = Child(
        'fluid_sim_node', 'fluid_sim_ros.ros.node', ['--ros-args', '-p', 'scene:=nowhere'],
        {}, tmp_path / 'node.log',
    )  # fmt: skip
    child.process.wait(30)
    with pytest.raises(FluidSimError) as caught:
        child.check()
    assert 'fluid_sim_node ended with exit code 2' in str(caught.value)
    assert "scene 'nowhere' is not known" in str(caught.value)
    assert child.stop() == 2


def test_bad_options_are_one_line(tmp_path: Path) -> None:
    blocked = tmp_path / 'file'
    blocked.write_text('')
    with pytest.raises(FluidSimError, match=r'--out .*file/out'):
        main(['--out', str(blocked / 'out')])
    with pytest.raises(FluidSimError, match='--duration -1'):
        main(['--out', str(tmp_path), '--duration', '-1'])
