"""``fluid_sim run`` and ``doctor`` with an autopilot, its program, and logs that fly again."""

import json
import random
import shlex
import sys
import threading

import pytest

from fluid_sim_ros.cli import main
from fluid_sim_ros.cli.flight import AutopilotRun
from fluid_sim_ros.cli.run import run_scene
from fluid_sim_ros.loop.autopilot_port import AutopilotOptions
from fluid_sim_ros.mavlink.mapping import load_mapping
from fluid_sim_ros.mavlink.program.program import Program, command_line
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.recording.replay.resimulate import resimulate
from fluid_sim_ros.schema.scene import Home
from test.support.autopilots.ardupilot_stand_in import Copter, Link, padded
from test.support.autopilots.autopilot_peers import free_port, waited
from test.support.paths import ROOT

PROGRAM = 'test.support.autopilots.px4_program'
COMMAND = shlex.join(['env', f'PYTHONPATH={ROOT}', sys.executable, '-m', PROGRAM])


@pytest.fixture
def instance():
    """Give the number of an instance whose port nobody listens on."""
    while True:
        port = free_port('px4')
        if port > 4560:
            return port - 4560


def test_a_program_is_started_flown_with_and_ended(tmp_path, instance, capfd):
    log = tmp_path / 'flight.mcap'
    arguments = [
        'run', 'x500_ground', '--autopilot', 'px4', '--instance', str(instance), '--duration', '4',
        '--exec', COMMAND, '--record', str(log), '--json', '-',
    ]  # fmt: skip
    assert main(arguments) == 0
    out, err = capfd.readouterr()
    assert json.loads(out)['vehicles']['x500']['position_w_m'][2] > 1.0
    assert f'airframe 10016, instance {instance}' in err
    assert 'states were answered' in err
    # without the autopilot, its commands give the same flight
    again = resimulate(open_log(log))
    assert again.commands > 900
    assert again.compared > 1000
    assert again.difference is None


def test_a_flight_with_changing_frames_repeats_bit_by_bit(tmp_path):
    log, port = tmp_path / 'flight.mcap', free_port('ardupilot')
    run = AutopilotRun(AutopilotOptions('ardupilot', port=port))

    def fly():
        link, copter, rng = Link(port), Copter((0.0, 0.0, -2.0), 0.77), random.Random(5)
        state = link.exchange(padded([1000] * 4))
        while state['timestamp'][0] < 1.8:
            link.rate = rng.choice((1200, 1111, 800, 400, 300))
            state = link.exchange(copter.pulses(state))
        link.rate = 11  # the last frame reaches beyond the end of the run
        link.socket.send(link.packet(copter.pulses(state)))

    autopilot = threading.Thread(target=fly)
    autopilot.start()
    run_scene('x500_ground', duration=1.85, record=log, autopilot=run)
    autopilot.join()
    again = resimulate(open_log(log))
    assert again.commands > 1000
    assert again.compared > 1000
    assert again.difference is None


def test_the_run_ends_with_its_program(instance):
    command = f'{sys.executable} -c "print(1 + 1)"'
    run = AutopilotRun(AutopilotOptions('px4', instance=instance), command)
    assert run_scene('x500_ground', autopilot=run)['steps'] == 0


def test_a_program_that_does_not_listen_to_requests_is_ended(instance):
    lines: list[str] = []
    command = f'{sys.executable} -c "print(5, flush=True); import time; time.sleep(60)"'
    file, _ = load_mapping('px4', 'x500')
    program = Program(command, AutopilotOptions('px4'), file, Home(), lines.append)
    assert waited(lambda: lines == ['5'])
    program.close()
    assert program.exit_code is not None


def test_command_lines(tmp_path):
    px4, _ = load_mapping('px4', 'x500')
    options = AutopilotOptions('px4', instance=2)
    command = command_line('bin/px4 -w "a b"', options, px4, Home(), tmp_path)
    assert command == ['bin/px4', '-w', 'a b', '-d', '-i', '2']
    sub, _ = load_mapping('ardupilot', 'bluerov2')
    options = AutopilotOptions('ardupilot', instance=1)
    home = Home(latitude=1.5, longitude=-2.0)
    command = command_line('ardusub', options, sub, home, tmp_path)
    assert command == [
        'ardusub', '--model', 'JSON:127.0.0.1', '--home', '1.5,-2.0,0.0,90', '--speedup', '100',
        '-I', '1', '--defaults', str(tmp_path / 'parameters.parm'),
    ]  # fmt: skip
    assert (tmp_path / 'parameters.parm').read_text() == 'FRAME_CONFIG 1\n'
    command = command_line('ardusub --defaults mine.parm', options, sub, home, tmp_path)
    assert command.count('--defaults') == 1


@pytest.mark.parametrize(
    ('arguments', 'line'),
    [
        (['--exec', 'px4'], '--exec needs --autopilot'),
        (['--instance', '1'], '--instance needs --autopilot'),
        (['--autopilot', 'px4', '--exec', '/no/px4'], '--exec /no/px4: No such file or directory'),
        (['--autopilot', 'px4', '--exec', '"'], '--exec ": No closing quotation'),
        (['--autopilot', 'px4', '--port', '70000'], 'port 70000'),
        (['--autopilot', 'px4', '--mapping', 'none.yaml'], 'none.yaml: no such file'),
    ],
)
def test_wrong_options_are_named_in_one_line(arguments, line, instance, capsys):
    if '--autopilot' in arguments and '--port' not in arguments:
        arguments = [*arguments, '--instance', str(instance)]
    assert main(['run', 'x500_ground', '--duration', '1', *arguments]) == 2
    err = capsys.readouterr().err
    assert line in err


def test_the_doctor_shows_what_it_sees(capsys, instance):
    arguments = ['doctor', '--autopilot', 'px4', '--instance', str(instance), '--seconds', '2',
                 '--exec', COMMAND, '--json', '-']  # fmt: skip
    assert main(arguments) == 0
    seen = json.loads(capsys.readouterr().out)
    assert seen['state'] == 'ok: in lockstep'
    assert seen['peer'].startswith('127.0.0.1:')
    assert seen['answered'] > 10
    assert len(seen['last_outputs']) == 16
