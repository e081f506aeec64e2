# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What the doctor looks at of this machine, without ROS."""

import os
import shlex
import shutil
import sys
from importlib import util

from fluid_sim_ros.cli.doctor.row import Row, probe, version
from fluid_sim_ros.errors import FluidSimError, listed


def machine_checks() -> list[Row]:
    """Return what was found of Python, MuJoCo, the plugin library, scenes and the compiler."""
    return [_python(), _mujoco(), _plugin_library(), _data(), _compiler()]


def _python() -> Row:
    found = '.'.join(map(str, sys.version_info[:3]))
    if sys.version_info[:2] in ((3, 11), (3, 12), (3, 13)):
        return Row('Python', 'ok', found)
    return Row('Python', 'broken', found, 'use Python 3.11, 3.12 or 3.13')


def _mujoco() -> Row:
    found = version('mujoco')
    if found and util.find_spec('mujoco'):
        return Row('MuJoCo', 'ok', found)
    return Row('MuJoCo', 'broken', 'not installed', 'reinstall fluid_sim_ros')


def _plugin_library() -> Row:
    name = 'plugin library'
    try:
        import mujoco

        from fluid_sim_ros.plugins import load_plugins, plugin_library

        load_plugins()
    except FluidSimError as error:
        return Row(name, 'broken', str(error), 'make clean, then make demo; or reinstall')
    except ImportError as error:
        return Row(name, 'broken', f'not loaded: {error}', 'first mend MuJoCo')
    return Row(name, 'ok', f'{plugin_library().name} fits {mujoco.__version__}')


def _data() -> Row:
    name = 'scenes'
    try:
        from fluid_sim_ros.scene import scene_names

        names = scene_names()
    except (FluidSimError, ImportError) as error:
        return Row(name, 'broken', str(error), 'reinstall fluid_sim_ros')
    if not names:
        return Row(name, 'broken', 'none', 'reinstall fluid_sim_ros')
    return Row(name, 'ok', listed(names))


def _compiler() -> Row:
    tried = shlex.split(os.environ.get('CXX', ''))[:1] or ['c++', 'g++', 'clang++']
    found = next(filter(None, map(shutil.which, tried)), None)
    if found is None:
        remedy = 'to rebuild the plugin library: apt-get install g++'
        return Row('C++ compiler', 'absent', f'none of {listed(tried)}', remedy)
    return Row('C++ compiler', 'ok', found)


def rendering() -> Row:
    """Return whether pictures can be made without a display."""
    name = 'rendering (EGL)'
    script = 'import mujoco; mujoco.GLContext(64, 64).make_current()'
    _, fault = probe(script, MUJOCO_GL='egl', PYOPENGL_PLATFORM='egl')
    if fault:
        return Row(name, 'absent', fault, 'apt-get install libegl1 libgl1-mesa-dri')
    return Row(name, 'ok', 'a context without a display was made')
