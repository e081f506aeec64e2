# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Hostile files that a scene names: read, or refused in one line; memory and time bounded."""

import numpy as np
import pytest

from fluid_sim_ros.errors import ConfigError, LimitError
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.scene.grid_files import check_packed, pack, read_grid, unpack
from fluid_sim_ros.scene.weather_files import read_csv
from test.support.hostile.files import KINDS, hostile_file
from test.support.hostile.judge import Outside, judged


def check(kind, seeds, folder, monkeypatch):
    outcomes = set()
    outside = Outside(folder)
    for seed in seeds:
        path = hostile_file(kind, seed, outside.working)
        size = sum(file.stat().st_size for file in outside.working.iterdir())
        monkeypatch.chdir(outside.working)
        verdict = judged(lambda path=path: Scene.load(path).compile(), size)
        monkeypatch.chdir('/')
        assert verdict.right, (seed, verdict)
        assert not outside.changed(), seed
        outcomes.add(verdict.outcome)
        outside.clear()
    assert outcomes == {'read', 'refused'}


@pytest.mark.filterwarnings('ignore')
@pytest.mark.parametrize('kind', KINDS)
def test_hostile_files_are_read_or_refused(kind, tmp_path, monkeypatch):
    check(kind, range(10**6, 10**6 + 30), tmp_path, monkeypatch)


@pytest.mark.full
@pytest.mark.filterwarnings('ignore')
@pytest.mark.timeout(3600)
@pytest.mark.parametrize('kind', KINDS)
def test_a_thousand_hostile_files(kind, tmp_path, monkeypatch):
    check(kind, range(2 * 10**6, 2 * 10**6 + 1000), tmp_path, monkeypatch)


# ---- crafted ones ------------------------------------------------------------------------------

AXES = {'x': np.arange(3.0), 'y': np.arange(2.0)}
FLOW = {'u': np.ones((3, 2)), 'v': np.ones((3, 2))}


def test_arrays_that_state_more_points_than_they_hold(tmp_path):
    """Room for the flow is made when every component has been seen to be there."""
    many = {name: np.arange(20_000.0) for name in 'txyz'}
    np.savez_compressed(tmp_path / 'a.npz', **many, u=np.ones(2), v=np.ones(2))
    verdict = judged(lambda: read_grid(tmp_path / 'a.npz'), 0)
    assert verdict.outcome == 'refused' and verdict.memory < 64 << 20
    assert "component 'u': shape (2,); allowed: (20000, 20000, 20000, 20000)" in verdict.line


def test_a_zip_bomb_meets_the_limit_that_names_itself(tmp_path):
    np.savez_compressed(tmp_path / 'a.npz', **AXES, u=np.zeros(30_000_000), v=np.ones(2))
    verdict = judged(lambda: read_grid(tmp_path / 'a.npz'), 0)
    assert verdict.outcome == 'refused' and verdict.memory < 64 << 20
    assert 'the limit expansion = 100' in verdict.line


def test_pickles_are_not_loaded(tmp_path):
    class Bad:
        def __reduce__(self):
            return (exec, ('raise SystemExit',))

    np.savez(tmp_path / 'a.npz', allow_pickle=True, **AXES, u=np.array([Bad()], dtype=object))
    with pytest.raises(ConfigError, match="array 'u': object; must be numbers"):
        read_grid(tmp_path / 'a.npz')


def test_a_packed_grid_is_what_was_packed(tmp_path):
    np.savez(tmp_path / 'a.npz', **AXES, **FLOW)
    text = pack(read_grid(tmp_path / 'a.npz'))
    check_packed(text)
    assert unpack(text)[:4].tolist() == [1, 3, 2, 1]


def packed(numbers):
    import base64
    import zlib

    return base64.b64encode(zlib.compress(np.array(numbers, dtype='<f8').tobytes())).decode()


@pytest.mark.parametrize(
    ('text', 'words'),
    [
        ('', 'cut'),
        ('!!!', 'data of a grid: '),
        ('AAAA', 'data of a grid: '),
        (packed([1, 1, 1, 1, 0, 0, 0, 0, 1, 2, 3])[:-8] + '====', 'data of a grid: '),
        (packed([]), 'its sizes are none'),
        (packed([1, 1, 1]), 'its sizes are none'),
        (packed([np.nan] * 4), 'its sizes are none'),
        (packed([np.inf] * 4), 'its sizes are none'),
        (packed([-1, 1, 1, 1]), 'its sizes are none'),
        (packed([1.5, 1, 1, 1]), 'its sizes are none'),
        (packed([1e300, 1e300, 1e300, 1e300]), 'not what its sizes need'),
        (packed([2**40, 2**40, 1, 1, 0]), 'not what its sizes need'),
        (packed([1, 1, 1, 1, 0, 0, 0, 0, 1, 2]), 'not what its sizes need'),
        (packed([1, 1, 1, 1, 0, 0, 0, np.nan, 1, 2, 3]), 'must be finite'),
        (packed([1, 1, 1, 2, 0, 0, 0, 5, 4, 1, 2, 3, 1, 2, 3]), 'must rise strictly'),
        (packed([1, 1, 1, 1, 0, 0, 0, 0, 1, np.inf, 3]), 'gaps'),
    ],
)
def test_packed_grids_that_lie(text, words):
    with pytest.raises(ConfigError) as caught:
        unpack(text)
    assert words in str(caught.value)


def test_a_packed_bomb_of_a_stranger():
    text = packed(np.zeros(30_000_000))
    verdict = judged(lambda: check_packed(text), len(text))
    assert verdict.outcome == 'refused' and 'the limit expansion' in verdict.line


@pytest.mark.parametrize('limit', ['csv_bytes=20', 'csv_rows=2'])
def test_rows_without_end(limit, tmp_path, monkeypatch):
    path = tmp_path / 'a.csv'
    path.write_text('t,x,y,z\n' + ''.join(f'{i},0,0,0\n' for i in range(3)))
    assert len(read_csv(path)) == 3
    monkeypatch.setenv('FLUID_SIM_LIMITS', limit)
    with pytest.raises(LimitError, match=f'the limit {limit.partition("=")[0]}'):
        read_csv(path)
