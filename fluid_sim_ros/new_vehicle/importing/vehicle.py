# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""From a file and answers to a vehicle: decided, computed, written and tried."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.hydro.coefficients import Coefficients
from fluid_sim_ros.hydro.keys import body_keys, numbers
from fluid_sim_ros.hydro.panels import COARSE
from fluid_sim_ros.new_vehicle.design import GRAVITY, hover_thrusts
from fluid_sim_ros.new_vehicle.importing.air_drag import air_drag_keys
from fluid_sim_ros.new_vehicle.importing.answers import Answers
from fluid_sim_ros.new_vehicle.importing.document import Contents, document_of
from fluid_sim_ros.new_vehicle.importing.hull import Hull, hull_of, hydro_of
from fluid_sim_ros.new_vehicle.importing.mass import BaseMass, mass_of
from fluid_sim_ros.new_vehicle.importing.other_sources import read_source
from fluid_sim_ros.new_vehicle.importing.questions import UndecidedError
from fluid_sim_ros.new_vehicle.importing.skeleton import Skeleton, skeleton_of
from fluid_sim_ros.new_vehicle.layout import (
    DENSITY,
    PRESETS,
    WITH_FINS,
    Medium,
    Thruster,
    complete_thruster,
    thrusters_of,
)
from fluid_sim_ros.physics.arrays import Array

#: Net buoyancy of the hull over the weight, beyond which it is asked about.
_BUOYANT = 0.1


@dataclass(frozen=True)
class Imported:
    """
    A vehicle whose numbers are all decided.

    Attributes
    ----------
    contents
        What its model is made of.
    mjcf
        The model.
    answers
        What the user said.
    hydro
        Coefficients of the hull; None in air.
    buoyancy
        Net force upward under water [N].
    said
        What was decided on the way.

    """

    contents: Contents
    mjcf: str
    answers: Answers
    hydro: Coefficients | None
    buoyancy: float
    said: list[str]


def import_vehicle(
    path: Path, answers: Answers, packages: list[Path], say: Callable[[str], None]
) -> Imported:
    """
    Return the vehicle of a file.

    Parameters
    ----------
    path
        URDF, xacro, MJCF or mesh.
    answers
        What the user says.
    packages
        Folders for ``package://`` and for files outside of the file's own.
    say
        Takes a line of progress.

    Returns
    -------
    Imported
        Decided in every number.

    Raises
    ------
    UndecidedError
        With the list of what only the user can say.
    ConfigError
        If the file or an answer has a fault.

    """
    say(f'reading {path.name}')
    source = read_source(path, packages, answers.unit, answers.body, answers.up)
    if answers.name is not None:
        source.name = answers.name
    skeleton = skeleton_of(source, answers)
    say('hull')
    hull = hull_of(skeleton, answers)
    mass = mass_of(skeleton, answers, hull)
    medium = answers.medium
    if medium is None:
        skeleton.questions.insert(0, 'medium: --medium air or water')
    _ask_thrusters(skeleton, answers)
    buoyancy = 0.0
    if medium == 'water' and hull is not None and mass is not None:
        buoyancy = _buoyancy(skeleton, answers, hull, mass)
    if skeleton.questions or hull is None or mass is None or medium is None:
        raise UndecidedError(path, skeleton.questions)
    return _finished(skeleton, answers, hull, mass, medium, buoyancy, say)


def _ask_thrusters(skeleton: Skeleton, answers: Answers) -> None:
    if answers.thrusters is None:
        fitting = [
            name for name, (where, _) in PRESETS.items()
            if answers.medium in (None, where) and name not in WITH_FINS
        ]  # fmt: skip
        skeleton.questions.append(
            f'thrusters: --thrusters {", ".join(fitting)}, or thrusters: with the links and '
            'max_thrust [N] in the YAML file'
        )
    if answers.medium != 'air' or not isinstance(answers.thrusters, list):
        return
    silent = [t.name or t.link for t in answers.thrusters if t.spin is None]
    if silent:
        skeleton.questions.append(
            f'spin of {", ".join(map(str, silent))}: ccw or cw, seen against the thrust, or none'
        )


def _buoyancy(skeleton: Skeleton, answers: Answers, hull: Hull, mass: BaseMass) -> float:
    density = answers.fluid_density or DENSITY['water']
    of_hull = GRAVITY * (density * hull.statics.volume - mass.total)
    weight = GRAVITY * mass.total
    if answers.buoyancy is None and abs(of_hull) > _BUOYANT * weight:
        skeleton.questions.append(
            f'buoyancy: the hull displaces {density * hull.statics.volume:.4g} kg and the vehicle '
            f'has {mass.total:.4g} kg: --buoyancy hull ({of_hull:+.4g} N), or the net force '
            'upward in newton (0: neutral)'
        )
    if answers.buoyancy in (None, 'hull'):
        return of_hull
    net = float(answers.buoyancy or 0.0)
    if net <= -weight:
        raise ConfigError(f'buoyancy {net:g}: must be above {-weight:.4g} N, minus the weight')
    return net


def _finished(
    skeleton: Skeleton, answers: Answers, hull: Hull, mass: BaseMass, medium: Medium,
    buoyancy: float, say: Callable[[str], None],
) -> Imported:  # fmt: skip
    thrusters = _thrusters(skeleton, answers, hull, mass, medium)
    water = medium == 'water'
    density = answers.fluid_density or DENSITY[medium]
    hover = np.zeros(len(thrusters))
    if not water and not skeleton.fins:
        hover = hover_thrusts(thrusters, mass.total * GRAVITY)
    hydro: Coefficients | None = None
    axes: Array | None = None
    center: Array | None = None
    if water:
        panels = COARSE if answers.panels is None else answers.panels
        hydro = hydro_of(hull, density, mass.total, mass.total_center, panels, say)
        keys = body_keys(hydro)
        volume = mass.total / density + buoyancy / GRAVITY / density
        keys['volume'] = numbers(volume, 12)
        center = hull.statics.center
        share = volume / (np.pi / 6 * hull.statics.size.prod())
        axes = 0.5 * hull.statics.size * share ** (1 / 3)
    else:
        keys = air_drag_keys(hull, density, mass.total_center)
    contents = Contents(
        skeleton, medium, density, mass, thrusters, hover, keys, axes, center,
        float(hull.statics.size.max()),
    )  # fmt: skip
    return Imported(contents, document_of(contents), answers, hydro, buoyancy, skeleton.said)


def _thrusters(
    skeleton: Skeleton, answers: Answers, hull: Hull, mass: BaseMass, medium: Medium
) -> list[Thruster]:
    """Return thrusters with positions from the centre of mass of the whole."""
    if isinstance(answers.thrusters, list):
        if answers.max_thrust is not None:
            raise ConfigError('max_thrust goes with a preset; a list states each max_thrust')
        return [
            complete_thruster(place.model_copy(update={
                'position': (np.array(place.position) - mass.total_center).tolist()
            }), medium)
            for place in skeleton.places
        ]  # fmt: skip
    weight = mass.total * GRAVITY
    preset = str(answers.thrusters)
    if preset in PRESETS:
        skeleton.said.append(f'thrusters: preset {preset}, scaled with the hull, about its middle')
    if preset in WITH_FINS:
        skeleton.said.append(f'{preset}: without its fins; name the links of fins under fins:')
    return thrusters_of(preset, medium, hull.statics.size, weight, answers.max_thrust)
