# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Runs of the remus100 that the tests and the benchmark compare with remus_equations."""

import re
import tempfile
from collections.abc import Mapping
from pathlib import Path

import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

from fluid_sim_ros import Simulation
from test.support import vehicle_runs as runs
from test.support.paths import MODELS
from test.support.remus_equations import ADDED, FLIP, FORCES, MASS, RIGID, VELOCITIES, convection

Array = NDArray[np.float64]
#: Speed of the measurement; the small velocity across, where drag (of second order) is nothing.
AHEAD, SMALL = 1.5, 1e-5  # [m/s], [m/s] or [rad/s]
#: Volume [m^3] of the model that weighs what it displaces.
NEUTRAL = MASS / 1030


def variant(changes: Mapping[str, str | None], *, fins: bool = True) -> Simulation:
    """Return the model, deep, with other values of fluid_sim.body; None takes a key away."""
    text = (MODELS / 'remus100.xml').read_text()
    text = text.replace('file="parts', f'file="{MODELS}/parts')
    for key, value in changes.items():
        pattern = rf'<config key="{key}"\s+value="[^"]*"/>'
        new = '' if value is None else f'<config key="{key}" value="{value}"/>'
        text, count = re.subn(pattern, new, text)
        if count != 1:
            raise ValueError(f'{key}: stands {count} times in remus100.xml')
    if not fins:
        text = re.sub(r'<plugin plugin="fluid_sim.foil">.*?</plugin>', '', text, flags=re.DOTALL)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / 'remus100.xml'
        path.write_text(text)
        simulation = Simulation(path)
    simulation.model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
    simulation.data.qpos[:] = [0, 0, -50, 1, 0, 0, 0, 0, 0]
    return simulation


def hydrodynamic_wrench(
    simulation: Simulation,
    nu: ArrayLike,
    deflection: ArrayLike = (0.0, 0.0),
    *,
    added: bool = True,
) -> Array:
    """
    Return the wrench of the water at a velocity, about the origin, body axes, without -A nu'.

    From MuJoCo's acceleration and the rigid body's Newton and Euler equations, without gravity;
    ``deflection`` of rudder and planes [rad]; ``added``: the model has its added mass.
    """
    model, data = simulation.model, simulation.data
    velocity = np.asarray(nu, dtype=float)
    model.opt.gravity[:] = 0
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4  # no damping in the effective mass
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_ACTUATION
    data.qpos[7:] = deflection
    data.qvel[:] = [*velocity, 0, 0]
    mujoco.mj_forward(model, data)
    rate = data.qacc[:6].copy()
    rate[:3] -= np.cross(velocity[3:], velocity[:3])  # as body axes see it
    matrix = RIGID + ADDED if added else RIGID
    wrench: Array = matrix @ rate - convection(RIGID, velocity)
    return wrench


def coefficient(simulation: Simulation, name: str, *, added: bool = True) -> float:
    """Return a coefficient as published (ship axes) from the wrench of the water."""
    row = FORCES.index(name[0])
    if name[1:3] == 'uu':  # of a fin
        nu, turned = [AHEAD, 0, 0, 0, 0, 0], 1e-3 * np.eye(2)[int(name.endswith('ds'))]
        up = hydrodynamic_wrench(simulation, nu, turned)
        return float(FLIP[row] * (up - hydrodynamic_wrench(simulation, nu, -turned))[row]
                     / (2e-3 * AHEAD**2))  # fmt: skip
    axis = VELOCITIES.index(name[2])
    alone = name[1] == name[2]
    step = (AHEAD if alone else SMALL) * np.eye(6)[axis]
    along = np.zeros(6) if alone else AHEAD * np.eye(6)[0]
    up = hydrodynamic_wrench(simulation, along + step, added=added)
    down = hydrodynamic_wrench(simulation, along - step, added=added)
    product = AHEAD**2 if alone else SMALL * AHEAD
    return float(FLIP[row] * FLIP[axis] * (up - down)[row] / (2 * product))


def straight_speed(thrust: float) -> float:
    """Return the speed [m/s] reached under a thrust [N], W = B, attitude and depth held."""
    simulation = variant({'volume': f'{NEUTRAL:.12g}'})
    runs.set_all(simulation, 'remus100', thrust)
    simulation.data.qvel[0] = 1.2
    velocity = runs.held(simulation, np.array([1.0, 0, 0, 0]), 120.0)
    if np.abs(velocity[:, 1:]).max() > 1e-3:
        raise ValueError('remus100 leaves its depth or its way')
    return float(velocity[-1, 0])
