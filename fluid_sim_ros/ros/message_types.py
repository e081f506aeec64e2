# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The ROS classes of message types, found by the name of the type."""

import os
import re
import sys
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

from fluid_sim_ros.errors import MissingExtraError
from fluid_sim_ros.messages.definitions import known
from fluid_sim_ros.messages.transform_topics import TRANSFORMS
from fluid_sim_ros.ros.transforms_type import transforms_type

_NAME = re.compile(r'([a-z][a-z0-9_]*)/msg/([A-Z][A-Za-z0-9]*)')


@cache
def find_message_class(message: str) -> Any | None:
    """
    Return the class of a message type, or None where ROS here lacks it.

    Only types that this package or the installed ROS knows are imported, so that a name from a
    file (a log) imports nothing else.

    Parameters
    ----------
    message
        Message type, ``package/msg/Name``.

    Returns
    -------
    type or None
        The class with which rclpy creates publishers and subscriptions of this type.

    """
    match = _NAME.fullmatch(message)
    if match is None or not (message in known() or _is_registered(*match.groups())):
        return None
    package, name = match.groups()
    try:
        return getattr(import_module(f'{package}.msg'), name, None)
    except ModuleNotFoundError:  # a part of ROS that the wheels lack
        return transforms_type() if message == TRANSFORMS else None


def message_class(message: str) -> Any:
    """
    Return the class of a message type that has to be there.

    Parameters
    ----------
    message
        Message type, ``package/msg/Name``.

    Returns
    -------
    type
        The class with which rclpy creates publishers and subscriptions of this type.

    Raises
    ------
    MissingExtraError
        If ROS here lacks it.

    """
    found = find_message_class(message)
    if found is None:
        raise MissingExtraError(f'{message} is not part of the ROS that is installed here')
    return found


def _is_registered(package: str, name: str) -> bool:
    """Return whether ROS's index of installed interfaces (ament) has a message."""
    prefixes = [*filter(None, os.environ.get('AMENT_PREFIX_PATH', '').split(':')), sys.prefix]
    for prefix in prefixes:
        index = Path(prefix) / 'share/ament_index/resource_index/rosidl_interfaces' / package
        if index.is_file() and f'msg/{name}.idl' in index.read_text(encoding='utf-8').split():
            return True
    return False
