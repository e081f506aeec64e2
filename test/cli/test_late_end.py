# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""An end that does not come is cut; a program leaves without waiting for what may never end."""

import pytest

from test.support.signalled import program, run_code


def test_an_end_that_takes_too_long_is_cut():
    done = program("""
        late_end.LONGEST_END = 0.1
        try:
            kill()
        finally:
            time.sleep(20)
    """)
    line = 'x: ended at once, since an end in order took over 0.1 s\n'
    assert (done.returncode, done.stderr) == (143, line)


LIBRARY = "import hashlib; hashlib.pbkdf2_hmac('sha256', b'x', b'y', 2**31 - 1)"  # for an hour


@pytest.mark.parametrize(
    'takes',
    [
        'begin("x"); begun()',
        'begin("x")',
        'from fluid_sim_ros.ros.process.signals import EndSignals; EndSignals("x")',
    ],
)
def test_a_signal_while_a_library_works_in_the_main_thread_ends_it(takes):
    """Python's own handlers would run when the library returns."""
    done = run_code(f"""
        import os, signal, threading
        from fluid_sim_ros.interruption import *
        from fluid_sim_ros.interruption import late_end
        late_end.LONGEST_END = 0.1
        {takes}
        threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGTERM)).start()
        {LIBRARY}
    """)
    assert done.returncode == 143
    assert done.stderr == 'x: ended at once, since an end in order took over 0.1 s\n'


def test_a_block_that_is_held_is_not_cut():
    done = program("""
        late_end.LONGEST_END = 0.2
        try:
            with held():
                kill()
                time.sleep(0.5)
                print('finished')
        except Interrupted as error:
            leave(error.code)
    """)
    assert (done.returncode, done.stdout, done.stderr) == (143, 'finished\n', '')


@pytest.mark.parametrize('start', ['', 'program._present = None\n'])  # a command, a node
def test_a_program_whose_exit_function_waits_for_ever_leaves_with_its_code(start):
    done = program(f"""
        import atexit
        late_end.LONGEST_END = 0.1
        atexit.register(time.sleep, 20)
        {start}
        settle()
        leave(3)
    """)
    assert (done.returncode, done.stdout, done.stderr) == (3, '', '')


def test_a_program_leaves_without_waiting_for_its_threads():
    done = program("""
        import threading
        threading.Thread(target=time.sleep, args=(20,)).start()
        print('told')
        settle()
        leave(0)
    """)
    assert (done.returncode, done.stdout, done.stderr) == (0, 'told\n', '')


def test_an_interrupted_program_leaves_without_waiting_for_its_threads():
    done = program("""
        import atexit, threading
        threading.Thread(target=time.sleep, args=(20,)).start()
        atexit.register(print, 'exit function')
        try:
            kill()
        except Interrupted as error:
            print('told')
            leave(error.code)
    """)
    assert (done.returncode, done.stdout, done.stderr) == (143, 'told\nexit function\n', '')
