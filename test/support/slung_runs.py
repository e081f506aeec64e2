# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The load of x500_slung_load under a vehicle that is held: a pendulum."""

import mujoco
import numpy as np
from scipy.special import ellipk

from fluid_sim_ros import Scene, load_plugins

#: Length of the cord [m], gravity [m/s^2].
LENGTH, GRAVITY = 1.5, 9.81


def exact_period(angle):
    """Return the period of a pendulum of any amplitude [rad] without drag [s]."""
    return 4 * np.sqrt(LENGTH / GRAVITY) * ellipk(np.sin(angle / 2) ** 2)


def pendulum(angle):
    """Return the mean period of eight swings of the load under a vehicle that is held [s]."""
    load_plugins()
    spec = Scene.load('x500_slung_load').read_model()
    for key in list(spec.keys):
        spec.delete(key)
    spec.delete(spec.joint('x500'))
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    hook = data.site('hook').xpos.copy()
    data.qpos[:3] = hook + LENGTH * np.array([np.sin(angle), 0.0, -np.cos(angle)])
    times, before = [], float(data.qpos[0])
    while len(times) < 9:
        mujoco.mj_step(model, data)
        now = float(data.qpos[0])
        if before < 0 <= now:
            times.append(data.time - model.opt.timestep * now / (now - before))
        before = now
    assert abs(data.ten_length[0] - LENGTH) < 1e-3
    return (times[-1] - times[0]) / 8
