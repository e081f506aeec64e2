"""The command line: ``fluid_sim``, or ``python -m fluid_sim_ros.cli``."""

from fluid_sim_ros.cli.main import main

__all__ = ['main']
