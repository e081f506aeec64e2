"""Runs ``python -m fluid_sim_ros.cli``."""

from fluid_sim_ros.cli import program

program()
