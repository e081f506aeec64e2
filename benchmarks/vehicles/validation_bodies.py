# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Bodies of the validation: settling spheres and falling plates."""

from typing import Any

import mujoco
import numpy as np
from scipy.integrate import solve_ivp

from benchmarks.vehicles.validation_row import Row
from fluid_sim_ros.lab.problems.plates import A, plate_mjcf, speed_scale, start_state
from fluid_sim_ros.physics.falling_plate import PlateParams, falling_plate_rhs
from test.support.plugin_models import Array, body_plugin, ellipsoid, free_body, load, world

G, WATER, TIMESTEP = 9.81, 997.0, 2e-4  # [m/s^2], [kg/m^3], [s]
#: [m^2/s]: of the water that gives their Reynolds numbers, 41, 280 and 360.
NU = 0.904e-6
#: Diameter [m], density over that of water, terminal speed [m/s], tau95 [s]: cases 1, 2 and 4.
SPHERES = {
    'glass, 0.5 mm': (0.5e-3, 2.56, 0.0741, 0.055),
    'steel, 0.8 mm': (0.8e-3, 7.71, 0.316, 0.108),
    'glass, 1.5 mm': (1.5e-3, 2.56, 0.218, 0.142),
}
MORDANT = 'Mordant and Pinton 2000, Eur. Phys. J. B 18:343, as in the test case of Basilisk'
#: Width and thickness [m] of the aluminium plate, and its speed of descent [m/s].
PLATE, DESCENT = (7.2e-3, 0.81e-3), 0.12
ANDERSEN = 'Andersen, Pesavento and Wang 2005, J. Fluid Mech. 541:65: tumbles at about 12 cm/s'


def settling_world(diameter: float, ratio: float, **more: Any) -> str:
    """Return MJCF of a sphere in water, ``more``: keys of fluid_sim.body."""
    plugin = body_plugin(
        added_mass='auto', volume='auto', drag='ellipsoid', drag_reynolds='brown_lawler', **more
    )
    return world(
        free_body(ellipsoid([diameter / 2] * 3, ratio * WATER) + plugin),
        gravity=(0, 0, -G), timestep=TIMESTEP, integrator='implicitfast',
        medium={'density': WATER, 'viscosity': NU * WATER},
    )  # fmt: skip


def settle(diameter: float, ratio: float, seconds: float, **more: Any) -> tuple[Array, Array]:
    """Return times [s] and speeds [m/s] of a sphere that sinks from rest; ``more``: keys."""
    timestep, every = TIMESTEP, 5
    model, data = load(settling_world(diameter, ratio, **more))
    speeds = np.zeros(round(seconds / timestep / every) + 1)
    for i in range(1, len(speeds)):
        mujoco.mj_step(model, data, every)
        speeds[i] = -data.qvel[2]
    return np.arange(len(speeds)) * timestep * every, speeds


def tau95(times: Array, speeds: Array) -> float:
    """Return when 95 % of the last speed is reached [s]."""
    beyond = int(np.argmax(speeds >= 0.95 * speeds[-1]))
    return float(np.interp(0.95 * speeds[-1], speeds[: beyond + 1], times[: beyond + 1]))


def spheres() -> list[Row]:
    """Return terminal speed and tau95 of each sphere."""
    rows = []
    for name, (diameter, ratio, terminal, time) in SPHERES.items():
        plain = settle(diameter, ratio, 12 * time)
        mended = settle(diameter, ratio, 12 * time, history='dorgan_loth')
        rows += [
            Row(name, 'terminal speed', 'm/s', terminal, MORDANT, float(plain[1][-1]),
                'the standard drag curve, within its scatter at this Reynolds number'),
            Row(name, 'time to 95 % of it', 's', time, MORDANT, tau95(*plain),
                'no history force', tau95(*mended), 'history="dorgan_loth"'),
        ]  # fmt: skip
    return rows


def descent(path: Array, times: Array) -> float:
    """Return the mean speed of descent in the second half."""
    half = len(times) // 2
    return float(-(path[-1, 1] - path[half, 1]) / (times[-1] - times[half]))


def plates() -> list[Row]:
    """Return how fast the plate descends, by the plugin and by the paper's own equations."""
    width, thickness = PLATE
    beta = thickness / width
    inertia = 2.7 * beta
    scale = float(np.sqrt((2.7 - 1) * G * thickness / 2))  # [m/s]
    unit = speed_scale(inertia, beta)
    model, data = load(plate_mjcf(inertia, plugin=True, beta=beta, timestep=0.01 * A / unit))
    data.qpos[:], data.qvel[:] = start_state(inertia, beta)
    path = np.zeros((2000, 3))
    for row in path:
        mujoco.mj_step(model, data, 10)
        row[:] = data.qpos[0] / A, data.qpos[1] / A, data.qpos[2]
    times = np.arange(len(path)) * 0.1
    solution = solve_ivp(
        falling_plate_rhs, (0, 200), (0, 0, 0.3, 0.01, -0.01, 0.01), t_eval=times, rtol=1e-8,
        atol=1e-10, args=(PlateParams(inertia),),
    )  # fmt: skip
    theory = descent(solution.y[:3].T, times) * scale
    turns = abs(path[-1, 2] - path[0, 2]) / (2 * np.pi)
    return [
        Row('plate 7.2 x 0.81 mm', 'speed of descent', 'm/s', DESCENT, ANDERSEN,
            descent(path, times) * scale,
            f'it flutters ({turns:.1f} turns); so do the paper\'s own quasi-steady equations, at '
            f'{theory:.3f} m/s: coefficients of thin plates, no wake'),
    ]  # fmt: skip


def bodies() -> list[Row]:
    """Return all rows."""
    return [*spheres(), *plates()]
