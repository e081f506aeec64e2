# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Random runs that are stable by construction: no watchdog may speak up in them."""

import numpy as np

from fluid_sim_ros.lab.problems.bodies import RADIUS, Body
from fluid_sim_ros.lab.problems.problem import INTEGRATORS

#: Share of the explicit stability limit, and of a radian, that a step may take.
_SMALL = 0.02


def random_run(rng: np.random.Generator) -> tuple[Body, str, float]:
    """
    Return a body, an integrator and a timestep far inside of every limit.

    Half of them tumble, by RK4, with or without drag and added mass; half are braked along their
    axis, by any integrator: a first-order one feeds a tumbling motion at every step size.

    Parameters
    ----------
    rng
        Source of the draws.

    Returns
    -------
    body, integrator, timestep
        What to run, by which integrator, at which timestep [s].

    """
    tumbling = bool(rng.integers(2))
    body = Body(
        density_ratio=float(np.exp(rng.uniform(np.log(0.05), np.log(8)))),
        aspect=float(np.exp(rng.uniform(np.log(0.3), np.log(3)))),
        speed=float(rng.uniform(0.2, 5)),
        spin=float(rng.uniform(0.5, 5)) if tumbling else 0.0,
        blunt=float(rng.choice([0.0, 0.2, 0.5])) if tumbling else float(rng.uniform(0.1, 0.6)),
        plugin=bool(rng.integers(2)),
        tumbling=tumbling,
        duration=0.3,
    )
    integrators = ('RK4',) if tumbling else INTEGRATORS
    limit = 2.0 / body.drag_number(1.0) if body.blunt else np.inf
    # the added-mass moment turns a body at v/r sqrt(m_A/(2/5 m)) or so
    munk = body.speed / RADIUS * np.sqrt(1 + 2.5 * body.lightness)
    turn = 1.0 / (body.spin + munk) if tumbling else np.inf
    step = _SMALL * min(limit, turn, 0.1)
    return body, str(rng.choice(integrators)), float(f'{step:.3g}')
