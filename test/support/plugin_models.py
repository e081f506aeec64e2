# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What the plugin benchmarks share: models with fluid_sim plugins, native calls, results."""

import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

from fluid_sim_ros.lab.problems.mjcf import (
    FIRST_ORDER,
    body_plugin,
    config,
    ellipsoid,
    free_body,
    text,
    world,
)
from fluid_sim_ros.plugins.messages import load_error_line
from fluid_sim_ros.plugins.native import native

__all__ = [
    'FIRST_ORDER', 'Array', 'body_plugin', 'config', 'ellipsoid', 'explicit_force', 'free_body',
    'kinetic_energy', 'load', 'refusal', 'set_medium', 'text', 'world',
]  # fmt: skip

Array = NDArray[np.float64]


def load(xml: str) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Compile MJCF and make its data."""
    native()
    model = mujoco.MjModel.from_xml_string(xml)
    return model, mujoco.MjData(model)


def explicit_force(model: mujoco.MjModel, data: mujoco.MjData) -> Array:
    """Return the generalized fluid force summed over the published terms, without qacc."""
    out = np.zeros(model.nv)
    scratch = mujoco.MjData(model)
    native().explicit_force(model._address, data._address, scratch._address, out.ctypes.data)
    return out


def kinetic_energy(
    model: mujoco.MjModel, data: mujoco.MjData, scratch: mujoco.MjData | None = None
) -> Array:
    """Return the kinetic energy of the bodies and of the flow around them [J], shape (2,)."""
    out = np.zeros(2)
    scratch = scratch or mujoco.MjData(model)
    native().kinetic_energy(model._address, data._address, scratch._address, out.ctypes.data)
    return out


def set_medium(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    *,
    wind: ArrayLike | None = None,
    current: ArrayLike | None = None,
) -> bool:
    """Let wind or current move towards a velocity [m/s]; False without a medium in charge."""
    vectors = [
        None if value is None else np.array(value, dtype=np.float64) for value in (wind, current)
    ]
    addresses = [0 if vector is None else vector.ctypes.data for vector in vectors]
    return bool(native().set_medium(model._address, data._address, *addresses))


def refusal(xml: str, plugin: str) -> str:
    """Return the one line with which ``plugin`` refuses a model; AssertionError if it does not."""
    try:
        load(xml)
    except ValueError as error:
        line = load_error_line(error)
    else:
        raise AssertionError('the model loads')
    assert '\n' not in line
    assert line.startswith(plugin), line
    return line
