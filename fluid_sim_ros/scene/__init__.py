# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A scene: its model, vehicles, weather and schedule, read from files and compiled."""

from fluid_sim_ros.scene.scene import Scene
from fluid_sim_ros.scene.scene_files import scene_names

__all__ = ['Scene', 'scene_names']
