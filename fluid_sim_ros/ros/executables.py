# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The executables of the package, with as few imports as can be.

Loading a node takes a second or more. A Ctrl-C in that time ends the process as quietly as later.
"""

import os
import sys
from importlib import import_module
from typing import NoReturn

from fluid_sim_ros.interruption import leave
from fluid_sim_ros.ros.process.signals import end_quietly


def fluid_sim_node() -> None:
    """Run the simulator's node."""
    _run('fluid_sim_ros.ros.node')


def quad_controller() -> None:
    """Run the multirotor's controller."""
    _run('fluid_sim_ros.ros.controllers.quad')


def rov_controller() -> None:
    """Run the underwater vehicle's controller."""
    _run('fluid_sim_ros.ros.controllers.rov')


def auv_controller() -> None:
    """Run the torpedo's controller."""
    _run('fluid_sim_ros.ros.controllers.auv')


def plane_controller() -> None:
    """Run the aircraft's controller."""
    _run('fluid_sim_ros.ros.controllers.plane')


def _run(module: str) -> NoReturn:
    end_quietly()
    # MuJoCo would look for a display as it is imported, in a process of its own: slow, and a
    # traceback on Ctrl-C
    os.environ.setdefault('MUJOCO_GL', 'disable')
    leave(import_module(module).main(sys.argv))
