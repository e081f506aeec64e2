# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The MuJoCo plugin library: where it is and how it is loaded."""

import ctypes
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import TypeVar

import mujoco

from fluid_sim_ros.errors import PluginError

_LIBRARY = Path(__file__).with_name('libfluid_sim.so')
_Functions = TypeVar('_Functions')


def plugin_library() -> Path:
    """
    Return the path of the shared library with the ``fluid_sim.*`` plugins.

    Raises
    ------
    PluginError
        If the library was not built.

    """
    if not _LIBRARY.exists():
        raise PluginError(
            f'the plugin library {_LIBRARY.name} is not built; '
            'install a C++17 compiler and reinstall fluid_sim_ros'
        )
    return _LIBRARY


@cache
def load_plugins() -> None:
    """
    Register the ``fluid_sim.*`` plugins with MuJoCo; calling it again does nothing.

    Raises
    ------
    PluginError
        If the library is missing or was built for another version of MuJoCo.

    """
    path = str(plugin_library())
    try:
        library = ctypes.CDLL(path)
    except OSError as error:
        raise PluginError(
            f'{_LIBRARY.name} does not load with MuJoCo {mujoco.__version__}; '
            f'reinstall fluid_sim_ros ({error})'
        ) from error
    built_for = library.fsr_built_for()
    if built_for != mujoco.mj_version():
        raise PluginError(
            f'{_LIBRARY.name} was built for MuJoCo version {built_for}, but {mujoco.mj_version()} '
            f'({mujoco.__version__}) is installed; reinstall fluid_sim_ros'
        )


def functions_of(functions: Callable[[str], _Functions], module: str) -> _Functions:
    """
    Return C functions of the library, with their types.

    Parameters
    ----------
    functions
        Takes them from the library at a path.
    module
        File that states them, for people.

    Raises
    ------
    PluginError
        If the library is missing, or does not fit MuJoCo or this module.

    """
    load_plugins()
    path = plugin_library()
    try:
        return functions(str(path))
    except AttributeError as error:
        raise PluginError(
            f'{path.name} and {module} are of different versions; '
            f'reinstall fluid_sim_ros ({error})'
        ) from error
