# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``fluid_sim run`` and ``doctor`` with an autopilot, its program, and logs that fly again."""

import json
import random
import shlex
import sys
import threading
from time import sleep

import pytest

from fluid_sim_ros.cli import main
from fluid_sim_ros.cli.flight import AutopilotRun
from fluid_sim_ros.cli.run import run_scene
from fluid_sim_ros.loop.autopilot_port import AutopilotOptions
from fluid_sim_ros.mavlink import silence
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.recording.replay.resimulate import resimulate
from test.support.autopilots.ardupilot_stand_in import Copter, Link, padded
from test.support.autopilots.autopilot_peers import free_port
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
    result = json.loads(out)
    assert result['vehicles']['x500']['position_w_m'][2] > 1.0
    flown = result['autopilot']
    assert (flown['exit_code'], flown['fault'], flown['restarts']) == (None, '', 0)
    assert flown['answered'] <= flown['sent'] == 999
    assert (flown['missed'], flown['late'], flown['repeated'], flown['malformed']) == (0,) * 4
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
    assert (seen['state'], seen['fault']) == ('ok: in lockstep', '')
    assert seen['peer'].startswith('127.0.0.1:')
    assert seen['answered'] > 10
    assert len(seen['last_outputs']) == 16


@pytest.mark.parametrize(
    ('protocol', 'reason'),
    [
        ('px4', 'PX4 is not started, or not with an airframe of a simulation'),
        ('ardupilot', 'ArduPilot is not started, or without --model JSON:127.0.0.1'),
    ],
)
def test_a_doctor_that_hears_nothing_fails_and_says_why(protocol, reason, capsys):
    arguments = ['doctor', '--autopilot', protocol, '--port', str(free_port(protocol)),
                 '--seconds', '0.2', '--json', '-']  # fmt: skip
    assert main(arguments) == 1
    out, err = capsys.readouterr()
    seen = json.loads(out)
    assert seen['reasons'][0].startswith(reason)
    assert err.splitlines()[-1] == 'fluid_sim: nothing was heard within 0.2 s'


def test_the_doctor_ends_with_the_program(capsys, instance):
    arguments = ['doctor', '--autopilot', 'px4', '--instance', str(instance), '--exec', 'false']
    assert main(arguments) == 1
    line = 'fluid_sim: the autopilot ended with code 1 before it answered'
    assert capsys.readouterr().err.splitlines()[-1] == line


def test_every_file_of_a_log_is_named(tmp_path, capsys):
    log, port = tmp_path / 'flight.mcap', free_port('ardupilot')

    def fly():
        for _ in range(3):  # the same process again and again
            link = Link(port)
            for _ in range(30):
                link.exchange(padded([1600] * 4))
            link.close()
            sleep(silence.REPORT_AFTER + 0.1)  # until then it is a stranger

    autopilot = threading.Thread(target=fly)
    autopilot.start()
    arguments = ['run', 'x500_ground', '--autopilot', 'ardupilot', '--port', str(port),
                 '--record', str(log), '--timeout', '1.5', '--on-timeout', 'stop']  # fmt: skip
    assert main(arguments) == 1
    autopilot.join()
    out, err = capsys.readouterr()
    named = [line.removeprefix('Log: ') for line in out.splitlines() if line.startswith('Log: ')]
    assert len(named) == 3
    assert sorted(map(str, tmp_path.iterdir())) == sorted(named)
    assert err.splitlines()[-1] == 'fluid_sim: ArduPilot: no answer for 1.5 s: stopped'
    # what is between two restarts counts for each of them
    assert 'ardupilot: 87 of 90 states were answered; missed 0, late 0' in err
