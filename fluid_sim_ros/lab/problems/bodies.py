# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Bodies that stability is mapped on: one ellipsoid of rotation, coasting in a still fluid.

Nothing drives it, so the kinetic energy T of body and fluid can only fall: what rises is the
integrator's doing. Semi-axes (aspect r, r, r), the first one along the motion.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from fluid_sim_ros.errors import ConfigError, did_you_mean, listed
from fluid_sim_ros.lab.problems.closed_forms import keyframe, scene_of
from fluid_sim_ros.lab.problems.mjcf import body_plugin, ellipsoid, free_body, world
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.physics.kappa import ellipsoid_added_mass, ellipsoid_volume
from fluid_sim_ros.scene import Scene

RADIUS, WATER = 0.1, 1000.0  # [m], [kg/m^3]
#: Direction of a tumbling start: no axis of symmetry, so that every term takes part.
_ALONG = np.array([1.0, 0.5, 0.3]) / np.linalg.norm([1.0, 0.5, 0.3])
_ABOUT = np.array([1.0, 2.0, 1.5]) / np.linalg.norm([1.0, 2.0, 1.5])


class Axis(NamedTuple):
    """A parameter that a map may run over, always on a logarithmic scale."""

    label: str
    low: float
    high: float


AXES = {
    'timestep': Axis('timestep [s]', 1e-4, 1.0),
    'density_ratio': Axis('density of the body / of the fluid [-]', 0.01, 10.0),
    'added_mass_ratio': Axis('largest added mass / mass [-]', 0.1, 100.0),
    'viscosity': Axis('dynamic viscosity [Pa s]', 0.1, 100.0),
    'aspect': Axis('length along the motion / width [-]', 0.02, 5.0),
    'speed': Axis('speed [m/s]', 0.1, 20.0),
    'spin': Axis('spin [rad/s]', 0.1, 100.0),
}


@dataclass(frozen=True)
class Body:
    """
    A body and its start; every number that a map may run over, and what does not change.

    ``blunt`` is C of the drag rho C A |v| v, ``plugin`` adds the inertia of the added mass,
    ``tumbling`` starts it askew and turning. ``duration`` is that of a run [s].
    """

    density_ratio: float = 1.0
    aspect: float = 1.0
    viscosity: float = 0.0  # [Pa s]
    speed: float = 1.0  # [m/s]
    spin: float = 0.0  # [rad/s]
    blunt: float = 0.0
    plugin: bool = False
    tumbling: bool = False
    duration: float = 2.0

    @property
    def axes(self) -> Array:
        """Semi-axes [m]."""
        return RADIUS * np.array([self.aspect, 1.0, 1.0])

    @property
    def mass(self) -> float:
        """Of the body [kg]."""
        return self.density_ratio * WATER * float(ellipsoid_volume(self.axes))

    @property
    def added_mass(self) -> Array:
        """Of the fluid along each axis [kg], whether the model has its inertia or not."""
        return np.asarray(ellipsoid_added_mass(self.axes, WATER)[0])

    def with_values(self, values: Mapping[str, float]) -> 'Body':
        """
        Return the body with some of its parameters replaced.

        Parameters
        ----------
        values
            By name of ``AXES``; ``timestep`` is not of a body and is passed over.

        Returns
        -------
        Body
            The changed body.

        Raises
        ------
        ConfigError
            For an unknown name, a value that is not finite and above 0, or two names that set the
            same thing.

        """
        known = {name: value for name, value in values.items() if name != 'timestep'}
        unknown = [name for name in known if name not in AXES]
        if unknown:
            hint = did_you_mean(unknown[0], AXES)
            raise ConfigError(f"axis '{unknown[0]}' is not known{hint} allowed: {listed(AXES)}")
        for name, value in known.items():
            if not 0 < value < np.inf:
                raise ConfigError(f'{name} {value:g}: must be above 0 and finite')
        if {'density_ratio', 'added_mass_ratio'} <= known.keys():
            raise ConfigError('density_ratio and added_mass_ratio set the same thing; give one')
        ratio = known.pop('added_mass_ratio', None)
        body = replace(self, **known)  # type: ignore[arg-type]
        if ratio is None:
            return body
        return replace(body, density_ratio=body.density_ratio * body.lightness / ratio)

    @property
    def lightness(self) -> float:
        """Largest added mass over the mass [-]."""
        return float(self.added_mass.max() / self.mass)

    def scene(self) -> Scene:
        """Return the body at its start, in a fluid at rest, without gravity."""
        density = self.density_ratio * WATER
        inside = ellipsoid(self.axes, density, (self.blunt, 0, 0, 0, 0))
        if self.plugin:
            inside += body_plugin(added_mass='auto')
        along, about = (_ALONG, _ABOUT) if self.tumbling else (np.eye(3)[0], np.zeros(3))
        mjcf = world(
            free_body(inside), option=f'density="{WATER}" viscosity="{self.viscosity}"',
            extra=keyframe((0, 0, 0, 1, 0, 0, 0), np.r_[self.speed * along, self.spin * about]),
        )  # fmt: skip
        return scene_of('body', mjcf)

    def drag_number(self, timestep: float) -> float:
        """
        Return x = h K |v|/(m + m_A) for quadratic drag, h S/(m + m_A) for linear drag [-].

        K = rho C pi r^2 of the face, S = 6 pi mu r (sphere); m_A counts where the model has it.

        Parameters
        ----------
        timestep
            h [s].

        Returns
        -------
        float
            x [-].

        """
        if self.viscosity > 0:
            rate = 6 * np.pi * self.viscosity * RADIUS
        else:
            rate = self.blunt * WATER * np.pi * RADIUS**2 * self.speed
        inertia = self.mass + (self.added_mass[0] if self.plugin else 0.0)
        return float(timestep * rate / inertia)


class Family(NamedTuple):
    """Bodies of one kind."""

    title: str
    body: Body
    x: str  # the axes of its map
    y: str
    drag: str = ''  # 'quadratic', 'linear': what the boundaries are predicted from


FAMILIES = {
    'drag': Family(
        "Sphere braked by MuJoCo's drag", Body(blunt=0.5, speed=5.0, density_ratio=0.05),
        'timestep', 'density_ratio', 'quadratic',
    ),
    'drag_added_mass': Family(
        'Sphere braked by drag, with the inertia of its added mass',
        Body(blunt=0.5, speed=5.0, density_ratio=0.05, plugin=True),
        'timestep', 'density_ratio', 'quadratic',
    ),
    'viscous': Family(
        'Sphere in a very viscous fluid', Body(viscosity=10.0, density_ratio=1.0),
        'timestep', 'viscosity', 'linear',
    ),
    'plate': Family(
        "Plate that meets the flow broadside, MuJoCo's drag",
        Body(blunt=0.5, speed=1.0, density_ratio=0.5, aspect=0.02),
        'timestep', 'aspect', 'quadratic',
    ),
    'stock_ideal': Family(
        "Tumbling ellipsoid, MuJoCo's added-mass forces without their inertia, no drag",
        Body(aspect=2.5, spin=2.7, tumbling=True, duration=5.0), 'timestep', 'spin',
    ),
    'kirchhoff': Family(
        'Tumbling ellipsoid with added mass, no drag',
        Body(aspect=2.5, spin=2.7, tumbling=True, plugin=True, duration=5.0),
        'timestep', 'added_mass_ratio',
    ),
    'tumbling_drag': Family(
        'Tumbling ellipsoid with added mass and drag',
        Body(aspect=2.5, spin=2.7, tumbling=True, plugin=True, blunt=0.1, duration=5.0),
        'timestep', 'added_mass_ratio',
    ),
}  # fmt: skip


def family(name: str) -> Family:
    """
    Return a family of bodies by name.

    Parameters
    ----------
    name
        One of FAMILIES.

    Returns
    -------
    Family
        The family.

    Raises
    ------
    ConfigError
        For another name, with those that there are.

    """
    if name not in FAMILIES:
        raise ConfigError(
            f"stability problem '{name}' is not known{did_you_mean(name, FAMILIES)} "
            f'allowed: {listed(FAMILIES)}'
        )
    return FAMILIES[name]
