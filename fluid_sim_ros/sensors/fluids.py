"""Which fluid is where, as sensors need it."""

import math
from dataclasses import dataclass

from fluid_sim_ros.plugins.native import native
from fluid_sim_ros.simulation import Simulation


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
    def of(cls, simulation: Simulation) -> 'Fluids':
        """Return the fluids of a simulation, from its medium or its options."""
        model = simulation.model

        def stated(key: str) -> str:
            values = (
                native().plugin_config(model._address, i, 'fluid_sim.medium', key)
                for i in range(model.nplugin)
            )
            return next(filter(None, values), '')

        density = float(stated('density') or model.opt.density)
        surface = stated('surface')
        if surface not in ('', 'none'):
            return cls(float(surface), density, float(stated('density_above') or 0.0))
        if 'current' in simulation.streams:
            return cls(0.0, density, 0.0)
        return cls(-math.inf, 0.0, density)
