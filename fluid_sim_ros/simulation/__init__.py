# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A scene that runs: stepping, commands, states and wrenches."""

from fluid_sim_ros.simulation.simulation import Simulation

__all__ = ['Simulation']
