# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The set-up and the build end with one clear line when something is missing."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def build_library(tmp_path, **environment):
    """Build the plugin library into a scratch folder; return exit code and error lines."""
    done = subprocess.run(
        [sys.executable, 'setup.py', '-q', 'build_ext',
         '--build-lib', str(tmp_path / 'lib'), '--build-temp', str(tmp_path / 'temp')],
        cwd=ROOT, capture_output=True, text=True, check=False, timeout=120,
        env={**os.environ, **environment},
    )  # fmt: skip
    return done.returncode, done.stderr.strip().splitlines()


def test_no_compiler(tmp_path):
    code, lines = build_library(tmp_path, PATH=str(tmp_path), CXX='')
    assert code != 0
    assert lines == [
        'fluid_sim_ros: no C++17 compiler found (tried: c++, g++, clang++); '
        'install one (Debian, Ubuntu: apt-get install g++) or set CXX'
    ]


def test_a_compiler_without_cxx17(tmp_path):
    code, lines = build_library(tmp_path, CXX='false --old')
    assert code != 0
    assert len(lines) == 1
    assert 'tried: false --old' in lines[0]


def test_another_mujoco_version(tmp_path):
    (tmp_path / 'mujoco').mkdir()
    (tmp_path / 'mujoco' / '__init__.py').touch()
    metadata = tmp_path / 'mujoco-3.2.0.dist-info' / 'METADATA'
    metadata.parent.mkdir()
    metadata.write_text('Metadata-Version: 2.1\nName: mujoco\nVersion: 3.2.0\n')

    code, lines = build_library(tmp_path, PYTHONPATH=str(tmp_path))

    assert code != 0
    assert len(lines) == 1
    assert 'mujoco 3.2.0 is installed, but this release needs 4.0.0' in lines[0]
    assert lines[0].endswith('-m pip install mujoco==4.0.0')


@pytest.fixture
def checkout(tmp_path):
    """Return a folder with what the set-up script reads, and no .venv."""
    (tmp_path / '.ci').mkdir()
    for name in ('.ci/venv', 'setup.py', 'pyproject.toml'):
        shutil.copy(ROOT / name, tmp_path / name)
    return tmp_path


def set_up(checkout, group='demo', **environment):
    """Run the set-up script without any ROS of this shell; return exit code and error lines."""
    kept = {
        key: value for key, value in os.environ.items()
        if key not in ('ROS_DISTRO', 'AMENT_PREFIX_PATH', 'PYTHON', 'CXX')
    }  # fmt: skip
    done = subprocess.run(
        [checkout / '.ci' / 'venv', group],
        capture_output=True, text=True, check=False, timeout=60, env={**kept, **environment},
    )  # fmt: skip
    return done.returncode, done.stderr.strip().splitlines()


@pytest.fixture
def python_3_10(tmp_path):
    """Return a command that answers as Python 3.10 would."""
    command = tmp_path / 'python3.10'
    command.write_text('#!/bin/sh\necho 3.10\n')
    command.chmod(0o755)
    return str(command)


def test_set_up_with_an_unsupported_python(checkout, python_3_10):
    code, lines = set_up(checkout, PYTHON=python_3_10)
    assert code != 0
    assert lines == [
        f'setup: error: Python 3.11, 3.12 or 3.13 is needed, but {python_3_10} is 3.10; '
        'type: make PYTHON=/path/to/python3.12 ...'
    ]


def test_set_up_without_a_compiler(checkout):
    code, lines = set_up(checkout, PYTHON=sys.executable, CXX='no-such-compiler')
    assert code != 0
    assert lines == [
        'setup: error: no C++17 compiler found (tried: no-such-compiler); '
        'type: apt-get install g++'
    ]


def test_set_up_beside_another_ros(checkout):
    code, lines = set_up(checkout, ROS_DISTRO='humble', AMENT_PREFIX_PATH='/opt/ros/humble')
    assert code != 0
    assert len(lines) == 1
    assert lines[0].startswith('setup: error: ROS 2 humble is sourced, but jazzy is needed')


def test_set_up_with_ros_needs_its_python(checkout):
    python = checkout / 'python3.11'
    python.write_text('#!/bin/sh\necho 3.11\n')
    python.chmod(0o755)
    code, lines = set_up(
        checkout, PYTHON=str(python), ROS_DISTRO='jazzy', AMENT_PREFIX_PATH='/opt/ros/jazzy'
    )
    assert code != 0
    assert len(lines) == 1
    assert 'Python 3.12 (the Python of ROS 2 Jazzy) is needed' in lines[0]


def test_set_up_of_an_unknown_group(checkout):
    code, lines = set_up(checkout, 'everything')
    assert code != 0
    assert lines == [
        "setup: error: unknown group 'everything'; allowed: demo, test, bench, dev, docs, coverage"
    ]
