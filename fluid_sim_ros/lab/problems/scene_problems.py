# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Problems that are scenes: what no formula gives, against its own converged run."""

from dataclasses import replace

from fluid_sim_ros.lab.problems.from_scene import of_scene
from fluid_sim_ros.lab.problems.problem import Problem
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.schema.turbulence import Dryden


def swimmer() -> Problem:
    """Return six links that swim by a travelling wave."""
    case = of_scene('swimmer', 2.0)
    return replace(
        case, title='Six links swim by a travelling wave',
        stands_for='towing-tank test of an eel-like robot (AmphiBot); articulated bodies',
        timesteps=tuple(h for h in case.timesteps if h >= 2e-4),
    )  # fmt: skip


def quad_in_turbulence() -> Problem:
    """Return a quadrotor that hovers on constant thrust in Dryden turbulence."""
    air = Dryden(model='dryden', wind_6m=7.3, height=10, airspeed=8)  # [m/s], [m], [m/s]
    scene = replace(Scene.load('quadrotor'), name='quad_in_turbulence', schedule=(), wind=(air,))
    return replace(
        of_scene(scene, 5.0), title='Quadrotor in Dryden turbulence',
        stands_for='flight in light turbulence near the ground (MIL-F-8785C), same gusts in each '
        'run',
    )  # fmt: skip
