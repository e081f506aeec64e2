# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""SIGINT and SIGTERM at any moment: no traceback, the stated exit code, nothing left behind."""

import random
import signal
import textwrap

import pytest

from fluid_sim_ros.recording.reader import open_log
from test.support.kills import Killer
from test.support.recorded_flights import record_flight
from test.support.signalled import program, run_code

INT, TERM, KILL = signal.SIGINT, signal.SIGTERM, signal.SIGKILL

#: A program that is signalled in the moment in which a module is looked for.
AT_IMPORT = """
    import os, sys
    class Signal:
        def find_spec(self, name, path=None, target=None):
            if name == {module!r}:
                os.kill(os.getpid(), {number})
    sys.meta_path.insert(0, Signal())
    sys.argv = {words!r}
    {start}
"""
COMMAND = 'from fluid_sim_ros.cli import main; sys.exit(main())'
NODE = 'from fluid_sim_ros.ros.executables import fluid_sim_node; fluid_sim_node()'


def signalled(module, number, start, *words):
    return run_code(AT_IMPORT.format(module=module, number=int(number), words=words, start=start))


@pytest.mark.parametrize(
    ('module', 'number', 'words'),
    [
        ('rich_argparse', INT, ['run', 'sphere']),  # the command line itself
        ('numpy', TERM, ['run', 'sphere']),
        pytest.param('mujoco._structs', INT, ['run', 'sphere'], marks=pytest.mark.full),
        pytest.param('rclpy', TERM, ['replay', 'LOG'], marks=pytest.mark.full),
    ],
)
def test_a_signal_at_any_import_of_a_command(tmp_path, monkeypatch, module, number, words):
    monkeypatch.chdir(tmp_path)
    if 'LOG' in words:
        record_flight(tmp_path / 'a.mcap', 'sphere', seconds=0.1)
        words = ['replay', 'a.mcap']
    done = signalled(module, number, COMMAND, '/bin/fluid_sim', *words)
    assert (done.returncode, done.stderr) == (128 + number, 'fluid_sim: interrupted\n')
    assert not done.stdout


def test_a_signal_before_the_first_step_leaves_a_log_that_reads(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    module = 'fluid_sim_ros.recording.recorder'
    words = ['/bin/fluid_sim', 'run', 'sphere', '--record', 'x.mcap']
    done = signalled(module, TERM, COMMAND, *words)
    assert (done.returncode, done.stderr) == (143, '')
    assert '0 s in' in done.stdout and 'ended by SIGTERM' in done.stdout
    log = open_log(tmp_path / 'x.mcap')
    assert not log.faults and log.description().run['scene']['name'] == 'sphere'


@pytest.mark.ros
@pytest.mark.parametrize(('module', 'number'), [('rclpy', INT), ('mujoco', TERM)])
def test_a_signal_at_any_import_of_the_node(module, number):
    done = signalled(module, number, NODE, 'fluid_sim_node')
    assert (done.returncode, done.stderr, done.stdout) == (0, '', '')


@pytest.mark.ros
@pytest.mark.parametrize(
    ('module', 'code', 'line'),
    [('fluid_sim_ros.cli', 130, 'fluid_sim: interrupted\n'), ('fluid_sim_ros.ros.node', 0, '')],
)
def test_what_is_run_with_m_takes_signals_from_its_first_line(tmp_path, module, code, line):
    # Python imports this one at its start
    (tmp_path / 'sitecustomize.py').write_text(
        textwrap.dedent("""
        import os, sys
        class Signal:
            def find_spec(self, name, path=None, target=None):
                if name in ('argparse', 'rclpy'):
                    os.kill(os.getpid(), 2)
        sys.meta_path.insert(0, Signal())
    """)
    )
    start = f'import os; sys.path.insert(0, {str(tmp_path)!r})'
    command = f'os.environ["PYTHONPATH"] = os.pathsep.join(sys.path); os.execv(sys.executable, ' \
        f'[sys.executable, "-m", {module!r}, "run", "sphere"])'  # fmt: skip
    done = run_code(f'import sys; {start}; {command}')
    assert (done.returncode, done.stderr) == (code, line)


@pytest.mark.ros
def test_signals_at_seeded_moments_of_start_flight_and_end(tmp_path):
    killer, chance = Killer(tmp_path), random.Random(15)
    kills = []
    for name, count in (('run', 3), ('node', 2), ('resimulate', 1), ('sweep', 1)):
        for i in range(count):
            number = (INT, TERM, KILL)[i % 3]
            kills.append(killer.kill(name, number, chance.uniform(0.0, 1.6)))
    assert [kill for kill in kills if kill.wrong] == []


# ---- the states of a program ---------------------------------------------------------------


def test_a_held_block_is_finished_first():
    done = program("""
        try:
            with held():
                kill()
                print('finished')
            print('not reached')
        except Interrupted as error:
            print(error.code)
    """)
    assert (done.stdout, done.stderr) == ('finished\n143\n', '')


def test_a_signal_during_an_import_comes_behind_it_also_where_a_block_holds_it(tmp_path):
    (tmp_path / 'slow.py').write_text('kill()\ntime.sleep(0.05)\n')
    done = program(f"""
        import builtins
        builtins.kill, builtins.time = kill, time
        sys.path.insert(0, {str(tmp_path)!r})
        try:
            with held():
                import slow
                print('whole')
            print('not reached')
        except Interrupted as error:
            print(error.code)
    """)
    assert (done.stdout, done.stderr) == ('whole\n143\n', '')


def test_an_interruption_where_python_forgets_exceptions_comes_again():
    done = program("""
        class Ended:
            def __del__(self):
                kill()
        import weakref
        for forget in (lambda: Ended(), lambda: weakref.finalize(lambda: 0, kill)):
            program._present.number = 0
            try:
                forget()
                time.sleep(20)
            except Interrupted as error:
                print(error.code)
    """)
    assert (done.stdout, done.stderr) == ('143\n143\n', '')


def test_a_second_signal_at_once_is_the_same_wish_and_a_later_one_ends_it():
    done = program("""
        try:
            kill()
        except Interrupted:
            kill()
            handler.SAME_WISH = 0.0
            try:
                kill(signal.SIGINT)
            finally:
                print('not reached')
    """)
    line = 'x: ended at once by a second signal; a log may lack its end\n'
    assert (done.returncode, done.stdout, done.stderr) == (130, '', line)


def test_a_signal_after_the_result_changes_nothing():
    done = program("""
        settle()
        kill()
        print('all of it')
        leave(3)
    """)
    assert (done.returncode, done.stdout, done.stderr) == (3, 'all of it\n', '')


def test_whoever_calls_a_run_keeps_signals_of_his_own():
    def mine(*_):
        raise AssertionError

    from fluid_sim_ros.cli.run import run_scene

    before = signal.signal(TERM, mine)
    try:
        assert run_scene('sphere', duration=0.1)['interrupted'] == ''
        assert signal.getsignal(TERM) is mine
    finally:
        signal.signal(TERM, before)


def test_a_library_that_takes_signals_for_itself_does_not_have_them():
    done = program("""
        try:
            with held(from_library=True):  # as Ray does when it is imported
                signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(number))
                kill()
                print('finished')
            print('not reached')
        except KeyboardInterrupt:
            print(interrupted_by())
    """)
    assert (done.stdout, done.stderr) == ('finished\n143\n', '')
