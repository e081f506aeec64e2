# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The problem that a scene is: its own manoeuvre, with its models from the poorest on."""

from dataclasses import replace

import numpy as np

from fluid_sim_ros.errors import ConfigError, ModelError
from fluid_sim_ros.lab.problems.problem import TIMESTEPS, Problem, Rung, fits
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.scene.fluid_models import has_body_plugins
from fluid_sim_ros.schema.settings import FLUID_RUNGS, RunSettings


def of_scene(scene: str | Scene, duration: float | None = None) -> Problem:
    """
    Return the problem that a scene is: its own manoeuvre, against its own converged run.

    The rungs are those of ``scene.fluid_models`` below the model's own, poorest first, and last
    ``scene``, the model's own; what the scene's file says of the settings does not count.
    Timesteps reach from 1/40 to 25 times the model's own.

    Parameters
    ----------
    scene
        Name, path, or ``Scene``.
    duration
        Simulated time [s]; None: the scene's.

    Returns
    -------
    Problem
        The problem; it has no reference of its own.

    Raises
    ------
    ConfigError
        If the duration is shorter than a sample, or no timestep fits the scene.

    """
    loaded = replace(Scene.load(scene), fluid=None, timestep=None, integrator=None)
    rungs = {name: Rung(loaded, name) for name in _poorer(loaded)} | {'scene': Rung(loaded)}
    own = float(loaded.compile().model.opt.timestep)
    seconds = loaded.duration if duration is None else duration
    sample = 0.1 if seconds >= 1 else 0.01
    if seconds < sample:
        raise ConfigError(
            f'{loaded.name}: duration {seconds:g} s: at least {sample:g} s are needed to compare'
        )
    seconds = round(seconds / sample) * sample
    steps = tuple(
        h for h in (*TIMESTEPS, 2e-5, 1e-5, 5e-6, 2e-6)
        if own / 40.1 <= h <= own * 25.1 and fits(rungs['scene'], h, sample)
    )  # fmt: skip
    if not steps:
        raise ConfigError(f'{loaded.name}: no timestep of 1, 2, 5 times a power of ten fits it')
    return Problem(
        name=loaded.name,
        title=loaded.description or loaded.name,
        stands_for=f'the manoeuvre of the scene {loaded.name}',
        duration=float(f'{seconds:.9g}'),
        rungs=rungs,
        sample=sample,
        timesteps=steps,
    )


def _poorer(scene: Scene) -> list[str]:
    """Return the fluid rungs that lie below a scene's own model."""
    model = scene.compile().model
    stock = model.opt.density > 0 or model.opt.viscosity > 0
    if has_body_plugins(scene.read_model()):
        below = [rung for rung in FLUID_RUNGS if rung != 'inflow']  # that one lies above
    elif stock and np.any(model.geom_fluid[:, 0] > 0):
        below = ['none', 'inertia']
    else:
        below = ['none']
    return [name for name in below if _rung_compiles(scene, name)]


def _rung_compiles(scene: Scene, fluid: str) -> bool:
    try:
        scene.compile(RunSettings(fluid=fluid))
    except (ConfigError, ModelError):
        return False
    return True
