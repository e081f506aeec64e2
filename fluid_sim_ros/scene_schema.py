"""The YAML schema of config/scenes and config/vehicles, and its one-line errors."""

import math
from pathlib import Path
from typing import Annotated, Any, Literal, TypeVar

import yaml
from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    ValidationError,
    model_validator,
)

from fluid_sim_ros.errors import ConfigError, listed

Schema = TypeVar('Schema', bound='_Strict')

# A vehicle name becomes part of topic names, so it follows the ROS 2 rule for name tokens.
NAME_PATTERN = r'^[A-Za-z][A-Za-z0-9_]*$'


def _number(value: Any) -> float:
    """Accept what YAML 1.1 and people write for a finite number (also ``1e-3``, a YAML string)."""
    if isinstance(value, bool) or not isinstance(value, int | float | str):
        raise ValueError('must be a number')
    try:
        number = float(value)
    except ValueError:
        raise ValueError('must be a number') from None
    if not math.isfinite(number):
        raise ValueError('must be finite')
    return number


Number = Annotated[float, BeforeValidator(_number)]
Vector = Annotated[list[Number], Field(min_length=3, max_length=3)]
Name = Annotated[str, Field(pattern=NAME_PATTERN)]


class _Strict(BaseModel):
    model_config = ConfigDict(extra='forbid', frozen=True)


class VehicleFile(_Strict):
    """One file of config/vehicles: how commands map onto a body of the MJCF model."""

    body: str
    thrusters: list[str] | None = None
    joints: list[str] | None = None
    source: str = ''


class BodyWrench(_Strict):
    """A wrench at a vehicle's base_link origin: force [N], torque [N m], axes of ``frame``."""

    force: Vector = [0.0, 0.0, 0.0]
    torque: Vector = [0.0, 0.0, 0.0]
    frame: Literal['base_link', 'map'] = 'base_link'


class ScheduledEvent(_Strict):
    """What changes at one simulated time ``at`` [s]."""

    at: Annotated[Number, Field(ge=0)]
    wind: Vector | None = None
    current: Vector | None = None
    thrust: dict[Name, list[Number]] = {}
    wrench: dict[Name, BodyWrench] = {}

    @model_validator(mode='after')
    def _does_something(self) -> 'ScheduledEvent':
        if not (self.wind or self.current or self.thrust or self.wrench):
            raise ValueError('changes nothing; allowed: wind, current, thrust, wrench')
        return self


class Gait(_Strict):
    """
    A sine wave on a vehicle's joints (control.gait.JointWave), from the start of the scene.

    ``frequency`` [Hz], ``amplitudes``, ``phases`` and ``offsets`` [rad] one per joint in command
    order, smooth start over ``ramp`` [s], evaluated at ``rate`` [Hz].
    """

    frequency: Annotated[Number, Field(gt=0)]
    amplitudes: list[Number]
    phases: list[Number]
    offsets: list[Number] = []
    ramp: Annotated[Number, Field(ge=0)] = 0.0
    rate: Annotated[Number, Field(gt=0)] = 100.0


class SceneFile(_Strict):
    """One file of config/scenes."""

    model: str
    description: str = ''
    medium: Literal['air', 'water'] | None = None
    vehicles: dict[Name, str | VehicleFile] | None = None
    duration: Annotated[Number, Field(gt=0)] = 10.0
    keyframe: str | None = None
    schedule: list[ScheduledEvent] = []
    gait: dict[Name, Gait] = {}


class _UniqueKeys(yaml.SafeLoader):
    """A safe loader that refuses a key given twice (plain YAML keeps the last, silently)."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
        seen = set()
        for key_node, _ in node.value:
            key = self.construct_object(key_node, deep=True)
            if key in seen:
                raise yaml.constructor.ConstructorError(
                    None, None, f'key {key!r} stands twice', key_node.start_mark
                )
            seen.add(key)
        return super().construct_mapping(node, deep)


def read_yaml(path: Path) -> Any:
    """Return the content of a YAML file; a ConfigError names the file and the line."""
    try:
        return yaml.load(path.read_text(encoding='utf-8'), Loader=_UniqueKeys)
    except FileNotFoundError:
        raise ConfigError(f'{path}: no such file') from None
    except (OSError, UnicodeDecodeError) as error:
        raise ConfigError(f'{path}: {error}') from None
    except yaml.YAMLError as error:
        raise ConfigError(f'{path}: not valid YAML: {" ".join(str(error).split())}') from None


def parse(schema: type[Schema], content: Any, path: Path) -> Schema:
    """Validate ``content`` against a schema; the first fault becomes one line of ConfigError."""
    if not isinstance(content, dict):
        raise ConfigError(
            f'{path}: must be a mapping with the keys: {listed(schema.model_fields)}'
        )
    try:
        return schema.model_validate(content)
    except ValidationError as error:
        raise ConfigError(f'{path}: {_first_fault(schema, error)}') from None


def _first_fault(schema: type[BaseModel], error: ValidationError) -> str:
    # the deepest fault is the one that the writer can act on (a union reports each member)
    fault = max(error.errors(include_url=False), key=lambda fault: len(fault['loc']))
    # pydantic adds the names of union members to the place; they mean nothing to a reader
    place = '.'.join(
        str(part) for part in fault['loc']
        if part not in ('str', 'VehicleFile') and '[' not in str(part)
    )  # fmt: skip
    if fault['type'] == 'extra_forbidden':
        owner = _owner(schema, fault['loc'][:-1])
        return f"unknown key '{place}'; allowed: {listed(owner.model_fields)}"
    if fault['type'] == 'missing':
        return f"missing key '{place}'"
    message = fault['msg'].removeprefix('Value error, ')
    return f"key '{place}': {message} (got {fault['input']!r})"


_MEMBERS: dict[str, type[BaseModel]] = {
    'vehicles': VehicleFile, 'schedule': ScheduledEvent, 'wrench': BodyWrench, 'gait': Gait
}  # fmt: skip


def _owner(schema: type[BaseModel], place: tuple[Any, ...]) -> type[BaseModel]:
    """Return the schema of the mapping that a fault's place lies in."""
    for part in place:
        schema = _MEMBERS.get(str(part), schema)
    return schema
