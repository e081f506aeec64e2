# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Small things that make the command line feel cared for."""

import json
import os
import pty
import re
import signal
import subprocess
import sys
import time

import pytest

from fluid_sim_ros import cli, scene_names
from fluid_sim_ros.cli import completion
from fluid_sim_ros.cli.main import _build_parser
from fluid_sim_ros.cli.parser import Parser
from fluid_sim_ros.cli.tables import short, table_of
from fluid_sim_ros.schema.settings import FLUID_RUNGS, INTEGRATORS

PROGRAM = [sys.executable, '-m', 'fluid_sim_ros.cli']
COLOUR = '\x1b['


def refusal(capsys, *arguments):
    """Run a command that fails; return its help or table, and its one line of error."""
    try:
        code = cli.main([*arguments])
    except SystemExit as end:
        code = end.code
    captured = capsys.readouterr()
    assert code == 2
    (line,) = captured.err.strip().splitlines()
    return captured.out, line


def on_terminal(*arguments, columns=80):
    """Run a command with its output and errors on a terminal; return what that showed."""
    ours, theirs = pty.openpty()
    environment = {**os.environ, 'TERM': 'xterm-256color', 'COLUMNS': str(columns)}
    environment.pop('NO_COLOR', None)
    process = subprocess.Popen(
        [*PROGRAM, *arguments], stdout=theirs, stderr=theirs, env=environment
    )
    os.close(theirs)
    shown = b''
    while True:
        try:
            data = os.read(ours, 65536)
        except OSError:  # the other end is closed
            break
        if not data:
            break
        shown += data
    os.close(ours)
    assert process.wait(30) == 0
    return shown.decode()


# ---- help and what was meant ---------------------------------------------------------------


@pytest.mark.parametrize(
    ('arguments', 'usage'),
    [([], 'Usage: fluid_sim '), (['run'], 'Usage: fluid_sim run '),
     (['new-vehicle'], 'Usage: fluid_sim new-vehicle '), (['plot'], 'Usage: fluid_sim plot ')],
)  # fmt: skip
def test_help_when_called_bare(capsys, arguments, usage):
    shown, line = refusal(capsys, *arguments)
    assert shown.startswith(usage)
    assert 'required' in line


def test_a_command_that_needs_nothing_runs_when_called_bare(capsys):
    assert cli.main(['stability']) == 0
    shown = capsys.readouterr().out
    assert 'Usage' not in shown and 'Stability problems' in shown


@pytest.mark.parametrize(
    ('arguments', 'meant'),
    [
        (['rnu', 'rov'], "COMMAND 'rnu' is not known; did you mean 'run'?"),
        (['stabilty'], "did you mean 'stability'?"),
        (['run', 'quadrator'], "scene 'quadrator' is not known; did you mean 'quadrotor'?"),
        (['advise', 'BlueROV', '--tolerance', '.1'], "did you mean 'bluerov2'?"),
        (['run', 'rov', '--duraton', '1'], "'--duraton' is not known; did you mean '--duration'?"),
        (['run', 'rov', '--duraton=1'], "did you mean '--duration'?"),
        (['run', 'rov', '--pacing', 'relatime'], "did you mean 'realtime'?"),
        (['run', 'rov', '--integrator', 'implicitfas'], "did you mean 'implicitfast'?"),
        (['run', 'rov', '--fluid', 'elipsoid'], "did you mean 'ellipsoid'?"),
        (['run', 'x500', '--keyframe', 'hove'], "did you mean 'hover'?"),
        (['run', 'x500_ground', '--autopilot', 'px4', '--vehicle', 'x550'],
         "did you mean 'x500'?"),
        (['run', 'x500_ground', '--autopilot', 'px4', '--mapping', 'px4_x50'],
         "did you mean 'px4_x500'?"),
        (['chart', 'kirchof'], "problem 'kirchof' is not known; did you mean 'kirchhoff'?"),
        (['chart', 'rvo'], "did you mean 'rov'?"),
        (['stability', 'tumbling'], 'stability problem'),
        (['stability', 'drag', '--x', 'timestp'], "did you mean 'timestep'?"),
        (['advise', 'rov', '--tolerance', '.1', '--metric', 'positon'],
         "did you mean 'position'?"),
    ],
)  # fmt: skip
def test_did_you_mean(capsys, arguments, meant):
    _, line = refusal(capsys, *arguments)
    assert meant in line


def test_nothing_is_meant_by_a_word_that_is_like_no_other(capsys):
    _, line = refusal(capsys, 'run', 'xyzzy')
    assert 'did you mean' not in line
    assert f'scenes: {", ".join(scene_names())}' in line


def test_discrete_in_the_help_of_integrator(capsys):
    with pytest.raises(SystemExit):
        cli.main(['run', '--help'])
    assert re.search(r'--integrator NAME .*discrete', capsys.readouterr().out)
    assert {name.lower() for name in completion.INTEGRATORS} == set(INTEGRATORS)
    assert completion.FLUIDS == FLUID_RUNGS


@pytest.mark.parametrize(
    'arguments',
    [
        ['render', 'a.mcap', '--fps', 'inf'], ['render', 'a.mcap', '--speed', '0'],
        ['render', 'a.mcap', '--size', '640', '0'], ['replay', 'a.mcap', '--rate', 'nan'],
        ['chart', 'stokes', '--rounds', '0'], ['doctor', '--autopilot', 'px4', '--seconds', '-1'],
        ['doctor', '--autopilot', 'px4', '--seconds', 'nan'],
        ['run', 'x500_ground', '--autopilot', 'px4', '--instance', '-1'],
    ],
)  # fmt: skip
def test_a_number_out_of_its_range_is_refused_with_the_range(capsys, arguments):
    _, line = refusal(capsys, *arguments)
    assert re.search(r'must be (above \d|\d or more) \(got', line)


def test_help_is_coloured_on_a_terminal_and_plain_elsewhere():
    assert COLOUR in on_terminal('run', '--help')
    piped = subprocess.run([*PROGRAM, 'run', '--help'], capture_output=True, text=True, check=True)
    assert COLOUR not in piped.stdout
    assert '[m/s], east' in ' '.join(piped.stdout.split())  # units are no markup


# ---- shell completion ----------------------------------------------------------------------


def completed(line, tmp_path):
    """Return the words that a shell is offered at the end of a line."""
    out = tmp_path / 'words'
    environment = {
        **os.environ, '_ARGCOMPLETE': '1', 'COMP_LINE': line, 'COMP_POINT': str(len(line)),
        '_ARGCOMPLETE_STDOUT_FILENAME': str(out), '_ARGCOMPLETE_IFS': '\n', 'COMP_TYPE': '9',
    }  # fmt: skip
    code = 'import sys; sys.argv = ["fluid_sim"]; from fluid_sim_ros.cli import main; main()'
    subprocess.run([sys.executable, '-c', code], env=environment, cwd=tmp_path, check=True)
    return {word.strip() for word in out.read_text().split('\n') if word.strip()}


def test_shell_completion_of_commands_options_scenes_and_files(tmp_path):
    (tmp_path / 'rocket.xml').write_text('')
    (tmp_path / 'notes.txt').write_text('')
    (tmp_path / 'flight.mcap').write_text('')
    assert {'run', 'render', 'repair', 'replay'} == completed('fluid_sim r', tmp_path)
    assert {'--duration', '--record'} <= completed('fluid_sim run --', tmp_path)
    assert completed('fluid_sim run ro', tmp_path) == {'rov', 'rocket.xml'}
    assert {*scene_names(), 'rocket.xml'} <= completed('fluid_sim run ', tmp_path)
    assert completed('fluid_sim run rov --integrator impl', tmp_path) == {
        'implicit', 'implicitfast'
    }  # fmt: skip
    assert completed('fluid_sim plot ', tmp_path) == {'flight.mcap'}
    assert 'kirchhoff' in completed('fluid_sim chart k', tmp_path)
    assert completed('fluid_sim stability tum', tmp_path) == {'tumbling_drag'}


@pytest.mark.parametrize('shell', completion.SHELLS)
def test_completion_prints_what_a_shell_runs(capsys, shell):
    assert cli.main(['completion', shell]) == 0
    assert 'fluid_sim' in capsys.readouterr().out


def test_bash_takes_the_completion(capsys):
    cli.main(['completion', 'bash'])
    script = capsys.readouterr().out + '\ncomplete -p fluid_sim'
    done = subprocess.run(['bash', '-c', script], capture_output=True, text=True, check=True)
    assert done.stdout.strip().endswith('fluid_sim')


# ---- run -----------------------------------------------------------------------------------


def test_run_starts_at_a_keyframe(capsys):
    at = {}
    for keyframe in ('hover', 'dive'):
        options = ['--keyframe', keyframe, '--duration', '.002', '--json', '-']
        assert cli.main(['run', 'amphibious', *options]) == 0
        result = json.loads(capsys.readouterr().out)
        at[keyframe] = result['vehicles']['amphibious']['position_w_m'][2]
    assert at['hover'] - at['dive'] > 1


def test_a_live_status_line_with_pacing_realtime():
    shown = on_terminal('run', 'rov', '--pacing', 'realtime', '--duration', '1')
    lines = re.findall(r'(\d\.\d) s  (\d\.\d\d) x  bluerov2_heavy at .*? m, \d+\.\d\d m/s', shown)
    assert len(lines) >= 3
    assert 0.5 < float(lines[-1][1]) < 1.2
    assert 'rov: 1 s in' in shown


@pytest.mark.parametrize(
    ('number', 'code'),
    [(signal.SIGINT, 130), pytest.param(signal.SIGTERM, 143, marks=pytest.mark.full)],
)
def test_the_result_is_shown_and_the_log_closed_on_ctrl_c(number, code, tmp_path):
    log, result = tmp_path / 'a.mcap', tmp_path / 'a.json'
    process = subprocess.Popen(
        [*PROGRAM, 'run', 'rov', '--pacing', 'realtime', '--duration', '60', '--record', str(log),
         '--json', str(result)],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    deadline = time.monotonic() + 30
    while not (log.exists() and log.stat().st_size > 20_000):
        assert time.monotonic() < deadline and process.poll() is None
        time.sleep(0.05)
    process.send_signal(number)
    shown, errors = process.communicate(timeout=30)
    assert process.returncode == code, errors
    assert 'bluerov2_heavy' in shown and number.name in shown
    assert 0 < json.loads(result.read_text())['duration_s'] < 60
    assert cli.main(['info', str(log), '--json', str(tmp_path / 'info.json')]) == 0
    assert json.loads((tmp_path / 'info.json').read_text())['faults'] == []


# ---- tables --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    'arguments',
    [
        ['scenes'], ['chart'], ['stability'], ['doctor', 'rov'],
        ['run', 'bluerov2_waves', '--duration', '.1'], ['run', 'amphibious', '--duration', '.1'],
        *(pytest.param(words, marks=pytest.mark.full) for words in (
            ['stability', 'drag', '--cells', '2', '--out', '{tmp}'],
            ['advise', 'sphere', '--tolerance', '.1', '--budget', '5'],
            ['chart', 'stokes', '--timesteps', '.01', '.005', '--rounds', '1', '--out', '{tmp}'],
        )),
    ],
)  # fmt: skip
def test_tables_fit_80_columns(capsys, monkeypatch, tmp_path, arguments):
    monkeypatch.setenv('COLUMNS', '80')
    assert cli.main([word.format(tmp=tmp_path) for word in arguments]) in (0, 1)
    lines = capsys.readouterr().out.splitlines()
    table = [line for line in lines if line[:1] in '┏┃┡│└']
    assert table and max(map(len, table)) <= 80
    assert not any('…' in line for line in table)  # nothing is cut off


def test_a_column_that_says_nothing_is_left_out():
    table = table_of(('a', 'b', 'c'), [('x', '', '0'), ('y', '', '[1]')])
    assert [column.header for column in table.columns] == ['a', 'c']
    zeros = table_of(('a', 'b'), [('x', '0'), ('y', '0')], idle=('0',))
    assert [column.header for column in zeros.columns] == ['a']
    assert [short(value) for value in (1.23456789, -4e-17, 0.0)] == ['1.2346', '0', '0']


def test_every_positional_argument_and_file_option_is_completed():
    parser = _build_parser()
    assert isinstance(parser, Parser)
    for name, command in parser.commands.items():
        for action in command._actions:
            if action.dest in ('scene', 'problem', 'log', 'logs', 'file', 'mesh', 'model'):
                assert hasattr(action, 'completer'), (name, action.dest)
