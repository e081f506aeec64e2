# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""GLB and DAE through ``fluid_sim import``: unit and up axis as they state them, with a word."""

import json

import numpy as np
import pytest

from fluid_sim_ros.cli import main
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.hydro.meshes.reading import read_mesh
from fluid_sim_ros.hydro.meshes.up_axis import stated_up
from fluid_sim_ros.hydro.statics import statics_of

trimesh = pytest.importorskip('trimesh')
pytest.importorskip('capytaine')
ASKED = (
    '--medium',
    'air',
    '--mass',
    '1.5',
    '--even',
    '--thrusters',
    'quad',
    '--max-thrust',
    '8',
)
#: Vehicle axes to those of a file with y up, and with x up.
TO_Y_UP = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])
TO_X_UP = np.array([[0, 0, 1], [-1, 0, 0], [0, -1, 0]])


def hull(turn=None, scale=1.0):
    """Return a body with a different size, and a different centre, along each axis."""
    parts = [
        trimesh.creation.box((0.6, 0.4, 0.2)),
        trimesh.creation.box((0.2, 0.1, 0.1), trimesh.transformations.translation_matrix(
            (0.3, 0.05, 0.12))),
    ]  # fmt: skip
    mesh = trimesh.boolean.union(parts)
    if turn is not None:
        mesh.apply_transform(
            np.block([[turn, np.zeros((3, 1))], [np.zeros((1, 3)), np.ones((1, 1))]])
        )
    mesh.apply_scale(scale)
    return mesh


def imported(path, tmp_path, *options):
    out, report = tmp_path / 'out', tmp_path / 'report.json'
    code = main(['import', str(path), *ASKED, '--out', str(out), '--force', '--json', str(report),
                 *options])  # fmt: skip
    assert code == 0
    return json.loads(report.read_text())


def center(path, up='file'):
    """Return the centre of the volume that is read [m]."""
    return statics_of(read_mesh(path, up=up).solid).center


@pytest.fixture(scope='module')
def expected(tmp_path_factory):
    """Return the centre that a file with z up in metres gives [m]."""
    path = tmp_path_factory.mktemp('stl') / 'hull.stl'
    hull().export(path)
    return center(path)


def dae(path, mesh, up, unit):
    mesh.export(path)
    text = path.read_text()
    stated = f'<unit name="x" meter="{unit}"/>' if unit else ''
    found = '<up_axis>Y_UP</up_axis>'
    assert found in text
    path.write_text(text.replace(found, stated + (f'<up_axis>{up}</up_axis>' if up else '')))


def test_a_glb_with_y_up_becomes_a_vehicle_with_z_up(tmp_path, expected):
    hull(TO_Y_UP).export(tmp_path / 'hull.glb')
    made = imported(tmp_path / 'hull.glb', tmp_path)
    written = trimesh.load(tmp_path / 'out' / 'assets' / 'hull.stl')
    np.testing.assert_allclose(written.center_mass, expected, atol=1e-6)
    assert any('glTF has y up: turned so that z is up; x stays' in line for line in made['said'])


def test_a_glb_whose_writer_left_z_up_is_taken_as_it_is(tmp_path, expected):
    hull().export(tmp_path / 'hull.glb')
    np.testing.assert_allclose(center(tmp_path / 'hull.glb', 'z'), expected, atol=1e-6)


@pytest.mark.parametrize(
    ('turn', 'up', 'unit', 'scale'),
    [(TO_Y_UP, 'Y_UP', 0.01, 100), (TO_X_UP, 'X_UP', 0.001, 1000), (None, 'Z_UP', None, 1)],
)
def test_a_dae_is_scaled_and_turned_as_it_states(tmp_path, expected, turn, up, unit, scale):
    dae(tmp_path / 'hull.dae', hull(turn, scale), up, unit)
    file = read_mesh(tmp_path / 'hull.dae', up='file')
    np.testing.assert_allclose(statics_of(file.solid).center, expected, atol=1e-6)
    assert ('as the file says' in file.unit) == bool(unit)
    assert any('turned so that z is up' in line for line in file.repairs) == (up != 'Z_UP')


def test_a_dae_without_an_up_axis_keeps_its_axes(tmp_path):
    dae(tmp_path / 'hull.dae', hull(), None, None)
    assert stated_up(tmp_path / 'hull.dae') == ''
    assert read_mesh(tmp_path / 'hull.dae', up='file').repairs == ()


def test_hydro_keeps_the_axes_of_the_file_and_says_so(tmp_path):
    hull(TO_Y_UP).export(tmp_path / 'hull.glb')
    kept, turned = (read_mesh(tmp_path / 'hull.glb', up=up) for up in ('keep', 'file'))
    assert kept.repairs == ('glTF has y up: its axes are kept (--up file turns it)',)
    np.testing.assert_allclose(
        kept.solid.in_mesh_axes().size(), turned.solid.in_mesh_axes().size()[[0, 2, 1]]
    )
    with pytest.raises(ConfigError, match="up 'sideways': unknown; allowed: keep, file, x, y, z"):
        read_mesh(tmp_path / 'hull.glb', up='sideways')
