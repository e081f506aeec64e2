"""The node's parameters: one table that declares, checks and documents them."""

import math
import os
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import yaml
from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
    SetParametersResult,
)
from rclpy.node import Node
from rclpy.parameter import Parameter

from fluid_sim_ros.autopilot import LOOPBACK, PROTOCOLS
from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.fluid_rungs import FLUID_RUNGS
from fluid_sim_ros.scene import INTEGRATORS

PACINGS = ('realtime', 'free', 'lockstep')
MATCHES = ('stamp', 'count')
TIMEOUT_RULES = ('hold', 'continue', 'stop')
RECORD_POLICIES = ('block', 'drop')
THRUST_UNITS = ('newton', 'normalized')
#: Largest ROS_DOMAIN_ID whose UDP ports stay below 65536 (OMG DDSI-RTPS 2.5, section 9.6.2.3).
_LARGEST_DOMAIN = 232


@dataclass(frozen=True)
class Declared:
    """
    One parameter.

    Attributes
    ----------
    default
        Its type is the parameter's type; a float also takes an integer.
    description
        Starts with the unit in brackets where there is one.
    low, high
        Allowed range of numbers, ends included.
    choices
        Allowed strings.
    length
        Allowed lengths of an array.
    live
        May change while the node is configured.

    """

    default: Any
    description: str
    low: float = -math.inf
    high: float = math.inf
    choices: tuple[str, ...] = ()
    length: tuple[int, ...] = ()
    live: bool = False


_VARIANCE = [0.0] * 6

TABLE: dict[str, Declared] = {
    'scene': Declared('quadrotor', 'scene name, or path of a scene (.yaml) or MJCF (.xml) file'),
    'seed': Declared(0, 'seed of everything random', low=0),
    'timestep': Declared(0.0, "[s] replaces the model's timestep; 0 = the model's", low=0, high=1),
    'integrator': Declared(
        '', "replaces the model's integrator; empty = the model's", choices=('', *INTEGRATORS)
    ),
    'fluid': Declared(
        '', "replaces the model's fluid forces; empty = the model's", choices=('', *FLUID_RUNGS)
    ),
    'autostart': Declared(True, 'configure and activate at start'),
    'duration': Declared(0.0, '[s] simulated time after which the node ends; 0 = never', low=0),
    'pacing': Declared('realtime', 'how fast simulated time passes', choices=PACINGS, live=True),
    'realtime.factor': Declared(
        1.0, '[-] simulated seconds per wall second', low=1e-3, high=1e3, live=True
    ),
    'lockstep.period': Declared(0.01, '[s] simulated time between two answers', low=1e-6, high=10),
    'lockstep.match': Declared(
        'stamp', 'an answer is matched by its stamp, or by count', choices=MATCHES
    ),
    'lockstep.wait_for': Declared(
        [''],
        'topics that must answer; a trailing ? marks one that counts only while somebody '
        'publishes it; empty = the thrust topic of every vehicle that has thrusters, and its '
        'cmd/joints if it has joint actuators too',
    ),
    'lockstep.on_timeout': Declared(
        'hold',
        'without an answer: hold and publish again, continue, or stop',
        choices=TIMEOUT_RULES,
    ),
    'lockstep.timeout': Declared(
        1.0, '[s] wall time to wait for an answer with continue and stop', low=1e-3, high=3600
    ),
    'command_timeout': Declared(
        0.5,
        '[s] age at which a thrust command is stale and thrust goes to zero (simulated time; wall '
        'time with free pacing); 0 = off',
        low=0,
        live=True,
    ),
    'thrust.unit': Declared(
        'newton', 'unit of thrust commands; normalized = share of the limit', choices=THRUST_UNITS
    ),
    'enable_wind': Declared(True, 'wind and current act', live=True),
    'reset.keyframe': Declared('', "keyframe of ~/reset; empty = the scene's", live=True),
    'step_count': Declared(1, 'steps that ~/step takes', low=1, live=True),
    'odom.rate': Declared(100.0, '[Hz] of simulated time, must divide the step rate', low=1e-3),
    'odom.pose_covariance': Declared(
        _VARIANCE, '[m^2, rad^2] diagonal of the pose covariance', low=0, length=(6,)
    ),
    'odom.twist_covariance': Declared(
        _VARIANCE, '[m^2/s^2, rad^2/s^2] diagonal of the twist covariance', low=0, length=(6,)
    ),
    'wrench.rate': Declared(100.0, '[Hz] of simulated time, must divide the step rate', low=1e-3),
    'medium.rate': Declared(100.0, '[Hz] of simulated time, must divide the step rate', low=1e-3),
    'joint_states.rate': Declared(
        100.0, '[Hz] of simulated time, must divide the step rate', low=1e-3
    ),
    'clock.rate': Declared(100.0, '[Hz] of simulated time, must divide the step rate', low=1e-3),
    'tf.rate': Declared(50.0, '[Hz] of simulated time, must divide the step rate', low=1e-3),
    'record': Declared(
        '',
        'MCAP file (.mcap) to record to, or a folder that becomes a rosbag2 bag; empty = no '
        'recording; a reset begins a new one',
    ),
    'record.topics': Declared(
        ['*'],
        'shell patterns of the state topics to record; commands are always recorded, because the '
        'run cannot be repeated without them',
    ),
    'record.policy': Declared(
        'block', 'when the disk is too slow: wait, or leave states out', choices=RECORD_POLICIES
    ),
    'record.queue': Declared(8.0, '[MiB] size of the queue to the writer', low=0.25, high=1024),
    'record.chunk': Declared(
        1.0, '[s] wall time after which data is on the disk', low=0.05, high=3600
    ),
    'autopilot.protocol': Declared(
        'none', 'autopilot that flies a vehicle, in lockstep', choices=('none', *PROTOCOLS)
    ),
    'autopilot.vehicle': Declared('', 'vehicle that it flies; empty = the only one'),
    'autopilot.mapping': Declared(
        '', 'what its outputs drive: name in config/autopilots, or file; empty = by vehicle'
    ),
    'autopilot.instance': Declared(0, 'its number on this host', low=0, high=250),
    'autopilot.port': Declared(
        0, 'port to listen on; 0 = that of the protocol and the instance', low=0, high=65535
    ),
    'autopilot.address': Declared(LOOPBACK, 'address to listen on; loopback = this host only'),
    'autopilot.timeout': Declared(
        1.0, '[s] wall time without an answer after which it counts as gone', low=0.01, high=3600
    ),
    'markers.rate': Declared(20.0, '[Hz] of wall time', low=0.1, high=100),
}

_BUILT_IN = ('use_sim_time', 'start_type_description_service')


def declare_all(node: Node) -> None:
    """
    Declare the whole table on a node.

    Raises
    ------
    ConfigError
        If an override names no parameter, has the wrong type, or is out of range.

    """
    given = node._parameter_overrides  # rclpy offers no public view of what the user passed
    for name in given:
        if name not in TABLE and name not in _BUILT_IN and not name.startswith('qos_overrides.'):
            raise ConfigError(f"parameter '{name}' is not known; parameters: {listed(TABLE)}")
    if 'use_sim_time' in given and given['use_sim_time'].value:
        raise ConfigError(USE_SIM_TIME_REFUSED)
    for name, declared in TABLE.items():
        if name in given:
            fault = check(name, given[name].value)
            if fault:
                raise ConfigError(fault)
        node.declare_parameter(name, declared.default, _descriptor(declared))


USE_SIM_TIME_REFUSED = (
    "parameter 'use_sim_time': must be false for this node, because it is the one that "
    'publishes /clock'
)


def _descriptor(declared: Declared) -> ParameterDescriptor:
    descriptor = ParameterDescriptor(description=declared.description, dynamic_typing=True)
    if declared.choices:
        descriptor.additional_constraints = f'one of: {_choices(declared)}'
    bounded = math.isfinite(declared.low) or math.isfinite(declared.high)
    if bounded and isinstance(declared.default, float):
        low, high = max(declared.low, -1e300), min(declared.high, 1e300)
        descriptor.floating_point_range = [FloatingPointRange(from_value=low, to_value=high)]
    elif bounded and isinstance(declared.default, int):
        high = int(min(declared.high, 2**62))
        descriptor.integer_range = [IntegerRange(from_value=int(declared.low), to_value=high)]
    return descriptor


def _choices(declared: Declared) -> str:
    return listed(choice or '(empty)' for choice in declared.choices)


def check(name: str, value: Any) -> str | None:
    """Return what is wrong with a parameter's value in one line, or None."""
    declared = TABLE[name]
    where = f"parameter '{name}': {value!r}"
    default = declared.default
    if isinstance(default, list):
        return _check_array(where, declared, value)
    if isinstance(default, float):
        if isinstance(value, bool) or not isinstance(value, int | float):
            return f'{where} is not a number'
    elif type(value) is not type(default):
        return f'{where} is not of type {type(default).__name__}'
    if declared.choices and value not in declared.choices:
        return f'{where} is not allowed; allowed: {_choices(declared)}'
    if isinstance(default, int | float) and not isinstance(default, bool):
        return _check_range(where, declared, [value])
    return None


def _check_array(where: str, declared: Declared, value: Any) -> str | None:
    if (not isinstance(value, Sequence) and not hasattr(value, '__len__')) or isinstance(
        value, str
    ):
        return f'{where} is not an array'
    if isinstance(declared.default[0], str):
        return None if all(isinstance(v, str) for v in value) else f'{where}: not all are strings'
    if declared.length and len(value) not in declared.length:
        return f'{where}: has {len(value)} values, needs {listed(map(str, declared.length))}'
    return _check_range(where, declared, value)


def _check_range(where: str, declared: Declared, values: Sequence[float]) -> str | None:
    if all(math.isfinite(v) and declared.low <= v <= declared.high for v in values):
        return None
    return f'{where} is out of range; allowed: {declared.low:g} to {declared.high:g}'


def read_all(node: Node) -> dict[str, Any]:
    """Return the present values; a float parameter that was given as an integer is a float."""
    values = {}
    for name, declared in TABLE.items():
        value = node.get_parameter(name).value
        values[name] = float(value) if isinstance(declared.default, float) else value
    return values


def judge_change(parameters: Sequence[Parameter], configured: bool) -> SetParametersResult:
    """Accept or refuse a change at run time, with the reason."""
    for parameter in parameters:
        name = parameter.name
        if name == 'use_sim_time' and parameter.value:
            return SetParametersResult(successful=False, reason=USE_SIM_TIME_REFUSED)
        if name not in TABLE:
            continue
        fault = check(name, parameter.value)
        if fault is None and configured and not TABLE[name].live:
            live = listed(n for n, d in TABLE.items() if d.live)
            fault = (
                f"parameter '{name}': fixed while the node is configured (cleanup first); "
                f'changeable: {live}'
            )
        if fault:
            return SetParametersResult(successful=False, reason=fault)
    return SetParametersResult(successful=True)


def check_domain() -> None:
    """
    Check ROS_DOMAIN_ID, and keep discovery on this host unless the user opened it.

    Raises
    ------
    ConfigError
        If the domain is not a whole number from 0 to 232.

    """
    text = os.environ.get('ROS_DOMAIN_ID', '')
    if text and not (text.isdecimal() and int(text) <= _LARGEST_DOMAIN):
        raise ConfigError(f"ROS_DOMAIN_ID is '{text}'; allowed: 0 to {_LARGEST_DOMAIN}")
    os.environ.setdefault('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')


def check_parameter_files(arguments: Sequence[str]) -> None:
    """
    Refuse parameter files that the ROS parser would read as something else without a word.

    Raises
    ------
    ConfigError
        If a ``--params-file`` is missing or holds more than flat ROS parameters.

    """
    for flag, value in pairwise(arguments):
        if flag == '--params-file':
            _check_parameter_file(Path(value))


def _check_parameter_file(path: Path) -> None:
    if not path.is_file():
        raise ConfigError(f'{path}: no such parameter file')
    try:
        content = yaml.safe_load(path.read_text(encoding='utf-8'))
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise ConfigError(f'{path}: not valid YAML: {" ".join(str(error).split())}') from None
    if not isinstance(content, dict):
        raise ConfigError(f'{path}: needs <node name>: ros__parameters: <parameters>')
    for node, body in content.items():
        parameters = body.get('ros__parameters') if isinstance(body, dict) else None
        if not isinstance(parameters, dict):
            raise ConfigError(
                f"{path}: '{node}' holds no 'ros__parameters' mapping; this looks like a scene or "
                "vehicle file, which belongs in the parameter 'scene'"
            )
        _check_flat(path, '', parameters)


def _check_flat(path: Path, prefix: str, parameters: dict[str, Any]) -> None:
    for key, value in parameters.items():
        name = f'{prefix}{key}'
        if isinstance(value, dict):
            _check_flat(path, f'{name}.', value)
        elif isinstance(value, list) and any(isinstance(v, dict | list) for v in value):
            raise ConfigError(
                f"{path}: parameter '{name}' is a list of mappings or lists, which ROS cannot "
                'hold; scenes and vehicles have files of their own (config/scenes)'
            )
