# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""All hydrodynamic coefficients of a mesh file, checked and in one place."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.hydro.added_mass import AddedMass, added_mass_of_body
from fluid_sim_ros.hydro.damping import Damping, damping_of
from fluid_sim_ros.hydro.estimates import box_estimate, ellipsoid_estimate
from fluid_sim_ros.hydro.meshes.reading import MeshFile, read_mesh
from fluid_sim_ros.hydro.meshes.surface import MeshFaultError
from fluid_sim_ros.hydro.panels import COARSE
from fluid_sim_ros.hydro.planes import Plane
from fluid_sim_ros.hydro.potential import BoundaryElementError
from fluid_sim_ros.hydro.projected import projected_areas
from fluid_sim_ros.hydro.statics import Righting, Statics, righting_of, statics_of
from fluid_sim_ros.physics.arrays import Array

GRAVITY = 9.81  # [m/s^2], MuJoCo's default
#: Panels of the coarser mesh that can be asked for.
_PANELS = (20, 2500)
#: Viscosity taken where none is given [Pa s]: of water at 20 degC above 100 kg/m^3 (IAPWS), of
#: air at 15 degC below (ISA).
_WATER, _AIR, _LIGHT = 1.0e-3, 1.79e-5, 100.0
#: Densest and lightest that a vehicle may be [kg/m^3]: osmium, and a balloon's skin.
_DENSEST, _LIGHTEST = 22590.0, 0.5


@dataclass(frozen=True)
class Request:
    """
    What is asked about a mesh.

    Attributes
    ----------
    mesh
        The file.
    density
        Of the fluid [kg/m^3].
    viscosity
        [Pa s]; None: water or air by the density.
    unit
        Of the file's numbers; None: metres, unusual sizes are asked about.
    about
        Reference point, mesh axes [m]; None: the centre of buoyancy.
    mass, mass_center
        Of the vehicle [kg], mesh axes [m]; None: no righting arms.
    thrust
        Along each axis, for the top speeds [N]; None: the thrust for ``speed``.
    speed
        At which friction is taken [m/s].
    drag_coefficients
        Along x, y, z; None: by the shape.
    planes
        Wall, bed, surface.
    coarse
        Most panels of the coarser mesh.
    up
        Which axis of the mesh becomes z, one of ``up_axis.UPS``.

    """

    mesh: Path
    density: float
    viscosity: float | None = None
    unit: str | None = None
    about: tuple[float, float, float] | None = None
    mass: float | None = None
    mass_center: tuple[float, float, float] | None = None
    thrust: float | None = None
    speed: float = 1.0
    drag_coefficients: tuple[float, float, float] | None = None
    planes: list[Plane] = field(default_factory=list)
    coarse: int = COARSE
    up: str = 'keep'


@dataclass(frozen=True)
class Coefficients:
    """
    What was found about a mesh.

    Attributes
    ----------
    request
        What was asked.
    file
        The mesh that was read.
    viscosity
        Of the fluid [Pa s].
    statics
        Volume, centre of buoyancy, wetted area.
    added_mass
        About the reference point.
    damping
        About the reference point.
    righting
        None without a mass.
    ellipsoid, box
        Estimates of the added mass about the centre of buoyancy, shape (6,) and (3,).

    """

    request: Request
    file: MeshFile
    viscosity: float
    statics: Statics
    added_mass: AddedMass
    damping: Damping
    righting: Righting | None
    ellipsoid: Array
    box: Array


def coefficients_of(
    request: Request,
    say: Callable[[str], None] = lambda line: None,
    file: MeshFile | None = None,
) -> Coefficients:
    """
    Return the hydrodynamic coefficients of a mesh file.

    Parameters
    ----------
    request
        What is asked.
    say
        Takes a line of progress.
    file
        The mesh as read already; None: it is read.

    Returns
    -------
    Coefficients
        In mesh axes.

    Raises
    ------
    ConfigError
        If a number is impossible, or the mesh is refused: one line with the remedy.

    """
    _check(request)
    if file is None:
        say('reading the mesh')
        file = read_mesh(request.mesh, request.unit, request.up)
    statics = statics_of(file.solid)
    _check_density(request, statics)
    say('added mass: panels and potential')
    try:
        about_center = added_mass_of_body(
            file.solid, request.density, request.planes, request.coarse
        )
    except (MeshFaultError, BoundaryElementError) as fault:
        raise ConfigError(f'{file.path}: {fault}') from None
    point = statics.center if request.about is None else np.array(request.about, dtype=float)
    added_mass = about_center.about(point)
    say('damping')
    viscosity = request.viscosity
    if viscosity is None:
        viscosity = _WATER if request.density > _LIGHT else _AIR
    given = request.drag_coefficients
    damping = damping_of(
        added_mass.triangles, statics, projected_areas(file.solid), point, request.density,
        viscosity, speed=request.speed, coefficients=None if given is None else np.array(given),
    )  # fmt: skip
    righting = None
    if request.mass is not None:
        center = np.array(request.mass_center or (0.0, 0.0, 0.0), dtype=float)
        righting = righting_of(statics, request.mass, center, request.density, GRAVITY)
    return Coefficients(
        request, file, viscosity, statics, added_mass, damping, righting,
        ellipsoid_estimate(statics, request.density), box_estimate(statics, request.density),
    )  # fmt: skip


def _check(request: Request) -> None:
    positive = {
        '--density [kg/m^3]': request.density, '--viscosity [Pa s]': request.viscosity,
        '--mass [kg]': request.mass, '--thrust [N]': request.thrust,
        '--speed [m/s]': request.speed,
    }  # fmt: skip
    for name, value in positive.items():
        if value is not None and not (np.isfinite(value) and value > 0):
            raise ConfigError(f'{name}: {value:g}; must be a finite number above 0')
    vectors = {
        '--about [m]': request.about, '--center-of-mass [m]': request.mass_center,
        '--drag': request.drag_coefficients,
    }  # fmt: skip
    for name, numbers in vectors.items():
        if numbers is not None and not np.isfinite(numbers).all():
            raise ConfigError(f'{name}: {" ".join(map(str, numbers))}; must be finite numbers')
    if request.drag_coefficients is not None and min(request.drag_coefficients) <= 0:
        raise ConfigError('--drag: all three must be above 0')
    if request.mass_center is not None and request.mass is None:
        raise ConfigError('--center-of-mass goes with --mass')
    low, high = _PANELS
    if not low <= request.coarse <= high:
        raise ConfigError(
            f'--panels {request.coarse}: must be {low} to {high}; four times as many are solved '
            f'for, in {8 * (4 * high) ** 2 / 2**30:.2g} GiB at most'
        )


def _check_density(request: Request, statics: Statics) -> None:
    if request.mass is None:
        return
    density = request.mass / statics.volume
    if _LIGHTEST <= density <= _DENSEST:
        return
    size = ' x '.join(f'{x:.4g}' for x in statics.size)
    kind = 'lighter than any vehicle' if density < _LIGHTEST else 'denser than any metal'
    raise ConfigError(
        f'--mass {request.mass:g} in a body of {size} m: {density:.3g} kg/m^3, {kind}; '
        'is the unit of the mesh right (--unit m, cm, mm, in, ft)?'
    )
