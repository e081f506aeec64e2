# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Processes that judge seeds: each seed is told once, in order, whatever crashes or hangs."""

import os
import textwrap

import pytest

from benchmarks.robustness.workers import Worker, in_portions
from test.support.hostile.files import KINDS as FILES
from test.support.hostile.foreign.kinds import KINDS as FOREIGN
from test.support.paths import ROOT

_JUDGE = """
    import os, sys, time
    from benchmarks.robustness.workers import serve

    def judge(seed):
        if seed == 7:
            print('killed by seed 7', file=sys.stderr, flush=True)
            os.abort()
        if seed == 12:
            time.sleep(60)
        last[0] = seed
        print('noise that is no JSON')
        return {'seed': seed, 'outcome': 'read', 'line': ''}

    def end():
        if last[0] == 18:  # what its last seed has left ends the process
            os.abort()
        return {'children': 5}

    last = [0]
    serve(judge, end)
"""


@pytest.fixture
def made(tmp_path):
    """Return what makes workers of a module."""

    def make(text):
        (tmp_path / 'judge_of_a_test.py').write_text(textwrap.dedent(text), encoding='utf-8')
        path = os.pathsep.join((str(tmp_path), str(ROOT)))
        environment = os.environ | {'PYTHONPATH': path}
        return lambda: Worker('judge_of_a_test', [], tmp_path, environment, patience=0.4)

    return make


def test_each_seed_is_told_once_in_order_whatever_crashes_or_hangs(made):
    portions = list(in_portions(made(_JUDGE), range(3, 21), 4, 1e9, workers=2))
    told = [line for portion in portions for line in portion if 'outcome' in line]
    assert [line['seed'] for line in told] == list(range(3, 21))
    outcomes = {line['seed']: line['outcome'] for line in told if line['outcome'] != 'read'}
    assert outcomes == {7: 'crash', 12: 'hang', 18: 'crash'}
    assert 'killed by seed 7' in next(line['line'] for line in told if line['seed'] == 7)
    assert [line['children'] for portion in portions for line in portion if 'done' in line]


def test_nothing_begins_after_the_time_is_over(made):
    assert list(in_portions(made(_JUDGE), range(5), 2, -1.0, workers=1)) == []


def test_a_worker_that_cannot_start_is_an_error(made):
    worker = made("raise SystemExit('no such thing')")()
    with pytest.raises(RuntimeError, match='no such thing'):
        worker.judged(0, 3)
    worker.close()


@pytest.mark.parametrize(
    'kind', ['yaml', *(pytest.param(k, marks=pytest.mark.full) for k in ('log', *FILES, *FOREIGN))]
)
def test_a_worker_of_each_kind_of_hostile_file_tells_of_its_seeds(kind):
    environment = {'MUJOCO_GL': 'egl', **os.environ, 'PYTHONPATH': str(ROOT)}
    module = 'benchmarks.robustness.hostile_files'
    worker = Worker(module, ['--worker', kind], ROOT, environment, patience=60)
    try:
        told = worker.judged(0, 2) + worker.judged(2, 3)
    finally:
        worker.close()
    assert [line['seed'] for line in told if 'outcome' in line] == [0, 1, 2]
