# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Runs each command block of README.md and doc/ in a checkout right after ``make demo``.

What they need beyond that environment, such as another extra, fails here, as it would for a
reader. What a block leaves behind goes into a folder of its own.
"""

import itertools
import os
import sys
import tempfile
import time
import traceback
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from test.support.doc_blocks import Block, blocks, tutorials
from test.support.doc_commands import run_block

ROOT = Path(__file__).resolve().parent.parent
#: Blocks at a time; most wait for other processes, and no two that run share a DDS domain.
_AT_ONCE, _DOMAINS = 3, range(61, 100)


def main() -> int:
    """Run them all, some at once, since many wait; return how many failed, at most 1."""
    begin = time.monotonic()
    each = list(tutorials(blocks(shell=True)))
    with ThreadPoolExecutor(_AT_ONCE) as pool:
        failed = [name for name in pool.map(run, each, itertools.cycle(_DOMAINS)) if name]
    seconds = time.monotonic() - begin
    print(f'command blocks of the documentation: {len(failed)} failed, in {seconds:.0f} s')
    return min(len(failed), 1)


def run(block: Block, domain: int) -> str:
    """Run a block in a folder of its own; return its place where it failed."""
    name = f'{block.page}:{block.line}'
    with tempfile.TemporaryDirectory() as folder:
        for part in ('.venv', 'benchmarks', 'config', 'models', 'test'):
            (Path(folder) / part).symlink_to(ROOT / part)
        environment = dict(os.environ, COLUMNS='80', ROS_DOMAIN_ID=str(domain))
        environment['PATH'] = f'{ROOT}/.venv/bin:{environment["PATH"]}'
        environment.pop('PYTHONPATH', None)
        try:
            run_block(block, Path(folder), environment)
        except Exception:  # noqa: BLE001 - whatever it is, the other blocks run as well
            print(f'FAILED {name}', file=sys.stderr)
            traceback.print_exc(chain=False)
            return name
    return ''


if __name__ == '__main__':
    sys.exit(main())
