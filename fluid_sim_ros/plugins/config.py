# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The plugins of a compiled model and the keys that they were given.

The one place that reads a plugin's keys back from a model; everything above asks here.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import mujoco

from fluid_sim_ros.plugins.native import native

#: Names of our plugins.
BODY = 'fluid_sim.body'
MEDIUM = 'fluid_sim.medium'
FOIL = 'fluid_sim.foil'
THRUSTER = 'fluid_sim.thruster'


@dataclass(frozen=True)
class PluginInstance:
    """
    One plugin instance of a compiled model.

    Attributes
    ----------
    model
        The model that it belongs to.
    index
        Its index in the model.

    """

    model: mujoco.MjModel
    index: int

    @property
    def plugin(self) -> str:
        """Name of the plugin, such as ``fluid_sim.body``."""
        return native().plugin_name(self.model._address, self.index)

    def text(self, key: str) -> str:
        """
        Return what a key was given, as it stands in the MJCF, or '' where it is not given.

        Parameters
        ----------
        key
            Name of the key.

        """
        return native().plugin_config(self.model._address, self.index, key)

    def number(self, key: str, default: float = 0.0) -> float:
        """
        Return the first number of a key.

        Parameters
        ----------
        key
            Name of the key. The plugin has checked that its value is made of numbers.
        default
            What an absent key stands for, in the unit of the key.

        """
        words = self.text(key).split()
        return float(words[0]) if words else default


def plugin_instances(model: mujoco.MjModel, plugin: str = '') -> Iterator[PluginInstance]:
    """
    Yield a model's instances of one plugin (of all of them, by default), in the model's order.

    Parameters
    ----------
    model
        The compiled model.
    plugin
        Name of the plugin, such as ``fluid_sim.body``.

    """
    for index in range(model.nplugin):
        instance = PluginInstance(model, index)
        if plugin in ('', instance.plugin):
            yield instance


def plugin_of_actuator(model: mujoco.MjModel, actuator: int, plugin: str) -> PluginInstance | None:
    """
    Return the instance of a plugin that drives an actuator, or nothing.

    Parameters
    ----------
    model
        The compiled model.
    actuator
        Id of the actuator.
    plugin
        Name of the plugin; an instance of another one counts as none.

    """
    return _of(model, int(model.actuator_plugin[actuator]), plugin)


def plugin_of_body(model: mujoco.MjModel, body: int, plugin: str) -> PluginInstance | None:
    """
    Return the instance of a plugin that a body has, or nothing.

    Parameters
    ----------
    model
        The compiled model.
    body
        Id of the body.
    plugin
        Name of the plugin; an instance of another one counts as none.

    """
    return _of(model, int(model.body_plugin[body]), plugin)


def medium_of(model: mujoco.MjModel) -> PluginInstance | None:
    """
    Return the one ``fluid_sim.medium`` of a model, or nothing.

    Parameters
    ----------
    model
        The compiled model.

    """
    return next(plugin_instances(model, MEDIUM), None)


def _of(model: mujoco.MjModel, index: int, plugin: str) -> PluginInstance | None:
    instance = PluginInstance(model, index)
    return instance if index >= 0 and instance.plugin == plugin else None
