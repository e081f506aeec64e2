# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A wheel serves each Python and machine: no compiler, all data, no path of its builder."""

import subprocess
import sys
import tarfile
import zipfile

import pytest

from test.support.paths import ROOT

check_wheel = pytest.importorskip('check_wheel', reason='needs auditwheel, as make wheel has')
NAME = 'fluid_sim_ros-1.2.3-py3-none-manylinux_2_28_x86_64.whl'
DATA = 'fluid_sim_ros-1.2.3.data/data/share/fluid_sim_ros'


def write(path, files):
    with zipfile.ZipFile(path, 'w') as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return path


def test_a_file_that_is_missing_is_found(tmp_path):
    wheel = write(tmp_path / NAME, {f'{DATA}/models/rov.xml': '', 'fluid_sim_ros/a.py': ''})
    wanted = {'models/rov.xml', 'models/x500.xml', 'fluid_sim_ros/a.py'}
    assert check_wheel.faults(wheel, wanted) == ['models/x500.xml is missing']


def test_a_copy_of_mujoco_is_found(tmp_path):
    wheel = write(tmp_path / NAME, {'fluid_sim_ros.libs/libmujoco-1a2b.so.4.0.0': ''})
    (line,) = check_wheel.faults(wheel, set())
    assert line == 'fluid_sim_ros.libs/libmujoco-1a2b.so.4.0.0 does not belong there'


@pytest.mark.parametrize('tag', ['cp311-cp311-manylinux_2_28_x86_64', 'py3-none-linux_x86_64'])
def test_a_wheel_for_one_python_or_one_machine_is_found(tmp_path, tag):
    wheel = write(tmp_path / f'fluid_sim_ros-1.2.3-{tag}.whl', {})
    (line,) = check_wheel.faults(wheel, set())
    assert line.endswith('the tag is not py3-none-manylinux')


def test_a_library_with_a_path_of_its_builder_is_found():
    # the library of the source tree holds the place of this MuJoCo
    content = (ROOT / check_wheel.LIBRARY).read_bytes()
    (line,) = check_wheel.library_faults(content)
    assert 'looks for libraries in' in line


def test_a_wheel_holds_models_configuration_and_launch_files():
    wanted = check_wheel.expected()
    for name in ('models/rov.xml', 'launch/fluid_sim.launch.py', 'fluid_sim_ros/py.typed'):
        assert name in wanted, name
    assert not any(name.endswith(('.cc', '.h')) for name in wanted)


def test_the_source_archive_holds_what_the_wheel_is_made_of(tmp_path):
    subprocess.run(
        [sys.executable, 'setup.py', '-q', 'egg_info', '--egg-base', tmp_path,
         'sdist', '--dist-dir', tmp_path],
        cwd=ROOT, check=True, capture_output=True,
    )  # fmt: skip
    (archive,) = tmp_path.glob('*.tar.gz')
    with tarfile.open(archive) as opened:
        names = {name.partition('/')[2] for name in opened.getnames()}
    wanted = check_wheel.expected() - {check_wheel.LIBRARY}
    assert sorted(wanted - names) == []
    sources = subprocess.run(
        ['git', 'ls-files', check_wheel.SOURCES], cwd=ROOT, capture_output=True, text=True,
        check=True,
    ).stdout.split()  # fmt: skip
    assert sorted({name for name in sources if name.endswith(('.cc', '.h'))} - names) == []
    assert {'setup.py', 'pyproject.toml', 'LICENSE', 'README.md', 'package.xml'} <= names
