# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Which fluid a fleet is in: that of one of its models, which the others must be able to meet."""

from collections.abc import Mapping
from dataclasses import dataclass

import mujoco

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.plugins.config import BODY, MEDIUM

#: Our instance for bodies that MuJoCo's own drag acted on.
_IN_THE_MEDIUM = 'in_the_medium'


@dataclass(frozen=True)
class FluidOf:
    """
    The fluid that a model states.

    Attributes
    ----------
    density, viscosity
        Of its options [kg/m^3], [Pa s].
    wind
        Of its options [m/s], shape (3,).
    medium
        Keys of its fluid_sim.medium; None without one.

    """

    density: float
    viscosity: float
    wind: tuple[float, ...]
    medium: tuple[tuple[str, str], ...] | None

    @classmethod
    def of(cls, spec: mujoco.MjSpec) -> 'FluidOf':
        """
        Return the fluid of a model.

        Parameters
        ----------
        spec
            As it was read.

        """
        option = spec.option
        media = [p for p in spec.plugins if p.plugin_name == MEDIUM]
        keys = tuple(sorted(dict(media[0].config).items())) if media else None
        return cls(
            float(option.density), float(option.viscosity), tuple(option.wind.tolist()), keys
        )

    @property
    def stock(self) -> bool:
        """Whether MuJoCo's own forces know it."""
        return self.density > 0 or self.viscosity > 0

    @property
    def rank(self) -> int:
        """How much of a world it is: 2 with a surface, 1 with a medium, 0 for plain options."""
        if self.medium is None:
            return 0
        return 2 if dict(self.medium).get('surface', 'none') != 'none' else 1

    def line(self) -> str:
        """Return it in words."""
        if self.medium is not None:
            return ', '.join(f'{key} {value}' for key, value in self.medium) or 'a medium'
        return f'density {self.density:g} kg/m^3, viscosity {self.viscosity:g} Pa s'


def leading(fluids: Mapping[str, FluidOf]) -> str | tuple[str, str]:
    """
    Return the model whose fluid a fleet is in, or two that contradict each other.

    Parameters
    ----------
    fluids
        By model, in the order of the file.

    Returns
    -------
    str or tuple
        The first of the models whose fluid is most of a world (a surface; else a medium; else
        options); two of them where these differ.

    """
    most = max(fluid.rank for fluid in fluids.values())
    first, *others = [name for name, fluid in fluids.items() if fluid.rank == most]
    for other in others:
        if fluids[other] != fluids[first]:
            return first, other
    return first


def check_rung(spec: mujoco.MjSpec, fluid: str, where: str) -> None:
    """
    Refuse a rung that would put vehicles of the air into the water, or the other way round.

    Parameters
    ----------
    spec
        The composed model.
    fluid
        One of ``FLUID_RUNGS``.
    where
        What an error begins with.

    Raises
    ------
    ConfigError
        If the rung knows one fluid only, and the vehicles are in two.

    """
    if fluid not in ('inertia', 'ellipsoid') or FluidOf.of(spec).rank < 2:
        return
    if any(plugin.name.endswith(f'/{_IN_THE_MEDIUM}') for plugin in spec.plugins):
        raise ConfigError(
            f"{where}: fluid '{fluid}' knows one fluid everywhere, and the vehicles are in two; "
            'allowed: none, no_added_mass, inflow'
        )


def meet_medium(spec: mujoco.MjSpec) -> None:
    """
    Have the bodies that MuJoCo's own drag braked be braked by a medium in the same way.

    Bodies with ellipsoids are already (see doc/plugins.md, "Without drag"); the others get the
    plugin without keys, which stands for MuJoCo's inertia model in the local fluid.

    Parameters
    ----------
    spec
        A model whose options have a fluid, for a world where they have none; changed.

    """
    dry = [
        body
        for body in spec.bodies[1:]
        if not body.plugin.active and not any(geom.fluid_ellipsoid > 0 for geom in body.geoms)
    ]
    if not dry:
        return
    spec.activate_plugin(BODY)
    spec.add_plugin(name=_IN_THE_MEDIUM, plugin_name=BODY, active=True)
    for body in dry:
        body.plugin.name, body.plugin.plugin_name = _IN_THE_MEDIUM, BODY
        body.plugin.active = True
