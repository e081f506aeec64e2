# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""MJCF of small worlds: bodies in a fluid with the plugins, as text with every digit kept."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

#: Integrators of order 1 (MuJoCo's others: RK4).
FIRST_ORDER = ('Euler', 'implicit', 'implicitfast', 'discrete')


def text(values: ArrayLike) -> str:
    """
    Return numbers with all their digits, as MJCF wants them.

    Parameters
    ----------
    values
        Numbers of any shape.

    Returns
    -------
    str
        The numbers, separated by spaces.

    """
    return ' '.join(f'{value:.17g}' for value in np.asarray(values, dtype=float).reshape(-1))


def config(values: Mapping[str, Any]) -> str:
    """
    Return the <config> elements of a plugin instance.

    Parameters
    ----------
    values
        Value by key: a text, or numbers of any shape.

    Returns
    -------
    str
        Elements, one behind the other.

    """
    lines = []
    for key, value in values.items():
        written = value if isinstance(value, str) else text(value)
        lines.append(f'<config key="{key}" value="{written}"/>')
    return ''.join(lines)


def body_plugin(**values: Any) -> str:
    """
    Return the element that puts fluid_sim.body on the body around it.

    Parameters
    ----------
    values
        Configuration of the plugin by key.

    Returns
    -------
    str
        A ``<plugin>`` element.

    """
    return f'<plugin plugin="fluid_sim.body">{config(values)}</plugin>'


def ellipsoid(size: ArrayLike, density: float, coef: ArrayLike = (0, 0, 0, 0, 0)) -> str:
    """
    Return an ellipsoid geom that takes part in the fluid.

    Parameters
    ----------
    size
        Semi-axes [m], shape (3,).
    density
        [kg/m^3].
    coef
        MuJoCo's five ``fluidcoef`` [-].

    Returns
    -------
    str
        A ``<geom>`` element.

    """
    return (
        f'<geom type="ellipsoid" size="{text(size)}" density="{text(density)}" '
        f'fluidshape="ellipsoid" fluidcoef="{text(coef)}" contype="0" conaffinity="0"/>'
    )


def world(
    bodies: str,
    *,
    integrator: str = 'RK4',
    timestep: float = 0.01,
    gravity: ArrayLike = (0.0, 0.0, 0.0),
    option: str = '',
    flag: str = '',
    medium: Mapping[str, Any] | None = None,
    extra: str = '',
) -> str:
    """
    Return MJCF of a world with the plugins declared.

    Parameters
    ----------
    bodies
        Elements of the bodies.
    integrator
        Name of the integrator.
    timestep
        [s].
    gravity
        World axes [m/s^2], shape (3,).
    option, flag
        More attributes of ``<option>`` and of ``<flag>``.
    medium
        Configuration of ``fluid_sim.medium``; None leaves the plugin out.
    extra
        More elements, such as keyframes and actuators.

    Returns
    -------
    str
        The whole text.

    """
    instance = '' if medium is None else f'<instance name="fluid">{config(medium)}</instance>'
    if medium is not None:
        instance = f'<plugin plugin="fluid_sim.medium">{instance}</plugin>'
    return f"""<mujoco><option timestep="{timestep:.17g}" integrator="{integrator}"
gravity="{text(gravity)}" {option}><flag contact="disable" {flag}/></option>
<extension><plugin plugin="fluid_sim.body"/>{instance}</extension>
<worldbody>{bodies}</worldbody>{extra}</mujoco>"""


def free_body(inside: str, *, name: str = 'hull', position: ArrayLike = (0, 0, 0)) -> str:
    """
    Return a body with a free joint whose whole inertia matrix MuJoCo stores.

    Parameters
    ----------
    inside
        Elements of the body.
    name
        Of the body.
    position
        In the world [m], shape (3,).

    Returns
    -------
    str
        A ``<body>`` element.

    """
    return f'<body name="{name}" pos="{text(position)}" simple="false"><freejoint/>{inside}</body>'
