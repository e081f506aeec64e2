# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What the doctor looks at for ROS 2."""

import os
from importlib import util

from fluid_sim_ros.cli.doctor.optional import install
from fluid_sim_ros.cli.doctor.row import Row, State, probe, version
from fluid_sim_ros.errors import FluidSimError, listed

#: Below this much free shared memory Fast DDS falls back or fails [bytes]; Docker gives 64 MiB.
_LEAST_SHARED_MEMORY = 32 * 2**20
MESSAGES = (
    'builtin_interfaces', 'diagnostic_msgs', 'geometry_msgs', 'lifecycle_msgs', 'nav_msgs',
    'rcl_interfaces', 'rosgraph_msgs', 'sensor_msgs', 'std_msgs', 'std_srvs', 'visualization_msgs',
)  # fmt: skip


def ros_checks() -> list[Row]:
    """Return what was found of ROS 2, its middleware and its messages."""
    rclpy = _ros()
    return [
        rclpy, _messages(), _publishing(rclpy.state), _domain(rclpy.state), _discovery(),
        _shared_memory(),
    ]  # fmt: skip


def _ros() -> Row:
    name = 'ROS 2'
    if util.find_spec('rclpy') is None:
        remedy = f'source a ROS 2 Jazzy, or type: {install("ros")}'
        return Row(name, 'absent', 'no rclpy', remedy)
    script = 'import rclpy; print(rclpy.__file__, rclpy.get_rmw_implementation_identifier())'
    answer, fault = probe(script)
    if fault:
        remedy = 'unset RMW_IMPLEMENTATION, or install the middleware that it names'
        return Row(name, 'broken', f'rclpy does not load: {fault}', remedy)
    file, middleware = answer.rsplit(maxsplit=1)
    distribution = os.environ.get('ROS_DISTRO', '')
    origin = f'ROS 2 {distribution} install' if _is_rosinstall(file) else 'pip wheels'
    return Row(name, 'ok', f'rclpy {version("rclpy")} ({origin}), {middleware}')


def _is_rosinstall(file: str) -> bool:
    prefixes = os.environ.get('AMENT_PREFIX_PATH', '').split(os.pathsep)
    return any(prefix and file.startswith(prefix + os.sep) for prefix in prefixes)


def _messages() -> Row:
    missing = [package for package in MESSAGES if util.find_spec(package) is None]
    if missing:
        remedy = f'apt-get install ros-jazzy-common-interfaces, or type: {install("ros")}'
        return Row('ROS messages', 'absent', f'missing: {listed(missing)}', remedy)
    return Row('ROS messages', 'ok', f'{len(MESSAGES)} packages')


def _publishing(rclpy: State) -> Row:
    name = 'publishing'
    if rclpy != 'ok':
        return Row(name, 'absent', 'not looked at', 'first mend ROS 2')
    found, fault = probe('from fluid_sim_ros.ros.publishing import usual_way; print(usual_way())')
    if fault:
        return Row(name, 'broken', fault, 'reinstall fluid_sim_ros')
    return Row(name, 'ok', found)


def _domain(rclpy: State) -> Row:
    name = 'ROS_DOMAIN_ID'
    value = os.environ.get(name, '')
    if rclpy != 'ok':  # the check comes with the node, and a broken rclpy ends the process
        return Row(name, 'absent', value or 'not set', 'first mend ROS 2')
    from fluid_sim_ros.ros.process.this_host import check_domain

    try:
        check_domain()
    except FluidSimError as error:
        return Row(name, 'broken', str(error), 'export ROS_DOMAIN_ID=0')
    return Row(name, 'ok', value or '0 (not set)')


def _discovery() -> Row:
    name, allowed = 'ROS discovery', ('LOCALHOST', 'SUBNET', 'OFF', 'SYSTEM_DEFAULT')
    value = os.environ.get('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    if value not in allowed:
        remedy = f'ROS_AUTOMATIC_DISCOVERY_RANGE must be one of {listed(allowed)}'
        return Row(name, 'broken', value, remedy)
    reach = {
        'LOCALHOST': 'this host only',
        'SUBNET': 'the network too',
        'OFF': 'no other process is found',
        'SYSTEM_DEFAULT': "the middleware's own rule",
    }
    from fluid_sim_ros.ros.process.this_host import opened

    choice = opened()
    if choice and value in ('LOCALHOST', 'OFF'):
        return Row(name, 'ok', f'{value}, with transports or peers of your own ({choice})')
    return Row(name, 'ok', f'{value}: {reach[value]}')


def _shared_memory() -> Row:
    name, path = 'shared memory', '/dev/shm'
    try:
        state = os.statvfs(path)
    except OSError as error:
        return Row(name, 'absent', f'{path}: {error.strerror}', 'DDS will use UDP, slower')
    free = state.f_bavail * state.f_frsize
    found = f'{path}: {free / 2**20:.0f} MiB free'
    if free < _LEAST_SHARED_MEMORY:
        return Row(name, 'absent', found, 'free some, or docker run --shm-size=256m')
    return Row(name, 'ok', found)
