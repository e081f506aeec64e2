"""Which fluids a compiled model has, and where."""

import math
from dataclasses import dataclass

import mujoco

from fluid_sim_ros.plugins.native import native

#: The plugin that gives each body the flow of its place and time.
MEDIUM = 'fluid_sim.medium'
#: Where a plain velocity of the whole scene stands.
OPTION = 'opt.wind'
#: Above this density the one medium of a scene without a stated one is water [kg/m^3]; it lies
#: between the densest air (1.4 at -20 degC) and the lightest water (958 at 100 degC).
_WATER_DENSITY = 100.0


def streams_of(model: mujoco.MjModel, medium: str | None) -> tuple[str, ...]:
    """Return which of wind and current a model has: both where a free surface parts two fluids."""
    density = model.opt.density
    for instance in range(model.nplugin):
        surface = native().plugin_config(model._address, instance, MEDIUM, 'surface')
        if surface not in ('', 'none'):
            return ('wind', 'current')
        stated = native().plugin_config(model._address, instance, MEDIUM, 'density')
        density = float(stated) if stated else density
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
        """Return the fluids of a model, from its medium or its options; see ``streams_of``."""
        density = float(_stated(model, 'density') or model.opt.density)
        surface = _stated(model, 'surface')
        if surface not in ('', 'none'):
            return cls(float(surface), density, float(_stated(model, 'density_above') or 0.0))
        if 'current' in streams:
            return cls(0.0, density, 0.0)
        return cls(-math.inf, 0.0, density)


def _stated(model: mujoco.MjModel, key: str) -> str:
    """Return a key of the model's fluid_sim.medium, '' without one."""
    values = (native().plugin_config(model._address, i, MEDIUM, key) for i in range(model.nplugin))
    return next(filter(None, values), '')
