# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What every benchmark shares: its command line, and results that say what was measured."""

import argparse
import datetime
import json
import os
import platform
import subprocess
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import mujoco

from fluid_sim_ros.ros.process.this_host import stay_on_this_host
from test.support.paths import ROOT

__all__ = [
    'RESULTS',
    'ROOT',
    'arguments',
    'commit',
    'machine',
    'thread_seconds',
    'wall_seconds',
    'write',
]

RESULTS = ROOT / 'benchmarks' / 'results'


def arguments(
    doc: str | None,
    name: str,
    parts: Sequence[str] = (),
    *,
    more: Mapping[str, str] | None = None,
    flags: Mapping[str, str] | None = None,
) -> argparse.Namespace:
    """
    Return ``json`` (path of the result), ``quick`` and, with ``parts``, ``only``, as given.

    ``only`` names the parts to measure anew; a result keeps the others. ``more`` are options of
    the benchmark's own that take a value, ``flags`` its switches: name -> help.
    """
    parser = argparse.ArgumentParser(description=(doc or name).strip().splitlines()[0])
    parser.add_argument('--json', type=Path, default=RESULTS / f'{name}.json')
    parser.add_argument('--quick', action='store_true', help='a fraction of the volume')
    if parts:
        parser.add_argument(
            '--only', nargs='+', choices=parts, metavar='NAME',
            help=f'measure these anew, keep the others: {", ".join(parts)}',
        )  # fmt: skip
    for option, text in (more or {}).items():
        parser.add_argument(f'--{option}', help=text)
    for flag, text in (flags or {}).items():
        parser.add_argument(f'--{flag}', action='store_true', help=text)
    stay_on_this_host()  # also with ROS in this process, and in those that it starts
    return parser.parse_args()


def commit() -> str:
    """Return the commit that is measured, marked where the measured files differ from it."""

    def git(*words: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            ['git', *words], cwd=ROOT, capture_output=True, text=True, check=False
        )

    head = git('rev-parse', '--short=12', 'HEAD').stdout.strip()
    measured = ('fluid_sim_ros', 'models', 'config', 'benchmarks/*.py', 'test/support')
    changed = head and git('diff', '--quiet', 'HEAD', '--', *measured).returncode
    return (head or 'unknown') + ('-dirty' if changed else '')


def machine() -> dict[str, Any]:
    """Return processor, cores, operating system and how busy the machine is."""
    info = Path('/proc/cpuinfo')
    lines = info.read_text(encoding='utf-8').splitlines() if info.exists() else []
    models = [line.split(':', 1)[1].strip() for line in lines if line.startswith('model name')]
    try:
        system = platform.freedesktop_os_release()['PRETTY_NAME']
    except OSError:
        system = platform.platform(terse=True)
    return {
        'cpu': models[0] if models else platform.machine(),
        'cores': os.cpu_count(),
        'os': f'{system}, {platform.system()} {platform.release().split("-")[0]}',
        'load_average': os.getloadavg()[0],
    }


def write(path: Path, result: Mapping[str, Any]) -> None:
    """Write a result with the commit, the date, the versions and the machine it is from."""
    measured = {
        'commit': commit(),
        'date': datetime.datetime.now(datetime.UTC).isoformat(timespec='seconds'),
        'mujoco': mujoco.__version__,
        'python': platform.python_version(),
        **machine(),
        **result,
    }
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(measured, indent=1) + '\n', encoding='utf-8')
    print(f'wrote {path}')


def wall_seconds(work: Callable[[], object]) -> float:
    """Return the wall time that a call takes [s]."""
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def thread_seconds(work: Callable[[], object]) -> float:
    """Return the processor time that a call takes in this thread [s]; others disturb it little."""
    start = time.thread_time()
    work()
    return time.thread_time() - start
