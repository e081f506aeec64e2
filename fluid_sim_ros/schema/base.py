# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Our YAML files as strict schemas: number types, and one-line errors.

``yaml_file`` reads them. What they hold stands in ``scene``, ``sensors`` and ``weather`` beside
this module.
"""

import math
from collections.abc import Iterator
from numbers import Real
from pathlib import Path
from typing import Annotated, Any, TypeVar, get_args

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError

from fluid_sim_ros.errors import ConfigError, did_you_mean, listed, printable

Schema = TypeVar('Schema', bound='Strict')

# A vehicle name becomes part of topic names, so it follows the ROS 2 rule for name tokens.
NAME_PATTERN = r'^[A-Za-z][A-Za-z0-9_]*$'


def _number(value: Any) -> float:
    """Accept what YAML 1.1 and people write for a finite number (also ``1e-3``, a YAML string)."""
    if type(value) is float and math.isfinite(value):  # nearly all: a check less for long lists
        return value
    if isinstance(value, bool) or not isinstance(value, Real | str):
        raise ValueError('must be a number')
    try:
        number = float(value)
    except (ValueError, OverflowError):
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


def parse(schema: type[Schema], content: Any, path: Path) -> Schema:
    """
    Validate what a file says.

    Parameters
    ----------
    schema
        What it may say.
    content
        What ``yaml_file.read_yaml`` found.
    path
        The file, for errors.

    Returns
    -------
    Strict
        An instance of the schema.

    Raises
    ------
    ConfigError
        For the first fault: one line with file, key, value and what is allowed.

    """
    if not isinstance(content, dict):
        raise ConfigError(
            f'{path}: must be a mapping with the keys: {listed(schema.model_fields)}'
        )
    return validated(schema, content, where=f'{path}: ')


def validated(
    schema: type[Schema], content: Any, *, where: str = '', named: str = "key '{}'"
) -> Schema:
    """
    Validate a mapping against a schema.

    Parameters
    ----------
    schema
        What the mapping may hold.
    content
        The mapping.
    where
        Begin of the error.
    named
        How the user wrote a key, with ``{}`` for its name.

    Returns
    -------
    Strict
        An instance of the schema.

    Raises
    ------
    ConfigError
        For the first fault: one line with key, value and what is allowed.

    """
    try:
        return schema.model_validate(content)
    except ValidationError as error:
        raise ConfigError(where + _first_fault(schema, error, named)) from None


def _first_fault(schema: type[BaseModel], error: ValidationError, named: str) -> str:
    # the deepest fault is the one that the writer can act on (a union reports each member)
    fault = max(error.errors(include_url=False), key=lambda fault: len(fault['loc']))
    place, owner = _place(schema, fault['loc'])
    kind, message = fault['type'], fault['msg'].removeprefix('Value error, ')
    message = printable(message.replace('Input should be', 'must be'), 500)
    if kind == 'string_pattern_mismatch' and fault['ctx']['pattern'] == NAME_PATTERN:
        message = 'must have letters, digits and _ only, a letter first'
    key = _filled(named, printable(place))
    if kind == 'extra_forbidden':
        known = owner.model_fields
        hint = did_you_mean(str(fault['loc'][-1]), known)
        return f'unknown {key}{hint} allowed: {listed(known)}'
    if kind == 'missing':
        return f'missing {key}'
    if kind == 'union_tag_not_found':
        return f'missing {_filled(named, printable(f"{place}.model"))}'
    if kind == 'union_tag_invalid':
        known = fault['ctx']['expected_tags'].replace("'", '')
        key = _filled(named, printable(f'{place}.model'))
        tag = printable(fault['ctx']['tag'])
        return (
            f"{key}: '{tag}' is not known{did_you_mean(tag, known.split(', '))} allowed: {known}"
        )
    if isinstance(fault['input'], dict):  # a rule between keys: the whole mapping tells nothing
        return f'{key}: {message}' if place else message
    got = printable(fault['input'])
    if isinstance(fault['input'], str):
        got = repr(got)
        if got in message:
            return f'{key}: {message}'
    return f'{key}: {message} (got {got})'


def _filled(named: str, key: str) -> str:
    """Return how the user wrote a key; braces in the name of a file mean nothing."""
    before, _, after = named.rpartition('{}')
    return f'{before}{key}{after}'


def _place(schema: type[BaseModel], location: tuple[Any, ...]) -> tuple[str, type[BaseModel]]:
    """
    Return a fault's place as a reader writes it, and the schema of the mapping it lies in.

    pydantic adds to the place which member of a union it took: a class, a type, or the value of
    the key ``model``; these mean nothing to a reader.
    """
    parts, members = [], [schema]
    for part in location:
        chosen = [member for member in members if part in (member.__name__, _model(member))]
        if chosen and not any(part in member.model_fields for member in members):
            members = chosen
        elif part != 'str' and '[' not in str(part):
            parts.append(str(part))
            fields = [m.model_fields[part] for m in members if part in m.model_fields]
            found = [s for field in fields for s in _schemas(field.annotation)]
            schema, members = members[0], found or members
    return '.'.join(parts), schema


def _model(schema: type[BaseModel]) -> str | None:
    """Return the value of the key ``model`` that chooses a schema in a union."""
    field = schema.model_fields.get('model')
    values = get_args(field.annotation) if field else ()
    return values[0] if values else None


def _schemas(annotation: Any) -> Iterator[type[BaseModel]]:
    """Yield the schemas that a field's type is made of."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for part in get_args(annotation):
        yield from _schemas(part)
