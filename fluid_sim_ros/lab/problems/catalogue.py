# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The problems by name."""

from collections.abc import Callable
from pathlib import Path

from fluid_sim_ros.errors import ConfigError, did_you_mean, listed
from fluid_sim_ros.lab.problems import closed_forms, plates, scene_problems, solved_bodies
from fluid_sim_ros.lab.problems.from_scene import of_scene
from fluid_sim_ros.lab.problems.problem import Problem
from fluid_sim_ros.scene import scene_names

#: Problems of the laboratory; every scene is one too.
PROBLEMS: dict[str, Callable[[], Problem]] = {
    make.__name__: make
    for make in (
        closed_forms.terminal_velocity, closed_forms.stokes, closed_forms.buoyant_rise,
        closed_forms.spin_down, closed_forms.water_pendulum, solved_bodies.kirchhoff,
        solved_bodies.vehicle_in_current, solved_bodies.rov_step, solved_bodies.foil_glide,
        plates.plate_flutter, plates.plate_tumble, plates.plate_chaos,
        scene_problems.swimmer, scene_problems.quad_in_turbulence,
    )
}  # fmt: skip


def is_scene(name: str) -> bool:
    """
    Return whether a name is that of a scene, or could be the path of one.

    Parameters
    ----------
    name
        As the user gave it.

    Returns
    -------
    bool
        False for a name that is neither.

    """
    return name in scene_names() or '.' in name or '/' in name or Path(name).is_file()


def problem(name: str) -> Problem:
    """
    Return a problem by name, or the one that a scene (name or path) is.

    Parameters
    ----------
    name
        One of PROBLEMS, or name or path of a scene.

    Returns
    -------
    Problem
        The problem.

    Raises
    ------
    ConfigError
        For a name that is neither.

    """
    if name in PROBLEMS:
        return PROBLEMS[name]()
    if not is_scene(name):
        raise ConfigError(
            f"problem '{name}' is not known{did_you_mean(name, [*PROBLEMS, *scene_names()])} "
            f'problems: {listed(PROBLEMS)}; '
            f'scenes: {listed(scene_names())}'
        )
    return of_scene(name)
