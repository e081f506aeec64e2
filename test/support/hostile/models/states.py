# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What is done with a drawn model: steps, and states, times and commands that are no numbers."""

import mujoco
import numpy as np

from fluid_sim_ros.plugins.native import ROW_WIDTH, native
from test.support.hostile.models.draw import Draw

INTEGRATORS = (mujoco.mjtIntegrator.mjINT_RK4, mujoco.mjtIntegrator.mjINT_IMPLICITFAST)
#: No numbers, ends of the doubles, and where whole numbers and ticks end.
BAD = (
    np.nan, np.inf, -np.inf, 1.7e308, -1.7e308, 1e200, 1e100, -1e100, 1e30, -1e30, 2.0**63, 1e17,
    -1e17, 2.0**53, 2.0**31, -(2.0**31), 1e6, -1e6, 5e-324, -0.0,
)  # fmt: skip
#: Arrays of mjData that a snapshot, a user or a plugin of others may fill.
PLACES = (
    'qpos', 'qvel', 'act', 'ctrl', 'plugin_state', 'qfrc_applied', 'xfrc_applied',
    'qacc_warmstart',
)  # fmt: skip
STEPS = 3


def used(model: mujoco.MjModel, seed: int) -> bool:
    """
    Step a model with both integrators, spoil its state in a few ways, and read everything of it.

    Parameters
    ----------
    model
        A drawn model.
    seed
        Chooses what is spoiled, by what.

    Returns
    -------
    bool
        Whether its state had only finite numbers after the steps from its start.

    """
    draw = Draw(f'state {seed}')
    data, scratch = mujoco.MjData(model), mujoco.MjData(model)
    finite = True
    for integrator in INTEGRATORS:
        model.opt.integrator = integrator
        mujoco.mj_resetData(model, data)
        data.ctrl[:] = [draw.choice((0, 0.5, -1, 1500, 1e4)) for _ in range(model.nu)]
        mujoco.mj_step(model, data, STEPS)
        finite &= bool(np.isfinite(data.qvel).all())
        _read(model, data, scratch, draw)
        for _ in range(3):
            _spoil(model, data, draw)
            _read(model, data, scratch, draw)
            model.opt.disableflags ^= draw.choice((0, mujoco.mjtDisableBit.mjDSBL_AUTORESET))
            mujoco.mj_step(model, data, STEPS)
    _with_other_options(model, data, scratch, draw)
    return finite


def _with_other_options(
    model: mujoco.MjModel, data: mujoco.MjData, scratch: mujoco.MjData, draw: Draw
) -> None:
    """Step under what a caller may set in a loaded model."""
    bits = mujoco.mjtDisableBit
    model.opt.integrator = draw.choice(list(mujoco.mjtIntegrator.__members__.values()))
    model.opt.disableflags = draw.choice((0, bits.mjDSBL_CLAMPCTRL, bits.mjDSBL_GRAVITY))
    model.opt.timestep = model.opt.timestep * draw.choice((1, 1e-6, 100))
    mujoco.mj_resetData(model, data)
    mujoco.mj_step(model, data, STEPS)
    _read(model, data, scratch, draw)


def _spoil(model: mujoco.MjModel, data: mujoco.MjData, draw: Draw) -> None:
    """Put numbers that are none, or hardly any, into the state."""
    mujoco.mj_resetData(model, data)
    bad = draw.choice(BAD)
    if draw.yes(0.4):
        data.time = bad
    for place in draw.sample(PLACES, draw.choice((0, 1, 1, 2, len(PLACES)))):
        array = getattr(data, place).reshape(-1)
        if not array.size:
            continue
        if draw.yes():
            array[:] = bad
        else:
            for at in draw.sample(range(array.size), draw.randrange(1, min(4, array.size) + 1)):
                array[at] = draw.choice(BAD)
    mujoco.mj_forward(model, data)


def _read(model: mujoco.MjModel, data: mujoco.MjData, scratch: mujoco.MjData, draw: Draw) -> None:
    """Ask the library for all that it tells of a state."""
    library, addresses = native(), (model._address, data._address)
    out = np.zeros(max(64, 2 * model.nv, 8 * model.nbody))
    point = np.array([draw.choice((*BAD, 0.0, 1.0, -1.0)) for _ in range(3)])
    body = draw.randrange(1, model.nbody)
    library.flow(*addresses, body, point.ctypes.data, out.ctypes.data)
    library.surface(*addresses, point.ctypes.data, 1, out.ctypes.data)
    library.beyond_grids(*addresses, point.ctypes.data, out.ctypes.data)
    for actuator in range(model.nu):
        library.thruster(*addresses, actuator, out.ctypes.data)
    library.kinetic_energy(*addresses, scratch._address, out.ctypes.data)
    library.explicit_force(*addresses, scratch._address, out.ctypes.data)
    sums = np.zeros(3)
    library.energy_take(*addresses, scratch._address, 0.1, sums.ctypes.data)
    bases = np.array([body], dtype=np.int32)
    rows = np.zeros(ROW_WIDTH)
    library.observe(*addresses, scratch._address, bases.ctypes.data, 1, 2, rows.ctypes.data)
    number = 0
    while library.limits(*addresses, number, out.ctypes.data) >= 0:
        number += 1
    library.forget_limits(*addresses)
    target = np.array([draw.choice((*BAD, 0.0, 3.0)) for _ in range(3)])
    if draw.yes(0.2):
        library.set_medium(*addresses, target.ctypes.data, target.ctypes.data)
    if draw.yes(0.1):
        library.seed_medium(*addresses, draw.choice((*BAD, 0.0, 3.0)))
    if draw.yes(0.1):
        library.enable_medium(*addresses, draw.choice((0, 1)))
