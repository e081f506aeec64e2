# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The largest timestep that is stable, found by bisection."""

import itertools
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from fluid_sim_ros.lab.problems.bodies import Body, Family
from fluid_sim_ros.lab.problems.boundaries import critical
from fluid_sim_ros.lab.stability.outcomes import one_step, outcome
from fluid_sim_ros.lab.stability.stability_map import body_at, values
from fluid_sim_ros.output.progress import Report, silent

#: Bisection ends when the timestep is known to this factor.
_PRECISION = 1.05


def bisect(
    accepts: Callable[[float], bool], low: float, high: float, precision: float = _PRECISION
) -> float | None:
    """
    Return the timestep up to which all are accepted.

    Steps are doubled up to the first that is refused, then halved (by their ratio) in between.

    Parameters
    ----------
    accepts
        Whether a timestep [s] is good.
    low, high
        Smallest and largest timestep [s].
    precision
        Factor to which the result is known.

    Returns
    -------
    float or None
        [s]; None where ``low`` is refused already, ``high`` where nothing is refused.

    """
    if not accepts(low):
        return None
    while accepts(min(2 * low, high)):
        if 2 * low >= high:
            return high
        low *= 2
    high = min(2 * low, high)
    while high / low > precision:
        middle = float(np.sqrt(low * high))
        low, high = (middle, high) if accepts(middle) else (low, middle)
    return float(np.sqrt(low * high))


def largest_steps(head: Mapping[str, Any], report: Report = silent) -> list[dict[str, Any]]:
    """
    Return the largest stable timestep at each value of y.

    Parameters
    ----------
    head
        Of a map whose x is the timestep.
    report
        Told how far it is.

    Returns
    -------
    list
        Rows with ``integrator``, ``y`` and ``largest_s`` [s] (None: unstable everywhere).

    """
    low, high = head['x_range']
    keys = list(itertools.product(head['integrators'], values(head, 'y')))
    rows = []
    for done, (integrator, y) in enumerate(keys):
        report(f'{head["problem"]}: bisection', done, len(keys))
        body = body_at(head, {**head['fixed'], head['y']: y})

        def stable(h: float, body: Body = body, kind: str = integrator) -> bool:
            return outcome(body, kind, h).word == 'stable'

        rows.append({'integrator': integrator, 'y': y, 'largest_s': bisect(stable, low, high)})
    report(f'{head["problem"]}: bisection', len(keys), len(keys))
    return rows


def measured_numbers(kind: Family, integrator: str) -> dict[str, dict[str, float]]:
    """
    Return the drag number of each boundary, predicted and measured by bisection of one step.

    Over three densities, so that the mass (and the added mass) is seen to be the right one.

    Parameters
    ----------
    kind
        Bodies whose drag is explicit.
    integrator
        ``Euler`` or ``RK4``.

    Returns
    -------
    dict
        By boundary: ``predicted`` and ``measured`` drag number [-], and ``worst``, the largest
        relative difference.

    """
    out = {}
    for name, number in critical(integrator, kind.drag).items():
        found = []
        for ratio in (0.01, 0.1, 1.0):
            body = kind.body.with_values({'density_ratio': ratio})

            def accepts(x: float, body: Body = body, name: str = name) -> bool:
                gain = one_step(body, integrator, x / body.drag_number(1.0))
                return gain > 0 if name == 'sign flip' else abs(gain) < 1

            bound = bisect(accepts, number / 3, number * 3, 1.0001)
            found.append(float('nan') if bound is None else bound)
        out[name] = {
            'predicted': number, 'measured': found[0],
            'worst': max(abs(x / number - 1) for x in found),
        }  # fmt: skip
    return out
