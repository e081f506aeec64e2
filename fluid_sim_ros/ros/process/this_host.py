# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Keeps ROS on this host, unless the user opened it.

``ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST`` is not enough: Fast DDS then looks for nobody on the
network, but its sockets still listen there, and take what a peer sends that knows the port. A
profile that binds them to 127.0.0.1 closes them.
"""

import os
from pathlib import Path

from fluid_sim_ros.errors import ConfigError

#: Largest ROS_DOMAIN_ID whose UDP ports stay below 65536 (OMG DDSI-RTPS 2.5, section 9.6.2.3).
_LARGEST_DOMAIN = 232
_RANGE = 'ROS_AUTOMATIC_DISCOVERY_RANGE'
#: Variables that name a file of profiles: of Fast DDS 2, which comes with Jazzy, and version 3.
FAST_DDS_PROFILES = ('FASTRTPS_DEFAULT_PROFILES_FILE', 'FASTDDS_DEFAULT_PROFILES_FILE')
#: Files of profiles that Fast DDS takes from the working folder by itself.
_FILES = ('DEFAULT_FASTRTPS_PROFILES.xml', 'DEFAULT_FASTDDS_PROFILES.xml')
#: With any of these a user has chosen transports or peers of their own.
_CHOICES = (
    *FAST_DDS_PROFILES, 'FASTDDS_BUILTIN_TRANSPORTS', 'ROS_STATIC_PEERS', 'ROS_DISCOVERY_SERVER',
)  # fmt: skip
PROFILE = Path(__file__).with_name('fastdds_loopback.xml')


def stay_on_this_host() -> None:
    """
    Keep discovery and messages on this host unless the user opened it; before ROS starts.

    It sets what is not set in the environment, for this process and those that it starts.
    """
    os.environ.setdefault(_RANGE, 'LOCALHOST')
    if not opened():
        for name in FAST_DDS_PROFILES:
            os.environ[name] = str(PROFILE)


def opened() -> str:
    """
    Return what of the user's opens ROS to the network, or may do so.

    Returns
    -------
    str
        Name of the variable or file; empty where everything stays on this host.

    """
    if os.environ.get(_RANGE, 'LOCALHOST') not in ('LOCALHOST', 'OFF'):
        return _RANGE
    for name in _CHOICES:
        value = os.environ.get(name, '')
        if value and value != str(PROFILE):
            return name
    return next((name for name in _FILES if Path(name).exists()), '')


def check_domain() -> None:
    """
    Check ROS_DOMAIN_ID, and keep ROS on this host unless the user opened it.

    Raises
    ------
    ConfigError
        If the domain is not a whole number from 0 to 232.

    """
    text = os.environ.get('ROS_DOMAIN_ID', '')
    if text and not (text.isdecimal() and int(text) <= _LARGEST_DOMAIN):
        raise ConfigError(f"ROS_DOMAIN_ID is '{text}'; allowed: 0 to {_LARGEST_DOMAIN}")
    stay_on_this_host()
