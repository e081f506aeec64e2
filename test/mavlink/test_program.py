# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""An autopilot's program as a child: how it is started, what it writes, how it ends."""

import json
import os
import shlex
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from fluid_sim_ros.cli import main
from fluid_sim_ros.loop.autopilot_port import AutopilotOptions
from fluid_sim_ros.mavlink.mapping import load_mapping
from fluid_sim_ros.mavlink.program.command_line import command_line
from fluid_sim_ros.mavlink.program.program import Program
from fluid_sim_ros.recording.reader import open_log
from test.support.autopilots.autopilot_peers import free_port, waited
from test.support.paths import ROOT

ARDUPILOT = f'env PYTHONPATH={ROOT} {sys.executable} -m test.support.autopilots.ardupilot_program'
PX4 = f'env PYTHONPATH={ROOT} {sys.executable} -m test.support.autopilots.px4_program'


HOME = (47.4, 8.5, 0.0, 90)


def alive(pid: int) -> bool:
    """Whether a process runs; one that has ended and is not reaped does not."""
    try:
        return Path(f'/proc/{pid}/stat').read_text().rpartition(')')[2].split()[0] != 'Z'
    except OSError:
        return False


def started(command, show, protocol='px4', vehicle='x500', **options):
    file, _ = load_mapping(protocol, vehicle)
    return Program(command, AutopilotOptions(protocol, **options), file, HOME, {}, show)


# ---- how it is started ---------------------------------------------------------------------


def test_command_lines(tmp_path):
    options = AutopilotOptions('px4', instance=2)
    command = command_line('bin/px4 -w "a b"', options, {}, HOME, tmp_path)
    assert command == ['bin/px4', '-w', 'a b', '-d', '-i', '2']
    sub = {'FRAME_CONFIG': 1.0, 'PSC_D_ACC_P': 0.2}
    options = AutopilotOptions('ardupilot', instance=1)
    home = (1.5, -2.0, 0.0, 90)
    command = command_line('./ardusub', options, sub, home, tmp_path)
    assert command == [
        './ardusub', '--model', 'JSON:127.0.0.1', '--home', '1.5,-2.0,0.0,90', '--speedup', '100',
        '-I', '1', '--serial0', 'tcp:0', '--defaults', str(tmp_path / 'parameters.parm'),
    ]  # fmt: skip
    assert (tmp_path / 'parameters.parm').read_text() == 'FRAME_CONFIG 1\nPSC_D_ACC_P 0.2\n'
    # of a name that stands twice ArduPilot takes the last
    command = command_line('ardusub --defaults a.parm,b.parm', options, sub, home, tmp_path)
    assert command[1:3] == ['--defaults', f'a.parm,b.parm,{tmp_path}/parameters.parm']
    command = command_line('ardusub --defaults=a.parm', options, sub, home, tmp_path)
    assert command[1] == f'--defaults=a.parm,{tmp_path}/parameters.parm'
    assert command.count('--defaults') == 0
    for given in ('--serial0 tcp:0:wait', '--serial0=udpclient:1.2.3.4', '--uartA tcp:0'):
        command = command_line(f'ardusub {given}', options, sub, home, tmp_path)
        assert sum('serial0' in word or 'uartA' in word for word in command) == 1
    options = AutopilotOptions('ardupilot', port=9500)
    command = command_line('ardusub', options, sub, home, tmp_path)
    assert command[command.index('--sim-port-out') + 1] == '9500'


def test_a_program_of_the_present_folder_and_of_the_home(tmp_path, monkeypatch):
    program = tmp_path / 'px4'
    program.write_text('#!/bin/sh\necho here\n')
    program.chmod(0o755)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv('HOME', str(tmp_path))
    for command in ('./px4', '~/px4', 'env A=1 ~/px4'):
        lines: list[str] = []
        child = started(command, lines.append)
        assert waited(lambda lines=lines: lines == ['here'])
        child.close()


def test_ardupilot_does_not_wait_for_a_ground_station(capfd):
    port = free_port('ardupilot')
    arguments = ['run', 'x500_ground', '--autopilot', 'ardupilot', '--port', str(port),
                 '--exec', ARDUPILOT, '--duration', '0.5', '--json', '-']  # fmt: skip
    assert main(arguments) == 0
    out, err = capfd.readouterr()
    assert json.loads(out)['duration_s'] > 0.49
    assert 'Waiting for connection' not in err
    assert 'ArduPilot at 127.0.0.1:' in err


# ---- what it writes ------------------------------------------------------------------------


def test_what_it_writes_is_shown_as_it_is(capfd):
    text = '[commander] Ready [/fs/x] :warning: [bold]b[/bold] \\[red]'
    command = shlex.join([sys.executable, '-c', f'print({text!r}); print("more")'])
    port = free_port('px4')
    arguments = [
        'run',
        'x500_ground',
        '--autopilot',
        'px4',
        '--port',
        str(port),
        '--exec',
        command,
    ]
    assert main(arguments) == 1
    lines = capfd.readouterr().err.splitlines()
    assert text in lines
    assert 'more' in lines


def test_one_that_nobody_shows_goes_on(tmp_path):
    def show(line):
        raise BrokenPipeError

    done = tmp_path / 'done'
    script = f'print("x\\n" * 200_000, flush=True); open({str(done)!r}, "w")'
    program = started(shlex.join([sys.executable, '-c', script]), show)
    assert waited(done.exists)
    program.close()


# ---- how it ends ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    ('command', 'line'),
    [
        ('false', 'the autopilot ended with code 1 before it answered'),
        ('true', 'the autopilot ended with code 0 before it answered'),
        ('sh -c "exit 255"', 'the autopilot ended with code 255 before it answered'),
        ('sh -c "kill -9 $$"', 'the autopilot was ended by SIGKILL before it answered'),
    ],
)
def test_one_that_cannot_start_ends_the_run_with_a_code_and_a_line(command, line, capfd):
    arguments = ['run', 'x500_ground', '--autopilot', 'px4', '--port', str(free_port('px4')),
                 '--exec', command, '--json', '-']  # fmt: skip
    assert main(arguments) == 1
    out, err = capfd.readouterr()
    flown = json.loads(out)['autopilot']
    assert flown['fault'] == line
    assert flown['exit_code'] in (0, 1, 255, -9)
    assert err.splitlines()[-1] == f'fluid_sim: {line}'


def test_one_that_is_killed_in_flight_ends_the_run(tmp_path, capfd):
    port, log = free_port('ardupilot'), tmp_path / 'flight.mcap'
    pids = tmp_path / 'pids'
    killer = subprocess.Popen(
        ['sh', '-c', f'while [ ! -s {pids} ]; do sleep .1; done; sleep 1; read one two < {pids}; '
         'kill -9 $one']
    )  # fmt: skip
    arguments = ['run', 'x500_ground', '--autopilot', 'ardupilot', '--port', str(port),
                 '--exec', f'{ARDUPILOT} --pids {pids}', '--record', str(log)]  # fmt: skip
    assert main(arguments) == 1
    killer.wait()
    out, err = capfd.readouterr()
    assert err.splitlines()[-1] == 'fluid_sim: the autopilot was ended by SIGKILL'
    assert 'states were answered; missed 0, late 0, repeated' in ' '.join(out.split())
    assert open_log(log).topic('/x500/cmd/thrust')
    _, child = map(int, pids.read_text().split())
    assert waited(lambda: not alive(child))


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_no_orphans_whatever_ends_the_run(tmp_path, number):
    port, log, pids = free_port('ardupilot'), tmp_path / 'flight.mcap', tmp_path / 'pids'
    flying = tmp_path / 'flying'
    run = subprocess.Popen(
        [sys.executable, '-m', 'fluid_sim_ros.cli', 'run', 'x500_ground', '--autopilot',
         'ardupilot', '--port', str(port), '--exec',
         f'{ARDUPILOT} --pids {pids} --flying {flying}', '--record', str(log), '--json', '-'],
        env={**os.environ, 'PYTHONPATH': str(ROOT)}, stdout=subprocess.PIPE,
        stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    assert waited(flying.exists, 30.0)
    family = [int(pid) for pid in pids.read_text().split()]
    assert all(map(alive, family))
    run.send_signal(number)
    out, err = run.communicate(timeout=20.0)
    assert waited(lambda: not any(map(alive, family)), 10.0)
    if number != signal.SIGKILL:
        assert run.returncode == 0
        result = json.loads(out)
        assert result['interrupted'] == signal.Signals(number).name
        assert result['autopilot']['answered'] > 0
        assert 'states were answered' in err
        assert open_log(log).topic('/x500/cmd/thrust')
        assert result['record_fault'] == ''


def test_what_it_has_started_in_a_session_of_its_own_ends_too(tmp_path):
    pid = tmp_path / 'pid'
    script = f'setsid sh -c "echo \\$\\$ > {pid}; exec sleep 1000" & exec sleep 1000'
    program = started(shlex.join(['sh', '-c', script]), print)
    assert waited(lambda: pid.exists() and pid.read_text())
    program.close()
    assert program.exit_code == -signal.SIGTERM
    assert waited(lambda: not alive(int(pid.read_text())))
