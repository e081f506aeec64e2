# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Models whose plugins MuJoCo itself loses or crashes on, found before they are compiled."""

import re
from collections.abc import Iterable
from typing import Any

import mujoco

REMEDY = (
    "MuJoCo's attach drops a plugin that is configured inside an element; give the attached model "
    'a named <instance> in <extension> and refer to it by instance="..."'
)


_REPLICATE = re.compile(
    r'<replicate\b(?:(?!</replicate>).)*<plugin\b[^>]*\binstance\s*=', re.DOTALL
)
_ACTUATOR_PLUGIN = re.compile(r'<actuator\b(?:(?!</actuator>).)*<plugin\b', re.DOTALL)


def crashing_replicate(mjcf: str) -> str:
    """
    Return one line about a model that ends MuJoCo 4.0.0 with a segmentation fault, or ''.

    Its ``<replicate>`` frees the plugin names of the instances that it copies. A model whose
    actuators have plugins, too, reads them again.

    Parameters
    ----------
    mjcf
        Text of the model's own file.

    Returns
    -------
    line
        What it is, and the remedy.

    """
    if _ACTUATOR_PLUGIN.search(mjcf) and _REPLICATE.search(mjcf):
        return (
            'a body with <plugin instance="..."/> inside <replicate>, beside actuators with '
            'plugins, ends MuJoCo 4.0.0 with a segmentation fault; configure the plugin inside '
            'the body (<plugin plugin="..."><config .../></plugin>)'
        )
    return ''


def dropped_plugin(spec: mujoco.MjSpec) -> str:
    """
    Return one line about the first element whose plugin was dropped, or ''.

    ``<attach>`` and ``MjSpec.attach_body`` copy named instances, but not the plugin that an
    element configures in itself: its number then stands for whatever instance has it in the
    whole model. The library refuses what it can see of this in a compiled model
    (plugins/src/shared/references.cc); a spec tells more.

    Parameters
    ----------
    spec
        Just read from a file: what MuJoCo keeps of plugins that were deleted since is not to be
        looked at.

    Returns
    -------
    line
        Naming the element, its plugin and the remedy.

    """
    names = [plugin.name for plugin in spec.plugins]
    for kind, elements in _elements(spec):
        for element in elements:
            plugin = element.plugin
            if not plugin.active or plugin.name or plugin.id < 0:
                continue
            # a plugin configured in its element is an instance without a name
            if plugin.id >= len(names) or names[plugin.id]:
                return f"{kind} '{element.name}' has lost its {plugin.plugin_name}: {REMEDY}"
    return ''


def _elements(spec: mujoco.MjSpec) -> Iterable[tuple[str, Iterable[Any]]]:
    yield 'body', spec.bodies
    yield 'geom', spec.geoms
    yield 'actuator', spec.actuators
    yield 'sensor', spec.sensors
