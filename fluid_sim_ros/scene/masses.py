# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Heavier and lighter bodies: mass and inertia of a model's bodies times a factor."""

from collections.abc import Mapping
from pathlib import Path

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError, listed


def scale_masses(spec: mujoco.MjSpec, factors: Mapping[str, float], path: Path) -> None:
    """
    Multiply mass and inertia of bodies, as if their density changed.

    Parameters
    ----------
    spec
        Changed in place.
    factors
        Body name -> factor.
    path
        File of the model, for errors.

    Raises
    ------
    ConfigError
        If a body is unknown or a factor is not above 0.

    """
    for name, factor in factors.items():
        body = spec.body(name)
        if body is None:
            names = listed(b.name for b in spec.bodies[1:] if b.name)
            raise ConfigError(f"{path}: mass of '{name}': no such body; bodies: {names}")
        if not (np.isfinite(factor) and factor > 0):
            raise ConfigError(f"{path}: mass of '{name}': factor {factor:g} must be above 0")
        if body.explicitinertial:
            body.mass *= factor
            body.inertia = body.inertia * factor
            body.fullinertia = body.fullinertia * factor
            continue
        for geom in body.geoms:
            if np.isfinite(geom.mass):
                geom.mass *= factor
            else:
                geom.density *= factor
