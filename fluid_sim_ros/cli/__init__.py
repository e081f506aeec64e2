# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The command line: ``fluid_sim``, or ``python -m fluid_sim_ros.cli``."""

import sys
from collections.abc import Sequence

from fluid_sim_ros.interruption import begin, leave

# Before the rest is loaded, but only where this process is the command itself: Python calls a
# module that is run with -m '-m' while it looks for it.
if sys.argv[:1] == ['-m'] or (sys.argv and sys.argv[0].endswith('/fluid_sim')):
    begin('fluid_sim')

from fluid_sim_ros.cli import main as command_line
from fluid_sim_ros.cli.main import DIVERGED, INTERRUPTED
from fluid_sim_ros.cli.parser import WRONG_INPUT

__all__ = ['DIVERGED', 'INTERRUPTED', 'WRONG_INPUT', 'main']


def main(argv: Sequence[str] | None = None) -> int:
    """
    Run the command line; return the exit code, or end the process where it is the command itself.

    Parameters
    ----------
    argv
        Words after the program's name; default: those of this process.

    Returns
    -------
    int
        As ``fluid_sim_ros.cli.main`` says.

    """
    code = command_line.main(argv)
    if argv is None and sys.argv[0].endswith('/fluid_sim'):
        leave(code)
    return code
