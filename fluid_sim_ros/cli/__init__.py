"""The command line: ``fluid_sim``, or ``python -m fluid_sim_ros.cli``."""

from fluid_sim_ros.cli.main import DIVERGED, INTERRUPTED, main
from fluid_sim_ros.cli.parser import WRONG_INPUT

__all__ = ['DIVERGED', 'INTERRUPTED', 'WRONG_INPUT', 'main']
