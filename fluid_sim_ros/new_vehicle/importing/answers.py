# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What a user says about a file that is imported: a small YAML file, options, or both."""

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.hydro.meshes.reading import UNITS
from fluid_sim_ros.new_vehicle.layout import Medium
from fluid_sim_ros.new_vehicle.sensors import SensorKind
from fluid_sim_ros.schema.base import (
    Name,
    NotNegative,
    Number,
    Positive,
    Strict,
    Vector,
    parse,
    validated,
)
from fluid_sim_ros.schema.yaml_file import read_yaml


class LinkThruster(Strict):
    """
    A thruster or rotor, at a link of the file or at a place of its own.

    ``direction`` of positive thrust, in the axes of the link, or of the base; left out: along the
    axis of the link's joint. The other keys are those of `layout.ThrusterPlace`.
    """

    name: Name | None = None
    link: str | None = None
    position: Vector | None = None
    direction: Vector | None = None
    max_thrust: Positive
    max_reverse: NotNegative | None = None
    spin: Literal['ccw', 'cw', 'none'] | None = None
    torque_ratio: NotNegative | None = None
    time_constant: NotNegative | None = None
    diameter: Positive | None = None

    @model_validator(mode='after')
    def _is_somewhere(self) -> 'LinkThruster':
        if self.link is None and (self.position is None or self.name is None):
            raise ValueError('give link, or name and position')
        if self.link is not None and self.position is not None:
            raise ValueError('give link or position, not both')
        if self.link is None and self.direction is None:
            raise ValueError('give direction, of positive thrust')
        return self


class LinkFin(Strict):
    """
    A fin or wing at a link: ``span``, ``chord`` [m]; its axes in those of the link.

    ``forward`` towards the leading edge, ``along`` the span; ``center`` in link axes [m].
    """

    link: str
    span: Positive
    chord: Positive
    forward: Vector = [1.0, 0.0, 0.0]
    along: Vector
    center: Vector = [0.0, 0.0, 0.0]


class Servo(Strict):
    """A driven joint: ``stiffness`` [N m/rad], ``lag`` [s], ``armature`` [kg m^2]."""

    stiffness: Positive = 100.0
    lag: NotNegative = 0.1
    armature: NotNegative = 0.01


class Answers(Strict):
    """
    What the file does not say. Lengths [m], masses [kg], axes of the base.

    ``even``: the mass is spread evenly over the hull. ``buoyancy``: ``hull``, or the net force
    upward under water [N]. ``hull``: ``collision``, ``visual`` or a mesh file. ``panels``: of the
    coarser mesh for the added mass, at most. ``up``: axis of a mesh that becomes z.
    """

    name: Name | None = None
    medium: Medium | None = None
    body: str | None = None
    mass: Number | None = None
    center_of_mass: Vector | None = None
    inertia: Annotated[list[Number], Field(min_length=3, max_length=3)] | None = None
    body_density: Positive | None = None
    even: bool = False
    unit: Literal[tuple(UNITS)] | None = None  # type: ignore[valid-type]
    up: Literal['file', 'x', 'y', 'z'] | None = None
    hull: str | None = None
    fluid_density: Positive | None = None
    panels: int | None = None
    buoyancy: Literal['hull'] | Number | None = None
    thrusters: str | list[LinkThruster] | None = None
    max_thrust: Positive | None = None
    fins: list[LinkFin] = []
    servos: dict[str, Servo] = {}
    fixed: list[str] = []
    sensors: list[SensorKind] | dict[str, Any] = []


def answers_of(path: Path | None, options: Mapping[str, Any]) -> Answers:
    """
    Return the answers of a file and of options; an option stands above the file.

    Parameters
    ----------
    path
        YAML file, or None.
    options
        Keys of `Answers`; None: not given.

    Returns
    -------
    Answers
        Checked.

    Raises
    ------
    ConfigError
        For the first fault, with the file and key, or the option.

    """
    given = {
        key: value for key, value in options.items()
        if value is not None and value is not False and value != []
    }  # fmt: skip
    content: dict[str, Any] = {}
    if path is not None:
        content = read_yaml(path) or {}
        parse(Answers, content, path)
        hull = content.get('hull')
        if hull not in (None, 'collision', 'visual'):
            content['hull'] = str(path.parent / hull)
        source = content.get('thrusters')
        if isinstance(source, str) and Path(source).suffix in ('.yaml', '.yml'):
            content['thrusters'] = str(path.parent / source)
    if 'fixed' in given:
        given['fixed'] = [*content.get('fixed', []), *given['fixed']]
    answers = validated(Answers, {**content, **given}, named='--{}')
    _check(answers)
    return answers


def _check(answers: Answers) -> None:
    if answers.mass is not None and answers.mass <= 0:
        raise ConfigError(f'mass {answers.mass:g}: must be above 0 [kg]')
    if answers.mass is not None and answers.body_density is not None:
        raise ConfigError('mass and body_density: give one of them')
    if answers.inertia is not None:
        low, middle, high = sorted(answers.inertia)
        if low <= 0:
            raise ConfigError(f'inertia {low:g}: must be above 0 [kg m^2]')
        if low + middle < high:
            raise ConfigError(
                f'inertia {_text(answers.inertia)}: no body has this: the two smaller moments '
                f'together are {low + middle:g}, the largest is {high:g} [kg m^2]'
            )
    if isinstance(answers.thrusters, list):
        names = [thruster.name or thruster.link for thruster in answers.thrusters]
        twice = sorted({str(name) for name in names if names.count(name) > 1})
        if twice:
            raise ConfigError(f"thrusters: the name '{twice[0]}' stands twice")


def _text(values: list[float]) -> str:
    return ' '.join(f'{value:g}' for value in values)
