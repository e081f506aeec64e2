# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Records an oscillation of a model, and the period of one."""

from typing import Any

import mujoco
import numpy as np

from test.support.plugin_models import Array


def period(times: Array, values: Array) -> float:
    """Return the mean period from the zero crossings of a decaying or steady oscillation."""
    rising = np.flatnonzero((values[:-1] < 0) & (values[1:] >= 0))
    share = values[rising] / (values[rising] - values[rising + 1])
    crossings = times[rising] + share * (times[1] - times[0])
    return float(np.mean(np.diff(crossings)))


def oscillation(
    model: mujoco.MjModel, data: mujoco.MjData, read: Any, duration: float
) -> tuple[Array, Array]:
    """Return times and ``read()`` at every step."""
    steps = round(duration / model.opt.timestep)
    values = np.zeros(steps)
    for i in range(steps):
        values[i] = read()
        mujoco.mj_step(model, data)
    return np.arange(steps) * model.opt.timestep, values
