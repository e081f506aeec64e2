"""Package metadata and the build of the MuJoCo plugin library (pip and colcon both read this)."""

import os
import shutil
import subprocess
import sys
import tempfile
from glob import glob
from importlib import metadata, util
from pathlib import Path

from setuptools import Extension, find_packages, setup
from setuptools.command.build_ext import build_ext

PACKAGE = 'fluid_sim_ros'
MUJOCO_VERSION = '4.0.0'
PLUGIN_LIBRARY = f'{PACKAGE}.plugins.libfluid_sim'


def fail(line):
    """End the build with one clear line."""
    raise SystemExit(f'{PACKAGE}: {line}')


def mujoco_folder():
    """Return the folder of the installed mujoco wheel (headers and library)."""
    spec = util.find_spec('mujoco')
    if spec is None or not spec.submodule_search_locations:
        fail(f'mujoco is not installed here; type: {sys.executable} -m pip install mujoco=={MUJOCO_VERSION}')
    found = metadata.version('mujoco')
    if found != MUJOCO_VERSION:
        fail(f'mujoco {found} is installed, but this release is built for {MUJOCO_VERSION}; '
             f'type: {sys.executable} -m pip install mujoco=={MUJOCO_VERSION}')
    return Path(spec.submodule_search_locations[0])


def find_compiler():
    """Return the C++ compiler that handles C++17, or end with one line."""
    tried = [os.environ['CXX'].split()[0]] if os.environ.get('CXX') else ['c++', 'g++', 'clang++']
    for name in tried:
        path = shutil.which(name)
        if path is None:
            continue
        with tempfile.TemporaryDirectory() as folder:
            probe = Path(folder) / 'probe.cc'
            probe.write_text('#include <optional>\nstatic_assert(__cplusplus >= 201703L);\n')
            done = subprocess.run([path, '-std=c++17', '-fsyntax-only', str(probe)],
                                  capture_output=True, check=False)
        if done.returncode == 0:
            return path
    return fail(f'no C++17 compiler found (tried: {", ".join(tried)}); '
                'install one (Debian/Ubuntu: apt-get install g++) or set CXX')


class BuildPluginLibrary(build_ext):
    """Compile plugins/src/*.cc into a plain shared library (no Python module inside)."""

    def get_ext_filename(self, fullname):
        return str(Path(*fullname.split('.'))) + '.so'

    def get_export_symbols(self, ext):
        return ext.export_symbols

    def build_extension(self, ext):
        mujoco = mujoco_folder()
        library = mujoco / f'libmujoco.so.{MUJOCO_VERSION}'
        output = Path(self.get_ext_fullpath(ext.name))
        output.parent.mkdir(parents=True, exist_ok=True)
        command = [
            find_compiler(), '-std=c++17', '-O2', '-fPIC', '-shared', '-fvisibility=hidden',
            '-ffp-contract=off', '-Wall', '-Wextra', '-Wno-unused-parameter',
            f'-I{mujoco / "include"}', *sorted(ext.sources),
            str(library), f'-Wl,-rpath,{mujoco}', '-Wl,-rpath,$ORIGIN/../../mujoco',
            '-o', str(output),
        ]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            fail('the plugin library does not compile:\n' + done.stderr)


def data(folder):
    """Return (share folder, files) pairs for a folder and all below it."""
    pairs = {}
    for path in Path(folder).rglob('*'):
        if path.is_file() and '__pycache__' not in path.parts:
            pairs.setdefault(f'share/{PACKAGE}/{path.parent.as_posix()}', []).append(str(path))
    return sorted(pairs.items())


ROS = ['ros-jazzy-rclpy[fastrtps]>=7.1,<8', 'ros-jazzy-common-interfaces>=5.3,<6']
CHARTS = ['matplotlib>=3.8,<4']
TEST = ['pytest>=8,<10', 'pytest-timeout>=2.2,<3', 'pytest-xdist>=3.5,<4', 'hypothesis>=6.100,<7']

setup(
    name=PACKAGE,
    version='0.1.0',
    description='ROS 2 node that steps MuJoCo with fluid forces for aerial and underwater vehicles',
    long_description=Path('README.md').read_text(encoding='utf-8') if Path('README.md').exists() else '',
    long_description_content_type='text/markdown',
    maintainer='fluid_sim_ros maintainers',
    maintainer_email='fluid_sim_ros@example.com',
    license='Apache-2.0',
    python_requires='>=3.11,<3.13',
    packages=find_packages(include=[PACKAGE, f'{PACKAGE}.*']),
    package_data={PACKAGE: ['py.typed']},
    ext_modules=[Extension(PLUGIN_LIBRARY, glob(f'{PACKAGE}/plugins/src/*.cc'),
                           depends=glob(f'{PACKAGE}/plugins/src/*.h'))],
    cmdclass={'build_ext': BuildPluginLibrary},
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{PACKAGE}']),
        (f'share/{PACKAGE}', ['package.xml']),
        *data('config'), *data('models'), *data('launch'),
    ],
    install_requires=[
        f'mujoco=={MUJOCO_VERSION}',
        'numpy>=1.26,<3',
        'scipy>=1.11,<2',
        'pydantic>=2.7,<3',
        'PyYAML>=6.0,<7',
        'rich>=13.7,<16',
    ],
    extras_require={
        'ros': ROS,
        'mavlink': ['pymavlink>=2.4.41,<3'],
        'record': ['mcap>=1.2,<2'],
        'charts': CHARTS,
        'test': [*TEST, *CHARTS],
        'dev': ['ruff>=0.6,<1', 'mypy>=1.11,<3', 'clang-format>=18,<23', 'colcon-common-extensions'],
    },
    entry_points={
        'console_scripts': [
            'fluid_sim = fluid_sim_ros.cli:main',
            'fluid_sim_node = fluid_sim_ros.ros.node:main',
            'quad_controller = fluid_sim_ros.ros.quad_controller:main',
            'rov_controller = fluid_sim_ros.ros.rov_controller:main',
        ],
    },
    zip_safe=False,
)
