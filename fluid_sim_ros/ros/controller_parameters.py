"""Parameters of the example controllers: declared from one table, checked, with units."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any, TypeVar

from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter

from fluid_sim_ros.control.gains import Gains, describe
from fluid_sim_ros.errors import ConfigError, listed

GainSet = TypeVar('GainSet', bound=Gains)

_BUILT_IN = ('use_sim_time', 'start_type_description_service')
_GAINS = 'gains.'


@dataclass(frozen=True)
class Declared:
    """
    One parameter.

    Attributes
    ----------
    default
        Its type is the parameter's type; a float also takes an integer; a list holds floats.
    description
        Starts with the unit in brackets where there is one.
    low
        Lowest allowed number.
    live
        May change while the controller runs.
    may_be_nan
        ``nan`` is allowed and means what the description says.

    """

    default: Any
    description: str
    low: float = -math.inf
    live: bool = False
    may_be_nan: bool = False


COMMON: dict[str, Declared] = {
    'scene': Declared('', "scene name or path, the same as the simulator's"),
    'vehicle': Declared('', "vehicle name; empty = the scene's only vehicle with thrusters"),
    'waypoints': Declared(
        [], '[m, m, m, rad, s] x, y, z, yaw, hold of each waypoint, one after another; '
        'empty = hold the pose of the first odometry'
    ),
    'waypoint_radius': Declared(0.25, '[m] distance at which a waypoint counts as reached', low=0),
}  # fmt: skip


def table_of(gains: type[Gains], own: Mapping[str, Declared]) -> dict[str, Declared]:
    """Return the whole table of a controller: the common part, its own, and its gains."""
    table = {**COMMON, **own}
    for entry in fields(gains):
        table[_GAINS + entry.name] = Declared(entry.default, describe(entry), low=0)
    return table


def declare(node: Node, table: Mapping[str, Declared]) -> None:
    """
    Declare a table on a node.

    Raises
    ------
    ConfigError
        If an override names no parameter, has the wrong type, or is out of range.

    """
    given = node._parameter_overrides  # rclpy offers no public view of what the user passed
    for name, override in given.items():
        if name in table:
            fault = check(table[name], name, override.value)
            if fault:
                raise ConfigError(fault)
        elif name not in _BUILT_IN and not name.startswith('qos_overrides.'):
            raise ConfigError(f"parameter '{name}' is not known; parameters: {listed(table)}")
    for name, declared in table.items():
        descriptor = ParameterDescriptor(description=declared.description, dynamic_typing=True)
        node.declare_parameter(name, declared.default, descriptor)


def check(declared: Declared, name: str, value: Any) -> str | None:
    """Return what is wrong with a value in one line, or None."""
    where = f"parameter '{name}': {value!r}"
    if isinstance(declared.default, str):
        return None if isinstance(value, str) else f'{where} is not of type str'
    if isinstance(declared.default, list):
        if isinstance(value, str | bytes) or not hasattr(value, '__len__'):
            return f'{where} is not an array'
        return None if all(map(_is_number, value)) else f'{where}: not all are numbers'
    if not _is_number(value):
        return f'{where} is not a number'
    if math.isnan(value) and declared.may_be_nan:
        return None
    if not math.isfinite(value) or value < declared.low:
        bound = f' and at least {declared.low:g}' if math.isfinite(declared.low) else ''
        return f'{where} is out of range; must be finite{bound}'
    return None


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def judge(table: Mapping[str, Declared], changes: Sequence[Parameter]) -> SetParametersResult:
    """Accept or refuse a change at run time, with the reason."""
    for change in changes:
        declared = table.get(change.name)
        if declared is None:
            continue
        fault = check(declared, change.name, change.value)
        if fault is None and not declared.live:
            live = listed(name for name, entry in table.items() if entry.live)
            fault = f"parameter '{change.name}': fixed while the controller runs; live: {live}"
        if fault:
            return SetParametersResult(successful=False, reason=fault)
    return SetParametersResult(successful=True)


def number(node: Node, name: str) -> float:
    """Return a numeric parameter."""
    return float(node.get_parameter(name).value)


def gains(node: Node, kind: type[GainSet]) -> GainSet:
    """Return the gains as the parameters have them."""
    return kind(**{entry.name: number(node, _GAINS + entry.name) for entry in fields(kind)})
