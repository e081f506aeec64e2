# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The optional parts: what each extra brings, and what to type for it."""

import shlex
import sys
from pathlib import Path
from typing import NamedTuple

from fluid_sim_ros.cli.doctor.row import Row, version
from fluid_sim_ros.errors import listed


class Part(NamedTuple):
    """One extra: the distributions that it installs, and what they are for."""

    distributions: tuple[str, ...]
    brings: str


#: Every extra of setup.py.
EXTRAS = {
    'ros': Part(('ros-jazzy-rclpy', 'ros-jazzy-common-interfaces'), 'the node, from pip'),
    'charts': Part(('matplotlib',), 'plot, chart, stability and advise'),
    'record': Part(('mcap', 'zstandard'), '--record, and the commands that read a log'),
    'flights': Part(
        ('pyulog', 'rosbags', 'pymavlink'), 'info, compare and fit of logs of other software'
    ),
    'render': Part(('imageio-ffmpeg', 'pillow'), 'render: a log as a film'),
    'view': Part(('viser',), 'view: a scene, a log or a node in the browser'),
    'foxglove': Part(('foxglove-sdk',), 'run --foxglove: live to Foxglove and Lichtblick'),
    'mavlink': Part(('pymavlink',), '--autopilot px4'),
    'parquet': Part(('pyarrow',), 'sweep on threads, and export --parquet'),
    'sweep': Part(('pyarrow', 'ray'), 'sweep --ray, on processes or a cluster'),
    'hydro': Part(
        ('capytaine', 'trimesh', 'manifold3d', 'fast-simplification', 'xacro'),
        'hydro and import: meshes and URDF',
    ),
    'warp': Part(('mujoco-warp', 'warp-lang', 'pyarrow'), 'sweep --device'),
    'all': Part(
        ('matplotlib', 'mcap', 'imageio-ffmpeg', 'pymavlink', 'pyarrow', 'ray'),
        'all of the above but warp, at once',
    ),
    'test': Part(('pytest', 'hypothesis'), 'the tests (make test)'),
    'peers': Part(('jsbsim', 'rotorpy'), 'other simulators, for one benchmark'),
    'dev': Part(('ruff', 'mypy', 'clang-format', 'colcon-core'), 'make lint, and colcon'),
    'docs': Part(('sphinx', 'myst-parser', 'furo'), 'make site: the documentation as HTML'),
    'coverage': Part(('pytest-cov', 'coverage', 'gcovr'), 'make coverage'),
}


def optional_parts() -> list[Row]:
    """Return what is there of each optional part."""
    return [_extra(name, part) for name, part in EXTRAS.items() if name != 'ros']


def install(extra: str) -> str:
    """
    Return what to type for an extra, in a source tree or an installed package.

    Parameters
    ----------
    extra
        Its name in setup.py.

    """
    source = Path(__file__).resolve().parents[3]
    python, target = sys.executable, f"'fluid_sim_ros[{extra}]'"
    if (source / 'setup.py').exists():
        target = f"-e '{source}[{extra}]'"
        if Path.cwd() == source and Path(python).is_relative_to(source):
            python, target = str(Path(python).relative_to(source)), f"-e '.[{extra}]'"
    return f'{shlex.quote(python)} -m pip install {target}'


def _extra(name: str, part: Part) -> Row:
    missing = [distribution for distribution in part.distributions if not version(distribution)]
    if missing:
        return Row(
            f'extra {name}', 'absent', f'no {listed(missing)}: {part.brings}', install(name)
        )
    found = listed(f'{each} {version(each)}' for each in part.distributions)
    return Row(f'extra {name}', 'ok', f'{part.brings} ({found})')
