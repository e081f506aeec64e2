# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Which texts are names of ROS topics and types; a log may hold any."""

import re

_TOPIC = re.compile(r'/?[A-Za-z_][A-Za-z0-9_]*(/[A-Za-z_][A-Za-z0-9_]*)*')
_TYPE = re.compile(r'[a-z][a-z0-9_]*/(msg|srv|action)/[A-Z][A-Za-z0-9_]*')
#: Longest name: DDS and file names take no longer ones.
_LONGEST = 200


def is_topic_name(text: str) -> bool:
    """
    Return whether a text is a topic's name: tokens of letters, digits and ``_`` between ``/``.

    Parameters
    ----------
    text
        Of a log.

    """
    return len(text) <= _LONGEST and _TOPIC.fullmatch(text) is not None


def is_type_name(text: str) -> bool:
    """
    Return whether a text is a type's name, such as ``nav_msgs/msg/Odometry``.

    Parameters
    ----------
    text
        Of a log.

    """
    return len(text) <= _LONGEST and _TYPE.fullmatch(text) is not None
