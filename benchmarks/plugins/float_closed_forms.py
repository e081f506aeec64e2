# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Floats against closed forms: depth at rest, frequencies of heave and roll."""

from typing import Any

import mujoco
import numpy as np
from scipy.optimize import brentq

from fluid_sim_ros.physics.kappa import ellipsoid_volume
from test.support.oscillations import oscillation, period
from test.support.plugin_models import Array, body_plugin, free_body, load, text, world

WATER, G = 1000.0, 9.81


def settled_depth(model: mujoco.MjModel, data: mujoco.MjData) -> float:
    """Return the height at which weight and buoyancy cancel (upright)."""

    def net(height: float) -> float:
        data.qpos[2] = height
        mujoco.mj_forward(model, data)
        return float(data.qfrc_passive[2] - data.qfrc_bias[2])

    return float(brentq(net, -0.3, 0.3, xtol=1e-13))


def float_cases() -> dict[str, tuple[str, float, float, float]]:
    """
    Return name -> (body, depth of the origin, heave stiffness, roll stiffness about x).

    Depth is the height of the origin at rest. Roll stiffness: rho g V_wet (BM - (z_G - z_B)), with
    BM the second moment of the waterplane over V_wet; for the sphere m g times the distance from
    its centre down to the centre of mass.
    """
    cases = {}
    radius, low = 0.15, 0.04
    volume = 4 / 3 * np.pi * radius**3
    mass = 0.4 * WATER * volume

    def wet(depth: float) -> float:
        return np.pi * (radius**2 * (radius + depth) - (depth**3 + radius**3) / 3)

    sunk = brentq(lambda d: wet(d) - mass / WATER, -radius, radius, xtol=1e-14)
    area = np.pi * (radius**2 - sunk**2)
    inside = (
        f'<inertial pos="0 0 {-low}" mass="{mass:.17g}" diaginertia=".02 .03 .04"/>'
        f'<geom type="sphere" size="{radius}"/>'
    )
    cases['sphere'] = (inside, -sunk, WATER * G * area, mass * G * low)

    half = np.array([0.3, 0.2, 0.1])
    draft = 0.12
    mass = WATER * 4 * half[0] * half[1] * draft
    inside = (
        f'<inertial pos="0 0 0" mass="{mass:.17g}" diaginertia=".9 1.2 1.5"/>'
        f'<geom type="box" size="{text(half)}"/>'
    )
    second = 2 * half[0] * (2 * half[1]) ** 3 / 12
    cases['box'] = (
        inside,
        half[2] - draft,
        WATER * G * 4 * half[0] * half[1],
        WATER * G * second - mass * G * (half[2] - draft / 2),
    )

    axes = np.array([0.35, 0.25, 0.15])
    whole = ellipsoid_volume(axes)
    mass = 0.6 * WATER * float(whole)
    share = brentq(lambda p: 2 / 3 + p - p**3 / 3 - 0.6 * 4 / 3, -1, 1, xtol=1e-14)
    sunk = share * axes[2]
    area = np.pi * axes[0] * axes[1] * (1 - share**2)
    second = np.pi / 4 * axes[0] * axes[1] ** 3 * (1 - share**2) ** 2
    center = -3 * (1 - share**2) ** 2 / (4 * (2 + 3 * share - share**3)) * axes[2]
    inside = (
        f'<inertial pos="0 0 0" mass="{mass:.17g}" diaginertia=".3 .5 .7"/>'
        f'<geom type="ellipsoid" size="{text(axes)}"/>'
    )
    cases['ellipsoid'] = (
        inside,
        -sunk,
        WATER * G * area,
        WATER * G * second + mass * G * center,
    )
    return cases


def floats() -> dict[str, float]:
    """
    Return errors of depth [of 0.1 m], heave and roll frequency of three floats.

    Each without and with a stated added mass about the centre of mass, of which the wetted share
    takes part: omega^2 = stiffness / (m + s A). The slamming force is of second order here.
    """
    errors = {}
    for name, (inside, height, heave, roll) in float_cases().items():
        for added in (0.0, 1.0):
            label = f'float_{name}' + ('_added_mass' if added else '')
            model, data = float_model(inside, added)
            mass, center = model.body_mass[1], model.body_ipos[1]
            share = mass / (WATER * volume_of(inside))
            about_x = model.body_inertia[1, np.argmax(np.abs(_axes(model)[0]))]
            errors[f'{label}_depth'] = abs(settled_depth(model, data) - height) / 0.1

            mujoco.mj_resetData(model, data)
            data.qpos[2] = height + 1e-5
            times, values = oscillation(model, data, lambda d=data, h=height: d.qpos[2] - h, 10.0)
            expected = 2 * np.pi * np.sqrt((mass + share * added * HEAVE_ADDED) / heave)
            errors[f'{label}_heave'] = abs(period(times, values) / expected - 1)

            mujoco.mj_resetData(model, data)
            angle = 1e-4
            data.qpos[:] = [0, 0, height, np.cos(angle / 2), np.sin(angle / 2), 0, 0]
            # turn about the centre of mass, so that heave and sway stay at rest
            data.qpos[1] += center[2] * np.sin(angle)
            data.qpos[2] += center[2] * (1 - np.cos(angle))
            times, values = oscillation(model, data, lambda d=data: d.qpos[4], 20.0)
            expected = 2 * np.pi * np.sqrt((about_x + share * added * ROLL_ADDED) / roll)
            errors[f'{label}_roll'] = abs(period(times, values) / expected - 1)
    return errors


HEAVE_ADDED, ROLL_ADDED = 9.0, 0.4  # [kg], [kg m^2], stated


def float_model(inside: str, added: float) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Return a float in still water, with the stated added mass times ``added``."""
    values: dict[str, Any] = {'volume': 'auto', 'drag': 'none'}
    if added:
        center = inside.split('pos="')[1].split('"')[0]
        diagonal = added * np.array([5, 6, HEAVE_ADDED, ROLL_ADDED, 0.3, 0.2])
        values |= {'added_mass': diagonal, 'reference_point': center}
    return load(
        world(
            free_body(inside + body_plugin(**values)),
            gravity=(0, 0, -G),
            timestep=0.002,
            medium={'density': WATER, 'surface': 0},
        )
    )


def volume_of(inside: str) -> float:
    """Return the whole volume of the float's geom [m^3]."""
    size = np.array(inside.split('size="')[1].split('"')[0].split(), dtype=float)
    if 'box' in inside:
        return float(8 * size.prod())
    return float(ellipsoid_volume(size if size.size == 3 else np.full(3, size[0])))


def _axes(model: mujoco.MjModel) -> Array:
    """Return the inertial frame's axes in body axes (rows: body x, y, z)."""
    matrix = np.zeros(9)
    mujoco.mju_quat2Mat(matrix, model.body_iquat[1])
    return matrix.reshape(3, 3)
