"""A scene that runs: stepping, commands, states and wrenches."""

from fluid_sim_ros.simulation.simulation import Simulation

__all__ = ['Simulation']
