# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Where explicit integration of drag fails, by theory: one step of v' = -|v| v or v' = -v."""

from collections.abc import Callable, Mapping
from functools import cache

import numpy as np
from scipy.optimize import brentq

from fluid_sim_ros.lab.problems.bodies import Body

#: Integrators that take drag at the start of the step, or within it, without its derivative.
EXPLICIT = ('Euler', 'RK4')


def amplification(integrator: str, drag: str, x: float) -> float:
    """
    Return v1/v0 after one step of drag number x = h K |v|/m (quadratic) or h S/m (linear).

    Euler: 1 - x for both. RK4: its four stages on v' = -|v| v or v' = -v with h = x, v0 = 1.

    Parameters
    ----------
    integrator
        ``Euler`` or ``RK4``.
    drag
        ``quadratic`` or ``linear``.
    x
        Drag number [-].

    Returns
    -------
    float
        v1/v0 [-].

    """

    def rate(v: float) -> float:
        return -abs(v) * v if drag == 'quadratic' else -v

    if integrator == 'Euler':
        return 1 + x * rate(1.0)
    k1 = rate(1.0)
    k2 = rate(1 + x / 2 * k1)
    k3 = rate(1 + x / 2 * k2)
    k4 = rate(1 + x * k3)
    return 1 + x / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


@cache
def critical(integrator: str, drag: str) -> dict[str, float]:
    """
    Return the drag numbers from which on a step turns the velocity round, and makes it grow.

    Euler: 1 and 2. RK4: it grows from 2.785 on (linear) or about 2.5 (quadratic).

    Parameters
    ----------
    integrator
        ``Euler`` or ``RK4``.
    drag
        ``quadratic`` or ``linear``.

    Returns
    -------
    dict
        Drag number [-] of ``sign flip`` and ``growth``, as far as there is one.

    """
    found = {}
    tests: dict[str, Callable[[float], float]] = {
        'sign flip': lambda x: amplification(integrator, drag, x),
        'growth': lambda x: abs(amplification(integrator, drag, x)) - 1,
    }
    for name, test in tests.items():
        grid = np.linspace(0.05, 4, 400)
        values = np.array([test(float(x)) for x in grid])
        crossings = np.flatnonzero(np.diff(np.sign(values)))
        if crossings.size:
            first = int(crossings[0])
            found[name] = float(brentq(test, grid[first], grid[first + 1], xtol=1e-12))
    return found


def predicted(body: Body, drag: str, integrator: str) -> Mapping[str, float]:
    """
    Return the timesteps at which theory places the boundaries.

    Parameters
    ----------
    body
        What coasts.
    drag
        ``quadratic``, ``linear``, or empty.
    integrator
        Name of the integrator.

    Returns
    -------
    dict
        [s] by name; empty where the integrator does not take drag explicitly.

    """
    if integrator not in EXPLICIT or not drag:
        return {}
    unit = body.drag_number(1.0)
    return {name: x / unit for name, x in critical(integrator, drag).items()}
