"""
Runs each command block of README.md and doc/ in a checkout right after ``make demo``.

What they need beyond that environment, such as another extra, fails here, as it would for a
reader. What a block leaves behind goes into a folder of its own.
"""

import os
import sys
import tempfile
import time
import traceback
from pathlib import Path

from test.support.doc_blocks import blocks, tutorials
from test.support.doc_commands import run_block

ROOT = Path(__file__).resolve().parent.parent


def main() -> int:
    """Run them all; return how many failed, at most 1."""
    failed, begin = [], time.monotonic()
    for block in tutorials(blocks(shell=True)):
        name = f'{block.page}:{block.line}'
        with tempfile.TemporaryDirectory() as folder:
            for part in ('.venv', 'config', 'models'):
                (Path(folder) / part).symlink_to(ROOT / part)
            environment = dict(os.environ, COLUMNS='80')
            environment['PATH'] = f'{ROOT}/.venv/bin:{environment["PATH"]}'
            environment.pop('PYTHONPATH', None)
            try:
                run_block(block, Path(folder), environment)
            except Exception:  # noqa: BLE001 - whatever it is, the other blocks run as well
                failed.append(name)
                print(f'FAILED {name}', file=sys.stderr)
                traceback.print_exc(chain=False)
    seconds = time.monotonic() - begin
    print(f'command blocks of the documentation: {len(failed)} failed, in {seconds:.0f} s')
    return min(len(failed), 1)


if __name__ == '__main__':
    sys.exit(main())
