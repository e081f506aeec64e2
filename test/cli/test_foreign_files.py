# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Hostile files of other software and of settings: read, or refused in one line, in bounds."""

import pytest

from test.support.hostile.foreign.kinds import KINDS, foreign_file, opened
from test.support.hostile.judge import Outside, judged

#: Kinds with a process for each file, or a picture, which take a second.
SLOW = ('xacro', 'mjcf', 'chart')


def check(kind, seeds, folder, monkeypatch):
    if kind in ('stl', 'obj', 'ply', 'off', 'glb', 'dae'):
        pytest.importorskip('trimesh')
    outside = Outside(folder)
    for seed in seeds:
        monkeypatch.chdir(outside.working)
        path = foreign_file(kind, seed, outside.working, outside.kept)
        size = path.stat().st_size
        verdict = judged(lambda path=path, seed=seed: opened(kind, path, seed), size)
        monkeypatch.chdir('/')
        assert verdict.right, (seed, verdict)
        assert not outside.changed(), seed
        assert not outside.told(verdict), seed
        outside.clear()


@pytest.mark.filterwarnings('ignore')
@pytest.mark.parametrize('kind', KINDS)
def test_hostile_files_of_others_are_read_or_refused(kind, tmp_path, monkeypatch):
    count = 2 if kind in SLOW else 9
    check(kind, range(10**6 + 1, 10**6 + 1 + count), tmp_path, monkeypatch)


@pytest.mark.full
@pytest.mark.filterwarnings('ignore')
@pytest.mark.timeout(3600)
@pytest.mark.parametrize('kind', KINDS)
def test_hundreds_of_hostile_files_of_others(kind, tmp_path, monkeypatch):
    count = 100 if kind in SLOW else 400
    check(kind, range(2 * 10**6, 2 * 10**6 + count), tmp_path, monkeypatch)


@pytest.mark.filterwarnings('ignore')
@pytest.mark.parametrize(('kind', 'seed'), [('ulg', 1409), ('chart', 81), ('flight_csv', 584)])
def test_what_the_large_volumes_found(kind, seed, tmp_path, monkeypatch):
    """A topic without times, orders of convergence that are none, 60,000 columns."""
    check(kind, [seed], tmp_path, monkeypatch)
