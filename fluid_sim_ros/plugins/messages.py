# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What MuJoCo says when a model with our plugins does not load, as one line."""

import re

from fluid_sim_ros.errors import did_you_mean, listed
from fluid_sim_ros.plugins.attached import REMEDY
from fluid_sim_ros.plugins.native import native

_OURS = re.compile(r'^(fluid_sim\.\w+: .*)$', re.MULTILINE)
_UNKNOWN_KEY = re.compile(r"unrecognized attribute 'plugin:(\w+)' for plugin ([\w.]+)")
_OUT_OF_BOUNDS = re.compile(r'Invalid model: (\w+)_plugin out of bounds')
_ELEMENT = re.compile(r"Element name '([^']*)'")
#: What MuJoCo says of a fault that users make, without how to mend it.
_REMEDIES = {
    'mass and inertia of moving bodies must be larger': (
        'give it a mass above 0 [kg]: mass or density of a geom, or <inertial>'
    ),
    'inertia must satisfy A + B >= C': (
        'no body has such moments: the two smaller ones together are at least the largest; check '
        'axes, units, and the signs of products of inertia'
    ),
    'Error opening file': 'its path is relative to the model, or to meshdir',
}


def load_error_line(error: Exception) -> str:
    """
    Return the one line that tells why a model or its data could not be made.

    MuJoCo wraps the line of a plugin into several of its own and repeats it; for an unknown
    key it does not say which keys there are. Any other error comes back on one line, unchanged.

    Parameters
    ----------
    error
        The ``ValueError`` of ``MjModel.from_xml_*`` or ``MjSpec.compile``, or the
        ``mujoco.FatalError`` of ``MjData(model)`` after ``model.opt`` was changed (MuJoCo gives no
        reason there and writes our line as a warning).

    """
    text = str(error)
    if ours := _OURS.search(text):
        return ours[1]
    if unknown := _UNKNOWN_KEY.search(text):
        key, plugin = unknown.groups()
        element = _ELEMENT.search(text)
        where = f"'{element[1]}': " if element else ''
        known = native().plugin_keys(plugin)
        hint = did_you_mean(key, known)
        return f"{plugin}: {where}unknown key '{key}'{hint} it has: {listed(known)}"
    if outside := _OUT_OF_BOUNDS.search(text):
        return f'the plugin of one {outside[1]} is not in the model: {REMEDY}'
    if 'plugin->init failed' in text:
        return 'a plugin refuses the changed model; the WARNING before this line says why'
    line = ' '.join(text.split())
    remedy = next((words for fault, words in _REMEDIES.items() if fault in line), '')
    return f'{line}; {remedy}' if remedy else line
