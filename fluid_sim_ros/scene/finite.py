# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Numbers of a model that positions come from: NaN, infinite and huge ones are refused."""

from pathlib import Path

import mujoco
import numpy as np

from fluid_sim_ros.errors import ModelError

#: Where MuJoCo itself gives a state up (mjMAXVAL).
MOST = 1e10
_OBJECTS = mujoco.mjtObj
#: Arrays of a model with one row per element: what they are of, and what they hold.
_ARRAYS = {
    'body_pos': (_OBJECTS.mjOBJ_BODY, 'pos'),
    'body_quat': (_OBJECTS.mjOBJ_BODY, 'orientation'),
    'body_ipos': (_OBJECTS.mjOBJ_BODY, 'centre of mass'),
    'body_mass': (_OBJECTS.mjOBJ_BODY, 'mass'),
    'body_inertia': (_OBJECTS.mjOBJ_BODY, 'inertia'),
    'jnt_pos': (_OBJECTS.mjOBJ_JOINT, 'pos'),
    'jnt_axis': (_OBJECTS.mjOBJ_JOINT, 'axis'),
    'geom_pos': (_OBJECTS.mjOBJ_GEOM, 'pos'),
    'geom_size': (_OBJECTS.mjOBJ_GEOM, 'size'),
    'site_pos': (_OBJECTS.mjOBJ_SITE, 'pos'),
    'site_quat': (_OBJECTS.mjOBJ_SITE, 'orientation'),
    'actuator_gear': (_OBJECTS.mjOBJ_ACTUATOR, 'gear'),
    'key_qpos': (_OBJECTS.mjOBJ_KEY, 'qpos'),
    'key_qvel': (_OBJECTS.mjOBJ_KEY, 'qvel'),
    'key_act': (_OBJECTS.mjOBJ_KEY, 'act'),
    'key_ctrl': (_OBJECTS.mjOBJ_KEY, 'ctrl'),
    'key_mpos': (_OBJECTS.mjOBJ_KEY, 'mpos'),
}
_KINDS = {
    _OBJECTS.mjOBJ_BODY: 'body', _OBJECTS.mjOBJ_JOINT: 'joint', _OBJECTS.mjOBJ_GEOM: 'geom',
    _OBJECTS.mjOBJ_SITE: 'site', _OBJECTS.mjOBJ_ACTUATOR: 'actuator', _OBJECTS.mjOBJ_KEY: 'key',
}  # fmt: skip


def check_numbers(model: mujoco.MjModel, path: Path) -> None:
    """
    Refuse a model from whose numbers no positions come.

    MuJoCo reads ``nan``, ``inf`` and ``1e308`` and, where a position is no number, writes more
    moments of site actuators than it has memory for (4.0.0).

    Parameters
    ----------
    model
        The compiled model.
    path
        Its file, for the error.

    Raises
    ------
    ModelError
        With the first element and number that is NaN, infinite or beyond ``MOST``.

    """
    for name, (kind, what) in _ARRAYS.items():
        rows = getattr(model, name)
        wrong = ~(np.abs(rows) <= MOST)
        if not wrong.any():
            continue
        index = int(np.argwhere(wrong)[0][0])
        title = _title(model, kind, index)
        raise ModelError(f'{path}: {title}: {what} {_refused(rows[wrong][0])}')
    wrong = ~(np.abs(model.qpos0) <= MOST)
    if wrong.any():
        raise ModelError(f'{path}: a joint: ref {_refused(model.qpos0[wrong][0])}')


def _refused(number: float) -> str:
    return f'= {number:g}; allowed: numbers from -{MOST:g} to {MOST:g}'


def _title(model: mujoco.MjModel, kind: mujoco.mjtObj, index: int) -> str:
    name = mujoco.mj_id2name(model, kind, index)
    return f"{_KINDS[kind]} '{name}'" if name else f'{_KINDS[kind]} {index}'
