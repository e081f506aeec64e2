"""What every benchmark shares: its command line, and results that say what was measured."""

import argparse
import datetime
import json
import os
import platform
import subprocess
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import mujoco

ROOT = Path(__file__).resolve().parents[1]
RESULTS = ROOT / 'benchmarks' / 'results'


def arguments(doc: str | None, name: str) -> argparse.Namespace:
    """Return ``json`` (path of the result) and ``quick`` from the command line."""
    parser = argparse.ArgumentParser(description=(doc or name).strip().splitlines()[0])
    parser.add_argument('--json', type=Path, default=RESULTS / f'{name}.json')
    parser.add_argument('--quick', action='store_true', help='a fraction of the volume')
    return parser.parse_args()


def write(path: Path, result: Mapping[str, Any]) -> None:
    """Write a result with the commit, the date and the versions that it was measured with."""
    head = subprocess.run(
        ['git', 'rev-parse', '--short=12', 'HEAD'],
        cwd=ROOT, capture_output=True, text=True, check=False,
    ).stdout.strip()  # fmt: skip
    measured = {
        'commit': head or 'unknown',
        'date': datetime.datetime.now(datetime.UTC).isoformat(timespec='seconds'),
        'mujoco': mujoco.__version__,
        'python': platform.python_version(),
        'cores': os.cpu_count(),
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
