# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
ROS 2 simulator for aerial and underwater vehicles: MuJoCo with fluid forces.

The public names are loaded on first use, so that ``import fluid_sim_ros`` stays cheap.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from fluid_sim_ros.plugins import load_plugins, plugin_library
    from fluid_sim_ros.scene import Scene, scene_names
    from fluid_sim_ros.simulation import Simulation

__version__ = '0.1.0'

__all__ = ['Scene', 'Simulation', 'load_plugins', 'plugin_library', 'scene_names']

_HOMES = {
    'Scene': 'fluid_sim_ros.scene.scene',
    'Simulation': 'fluid_sim_ros.simulation.simulation',
    'load_plugins': 'fluid_sim_ros.plugins',
    'plugin_library': 'fluid_sim_ros.plugins',
    'scene_names': 'fluid_sim_ros.scene.scene_files',
}


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f'module {__name__!r} has no attribute {name!r}')
    return getattr(import_module(_HOMES[name]), name)
