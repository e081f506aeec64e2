# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Ctrl-C under ``ros2 launch``: exit code 0 and no ERROR line, whenever it comes."""

import os
import signal
import subprocess
import sys
import time

import pytest
from nav_msgs.msg import Odometry

from fluid_sim_ros.recording.reader import open_log
from test.support.ros_processes import Peer, error_lines, wait_until
from test.support.volumes import quick

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]

EXECUTABLES = (
    'fluid_sim_node', 'quad_controller', 'rov_controller', 'auv_controller', 'plane_controller'
)  # fmt: skip


class Launched:
    """Executables in a process group of their own, as ``ros2 launch`` starts them."""

    def __init__(self, tmp_path):
        self._folder = tmp_path
        self.processes = {}

    def start(self, executable, **parameters):
        arguments = [part for k, v in parameters.items() for part in ('-p', f'{k}:={v}')]
        arguments = ['--ros-args', *arguments] if arguments else []
        code = (
            f'import sys; from fluid_sim_ros.ros.executables import {executable} as run; '
            "sys.stdout.write('loading\\n'); sys.stdout.flush(); run()"
        )
        leader = next(iter(self.processes.values()), None)
        with (self._folder / executable).open('wb') as output:
            self.processes[executable] = subprocess.Popen(
                [sys.executable, '-c', code, *arguments], stdout=output, stderr=subprocess.STDOUT,
                process_group=leader.pid if leader else 0,
            )  # fmt: skip

    def output(self, executable):
        return (self._folder / executable).read_text()

    def signal_group(self, number):
        os.killpg(next(iter(self.processes.values())).pid, number)

    def signal_each(self, number):
        for process in self.processes.values():
            if process.poll() is None:
                process.send_signal(number)

    def assert_clean(self):
        for name, process in self.processes.items():
            assert process.wait(20) == 0, (name, self.output(name))
            assert not error_lines(self.output(name))
            assert 'Interrupt' not in self.output(name)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.signal_each(signal.SIGKILL)
        for process in self.processes.values():
            process.wait()


@pytest.mark.parametrize(
    ('number', 'again'),
    [
        (signal.SIGINT, 0.05),
        pytest.param(signal.SIGINT, 1.0, marks=pytest.mark.full),
        (signal.SIGTERM, 0.3),
    ],
)
def test_ctrl_c_to_the_group_and_once_more_to_each_ends_all_with_0(tmp_path, number, again):
    """The terminal signals the group; launch then signals each process itself."""
    path = tmp_path / 'a.mcap'
    with Peer() as peer, Launched(tmp_path) as launched:
        odometry = peer.collect(Odometry, 'x500/odom')
        launched.start('fluid_sim_node', **{'record.path': path})
        launched.start('quad_controller')
        wait_until(lambda: len(odometry) > 20, 'odometry')
        wait_until(lambda: 'waiting for' in launched.output('quad_controller'), 'the controller')
        launched.signal_group(number)
        time.sleep(again)
        launched.signal_each(signal.SIGINT)
        launched.assert_clean()
    assert not open_log(path).faults  # the log has its end


@pytest.mark.parametrize(
    ('executable', 'delay'),
    [('fluid_sim_node', 0.1), ('fluid_sim_node', 0.7), ('fluid_sim_node', 1.3),
     ('rov_controller', 0.4), ('rov_controller', 1.0)],
)  # fmt: skip
def test_ctrl_c_while_it_starts_ends_it_with_0(tmp_path, executable, delay):
    with Launched(tmp_path) as launched:
        launched.start(executable)
        wait_until(lambda: 'loading' in launched.output(executable), 'the first line')
        time.sleep(delay)
        launched.signal_group(signal.SIGINT)
        launched.assert_clean()


@pytest.mark.parametrize('executable', quick(EXECUTABLES, 'fluid_sim_node', 'quad_controller'))
def test_every_executable_shows_its_help(tmp_path, executable):
    code = f'from fluid_sim_ros.ros.executables import {executable} as run; run()'
    option = '-h' if executable == 'quad_controller' else '--help'
    done = subprocess.run(
        [sys.executable, '-c', code, option], capture_output=True, text=True, timeout=60,
        check=False,
    )  # fmt: skip
    assert done.returncode == 0 and not done.stderr
    assert done.stdout.startswith(f'usage: {executable} ')
    assert ' scene (default: ' in done.stdout
    assert max(map(len, done.stdout.splitlines())) <= 100
    own = {'fluid_sim_node': 'lockstep.period', 'rov_controller': 'gains.attitude'}
    assert own.get(executable, 'vehicle') in done.stdout


def test_a_signal_long_after_the_first_ends_a_process_that_hangs(tmp_path):
    """Such as one whose disk does not answer."""
    code = (
        'import time; from fluid_sim_ros.ros.process.signals import EndSignals; '
        "EndSignals('x'); print('here', flush=True); time.sleep(60); time.sleep(60)"
    )
    with subprocess.Popen([sys.executable, '-c', code], stdout=-1, stderr=-1, text=True) as child:
        assert child.stdout.readline() == 'here\n'
        child.send_signal(signal.SIGINT)
        time.sleep(0.3)
        child.send_signal(signal.SIGINT)
        time.sleep(2.2)
        assert child.poll() is None
        child.send_signal(signal.SIGTERM)
        assert child.wait(10) == 128 + signal.SIGTERM
        assert 'ended at once by a second signal' in child.stderr.read()
