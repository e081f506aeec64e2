# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The tether of bluerov2_tether between two fixed points, settled in a current by the plugin."""

import mujoco
import numpy as np
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from fluid_sim_ros import Scene, load_plugins

SEGMENTS, LENGTH = 16, 1.0
#: Where the model ties its upper end [m].
ANCHOR = np.array([0.0, 0.0, -0.5])


def pinned(end) -> mujoco.MjModel:
    """Return the model without its vehicle: the tether's end is tied to a place [m]."""
    load_plugins()
    spec = Scene.load('bluerov2_tether').read_model()
    for key in list(spec.keys):
        spec.delete(key)
    spec.delete(spec.equality('tether'))
    spec.delete(spec.body('bluerov2'))
    spec.body(f'tether_{SEGMENTS}').add_site(name='end', pos=[LENGTH, 0, 0])
    spec.worldbody.add_body(name='pin', pos=end).add_site(name='pin')
    spec.add_equality(
        name='pin', type=mujoco.mjtEq.mjEQ_CONNECT, objtype=mujoco.mjtObj.mjOBJ_SITE,
        name1='end', name2='pin', solref=(0.005, 1), solimp=(0.99, 0.999, 0.001, 0.5, 2),
    )  # fmt: skip
    return spec.compile()


def arc(model: mujoco.MjModel, end, aside, roll: float = 0.0):
    """
    Return the turns of the joints for an arc of a circle to a place, bulging to one side.

    Parameters
    ----------
    model
        Of ``pinned``.
    end
        Of the tether [m].
    aside
        Direction in which it bulges, shape (3,).
    roll
        Twist of all segments about the tether [rad].

    """
    chord = np.asarray(end) - ANCHOR
    x = chord / np.linalg.norm(chord)
    y = np.asarray(aside) - (np.asarray(aside) @ x) * x
    y = y / np.linalg.norm(y)
    steps = np.arange(SEGMENTS)

    def reach(bend: float) -> float:
        angles = (steps - (SEGMENTS - 1) / 2) * bend
        return float(LENGTH * np.cos(angles).sum() - np.linalg.norm(chord))

    bend = brentq(reach, 1e-6, 2 * np.pi / SEGMENTS)
    plane = Rotation.from_matrix(np.column_stack([x, y, np.cross(x, y)]))
    angles = ((SEGMENTS - 1) / 2 - steps) * bend
    turns, before = [], Rotation.identity()
    for step, angle in zip(steps, angles, strict=True):
        stands = model.body(f'tether_{step + 1}').quat
        before = before * Rotation.from_quat(stands, scalar_first=True)
        # every other segment is turned by 45 degrees about the tether
        turn = plane * Rotation.from_euler('ZX', [angle, roll + step % 2 * np.pi / 4])
        turns.append((before.inv() * turn).as_quat(scalar_first=True))
        before = turn
    return np.concatenate(turns)


def settled(end, current, seconds: float, roll: float = 0.0):
    """
    Return places of the joints and the end, and what the tether pulls the end with.

    Parameters
    ----------
    end
        Where the end is tied to [m], shape (3,).
    current
        Velocity of the water [m/s], shape (3,).
    seconds
        How long it is left alone [s].
    roll
        As of ``arc``.

    Returns
    -------
    places, pull, speed
        [m], shape (SEGMENTS + 1, 3); [N], shape (3,); the largest of the joints' [m/s].

    """
    model = pinned(end)
    data = mujoco.MjData(model)
    data.qpos[:] = arc(model, end, current, roll)
    medium = next(i for i in range(model.nplugin) if model.plugin_statenum[i])
    address = model.plugin_stateadr[medium]
    # the current's target, and its start: it has flowed for long
    data.plugin_state[address : address + 6] = [*current, *current]
    bodies = [model.body(f'tether_{i}').id for i in range(1, SEGMENTS + 1)]
    places, before = np.zeros((SEGMENTS + 1, 3)), np.zeros((SEGMENTS + 1, 3))
    for step in range(round(seconds / model.opt.timestep) + 1):
        if step:
            before[:] = places
            mujoco.mj_step1(model, data)
            mujoco.mj_step2(model, data)
        places[:-1], places[-1] = data.xpos[bodies], data.site('end').xpos
    mujoco.mj_forward(model, data)
    speed = np.linalg.norm(places - before, axis=1).max() / model.opt.timestep
    return places, -data.efc_force[:3], speed  # the constraint pulls the end to the pin
