# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The parameters of the simulator's node."""

from collections.abc import Sequence
from typing import Any

from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.loop.autopilot_port import EARTHS, LOOPBACK, PROTOCOLS, TIMEOUT_RULES
from fluid_sim_ros.messages import commands, state_topics
from fluid_sim_ros.messages.transform_topics import ROOTS
from fluid_sim_ros.ros.parameters import table as parameter_table
from fluid_sim_ros.ros.parameters.changes import ALLOW_REMOTE_PATHS, judge
from fluid_sim_ros.ros.parameters.table import Declared
from fluid_sim_ros.ros.publishing import THREADS
from fluid_sim_ros.ros.raw import parameter_overrides
from fluid_sim_ros.schema.settings import FLUID_RUNGS, INTEGRATORS

PACINGS = ('realtime', 'free', 'lockstep')
MATCHES = ('stamp', 'count')
RECORD_POLICIES = ('block', 'drop')
THRUST_UNITS = ('newton', 'normalized')

_RATES = {
    'odom.rate': '<v>/odom', 'wrench.rate': 'each <v>/wrench topic',
    'medium.rate': '<v>/medium/wind and current', 'joint_states.rate': '<v>/joint_states',
    'clock.rate': '/clock', 'tf.rate': '/tf',
}  # fmt: skip

TABLE: dict[str, Declared] = {
    'scene': Declared(
        'quadrotor', 'scene name, or path of a scene (.yaml) or MJCF (.xml) file', names_place=True
    ),
    'seed': Declared(0, 'seed of everything random: weather, sensors', low=0),
    'timestep': Declared(0.0, "[s] replaces the model's timestep; 0 = the model's", low=0, high=1),
    'integrator': Declared(
        '', "replaces the model's integrator; empty = the model's", choices=('', *INTEGRATORS)
    ),
    'fluid': Declared(
        '', "replaces the model's fluid forces; empty = the model's", choices=('', *FLUID_RUNGS)
    ),
    'autostart': Declared(True, 'configure and activate at start'),
    ALLOW_REMOTE_PATHS: Declared(
        False, 'others may set, while the node is not configured, what names files or addresses'
    ),
    'duration': Declared(0.0, '[s] simulated time after which the node ends; 0 = never', low=0),
    'pacing': Declared('realtime', 'how fast simulated time passes', choices=PACINGS, live=True),
    'realtime.factor': Declared(
        1.0, '[-] simulated seconds per wall second', low=1e-3, high=1e3, live=True
    ),
    'lockstep.period': Declared(0.01, '[s] simulated time between two answers', low=1e-6, high=10),
    'lockstep.match': Declared(
        commands.DEFAULTS['lockstep.match'], 'an answer is matched by its stamp, or by count',
        choices=MATCHES,
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
        commands.DEFAULTS['thrust.unit'],
        'unit of thrust commands; normalized = share of the limit',
        choices=THRUST_UNITS,
    ),
    'enable_wind': Declared(True, 'wind and current act', live=True),
    'reset.keyframe': Declared('', "keyframe of ~/reset; empty = the scene's", live=True),
    'step_count': Declared(1, 'steps that ~/step takes', low=1, live=True),
    **{
        name: Declared(
            state_topics.DEFAULTS[name], f'[Hz] of {topics}; simulated time', low=1e-3
        )
        for name, topics in _RATES.items()
    },
    'tf.root': Declared(
        state_topics.DEFAULTS['tf.root'],
        'frame that the tree on /tf and /tf_static begins with; odom and base_link leave what is '
        'above to nodes that localise or estimate',
        choices=ROOTS,
    ),
    'tf.links': Declared(
        state_topics.DEFAULTS['tf.links'],
        'links and sensors are in the tree; false where a robot_state_publisher publishes them',
    ),
    'odom.pose_covariance': Declared(
        state_topics.DEFAULTS['odom.pose_covariance'],
        '[m^2, rad^2] diagonal of the pose covariance', low=0, length=(6,),
    ),
    'odom.twist_covariance': Declared(
        state_topics.DEFAULTS['odom.twist_covariance'],
        '[m^2/s^2, rad^2/s^2] diagonal of the twist covariance', low=0, length=(6,),
    ),
    'publish.thread': Declared(
        'auto',
        'messages go out in a thread of their own, while the steps go on; auto = with free '
        'pacing, where two cores are there',
        choices=THREADS,
        live=True,
    ),
    'record.path': Declared(
        '',
        'MCAP file (.mcap) to record to, or a folder that becomes a rosbag2 bag; empty = no '
        'recording; a reset begins a new one',
        former='record',
        names_place=True,
    ),
    'record.topics': Declared(
        ['*'],
        'shell patterns of the state topics to record, `!` takes away; commands are always '
        'recorded, because the run cannot be repeated without them',
    ),
    'record.policy': Declared(
        'block', 'when the disk is too slow: wait, or leave states out', choices=RECORD_POLICIES
    ),
    'record.queue': Declared(8.0, '[MiB] size of the queue to the writer', low=0.25, high=1024),
    'record.chunk': Declared(
        1.0, '[s] wall time after which data is on the disk', low=0.05, high=3600
    ),
    'record.allow_assets_from': Declared(
        '', "folder outside of the model's whose files a log may hold, if the model names them",
        names_place=True,
    ),
    'autopilot.protocol': Declared(
        'scene',
        'autopilot that flies a vehicle, in lockstep; scene = those of the scene file, if any',
        choices=('scene', 'none', *PROTOCOLS),
    ),
    'autopilot.vehicle': Declared('', 'vehicle that it flies; empty = the only one'),
    'autopilot.mapping': Declared(
        '', 'what its outputs drive: name in config/autopilots, or file; empty = by vehicle',
        names_place=True,
    ),
    'autopilot.instance': Declared(0, 'its number on this host', low=0, high=250),
    'autopilot.port': Declared(
        0, 'port to listen on; 0 = that of the protocol and the instance', low=0, high=65535
    ),
    'autopilot.address': Declared(
        LOOPBACK, 'address to listen on; loopback = this host only', names_place=True
    ),
    'autopilot.timeout': Declared(
        60.0, '[s] wall time that a silent one is waited for; simulated time stands still',
        low=0.01, high=86400,
    ),
    'autopilot.on_timeout': Declared(
        'continue', 'what follows: hold = wait on, continue = thrust to rest, stop = error',
        choices=TIMEOUT_RULES,
    ),
    'autopilot.sticks_timeout': Declared(
        0.5,
        '[s] wall time without a message on <v>/cmd/sticks after which the radio is lost; 0 = off',
        low=0,
        high=3600,
    ),
    'autopilot.earth': Declared(
        'wgs84', "what places that PX4 gets are computed on; sphere = PX4's own", choices=EARTHS
    ),
    'foxglove.port': Declared(
        0, 'serve Foxglove and Lichtblick live on this port of this host (8765 is theirs); 0 = no',
        low=0, high=65535,
    ),
    'markers.rate': Declared(
        state_topics.DEFAULTS['markers.rate'], '[Hz] at most, of simulated and of wall time',
        low=0.1, high=100,
    ),
}  # fmt: skip

USE_SIM_TIME_REFUSED = (
    "parameter 'use_sim_time': must be false for this node, because it is the one that "
    'publishes /clock'
)


def declare_all(node: Node) -> None:
    """
    Declare the whole table on the node.

    Parameters
    ----------
    node
        The simulator's node.

    Raises
    ------
    ConfigError
        If an override names no parameter, has the wrong type, or is out of range.

    """
    given = parameter_overrides(node)
    if 'use_sim_time' in given and given['use_sim_time'].value:
        raise ConfigError(USE_SIM_TIME_REFUSED)
    parameter_table.declare(node, TABLE, 'the node is configured')


def read_all(node: Node) -> dict[str, Any]:
    """
    Return the present values; a float parameter that was given as an integer is a float.

    Parameters
    ----------
    node
        The simulator's node.

    Returns
    -------
    dict
        Value by parameter name, in the parameter's unit.

    """
    return {name: parameter_table.value_of(node, TABLE, name) for name in TABLE}


def judge_change(
    node: Node, parameters: Sequence[Parameter], configured: bool
) -> SetParametersResult:
    """
    Accept or refuse a change at run time.

    Parameters
    ----------
    node
        The simulator's node.
    parameters
        What shall be changed.
    configured
        Whether the node is configured, so that only live parameters may change.

    Returns
    -------
    SetParametersResult
        Whether it is accepted, and the reason where it is not.

    """
    if any(change.name == 'use_sim_time' and change.value for change in parameters):
        return SetParametersResult(successful=False, reason=USE_SIM_TIME_REFUSED)
    fixed = 'the node is configured (cleanup first)' if configured else ''
    return judge(node, TABLE, parameters, fixed)
