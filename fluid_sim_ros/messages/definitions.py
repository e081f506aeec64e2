# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Definitions and type hashes of the ROS messages in use, kept as data: no ROS is needed."""

import json
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from fluid_sim_ros.errors import ConfigError, listed

_FILE = Path(__file__).with_name('definitions.json')


@dataclass(frozen=True)
class Definition:
    """A message's full text (schema encoding ``ros2msg``) and its RIHS01 type hash."""

    text: str
    hash: str


@cache
def _all() -> dict[str, Definition]:
    types = json.loads(_FILE.read_text(encoding='utf-8'))['types']
    return {name: Definition(entry['definition'], entry['hash']) for name, entry in types.items()}


def known() -> list[str]:
    """Return the message types whose definitions are kept, ``package/msg/Name``."""
    return list(_all())


def definition(message: str) -> Definition:
    """
    Return the definition of a message type.

    Parameters
    ----------
    message
        ``package/msg/Name``.

    Returns
    -------
    Definition
        Its text and hash.

    Raises
    ------
    ConfigError
        If the type is not kept here.

    """
    try:
        return _all()[message]
    except KeyError:
        raise ConfigError(
            f"message type '{message}' has no definition here; there are: {listed(_all())}"
        ) from None
