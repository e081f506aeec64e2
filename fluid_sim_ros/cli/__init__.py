"""The command line: ``fluid_sim``, or ``python -m fluid_sim_ros.cli``."""

import sys
from typing import NoReturn

from fluid_sim_ros.interruption import begin, leave

# Before the rest is loaded, but only where this process is the command itself: Python calls a
# module that is run with -m '-m' while it looks for it.
if sys.argv[:1] == ['-m'] or (sys.argv and sys.argv[0].endswith('/fluid_sim')):
    begin('fluid_sim')

from fluid_sim_ros.cli.main import DIVERGED, INTERRUPTED, main
from fluid_sim_ros.cli.parser import WRONG_INPUT

__all__ = ['DIVERGED', 'INTERRUPTED', 'WRONG_INPUT', 'main', 'program']


def program() -> NoReturn:
    """Run the command line as a process, and end that."""
    leave(main())
