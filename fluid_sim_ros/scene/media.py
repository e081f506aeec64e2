# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Which fluids a compiled model has, and where."""

import math
from dataclasses import dataclass

import mujoco

from fluid_sim_ros.plugins.config import medium_of

#: Where a plain velocity of the whole scene stands.
OPTION = 'opt.wind'
#: Seeds that fluid_sim.medium can tell apart: the whole numbers that a double holds.
MOST_SEEDS = 2**53
#: Above this density the one medium of a scene without a stated one is water [kg/m^3]; it lies
#: between the densest air (1.4 at -20 degC) and the lightest water (958 at 100 degC).
_WATER_DENSITY = 100.0


def streams_of(model: mujoco.MjModel, medium: str | None) -> tuple[str, ...]:
    """
    Return which of wind and current a model has.

    Parameters
    ----------
    model
        The compiled model.
    medium
        ``air`` or ``water`` as the scene states it; None: by the density.

    Returns
    -------
    tuple
        Names; both where a free surface parts two fluids.

    """
    if _surface(model) is not None:
        return ('wind', 'current')
    density = _number(model, 'density', model.opt.density)
    water = medium == 'water' if medium else density > _WATER_DENSITY
    return ('current',) if water else ('wind',)


@dataclass(frozen=True)
class Fluids:
    """
    The fluids of a scene.

    Attributes
    ----------
    surface
        Height of the mean water surface, world z [m]; 0 in a scene of water without a surface,
        -inf without water.
    water_density, air_density
        [kg/m^3]; 0 without water, and without air.

    """

    surface: float
    water_density: float
    air_density: float

    @classmethod
    def of(cls, model: mujoco.MjModel, streams: tuple[str, ...]) -> 'Fluids':
        """
        Return the fluids of a model, from its medium or its options.

        Parameters
        ----------
        model
            The compiled model.
        streams
            As ``streams_of`` returned them.

        Returns
        -------
        Fluids
            Their surface and densities.

        """
        density = _number(model, 'density', model.opt.density)
        surface = _surface(model)
        if surface is not None:
            return cls(surface, density, _number(model, 'density_above', 0.0))
        if 'current' in streams:
            return cls(0.0, density, 0.0)
        return cls(-math.inf, 0.0, density)


def _number(model: mujoco.MjModel, key: str, default: float) -> float:
    """Return a number of the model's fluid_sim.medium, or the default without one."""
    medium = medium_of(model)
    return medium.number(key, default) if medium else default


def _surface(model: mujoco.MjModel) -> float | None:
    """Return the mean height of the free surface, world z [m], or nothing without a surface."""
    medium = medium_of(model)
    stated = medium.text('surface') if medium else ''
    return None if stated in ('', 'none') else float(stated)
