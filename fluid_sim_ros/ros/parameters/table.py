# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Tables of ROS parameters: what declares them on a node, checks them and documents them."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
)
from rclpy.node import Node

from fluid_sim_ros.errors import ConfigError, did_you_mean, listed
from fluid_sim_ros.ros.raw import parameter_overrides
from fluid_sim_ros.schema.yaml_file import parse_yaml

_BUILT_IN = ('use_sim_time', 'start_type_description_service')


@dataclass(frozen=True)
class Declared:
    """
    One parameter.

    Attributes
    ----------
    default
        Its type is the parameter's type; a float also takes an integer; an empty list holds
        floats.
    description
        Starts with the unit in brackets where there is one.
    low, high
        Allowed range of numbers, ends included.
    choices
        Allowed strings.
    length
        Allowed lengths of an array.
    live
        May change at run time; the others are fixed while what they set up is there.
    may_be_nan
        ``nan`` is allowed and means what the description says.
    former
        Name that it had in the last release, which is still understood at the start.
    names_place
        Names a file or an address of this host, so that nobody else shall set it: it may change
        after the start only where ``allow_remote_paths`` was set there.

    """

    default: Any
    description: str
    low: float = -math.inf
    high: float = math.inf
    choices: tuple[str, ...] = ()
    length: tuple[int, ...] = ()
    live: bool = False
    may_be_nan: bool = False
    former: str = ''
    names_place: bool = False


Table = Mapping[str, Declared]


def declare(node: Node, table: Table, fixed: str) -> None:
    """
    Declare a table on a node.

    Parameters
    ----------
    node
        The node.
    table
        Its parameters by name.
    fixed
        While what the parameters that are not live keep their values, in words.

    Raises
    ------
    ConfigError
        If an override names no parameter, has the wrong type, or is out of range.

    """
    given = parameter_overrides(node)
    new_names = {declared.former: name for name, declared in table.items() if declared.former}
    replaced: dict[str, Any] = {}
    for given_name, override in given.items():
        name = new_names.get(given_name, given_name)
        if name in table:
            fault = check(table, name, override.value)
            if fault:
                raise ConfigError(fault)
            if name != given_name:
                _warn_of_former(node, name, given_name, both=name in given)
            if name != given_name or override.value is None:
                replaced[name] = converted(table[name], override.value)
        elif name not in _BUILT_IN and not name.startswith('qos_overrides.'):
            hint = did_you_mean(name, table)
            raise ConfigError(f"parameter '{name}' is not known{hint} parameters: {listed(table)}")
    for name, declared in table.items():
        value = replaced.get(name, declared.default)
        node.declare_parameter(name, value, _descriptor(declared, fixed), name in replaced)


def _warn_of_former(node: Node, name: str, former: str, both: bool) -> None:
    if both:
        raise ConfigError(f"parameters '{name}' and '{former}' are the same: give the first alone")
    node.get_logger().warning(
        f"parameter '{former}' is called '{name}' now; the next release does not know the old name"
    )


def value_of(node: Node, table: Table, name: str) -> Any:
    """
    Return the present value of a parameter.

    Parameters
    ----------
    node
        The node.
    table
        Its parameters by name.
    name
        One of them.

    Returns
    -------
    Any
        Of the default's type: a float also where an integer or a text was given.

    """
    return converted(table[name], node.get_parameter(name).value)


def converted(declared: Declared, value: Any) -> Any:
    """
    Return a value in the type of the parameter, where it can be read as such.

    The tools of ROS take ``1e-05`` and ``nan`` for texts, pass a list of numbers with one of
    these as one text, and read an empty list in a file as nothing at all.

    Parameters
    ----------
    declared
        The parameter.
    value
        What was given.

    Returns
    -------
    Any
        A float or a list of floats where the parameter is one and the value allows it; otherwise
        the value as it was given.

    """
    if value is None and isinstance(declared.default, list):
        return []
    try:
        if isinstance(declared.default, float) and not isinstance(value, bool):
            return float(value)
        if isinstance(declared.default, list) and not _holds_texts(declared):
            if isinstance(value, str):
                value = parse_yaml(value.encode(), 'a parameter')
            if not isinstance(value, str) and not any(isinstance(v, bool) for v in value):
                return [float(v) for v in value]
    except (TypeError, ValueError, ConfigError):
        return value
    return value


def _descriptor(declared: Declared, fixed: str) -> ParameterDescriptor:
    """
    Return what ``ros2 param describe`` shows.

    None is read-only to ROS: that would refuse ``ros2 param load`` of the values that there are.
    """
    descriptor = ParameterDescriptor(description=declared.description, dynamic_typing=True)
    descriptor.additional_constraints = '; '.join(_constraints(declared, fixed))
    bounded = math.isfinite(declared.low) or math.isfinite(declared.high)
    if bounded and isinstance(declared.default, float):
        low, high = max(declared.low, -1e300), min(declared.high, 1e300)
        descriptor.floating_point_range = [FloatingPointRange(from_value=low, to_value=high)]
    elif bounded and isinstance(declared.default, int):
        high = int(min(declared.high, 2**62))
        descriptor.integer_range = [IntegerRange(from_value=int(declared.low), to_value=high)]
    return descriptor


def _constraints(declared: Declared, fixed: str) -> Iterator[str]:
    if declared.choices:
        yield f'one of: {_choices(declared)}'
    if declared.length:
        yield f'{listed(map(str, declared.length))} values'
    if isinstance(declared.default, list) and math.isfinite(declared.low):
        yield f'each at least {declared.low:g}'
    if declared.may_be_nan:
        yield 'nan allowed'
    if declared.names_place:
        yield 'fixed after the start, unless allow_remote_paths was set there'
    yield 'may change at run time' if declared.live else f'fixed while {fixed}'


def _choices(declared: Declared) -> str:
    return listed(choice or '(empty)' for choice in declared.choices)


def check(table: Table, name: str, value: Any) -> str | None:
    """
    Return what is wrong with a parameter's value.

    Parameters
    ----------
    table
        The node's parameters by name.
    name
        One of them.
    value
        What it shall be.

    Returns
    -------
    str or None
        One line that names parameter and value, or None where nothing is wrong.

    """
    declared = table[name]
    where = f"parameter '{name}': {value!r}"
    value = converted(declared, value)
    default = declared.default
    if isinstance(default, list):
        return _check_array(where, declared, value)
    if isinstance(default, float):
        if not _is_number(value):
            return f'{where} is not a number'
    elif type(value) is not type(default):
        return f'{where} is not of type {type(default).__name__}'
    if declared.choices and value not in declared.choices:
        return f'{where} is not allowed; allowed: {_choices(declared)}'
    if isinstance(default, int | float) and not isinstance(default, bool):
        return _check_range(where, declared, [value])
    return None


def _holds_texts(declared: Declared) -> bool:
    return bool(declared.default) and isinstance(declared.default[0], str)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _check_array(where: str, declared: Declared, value: Any) -> str | None:
    if isinstance(value, str | bytes) or not hasattr(value, '__len__'):
        return f'{where} is not an array'
    if _holds_texts(declared):
        return None if all(isinstance(v, str) for v in value) else f'{where}: not all are strings'
    if not all(map(_is_number, value)):
        return f'{where}: not all are numbers'
    if declared.length and len(value) not in declared.length:
        return f'{where}: has {len(value)} values, needs {listed(map(str, declared.length))}'
    return _check_range(where, declared, value)


def _check_range(where: str, declared: Declared, values: Sequence[float]) -> str | None:
    for value in values:
        if math.isnan(value) and declared.may_be_nan:
            continue
        if not (math.isfinite(value) and declared.low <= value <= declared.high):
            return f'{where} is out of range; allowed: {declared.low:g} to {declared.high:g}'
    return None
