"""
Our YAML files as strict schemas: number types, reading, and one-line errors.

What the files hold stands in ``scene_schema`` and ``sensor_schema``.
"""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, TypeVar, get_args

import yaml
from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError

from fluid_sim_ros.errors import ConfigError, listed

Schema = TypeVar('Schema', bound='Strict')

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
Positive = Annotated[Number, Field(gt=0)]
NotNegative = Annotated[Number, Field(ge=0)]
Vector = Annotated[list[Number], Field(min_length=3, max_length=3)]
Name = Annotated[str, Field(pattern=NAME_PATTERN)]


class Strict(BaseModel):
    """A mapping with the stated keys and no others."""

    model_config = ConfigDict(extra='forbid', frozen=True)


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
    members = {'str', *(member.__name__ for member in Strict.__subclasses__())}
    place = '.'.join(
        str(part) for part in fault['loc'] if part not in members and '[' not in str(part)
    )
    if fault['type'] == 'extra_forbidden':
        owner = _owner(schema, fault['loc'][:-1])
        return f"unknown key '{place}'; allowed: {listed(owner.model_fields)}"
    if fault['type'] == 'missing':
        return f"missing key '{place}'"
    message = fault['msg'].removeprefix('Value error, ')
    return f"key '{place}': {message} (got {fault['input']!r})"


def _owner(schema: type[BaseModel], place: tuple[Any, ...]) -> type[BaseModel]:
    """Return the schema of the mapping that a fault's place lies in."""
    for part in place:
        field = schema.model_fields.get(str(part))
        if field is not None:
            schema = next(_schemas(field.annotation), schema)
    return schema


def _schemas(annotation: Any) -> Iterator[type[BaseModel]]:
    """Yield the schemas that a field's type is made of."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for part in get_args(annotation):
        yield from _schemas(part)
