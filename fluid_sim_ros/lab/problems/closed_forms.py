# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Problems whose motion is a formula: falls, rise, spin-down, pendulum in water."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import ellipj, ellipk

from fluid_sim_ros.lab.problems.body_watch import POSITION, QUATERNION, STATE_WIDTH
from fluid_sim_ros.lab.problems.mjcf import body_plugin, ellipsoid, free_body, text, world
from fluid_sim_ros.lab.problems.problem import TIMESTEPS, Problem, Rung
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.physics.kappa import ellipsoid_volume
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.schema.scene import VehicleFile

WATER, G = 1000.0, 9.81  # fresh water, rounded [kg/m^3]; gravity [m/s^2]
#: Rungs of a body that is one ellipsoid, poorest first.
RUNGS = ('none', 'inertia', 'ellipsoid', '+ buoyancy', '+ added inertia')


def scene_of(name: str, mjcf: str, body: str = 'hull') -> Scene:
    """
    Return a scene of one vehicle from text, starting at its keyframe ``start``.

    Parameters
    ----------
    name
        Of the scene.
    mjcf
        Text of the model, with a keyframe ``start``.
    body
        Name of the vehicle's base in it.

    Returns
    -------
    Scene
        One vehicle, ``hull``, without thrusters.

    """
    return Scene(
        name=name,
        model_path=Path(f'{name}.xml'),
        mjcf=mjcf,
        keyframe='start',
        vehicles={'hull': VehicleFile(body=body, thrusters=[], joints=[])},
    )


def keyframe(qpos: ArrayLike, qvel: ArrayLike, ctrl: str = '') -> str:
    """
    Return the element of the start state.

    Parameters
    ----------
    qpos
        Coordinates [m], [rad], quaternions w x y z; shape (nq,).
    qvel
        Velocities [m/s], [rad/s]; shape (nv,).
    ctrl
        Attribute ``ctrl="..."``, or empty.

    Returns
    -------
    str
        A ``<keyframe>`` element.

    """
    return (
        f'<keyframe><key name="start" qpos="{text(qpos)}" qvel="{text(qvel)}" {ctrl}/></keyframe>'
    )


def ellipsoid_rungs(
    name: str,
    axes: ArrayLike,
    density: float,
    *,
    fluid: float = WATER,
    viscosity: float = 0.0,
    coef: ArrayLike = (0, 0, 0, 0, 0),
    gravity: float = G,
    qvel: ArrayLike = (0, 0, 0, 0, 0, 0),
    rungs: Sequence[str] = RUNGS,
    place: Callable[[str], str] = free_body,
    qpos: ArrayLike = (0, 0, 0, 1, 0, 0, 0),
) -> dict[str, Rung]:
    """
    Return the rungs of a body that is one ellipsoid.

    Parameters
    ----------
    name
        Of the scenes.
    axes
        Semi-axes [m], shape (3,).
    density
        Of the body [kg/m^3].
    fluid
        Density of the fluid [kg/m^3].
    viscosity
        Of the fluid [Pa s].
    coef
        MuJoCo's five ``fluidcoef`` [-]: blunt, slender, angular, Kutta, Magnus.
    gravity
        Downward [m/s^2].
    qvel
        Velocities at the start [m/s], [rad/s], shape (nv,).
    rungs
        Which ones, poorest first.
    place
        Puts the geom (MJCF text) into a body of the world.
    qpos
        Coordinates at the start [m], [rad], shape (nq,).

    Returns
    -------
    dict
        Rung by name, poorest first.

    """
    plugins: dict[str, dict[str, Any]] = {
        '+ buoyancy': {'volume': 'auto'},
        '+ added inertia': {'volume': 'auto', 'added_mass': 'auto'},
    }
    out = {}
    for rung in rungs:
        geom = ellipsoid(axes, density, coef)
        if rung == 'inertia':
            geom = geom.replace('fluidshape="ellipsoid"', '')
        if rung in plugins:
            geom += body_plugin(**plugins[rung])
        option = f'density="{fluid}" viscosity="{viscosity}"' if rung != 'none' else ''
        mjcf = world(
            place(geom), gravity=(0, 0, -gravity), option=option, extra=keyframe(qpos, qvel)
        )
        out[rung] = Rung(scene_of(name, mjcf))
    return out


def level_states(count: int) -> Array:
    """
    Return states of one vehicle at rest at the origin, level.

    Parameters
    ----------
    count
        Number of times.

    Returns
    -------
    Array
        Columns as in ``problem``: position, quaternion, velocity, rate; shape (count, 1, 13).

    """
    states = np.zeros((count, 1, STATE_WIDTH))
    states[..., QUATERNION.start] = 1
    return states


def terminal_velocity() -> Problem:
    """Return the fall of an aluminium sphere in water: quadratic drag, tanh law."""
    return _newton_fall(
        'terminal_velocity', 'Aluminium sphere sinks to its terminal speed',
        'drop test of a sphere in a tank; Newton drag, v = vt tanh(t/tau)',
        radius=0.01, density=2700.0, blunt=0.23, duration=1.0,
    )  # fmt: skip


def buoyant_rise() -> Problem:
    """Return the rise of a light sphere: the added mass is 2.5 times its own."""
    return _newton_fall(
        'buoyant_rise', 'Light sphere rises in water',
        'release of a buoyant sphere under water; tanh law with the added mass',
        radius=0.05, density=200.0, blunt=0.23, duration=1.0,
    )  # fmt: skip


def _newton_fall(
    name: str, title: str, stands_for: str, *, radius: float, density: float, blunt: float,
    duration: float,
) -> Problem:  # fmt: skip
    """Fall by vt tau ln cosh(t/tau), vt = sqrt(W/K), tau = (m + m_A) vt/W, K = C rho pi r^2."""
    volume = float(ellipsoid_volume(np.full(3, radius)))
    mass, weight = (density + WATER / 2) * volume, (density - WATER) * volume * G
    drag = blunt * WATER * np.pi * radius**2
    speed = np.sqrt(abs(weight) / drag)
    tau = mass * speed / abs(weight)

    def reference(times: Array) -> Array:
        states = level_states(len(times))
        states[:, 0, 2] = -np.sign(weight) * speed * tau * np.log(np.cosh(times / tau))
        states[:, 0, 9] = -np.sign(weight) * speed * np.tanh(times / tau)
        return states

    return Problem(
        name=name, title=title, stands_for=stands_for, duration=duration,
        rungs=ellipsoid_rungs(name, [radius] * 3, density, coef=(blunt, 0, 0, 0, 0)),
        reference=reference, reference_kind='closed form',
    )  # fmt: skip


def stokes() -> Problem:
    """Return the fall of a small sphere in glycerol: linear drag."""
    radius, density, fluid, viscosity = 0.005, 2700.0, 1260.0, 1.41  # glycerol 20 degC (CRC)
    volume = float(ellipsoid_volume(np.full(3, radius)))
    weight = (density - fluid) * volume * G
    drag = 6 * np.pi * viscosity * radius
    speed, tau = weight / drag, (density + fluid / 2) * volume / drag

    def reference(times: Array) -> Array:
        states = level_states(len(times))
        states[:, 0, 2] = -speed * (times + tau * np.expm1(-times / tau))
        states[:, 0, 9] = speed * np.expm1(-times / tau)
        return states

    return Problem(
        name='stokes', title='Small sphere sinks in glycerol',
        stands_for='falling-ball viscometer (Re 0.5); Stokes drag and added mass, without the '
        'Basset history force',
        duration=0.05, sample=0.01, timesteps=tuple(h for h in TIMESTEPS if h <= 0.01),
        reference=reference, reference_kind='closed form',
        rungs=ellipsoid_rungs('stokes', [radius] * 3, density, fluid=fluid, viscosity=viscosity),
    )  # fmt: skip


def spin_down() -> Problem:
    """Return a sphere that spins in water: theta = (I/K) ln(1 + w0 t K/I)."""
    radius, coefficient, spin = 0.1, 1.5, 10.0  # [m], [-], [rad/s]
    inertia = 0.4 * WATER * float(ellipsoid_volume(np.full(3, radius))) * radius**2
    rate = coefficient * WATER * 8 * np.pi / 15 * radius**5 / inertia

    def reference(times: Array) -> Array:
        states = level_states(len(times))
        half = np.log1p(spin * times * rate) / rate / 2
        states[:, 0, 3], states[:, 0, 6] = np.cos(half), np.sin(half)
        states[:, 0, 12] = spin / (1 + spin * times * rate)
        return states

    return Problem(
        name='spin_down', title='Spinning sphere slows down in water',
        stands_for='spin-down test of a float; quadratic angular drag',
        duration=2.0, discretised_by='attitude_rad', reference=reference,
        reference_kind='closed form',
        rungs=ellipsoid_rungs(
            'spin_down', [radius] * 3, WATER, coef=(0, 0, coefficient, 0, 0), gravity=0,
            qvel=(0, 0, 0, 0, 0, spin), rungs=('none', 'inertia', 'ellipsoid'),
        ),
    )  # fmt: skip


def water_pendulum() -> Problem:
    """Return a ball that swings on a rod in an ideal fluid, 57 degrees to each side."""
    radius, density, length, start = 0.05, 2700.0, 0.6, 1.0  # [m], [kg/m^3], [m], [rad]
    volume = float(ellipsoid_volume(np.full(3, radius)))
    inertia = (density + WATER / 2) * volume * length**2
    inertia += 0.4 * density * volume * radius**2
    stiffness = (density - WATER) * volume * G * length
    omega, modulus = np.sqrt(stiffness / inertia), np.sin(start / 2) ** 2

    def reference(times: Array) -> Array:
        # theta = 2 asin(k sn(K - w t)), k = sin(theta0/2) (Landau and Lifshitz, Mechanics, 11)
        sn, cn, _, _ = ellipj(ellipk(modulus) - omega * times, modulus)
        angle = 2 * np.arcsin(np.sqrt(modulus) * sn)
        states = level_states(len(times))
        states[:, 0, 0], states[:, 0, 2] = -length * np.sin(angle), -length * np.cos(angle)
        states[:, 0, 3], states[:, 0, 5] = np.cos(angle / 2), np.sin(angle / 2)
        states[:, 0, 11] = -2 * omega * np.sqrt(modulus) * cn
        return states

    def invariants(_times: Array, states: Array) -> dict[str, Array]:
        rate, height = states[:, 0, 11], states[:, 0, POSITION][:, 2]
        return {'energy': inertia * rate**2 / 2 + stiffness * (1 + height / length)}

    def hang(inside: str) -> str:
        return (
            f'<body name="hull" pos="0 0 {-length}"><joint axis="0 1 0" pos="0 0 {length}"/>'
            f'{inside}</body>'
        )

    return Problem(
        name='water_pendulum', title='Ball on a rod swings in an ideal fluid',
        stands_for='pendulum in water (Bessel 1828, added mass of a sphere); elliptic functions',
        duration=5.0, reference=reference, reference_kind='closed form', invariants=invariants,
        rungs=ellipsoid_rungs(
            'water_pendulum', [radius] * 3, density, place=hang, qpos=[start], qvel=[0]
        ),
    )  # fmt: skip
