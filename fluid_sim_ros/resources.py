# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Finds config/ and models/ in a source tree, a pip installation and a colcon installation."""

from functools import cache
from pathlib import Path

from fluid_sim_ros.errors import ConfigError

#: Name of the package, and of its folder in ``share``.
SHARE = 'fluid_sim_ros'


@cache
def share_folder() -> Path:
    """
    Return the folder that holds ``config`` and ``models``.

    That is the source tree for an editable install, and ``<prefix>/share/fluid_sim_ros`` for an
    installed package, where ``<prefix>`` is found upward from the package itself (the same rule
    serves a virtual environment, a colcon install space and a system installation).

    Raises
    ------
    ConfigError
        If no such folder exists (the installation lacks its data files).

    """
    package = Path(__file__).resolve().parent
    candidates = [package.parent]
    candidates += [parent / 'share' / SHARE for parent in package.parents]
    for folder in candidates:
        if (folder / 'models').is_dir() and (folder / 'config').is_dir():
            return folder
    raise ConfigError(
        f'the data folders config/ and models/ of {SHARE} are not found near {package}; '
        'reinstall the package'
    )


def models_folder() -> Path:
    """Return the folder with the MJCF models."""
    return share_folder() / 'models'


def config_folder() -> Path:
    """Return the folder with scenes, vehicles and ROS parameter files."""
    return share_folder() / 'config'
