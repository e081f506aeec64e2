"""
``fluid_sim doctor``: what is installed and works, what is missing, and what to type.

Every check looks at the real thing: it loads the library, makes a rendering context, imports the
messages. A check that could take the process down runs in a process of its own.
"""

import os
import shlex
import shutil
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from importlib import metadata, util
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from fluid_sim_ros.errors import FluidSimError, listed

if TYPE_CHECKING:
    from rich.table import Table

State = Literal['ok', 'absent', 'broken']
#: Below this much free shared memory Fast DDS falls back or fails [bytes]; Docker gives 64 MiB.
_LEAST_SHARED_MEMORY = 32 * 2**20
_PROBE_TIMEOUT = 30.0  # [s] of wall time
MESSAGES = (
    'builtin_interfaces', 'diagnostic_msgs', 'geometry_msgs', 'lifecycle_msgs', 'nav_msgs',
    'rcl_interfaces', 'rosgraph_msgs', 'sensor_msgs', 'std_msgs', 'std_srvs', 'visualization_msgs',
)  # fmt: skip
EXTRAS = {
    'charts': 'matplotlib', 'record': 'mcap', 'mavlink': 'pymavlink', 'sweep': 'ray',
    'warp': 'mujoco-warp',
}  # fmt: skip
TOOLS = {'ruff': 'ruff', 'mypy': 'mypy', 'clang-format': 'clang-format', 'colcon': 'colcon-core'}


@dataclass(frozen=True)
class Row:
    """
    One check.

    Attributes
    ----------
    name
        What was looked at.
    state
        ``ok``; ``absent``: not there, needed by some tasks only; ``broken``: must be mended.
    found
        What is there.
    remedy
        What to do or type, empty when nothing is wrong.

    """

    name: str
    state: State
    found: str
    remedy: str = ''

    def as_dict(self) -> dict[str, str]:
        """Return the row for JSON."""
        return asdict(self)


def examine() -> list[Row]:
    """
    Run every check.

    Returns
    -------
    rows
        In the order of the table.

    """
    base = [_python(), _mujoco(), _plugin_library(), _data(), _compiler()]
    rclpy = _ros()
    ros = [rclpy, _messages(), _domain(rclpy.state), _discovery(), _shared_memory()]
    return base + ros + [_rendering(), *map(_extra, EXTRAS), _test_tools(), _developer_tools()]


def works(rows: Sequence[Row]) -> bool:
    """
    Return whether nothing is broken; what is merely absent does not count.

    Parameters
    ----------
    rows
        Of ``examine``.

    """
    return all(row.state != 'broken' for row in rows)


def table(rows: Sequence[Row]) -> 'Table':
    """
    Return the rows as a table for the terminal.

    Parameters
    ----------
    rows
        Of ``examine``.

    """
    from rich.markup import escape
    from rich.table import Column, Table

    colours = {'ok': 'green', 'absent': 'yellow', 'broken': 'red'}
    headers = [Column(name, overflow='fold') for name in ('part', 'state', 'found', 'what to do')]
    result = Table(*headers, title='fluid_sim doctor')
    for row in rows:
        state = f'[{colours[row.state]}]{row.state}[/]'
        result.add_row(row.name, state, escape(row.found), escape(row.remedy))
    return result


def _install(extra: str) -> str:
    """Return what to type for an extra, in a source tree or an installed package."""
    source = Path(__file__).resolve().parents[2]
    python, target = sys.executable, f"'fluid_sim_ros[{extra}]'"
    if (source / 'setup.py').exists():
        target = f"-e '{source}[{extra}]'"
        if Path.cwd() == source and Path(python).is_relative_to(source):
            python, target = str(Path(python).relative_to(source)), f"-e '.[{extra}]'"
    return f'{shlex.quote(python)} -m pip install {target}'


def _version(distribution: str) -> str:
    """Return an installed distribution's version, or nothing."""
    try:
        return metadata.version(distribution)
    except metadata.PackageNotFoundError:
        return ''


def _python() -> Row:
    found = '.'.join(map(str, sys.version_info[:3]))
    if sys.version_info[:2] in ((3, 11), (3, 12)):
        return Row('Python', 'ok', found)
    return Row('Python', 'broken', found, 'use Python 3.11 or 3.12')


def _mujoco() -> Row:
    found = _version('mujoco')
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


def _ros() -> Row:
    name = 'ROS 2'
    if util.find_spec('rclpy') is None:
        remedy = f'source a ROS 2 Jazzy, or type: {_install("ros")}'
        return Row(name, 'absent', 'no rclpy', remedy)
    script = 'import rclpy; print(rclpy.__file__, rclpy.get_rmw_implementation_identifier())'
    answer, fault = _probe(script)
    if fault:
        remedy = 'unset RMW_IMPLEMENTATION, or install the middleware that it names'
        return Row(name, 'broken', f'rclpy does not load: {fault}', remedy)
    file, middleware = answer.rsplit(maxsplit=1)
    distribution = os.environ.get('ROS_DISTRO', '')
    origin = f'ROS 2 {distribution} install' if _is_ros_install(file) else 'pip wheels'
    return Row(name, 'ok', f'rclpy {_version("rclpy")} ({origin}), {middleware}')


def _is_ros_install(file: str) -> bool:
    prefixes = os.environ.get('AMENT_PREFIX_PATH', '').split(os.pathsep)
    return any(prefix and file.startswith(prefix + os.sep) for prefix in prefixes)


def _messages() -> Row:
    missing = [package for package in MESSAGES if util.find_spec(package) is None]
    if missing:
        remedy = f'apt-get install ros-jazzy-common-interfaces, or type: {_install("ros")}'
        return Row('ROS messages', 'absent', f'missing: {listed(missing)}', remedy)
    return Row('ROS messages', 'ok', f'{len(MESSAGES)} packages')


def _domain(rclpy: State) -> Row:
    name = 'ROS_DOMAIN_ID'
    value = os.environ.get(name, '')
    if rclpy != 'ok':  # the check comes with the node, and a broken rclpy ends the process
        return Row(name, 'absent', value or 'not set', 'first mend ROS 2')
    from fluid_sim_ros.ros.preflight import check_domain

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


def _rendering() -> Row:
    name = 'rendering (EGL)'
    script = 'import mujoco; mujoco.GLContext(64, 64).make_current()'
    _, fault = _probe(script, MUJOCO_GL='egl', PYOPENGL_PLATFORM='egl')
    if fault:
        return Row(name, 'absent', fault, 'apt-get install libegl1 libgl1-mesa-dri')
    return Row(name, 'ok', 'a context without a display was made')


def _extra(extra: str) -> Row:
    distribution = EXTRAS[extra]
    found = _version(distribution)
    if not found:
        return Row(f'extra {extra}', 'absent', f'no {distribution}', _install(extra))
    return Row(f'extra {extra}', 'ok', f'{distribution} {found}')


def _test_tools() -> Row:
    found = _version('pytest')
    if not found:
        return Row('tests', 'absent', 'no pytest', f'make test, or type: {_install("test")}')
    return Row('tests', 'ok', f'pytest {found}')


def _developer_tools() -> Row:
    missing = [tool for tool, distribution in TOOLS.items() if not _version(distribution)]
    if missing:
        remedy = f'make lint, or type: {_install("dev")}'
        return Row('developer tools', 'absent', f'missing: {listed(missing)}', remedy)
    return Row('developer tools', 'ok', listed(TOOLS))


def _probe(script: str, **environment: str) -> tuple[str, str]:
    """Run a script in a Python of its own; return its output and, if it failed, one line why."""
    try:
        done = subprocess.run(
            [sys.executable, '-c', script], env={**os.environ, **environment},
            capture_output=True, text=True, timeout=_PROBE_TIMEOUT, check=False,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return '', f'no answer in {_PROBE_TIMEOUT:g} s'
    if done.returncode:
        lines = done.stderr.strip().splitlines() or [f'the process ended with {done.returncode}']
        return '', ' '.join(lines[-1].split())[:200]
    return done.stdout.strip(), ''
