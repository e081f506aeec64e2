"""Plugins that MuJoCo's attach has dropped from a model, found before it is compiled."""

from collections.abc import Iterable
from typing import Any

import mujoco

REMEDY = (
    "MuJoCo's attach drops a plugin that is configured inside an element; give the attached model "
    'a named <instance> in <extension> and refer to it by instance="..."'
)


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
