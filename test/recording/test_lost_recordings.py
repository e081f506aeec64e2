# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What ends a recording before the flight: it is said at once, and the flight goes on."""

import json
import os
import shutil
import subprocess
import sys
import textwrap
import time

import pytest

from fluid_sim_ros.recording.reader import open_log

PROGRAM = [sys.executable, '-m', 'fluid_sim_ros.cli']
#: A file system with a quota is asked of few machines: the writer's one word with the disk fails
#: as there, behind the first time.
QUOTA = """
    import errno, os
    sync, times = os.fdatasync, []
    def over(handle):
        times.append(handle)
        if len(times) > 1:
            raise OSError(errno.EDQUOT, os.strerror(errno.EDQUOT))
        sync(handle)
    os.fdatasync = over
"""


def start(folder, *words, before=(), **settings):
    return subprocess.Popen(
        [*before, *PROGRAM, 'run', 'rov', '--record', str(folder / 'a.mcap'), '--json',
         str(folder.parent / 'a.json'), *words],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **settings,
    )  # fmt: skip


def check(process, folder, reason, duration):
    _, errors = process.communicate(timeout=60)
    line = f'recording to {folder / "a.mcap"} stopped: {reason}'
    assert (process.returncode, errors.splitlines()) == (
        2, [f'warning: {line}; going on without', f'fluid_sim: {line}']
    )  # fmt: skip
    result = json.loads((folder.parent / 'a.json').read_text())
    assert result['record_fault'] == line and result['duration_s'] == pytest.approx(duration)


def folder_of(tmp_path):
    folder = tmp_path / 'logs'
    folder.mkdir()
    return folder


def begun(process, path):
    deadline = time.monotonic() + 30
    while not (path.exists() and path.stat().st_size > 1000):
        assert time.monotonic() < deadline and process.poll() is None
        time.sleep(0.01)


def test_a_folder_that_is_deleted_during_a_run(tmp_path):
    folder = folder_of(tmp_path)
    process = start(folder, '--pacing', 'realtime', '--duration', '2')
    begun(process, folder / 'a.mcap')
    shutil.rmtree(folder)
    check(process, folder, 'its file was deleted', 2.0)
    assert not folder.exists()


@pytest.mark.full
def test_a_folder_that_is_moved_during_a_run_holds_the_whole_log(tmp_path):
    folder = folder_of(tmp_path)
    process = start(folder, '--pacing', 'realtime', '--duration', '1.5')
    begun(process, folder / 'a.mcap')
    folder.rename(tmp_path / 'elsewhere')
    assert process.wait(60) == 0
    process.communicate()
    log = open_log(tmp_path / 'elsewhere' / 'a.mcap')
    assert not log.faults and max(message.log_ns for message in log.messages()) == 1_500_000_000


@pytest.mark.skipif(os.geteuid() != 0, reason='only root makes a disk')
def test_a_disk_that_fills_during_a_run(tmp_path):
    folder = folder_of(tmp_path)
    mount = f'mount -t tmpfs -o size=32k none {folder} && exec "$@"'
    before = ['unshare', '--mount', 'sh', '-c', mount, 'sh']
    process = start(folder, '--pacing', 'realtime', '--duration', '3', before=before)
    check(process, folder, 'No space left on device', 3.0)


@pytest.mark.full
def test_a_quota_that_is_used_up_during_a_run(tmp_path):
    folder = folder_of(tmp_path)
    (tmp_path / 'sitecustomize.py').write_text(textwrap.dedent(QUOTA))
    path = os.pathsep.join([str(tmp_path), *filter(None, sys.path)])
    process = start(
        folder, '--pacing', 'realtime', '--duration', '2', env=os.environ | {'PYTHONPATH': path}
    )
    check(process, folder, 'Disk quota exceeded', 2.0)


#: A file system of its own in a file, with a quota for one folder of it.
BTRFS = """
set -e
truncate -s 200M {0}/disk && mkfs.btrfs -q {0}/disk >&2
mount -o loop {0}/disk {0}/logs
btrfs subvolume create {0}/logs/mine >&2
btrfs quota enable {0}/logs && btrfs qgroup limit 300K {0}/logs/mine >&2
exec "$@"
"""


@pytest.mark.full
@pytest.mark.skipif(
    os.geteuid() != 0 or not (shutil.which('mkfs.btrfs') and shutil.which('btrfs')),
    reason='a file system with a quota takes root and btrfs-progs',
)
def test_a_quota_of_a_file_system_that_is_used_up_during_a_run(tmp_path):
    folder_of(tmp_path)
    before = ['unshare', '--mount', 'sh', '-c', BTRFS.format(tmp_path), 'sh']
    process = start(
        tmp_path / 'logs' / 'mine', '--pacing', 'realtime', '--duration', '7', '--json',
        str(tmp_path / 'a.json'), before=before,
    )  # fmt: skip
    _, errors = process.communicate(timeout=90)
    line = f'recording to {tmp_path / "logs" / "mine" / "a.mcap"} stopped: Disk quota exceeded'
    assert process.returncode == 2, errors
    assert errors.splitlines()[-2:] == [
        f'warning: {line}; going on without', f'fluid_sim: {line}'
    ]  # fmt: skip
    result = json.loads((tmp_path / 'a.json').read_text())
    assert result['record_fault'] == line and result['duration_s'] == pytest.approx(7.0)


@pytest.mark.full
def test_too_few_file_handles_for_a_recording_are_one_line(tmp_path):
    code = """
        import os, resource, sys
        from fluid_sim_ros.cli import main
        from fluid_sim_ros.cli import run
        from fluid_sim_ros.recording import sink
        used = max(map(int, os.listdir('/proc/self/fd')))
        words = ['run', 'sphere', '--duration', '.1']
        for more in range(1, 12):
            resource.setrlimit(resource.RLIMIT_NOFILE, (used + more, 4096))
            code = main([*words, '--record', f'{more}.mcap', '--json', f'{more}.json'])
            sys.stderr.write(f'{code}\\n')
    """
    done = subprocess.run(
        [sys.executable, '-c', textwrap.dedent(code)], cwd=tmp_path, capture_output=True,
        text=True, check=True,
    )  # fmt: skip
    lines = done.stderr.splitlines()
    assert 'Traceback' not in done.stderr and lines[-1] == '0'
    refused = [line for line in lines if line.startswith('fluid_sim: ')]
    assert len(refused) == lines.count('2') > 3
    assert all('Too many open files' in line for line in refused)


def test_too_few_file_handles_for_the_next_file_end_the_recording_and_not_the_run(tmp_path):
    code = """
        import os, resource, sys
        from pathlib import Path
        from fluid_sim_ros import Simulation
        from fluid_sim_ros.recording.sink import RecordingSink
        simulation = Simulation('sphere')
        sink = RecordingSink(simulation, Path('a.mcap'))
        used = max(map(int, os.listdir('/proc/self/fd')))
        resource.setrlimit(resource.RLIMIT_NOFILE, (used + 1, 4096))
        taken = []
        try:
            while True:
                taken.append(open(os.devnull))
        except OSError:
            pass
        simulation.reset()
        sink.next_segment()
        simulation.step(10)
        sink.write(simulation)
        sink.close()
        print(sink.recorder.fault)
    """
    done = subprocess.run(
        [sys.executable, '-c', textwrap.dedent(code)], cwd=tmp_path, capture_output=True,
        text=True, check=True,
    )  # fmt: skip
    assert done.stdout.startswith('recording stopped: ') and 'Too many open' in done.stdout
    assert not open_log(tmp_path / 'a.mcap').faults
