# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Threads and Ray fly the same rows, and a killed sweep goes on."""

import contextlib
import json
import os
import signal
import subprocess
import sys
import textwrap
import time
import types
from pathlib import Path

import pyarrow.parquet as pq
import pytest

from fluid_sim_ros.errors import ConfigError, MissingExtraError
from fluid_sim_ros.sweep.case_runs import CaseRunner
from fluid_sim_ros.sweep.run_sweep import run_sweep
from test.support.sweeps import sweep_of

ROOT = Path(__file__).resolve().parents[2]


MANY = {
    'scene': 'rov', 'duration': 0.1, 'runs': 40, 'seed': 3,
    'vary': {'integrator': {'values': ['RK4', 'implicitfast']}, 'current.x': {'normal': [0, 1]}},
}  # fmt: skip


def test_threads_keep_order_and_bits(tmp_path):
    sweep = sweep_of(**MANY)
    told = []
    result = run_sweep(
        sweep, tmp_path / 'a', workers=2, report=lambda done, total: told.append((done, total))
    )
    assert result['runs'] == 80 and result['status'] == {'ok': 80}
    assert told[0] == (0, 80) and told[-1] == (80, 80)
    table = pq.read_table(result['table']).to_pylist()
    assert [row['run'] for row in table] == list(range(80))
    assert table == CaseRunner(sweep).rows(0, 80)


def test_a_killed_sweep_goes_on_where_it_was(tmp_path):
    sweep, out = sweep_of(**MANY), tmp_path / 'out'
    code = textwrap.dedent(f"""
        import os, signal
        from pathlib import Path
        from fluid_sim_ros.sweep.run_sweep import run_sweep
        from fluid_sim_ros.sweep.sweep_file import SweepFile
        def report(done, total):
            if done >= 20:
                os.kill(os.getpid(), signal.SIGKILL)
        run_sweep(SweepFile.model_validate({MANY!r}), Path({str(out)!r}), workers=2, report=report)
    """)
    assert subprocess.run([sys.executable, '-c', code], check=False).returncode == -signal.SIGKILL
    assert not (out / 'results.parquet').exists()
    # half a portion, as a dying file system leaves it
    sorted((out / 'parts').glob('*.parquet'))[0].write_bytes(b'PAR1half')
    result = run_sweep(sweep, out, workers=3)
    assert 0 < result['runs_kept_from_before'] < 80
    assert pq.read_table(result['table']).to_pylist() == CaseRunner(sweep).rows(0, 80)
    with pytest.raises(ConfigError, match='holds the results of another sweep'):
        run_sweep(sweep.model_copy(update={'seed': 4}), out)


@pytest.mark.parametrize(
    ('address', 'line'),
    [
        ('nonsense', "--ray 'nonsense': not an address; allowed: local, auto, HOST:PORT"),
        ('', "--ray '': not an address"),
        ('127.0.0.1:1', "--ray '127.0.0.1:1': no Ray answers there"),  # Ray would try for minutes
    ],
)
def test_an_address_without_ray_is_one_line(tmp_path, monkeypatch, address, line):
    monkeypatch.setitem(sys.modules, 'ray', types.ModuleType('ray'))  # not asked
    with pytest.raises(ConfigError, match=line):
        run_sweep(sweep_of(), tmp_path, ray_address=address)


def test_without_ray_one_line_says_what_to_type(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, 'ray', None)
    with pytest.raises(MissingExtraError, match=r'--ray needs ray.*fluid_sim_ros\[sweep\]'):
        run_sweep(sweep_of(), tmp_path, ray_address='local')


@pytest.mark.full
def test_ray_gives_the_same_bits_and_survives_a_killed_worker(tmp_path):
    """Two Ray workers on this machine; one is killed on the way."""
    sweep = sweep_of(**{**MANY, 'duration': 0.5})
    killed, heard = [], set()

    def kill_one(done: int, total: int) -> None:
        busy = [pid for pid in descendants(os.getpid()) if title(pid).startswith('ray::_run')]
        if done and busy and not killed:
            heard.update(listening(descendants(os.getpid())))
            killed.append(busy[0])
            os.kill(busy[0], signal.SIGKILL)

    result = run_sweep(sweep, tmp_path, workers=2, ray_address='local', report=kill_one)
    assert killed
    assert heard and all(address.endswith('0100007F') for address in heard)  # 127.0.0.1 alone
    assert result['status'] == {'ok': 80}
    assert pq.read_table(result['table']).to_pylist() == CaseRunner(sweep).rows(0, 80)


@pytest.mark.full
@pytest.mark.parametrize('after', [0.5, 3.0, 8.0])
def test_sigterm_ends_a_sweep_on_ray_and_its_cluster(tmp_path, after):
    """While Ray is loaded, while it starts, and in flight."""
    pytest.importorskip('ray')
    (tmp_path / 'sweep.yaml').write_text(
        'scene: rov\nduration: 2.0\nruns: 2000\nseed: 3\nvary: {current.x: {normal: [0, 1]}}\n'
    )
    process = subprocess.Popen(
        [sys.executable, '-m', 'fluid_sim_ros.cli', 'sweep', 'sweep.yaml', '--ray', 'local',
         '--workers', '2', '--out', 'out'],
        cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    time.sleep(after)
    children = descendants(process.pid)
    process.send_signal(signal.SIGTERM)
    _, errors = process.communicate(timeout=60)
    assert (process.returncode, errors) == (143, 'fluid_sim: interrupted\n')
    deadline = time.monotonic() + 30
    while any('ray' in title(pid) for pid in children):
        assert time.monotonic() < deadline
        time.sleep(0.1)


def descendants(parent: int) -> list[int]:
    """Return every process that this one started, directly or not."""
    try:
        children = Path(f'/proc/{parent}/task/{parent}/children').read_text().split()
    except OSError:  # it ended meanwhile
        return []
    return [pid for child in map(int, children) for pid in (child, *descendants(child))]


def listening(processes: list[int]) -> set[str]:
    """Return the addresses on which processes wait for TCP connections, as the kernel has them."""
    links = set()
    for pid in processes:
        with contextlib.suppress(OSError):
            links |= {str(link.readlink()) for link in Path(f'/proc/{pid}/fd').iterdir()}
    found = set()
    for table in ('/proc/net/tcp', '/proc/net/tcp6'):
        for row in map(str.split, Path(table).read_text().splitlines()[1:]):
            if row[3] == '0A' and f'socket:[{row[9]}]' in links:
                found.add(row[1].split(':')[0])
    return found


def title(pid: int) -> str:
    try:
        return Path(f'/proc/{pid}/cmdline').read_text()
    except OSError:
        return ''


def test_the_command(tmp_path):
    path = tmp_path / 'sweep.yaml'
    path.write_text('scene: sphere\nduration: 0.1\nvary: {current.x: {values: [0, 1, 2]}}\n')
    command = [sys.executable, '-m', 'fluid_sim_ros.cli', 'sweep', str(path), '--json', '-']
    done = subprocess.run(
        [*command, '--out', str(tmp_path / 'out')], capture_output=True, text=True, check=True
    )
    result = json.loads(done.stdout)
    assert result['runs'] == 3 and result['status'] == {'ok': 3}
    assert result['columns']['current.x'] == {'min': 0.0, 'median': 1.0, 'max': 2.0}
    assert len(pq.read_table(result['table'])) == 3
