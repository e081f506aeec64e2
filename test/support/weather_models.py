# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A body that reads the flow of fluid_sim.medium, and what stands at a point of it."""

import mujoco
import numpy as np

from fluid_sim_ros.plugins.native import native
from test.support.plugin_models import (
    body_plugin,
    ellipsoid,
    free_body,
    load,
    world,
)

AIR = {'density': 1.2}
#: A body whose damping reads the flow: force = -(v - u) for unit coefficients.
PROBE = free_body(ellipsoid([0.3, 0.2, 0.1], 1e6) + body_plugin(linear_damping=[1, 1, 1, 0, 0, 0]))
DRYDEN = AIR | {
    'wind': [6, 0, 0], 'turbulence': 'dryden', 'turbulence_sigma': [1.5, 1.2, 0.8],
    'turbulence_length': [60, 50, 20], 'turbulence_airspeed': [12], 'seed': [5],
}  # fmt: skip


def flow(model, data, point=(0, 0, 0), body=1):
    """Return velocity, material derivative and spin of the flow at a point."""
    out, place = np.zeros(9), np.array(point, dtype=float)
    native().flow(model._address, data._address, body, place.ctypes.data, out.ctypes.data)
    return out[:3], out[3:6], out[6:]


def at(model, data, time):
    data.time = time
    return flow(model, data)


def weather(medium, **options):
    return load(world(PROBE, medium=medium, **options))


def rows_of(model, data, steps):
    out = []
    for _ in range(steps):
        out.append(np.concatenate(flow(model, data)))
        mujoco.mj_step(model, data)
    return np.array(out)
