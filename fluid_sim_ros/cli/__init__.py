"""The command line: ``fluid_sim``, or ``python -m fluid_sim_ros.cli``."""

from fluid_sim_ros.cli.main import DIVERGED, INTERRUPTED, WRONG_INPUT, main

__all__ = ['DIVERGED', 'INTERRUPTED', 'WRONG_INPUT', 'main']
