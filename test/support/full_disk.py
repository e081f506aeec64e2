# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Runs commands of ``fluid_sim`` in this process, each with a full disk to write to.

Run by root in a mount namespace of its own: ``unshare --mount python -m test.support.full_disk
FOLDER``, where FOLDER is empty; the commands come from standard input, as JSON: lists of words, in
which ``{full}`` stands for the disk. The answer is JSON: for each its exit code, what it said on
standard error, and what it left on the disk.
"""

import io
import json
import shutil
import subprocess
import sys
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

from fluid_sim_ros.cli.main import main

_PAGE = 4096


def _answer(words: list[str], full: Path) -> dict[str, object]:
    said = io.StringIO()
    with redirect_stderr(said), redirect_stdout(io.StringIO()):
        code = main([word.format(full=full) for word in words])
    left = [path for path in full.iterdir() if path.name != 'filler']
    for path in left:
        if path.is_dir():
            shutil.rmtree(path)
        else:
            path.unlink()
    return {'code': code, 'said': said.getvalue(), 'left': [path.name for path in left]}


def _main() -> None:
    full = Path(sys.argv[1])
    commands = json.loads(sys.stdin.read())
    subprocess.run(['mount', '-t', 'tmpfs', '-o', f'size={_PAGE}', 'none', full], check=True)
    (full / 'filler').write_bytes(bytes(_PAGE))
    print(json.dumps([_answer(words, full) for words in commands]))


if __name__ == '__main__':
    _main()
