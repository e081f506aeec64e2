# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Write fluid_sim_ros/messages/definitions.json from an installed ROS 2 Jazzy (or its wheels).

For each message type that the project uses: the full definition as MCAP's schema encoding
``ros2msg`` wants it (the type's own text, then each dependency behind a separator line), and the
type hash (RIHS01) that ROS 2 announces on the wire.
"""

import json
import os
import sys
from pathlib import Path

TYPES = (
    'nav_msgs/msg/Odometry', 'geometry_msgs/msg/WrenchStamped', 'geometry_msgs/msg/TwistStamped',
    'sensor_msgs/msg/JointState', 'std_msgs/msg/Float64MultiArray', 'std_msgs/msg/String',
    'rosgraph_msgs/msg/Clock', 'diagnostic_msgs/msg/DiagnosticArray',
    'visualization_msgs/msg/MarkerArray', 'sensor_msgs/msg/Imu', 'sensor_msgs/msg/MagneticField',
    'sensor_msgs/msg/NavSatFix', 'sensor_msgs/msg/FluidPressure', 'geometry_msgs/msg/PoseStamped',
    'geometry_msgs/msg/TwistWithCovarianceStamped', 'sensor_msgs/msg/Range',
    'geometry_msgs/msg/Vector3Stamped', 'sensor_msgs/msg/BatteryState', 'sensor_msgs/msg/Joy',
    'sensor_msgs/msg/LaserScan', 'sensor_msgs/msg/PointCloud2', 'sensor_msgs/msg/Image',
    'sensor_msgs/msg/CameraInfo',
)  # fmt: skip
# Not among the wheels: the text and the hash of ROS 2 Jazzy's tf2_msgs.
ELSEWHERE = {
    'tf2_msgs/msg/TFMessage': (
        'geometry_msgs/TransformStamped[] transforms\n',
        'RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087',
    ),
}
BUILT_IN = {
    'bool', 'byte', 'char', 'float32', 'float64', 'int8', 'uint8', 'int16', 'uint16', 'int32',
    'uint32', 'int64', 'uint64', 'string', 'wstring',
}  # fmt: skip
SEPARATOR = '=' * 80
TARGET = Path(__file__).resolve().parents[1] / 'fluid_sim_ros/messages/definitions.json'


def share_of(package: str) -> Path:
    """Return a ROS package's share folder."""
    prefixes = [*filter(None, os.environ.get('AMENT_PREFIX_PATH', '').split(':')), sys.prefix]
    for prefix in prefixes:
        folder = Path(prefix) / 'share' / package
        if folder.is_dir():
            return folder
    raise SystemExit(f'{package} is not installed; source ROS 2 Jazzy, or install the extra ros')


def text_of(message: str) -> str:
    """Return the text of a .msg file."""
    if message in ELSEWHERE:
        return ELSEWHERE[message][0]
    package, _, name = message.split('/')
    return (share_of(package) / 'msg' / f'{name}.msg').read_text(encoding='utf-8')


def members(message: str) -> list[str]:
    """Return the message types that a message is made of, in order."""
    package, found = message.split('/')[0], []
    for line in text_of(message).splitlines():
        words = line.partition('#')[0].split()
        if not words:
            continue
        kind = words[0].partition('[')[0].partition('<')[0]
        if kind in BUILT_IN:
            continue
        if '/' not in kind:
            kind = f'{package}/{kind}'
        first, _, last = kind.partition('/')
        found.append(f'{first}/msg/{last.removeprefix("msg/")}')
    return found


def definition(message: str) -> str:
    """Return a message's text with those of everything in it."""
    seen, waiting = [], [message]
    while waiting:
        current = waiting.pop(0)
        if current not in seen:
            seen.append(current)
            waiting += members(current)
    parts = [text_of(message)]
    for part in seen[1:]:
        package, _, name = part.split('/')
        parts.append(f'{SEPARATOR}\nMSG: {package}/{name}\n{text_of(part)}')
    return '\n'.join(text.rstrip('\n') + '\n' for text in parts)


def type_hash(message: str) -> str:
    """Return a message's type hash."""
    if message in ELSEWHERE:
        return ELSEWHERE[message][1]
    package, _, name = message.split('/')
    content = json.loads((share_of(package) / 'msg' / f'{name}.json').read_text(encoding='utf-8'))
    return next(
        entry['hash_string'] for entry in content['type_hashes'] if entry['type_name'] == message
    )


def collect() -> dict[str, object]:
    """Return what the file holds."""
    return {
        'source': 'common_interfaces and rcl_interfaces of ROS 2 Jazzy, Apache License 2.0',
        'types': {
            name: {'hash': type_hash(name), 'definition': definition(name)}
            for name in sorted((*TYPES, *ELSEWHERE))
        },
    }


if __name__ == '__main__':
    TARGET.write_text(json.dumps(collect(), indent=1) + '\n', encoding='utf-8')
