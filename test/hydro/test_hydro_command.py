# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``fluid_sim hydro``: what it writes, what it refuses, and that its keys fly."""

import json

import mujoco
import numpy as np
import pytest
import yaml

from fluid_sim_ros import Simulation
from fluid_sim_ros.cli import main
from fluid_sim_ros.hydro.meshes.shapes import box, ellipsoid, write_obj, write_stl
from fluid_sim_ros.physics.matrix6 import shift_reference_point

pytest.importorskip('capytaine')
BODY = """<mujoco>
  <option integrator="RK4" timestep="0.002"/>
  <extension><plugin plugin="fluid_sim.body"/>
    <plugin plugin="fluid_sim.medium"><instance name="water">
      <config key="density" value="1000"/><config key="viscosity" value="1e-3"/>
    </instance></plugin></extension>
  <worldbody><body name="hull" simple="false"><freejoint/>
    <inertial pos="0.1 0 0" mass="20" diaginertia="1 2 3"/>
    {plugin}
  </body></worldbody>
</mujoco>
"""


@pytest.fixture(scope='module')
def made(tmp_path_factory):
    """Return what the command wrote about an ellipsoid, about a point beside its centre."""
    folder = tmp_path_factory.mktemp('hydro')
    mesh = ellipsoid((0.5, 0.2, 0.1), 2)
    write_stl(type(mesh)(mesh.vertices + np.array([0.3, 0, 0.1]), mesh.faces), folder / 'hull.stl')
    code = main([
        'hydro', str(folder / 'hull.stl'), '--density', '1000', '--about', '.1', '0', '0',
        '--mass', '45', '--center-of-mass', '.3', '0', '.05', '--thrust', '50', '--panels', '150',
        '--json', str(folder / 'hull.json'), '--report', str(folder / 'report'),
    ])  # fmt: skip
    assert code == 0
    return folder, json.loads((folder / 'hull.json').read_text())


def test_the_json_has_what_a_program_needs(made):
    _, found = made
    volume = found['volume']
    assert volume == pytest.approx(4 / 3 * np.pi * 0.01, rel=0.05)
    np.testing.assert_allclose(found['center_of_buoyancy'], [0.3, 0, 0.1], atol=1e-6)
    assert found['reference_point'] == [0.1, 0, 0]
    matrix, error = np.array(found['added_mass']), found['estimated_errors']
    assert matrix.shape == np.array(error['added_mass']).shape == (6, 6)
    np.testing.assert_array_equal(matrix, matrix.T)
    assert np.linalg.eigvalsh(matrix)[0] > 0
    center = shift_reference_point(matrix, [0.2, 0, 0.1])
    assert center[2, 2] / (1000 * volume) == pytest.approx(1.625, rel=0.03)
    assert abs(center[2, 4]) < 1e-3 * abs(matrix[2, 4])
    assert found['righting']['net_buoyancy'] == pytest.approx(9.81 * (1000 * volume - 45))
    assert found['righting']['pitch_deg'] == pytest.approx(0, abs=1e-4)
    assert len(found['damping']['top_speed']) == 3
    assert found['damping']['axes'][0]['source']


def test_the_report_has_a_picture_and_the_keys(made):
    folder, found = made
    page = (folder / 'report' / 'hull.md').read_text()
    assert (folder / 'report' / 'hull.png').read_bytes()[:4] == b'\x89PNG'
    assert '![Mesh, centre of buoyancy and coefficients](hull.png)' in page
    for value in found['keys'].values():
        assert value.split(' ')[0] in page


def test_the_keys_load_and_the_plugin_applies_that_added_mass(made):
    folder, found = made
    page = (folder / 'report' / 'hull.md').read_text()
    plugin = page.split('```xml')[1].split('```')[0]
    model = folder / 'hull.xml'
    model.write_text(BODY.format(plugin=plugin))
    simulation = Simulation(model)
    dense = np.zeros((6, 6))
    mujoco.mj_forward(simulation.model, simulation.data)
    mujoco.mj_fullM(simulation.model, simulation.data, dense)
    rigid = mujoco.MjModel.from_xml_string(BODY.format(plugin=''))
    plain, alone = mujoco.MjData(rigid), np.zeros((6, 6))
    mujoco.mj_forward(rigid, plain)
    mujoco.mj_fullM(rigid, plain, alone)
    # at the identity the free joint's axes are those of the body, about its origin
    expected = shift_reference_point(found['added_mass'], -np.array(found['reference_point']))
    np.testing.assert_allclose(dense - alone, expected, rtol=1e-9, atol=1e-9 * dense.max())
    simulation.step(500)
    assert np.isfinite(simulation.data.qpos).all()
    # 45 kg of buoyancy against 20 kg: it rises, at no more than the damping allows
    assert 0.1 < simulation.data.qvel[2] < 3


def test_the_keys_fly_in_a_scene(made, tmp_path):
    folder, _ = made
    page = (folder / 'report' / 'hull.md').read_text()
    (tmp_path / 'hull.xml').write_text(BODY.format(plugin=page.split('```xml')[1].split('```')[0]))
    (tmp_path / 'hull_vehicle.yaml').write_text(
        'body: hull\nthrusters: []\njoints: []\nsource: t\n'
    )
    (tmp_path / 'hull.yaml').write_text(yaml.safe_dump({
        'model': 'hull.xml', 'description': 'hull', 'medium': 'water',
        'vehicles': {'hull': 'hull_vehicle.yaml'}, 'duration': 0.1,
    }))  # fmt: skip
    assert main(['run', str(tmp_path / 'hull.yaml'), '--json', str(tmp_path / 'run.json')]) == 0


def refusal(capsys, *words):
    assert main(['hydro', *map(str, words)]) == 2
    text = capsys.readouterr().err
    assert text.startswith('fluid_sim: ')
    assert text.count('\n') == 1
    return text


@pytest.mark.parametrize(
    ('options', 'words'),
    [
        (['--density', '0'], '--density'),
        (['--density', '-1000'], '--density'),
        (['--density', 'nan'], '--density'),
        (['--density', '1000', '--viscosity', '0'], '--viscosity'),
        (['--density', '1000', '--about', '0', 'inf', '0'], '--about'),
        (['--density', '1000', '--mass', '-3'], '--mass'),
        (['--density', '1000', '--center-of-mass', '0', '0', '0'], 'goes with --mass'),
        (['--density', '1000', '--drag', '1', '0', '1'], '--drag'),
        (['--density', '1000', '--panels', '5'], '--panels 5: must be 20 to 2500'),
        (['--density', '1000', '--panels', '100000'], '--panels 100000'),
        (['--density', '1000', '--speed', '0'], '--speed'),
    ],
)
def test_numbers_that_are_impossible_are_refused_before_the_mesh_is_read(options, words, capsys):
    assert words in refusal(capsys, 'no_such.stl', *options)


def test_a_mass_that_does_not_fit_the_size_asks_for_the_unit(tmp_path, capsys):
    write_obj(box((20, 10, 8)), tmp_path / 'box.obj')  # 20 mm, taken as metres
    text = refusal(capsys, tmp_path / 'box.obj', '--density', 1000, '--mass', 1)
    assert 'lighter than any vehicle; is the unit of the mesh right' in text


def test_a_report_is_not_overwritten(made, capsys):
    folder, _ = made
    text = refusal(
        capsys, folder / 'hull.stl', '--density', 1000, '--panels', 20, '--report',
        folder / 'report',
    )  # fmt: skip
    assert 'exists; give another --report, or --force' in text
