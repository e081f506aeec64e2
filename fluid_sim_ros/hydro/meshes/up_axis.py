# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Which axis of a mesh file points up, and turning it to z.

glTF has y up, always (glTF 2.0, 3.4: right-handed, +Y up, metres); COLLADA states ``<up_axis>``.
Other formats say nothing. Vehicles have z up, x ahead (REP-103).
"""

import re
from pathlib import Path

import numpy as np

from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.physics.arrays import Array

#: What may be asked for: the axes as they are, as the file states them, or an axis that is up.
UPS = ('keep', 'file', 'x', 'y', 'z')
#: Rows: x, y, z of the turned mesh in axes of the file, as COLLADA 1.4.1 means each.
_TURNS = {
    'y': ((1, 0, 0), (0, 0, -1), (0, 1, 0)),
    'x': ((0, -1, 0), (0, 0, -1), (1, 0, 0)),
}
_HEAD = 2**16  # bytes of a DAE file in which its asset stands


def stated_up(path: Path) -> str:
    """
    Return the axis that a file states to be up.

    Parameters
    ----------
    path
        Of a mesh.

    Returns
    -------
    str
        ``x``, ``y`` or ``z``; '' where the file says nothing.

    """
    kind = path.suffix.lower()
    if kind in ('.glb', '.gltf'):
        return 'y'
    if kind != '.dae':
        return ''
    with path.open('rb') as file:
        found = re.search(rb'<(?:\w+:)?up_axis>\s*([XYZ])_UP\s*<', file.read(_HEAD))
    return found[1].decode().lower() if found else ''


def turned_up(path: Path, up: str) -> tuple[Array, str]:
    """
    Return how a mesh is turned so that z is up, and what a reader must know of it.

    Parameters
    ----------
    path
        Of the mesh.
    up
        One of `UPS`.

    Returns
    -------
    rotation
        From axes of the file, shape (3, 3).
    words
        '' where there is nothing to say.

    Raises
    ------
    ConfigError
        For another word.

    """
    if up not in UPS:
        raise ConfigError(f"up '{up}': unknown; allowed: {listed(UPS)}")
    stated = stated_up(path)
    says = 'glTF has y up' if path.suffix.lower() != '.dae' else f'it states {stated} up'
    if up == 'keep':
        kept = stated in _TURNS
        return np.eye(3), f'{says}: its axes are kept (--up file turns it)' if kept else ''
    axis = stated if up == 'file' else up
    if axis not in _TURNS:
        return np.eye(3), ''
    words = f'{says}: turned so that z is up' if up == 'file' else f'turned: its {axis} is up'
    hint = '; x stays' if axis == 'y' else ''
    undo = ' (--up z takes it as it is)' if up == 'file' else ''
    return np.array(_TURNS[axis], dtype=float), words + hint + undo
