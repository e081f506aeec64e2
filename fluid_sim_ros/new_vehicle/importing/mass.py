# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Mass, centre of mass and inertia of the base: from the file, given, or spread over the hull."""

from dataclasses import dataclass

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.hydro.meshes.repair import Solid
from fluid_sim_ros.hydro.meshes.surface import volume_and_center
from fluid_sim_ros.new_vehicle.importing.answers import Answers
from fluid_sim_ros.new_vehicle.importing.hull import Hull
from fluid_sim_ros.new_vehicle.importing.skeleton import Skeleton
from fluid_sim_ros.physics.arrays import Array

#: Densest metal, and lighter than any vehicle [kg/m^3].
_DENSEST, _LIGHTEST = 22590.0, 0.5


@dataclass(frozen=True)
class BaseMass:
    """
    Of the base, without moving parts.

    Attributes
    ----------
    mass
        [kg].
    center
        Base axes [m], shape (3,).
    inertia
        About the centre of mass, base axes [kg m^2], shape (3, 3).
    total, total_center
        Of the whole vehicle [kg], [m].
    source
        Where they are from.

    """

    mass: float
    center: Array
    inertia: Array
    total: float
    total_center: Array
    source: str


def mass_of(skeleton: Skeleton, answers: Answers, hull: Hull | None) -> BaseMass | None:
    """
    Return mass and inertia of the base.

    Parameters
    ----------
    skeleton
        The vehicle; asked what is undecided.
    answers
        What the user says.
    hull
        Of the base, where it is known.

    Returns
    -------
    BaseMass
        None where it is undecided.

    Raises
    ------
    ConfigError
        If mass and hull do not fit together.

    """
    model, base = skeleton.model, skeleton.base_id
    turn = np.empty(9)
    mujoco.mju_quat2Mat(turn, model.body_iquat[base])
    axes = turn.reshape(3, 3)
    mass, source = float(model.body_mass[base]), 'the file'
    center = np.array(model.body_ipos[base])
    inertia = axes @ np.diag(model.body_inertia[base]) @ axes.T
    if not skeleton.has_mass or answers.even or answers.body_density is not None:
        found = _stated_anew(skeleton, answers, hull)
        if found is None:
            return None
        mass, center, inertia, source = found
    elif answers.mass is not None:
        inertia, mass = inertia * answers.mass / mass, answers.mass
        source = 'the file, scaled to the mass given'
    if answers.center_of_mass is not None:
        center, source = np.array(answers.center_of_mass), f'{source}; centre given'
    if answers.inertia is not None:
        inertia, source = np.diag(answers.inertia), f'{source}; inertia given'
    return _with_parts(skeleton, hull, mass, center, inertia, source)


def _with_parts(
    skeleton: Skeleton, hull: Hull | None, mass: float, center: Array, inertia: Array, source: str
) -> BaseMass:
    model, base = skeleton.model, skeleton.base_id
    parts = float(model.body_subtreemass[base] - model.body_mass[base])
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    whole = data.subtree_com[base] * model.body_subtreemass[base]
    place = data.xmat[base].reshape(3, 3)
    of_parts = whole - model.body_mass[base] * data.xipos[base] - parts * data.xpos[base]
    total = mass + parts
    total_center = (mass * center + place.T @ of_parts) / total
    if hull is not None:
        _check_density(skeleton, total, hull)
    return BaseMass(mass, center, inertia, total, total_center, source)


def _stated_anew(
    skeleton: Skeleton, answers: Answers, hull: Hull | None
) -> tuple[float, Array, Array, str] | None:
    given = answers.center_of_mass is not None and answers.inertia is not None
    if answers.body_density is None and answers.mass is None:
        skeleton.questions.append('mass: --mass KG, or --body-density KG/M3 of an even body')
        return None
    if answers.mass is not None and given:
        return (
            answers.mass,
            np.array(answers.center_of_mass),
            np.diag(answers.inertia or []),
            'you',
        )
    if not answers.even and answers.body_density is None:
        skeleton.questions.append(
            'how the mass is spread: --center-of-mass X Y Z and --inertia IX IY IZ, or --even '
            'over the hull'
        )
        return None
    if hull is None:
        return None
    volume, center, tensor = volume_moments(hull.file.solid)
    mass = answers.mass if answers.mass is not None else (answers.body_density or 0.0) * volume
    return mass, center, mass / volume * tensor, 'spread evenly over the hull'


def volume_moments(solid: Solid) -> tuple[float, Array, Array]:
    """
    Return volume, centre, and inertia per density of a solid.

    Parameters
    ----------
    solid
        Closed.

    Returns
    -------
    volume, center, inertia
        [m^3]; mesh axes [m]; about the centre, mesh axes [m^5], shape (3, 3).

    """
    triangles = solid.in_mesh_axes().triangles
    volume, center = volume_and_center(triangles)
    a, b, c = np.moveaxis(triangles - center, 1, 0)
    # tetrahedra from the centre: V/20 (sum of v v' + (sum v)(sum v)')
    share = np.einsum('ij,ij->i', a, np.cross(b, c)) / 6 / 20
    second = sum(np.einsum('n,ni,nj->ij', share, v, v) for v in (a, b, c, a + b + c))
    return volume, center, np.trace(second) * np.eye(3) - second


def _check_density(skeleton: Skeleton, mass: float, hull: Hull) -> None:
    density = mass / hull.statics.volume
    if _LIGHTEST <= density <= _DENSEST:
        return
    kind = 'lighter than any vehicle' if density < _LIGHTEST else 'denser than any metal'
    size = ' x '.join(f'{x:.4g}' for x in hull.statics.size)
    raise ConfigError(
        f'{skeleton.source.path}: {mass:.4g} kg in a hull of {size} m: {density:.3g} kg/m^3, '
        f'{kind}; is it in millimetres? --unit mm, cm, in or ft says so'
    )
