# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What a user must hear of a model when it is loaded: other units, bodies that are left out."""

import mujoco
import numpy as np

#: Gravity on the Earth in other units of length [unit/s^2].
_UNITS = {'feet': 32.174, 'inches': 386.09, 'centimetres': 980.665, 'millimetres': 9806.65}
#: Above this, gravity is none of a planet in metres (Jupiter's: 24.8 m/s^2).
_MOST_GRAVITY = 30.0


def load_warnings(model: mujoco.MjModel, every_free_body: bool) -> list[str]:
    """
    Return what is to be said of a compiled model.

    Parameters
    ----------
    model
        The compiled model.
    every_free_body
        Whether every free body with a name is a vehicle, since no file names the vehicles.

    Returns
    -------
    list
        One line for each thing.

    """
    lines = [_units(model)]
    if every_free_body:
        lines.append(_nameless(model))
    return [line for line in lines if line]


def _units(model: mujoco.MjModel) -> str:
    gravity = float(np.linalg.norm(model.opt.gravity))
    if gravity <= _MOST_GRAVITY:
        return ''
    near = [name for name, value in _UNITS.items() if abs(gravity / value - 1) < 0.01]
    length = f'the model seems to be in {near[0]}' if near else 'is the model in metres?'
    return (
        f'gravity is {gravity:g}: {length}; fluid_sim takes and shows metres, kilograms, seconds '
        'and newtons, so its numbers are in other units here, and the fluid of every default is '
        'wrong; scale the model to metres'
    )


def _nameless(model: mujoco.MjModel) -> str:
    joints = np.flatnonzero(model.jnt_type == mujoco.mjtJoint.mjJNT_FREE)
    bodies = [int(model.jnt_bodyid[joint]) for joint in joints]
    count = sum(not model.body(body).name for body in bodies)
    if not count:
        return ''
    which = 'one free body has' if count == 1 else f'{count} free bodies have'
    return f'{which} no name: left out as scenery; a vehicle needs a name'
