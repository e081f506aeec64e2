# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``fluid_sim import``: what a URDF, an MJCF model and a mesh become, and what is asked."""

import json

import mujoco
import numpy as np
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.cli import main
from fluid_sim_ros.hydro.meshes.shapes import box, ellipsoid, write_obj, write_stl
from fluid_sim_ros.new_vehicle.importing.answers import answers_of
from fluid_sim_ros.new_vehicle.importing.vehicle import import_vehicle
from fluid_sim_ros.new_vehicle.importing.writing import write_imported
from fluid_sim_ros.resources import models_folder
from test.support.imported import (
    BOX,
    INERTIAL,
    ROV,
    SCREW,
    questions,
    refusal,
    rov,
    vehicle,
)

pytest.importorskip('capytaine')
EXAMPLES = models_folder() / 'examples'


def test_the_example_quadrotor_keeps_mass_frames_and_turn_and_hovers(tmp_path):
    answers = answers_of(EXAMPLES / 'small_quad_answers.yaml', {})
    made = import_vehicle(EXAMPLES / 'small_quad.urdf', answers, [], lambda line: None)
    written = write_imported(made, tmp_path)
    assert written.drift < 1e-6
    simulation = Simulation(written.scene)
    model, body = simulation.model, simulation.model.body('base_link')
    assert float(body.mass[0]) == pytest.approx(1.5)
    # base 1.3 kg at 0.01 m, four discs of 0.05 kg at 0.045 m
    center = (1.3 * 0.01 + 0.2 * 0.045) / 1.5
    np.testing.assert_allclose(body.ipos, [0, 0, center], atol=1e-9)
    discs = 0.2 * (0.17**2 + (0.045 - center) ** 2) + 4 * 1.3e-5
    roll = 0.0105 + 1.3 * (center - 0.01) ** 2 + discs
    turn = np.empty(9)
    mujoco.mju_quat2Mat(turn, body.iquat)
    axes = turn.reshape(3, 3)
    assert (axes @ np.diag(body.inertia) @ axes.T)[0, 0] == pytest.approx(roll, rel=1e-6)
    np.testing.assert_allclose(model.site('imu_link').pos, [0.02, 0, 0.03])
    (small_quad,) = simulation.vehicles.values()
    assert small_quad.thrusters == ('front_right', 'rear_left', 'front_left', 'rear_right')
    assert small_quad.sensors.imu.site == 'imu_link'
    keys = made.contents.fluid_keys
    # ahead: the body's face and the slanted arms outside of it, at least the face
    assert float(keys['quadratic_damping'].split()[0]) > 0.5 * 1.225 * 0.8 * 0.11 * 0.07


def test_a_submerged_box_has_the_coefficients_of_its_hull(tmp_path):
    made = vehicle(rov(tmp_path))
    written = write_imported(made, tmp_path / 'out')
    simulation = Simulation(written.scene)
    assert simulation.vehicles.keys() == {'my_rov'}
    assert made.buoyancy == pytest.approx(0, abs=1e-6)  # 0.03 m^3 of 30 kg
    assert written.drift < 1e-6
    thruster = made.contents.thrusters[0]
    np.testing.assert_allclose(thruster.direction, [1, 0, 0], atol=1e-9)
    np.testing.assert_allclose(thruster.position, [-0.3, 0, 0.02], atol=1e-9)
    simulation.set_thrust('my_rov', [10.0])
    simulation.step(1500)
    drag = float(made.contents.fluid_keys['quadratic_damping'].split()[0])
    linear = 0.1 * drag
    speed = (np.sqrt(linear**2 + 4 * drag * 10) - linear) / (2 * drag)
    assert 0.5 * speed < simulation.data.qvel[0] < speed
    diagonal = np.diag(made.hydro.added_mass.matrix)
    assert (diagonal > 0).all()
    assert diagonal[2] > diagonal[1] > diagonal[0]
    report = (tmp_path / 'out' / 'my_rov_report.md').read_text()
    assert 'hull: the collision geometry' in report
    assert (tmp_path / 'out' / 'my_rov_hydro.png').exists()


def test_what_is_undecided_is_asked_in_one_list(tmp_path, capsys):
    hinge = (
        '<link name="arm"/><joint name="elbow" '
        'type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 1 0"/>'
        '<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>'
    )
    path = rov(tmp_path, inertial='', more=hinge)
    asked = ' | '.join(questions(path, medium=None, thrusters=None))
    for words in ('medium:', 'joints shaft, elbow', 'mass:', 'thrusters:'):
        assert words in asked
    asked = ' | '.join(questions(path, mass=20.0, fixed=['elbow']))
    assert 'how the mass is spread' in asked
    assert main(['import', str(path), '--json', str(tmp_path / 'q.json')]) == 2
    assert len(json.loads((tmp_path / 'q.json').read_text())['questions']) == 4
    assert 'import again' in capsys.readouterr().out
    light = questions(rov(tmp_path, mass=10))
    assert 'displaces 30 kg and the vehicle has 10 kg' in light[0]
    assert vehicle(rov(tmp_path, mass=10), buoyancy='1.5').buoyancy == 1.5
    assert vehicle(rov(tmp_path, mass=10), buoyancy='hull').buoyancy == pytest.approx(9.81 * 20)
    silent = questions(rov(tmp_path), medium='air', thrusters=[SCREW | {'max_thrust': 400}])
    assert 'spin of screw' in silent[0]
    other = '</collision><visual><geometry><sphere radius="0.4"/></geometry></visual><collision>'
    path.write_text(path.read_text().replace('</collision>', other + BOX + '</collision>', 1))
    assert any('collision 30 l, visual' in line for line in questions(path, mass=20.0, even=True))


def test_mass_can_be_given_or_spread_over_the_hull(tmp_path):
    path = rov(tmp_path, inertial='')
    even = vehicle(path, body_density=1000.0).contents.mass
    assert even.mass == pytest.approx(30)
    expected = 30 / 12 * np.array([0.3**2 + 0.2**2, 0.5**2 + 0.2**2, 0.5**2 + 0.3**2])
    np.testing.assert_allclose(even.inertia, np.diag(expected), atol=1e-6)
    given = {'mass': 29.0, 'center_of_mass': [0.01, 0, -0.03], 'inertia': [0.3, 0.5, 0.6]}
    stated = vehicle(path, **given).contents.mass
    np.testing.assert_allclose(stated.center, [0.01, 0, -0.03])
    np.testing.assert_allclose(np.diag(stated.inertia), [0.3, 0.5, 0.6])
    scaled = vehicle(rov(tmp_path), mass=31.0).contents.mass
    np.testing.assert_allclose(np.diag(scaled.inertia), np.array([0.2, 0.3, 0.4]) * 31 / 30)


def test_fins_turn_with_their_joint(tmp_path):
    fin = (
        '<link name="rudder">' + INERTIAL.format(mass=0.1, ixx=0.2) + '</link><joint '
        'name="rudder_joint" type="revolute"><parent link="base"/><child link="rudder"/>'
        '<origin xyz="-0.3 0 0"/><axis xyz="0 0 1"/>'
        '<limit lower="-0.4" upper="0.4" effort="1" velocity="1"/></joint>'
    )
    path = rov(tmp_path, more=fin)
    fins = [{'link': 'rudder', 'span': 0.2, 'chord': 0.1, 'along': [0, 0, 1]}]
    made = vehicle(path, fins=fins)
    written = write_imported(made, tmp_path / 'out')
    simulation = Simulation(written.scene)
    (name,) = simulation.vehicles
    assert simulation.vehicles[name].joints == ('rudder_joint',)
    np.testing.assert_allclose(simulation.vehicles[name].joint_range, [[-0.4, 0.4]])
    assert any('guess, those of the REMUS 100' in line for line in made.said)
    simulation.set_thrust(name, [15.0])
    simulation.set_joints(name, [0.2])
    simulation.step(1000)
    assert simulation.data.joint('rudder_joint').qpos[0] == pytest.approx(0.2, abs=0.03)
    assert abs(simulation.data.qvel[5]) > 0.02


def test_a_mesh_of_millimetres_is_asked_about_by_size_and_by_density(tmp_path):
    large, small = tmp_path / 'large.stl', tmp_path / 'small.obj'
    write_stl(box((500, 300, 200)), large)
    options = {'mass': 30.0, 'even': True, 'thrusters': 'vectored6'}
    assert 'in millimetres? give --unit mm' in refusal(large, **options)
    made = vehicle(large, unit='mm', **options)
    assert made.contents.mass.mass == 30
    assert made.hydro.statics.volume == pytest.approx(0.03, rel=1e-6)
    write_obj(box((20, 10, 8)), small)
    assert 'lighter than any vehicle; is it in millimetres?' in refusal(small, **options)


def test_meshes_are_found_in_the_package_and_nowhere_else(tmp_path):
    package = tmp_path / 'my_description'
    (package / 'urdf').mkdir(parents=True)
    (package / 'meshes').mkdir()
    (package / 'package.xml').write_text('<package><name>my_description</name></package>')
    write_obj(ellipsoid((250, 150, 100), 2), package / 'meshes' / 'hull.obj')

    def mesh(name):
        scale = 'scale="0.001 0.001 0.001"'
        return f'<geometry><mesh filename="{name}" {scale}/></geometry>'

    path = rov(
        package / 'urdf', mass=15, geometry=mesh('package://my_description/meshes/hull.obj')
    )
    made = vehicle(path)
    assert made.hydro.statics.size == pytest.approx([0.5, 0.3, 0.2], rel=0.06)
    assert vehicle(rov(package / 'urdf', mass=15, geometry=mesh('../meshes/hull.obj')))
    elsewhere = rov(tmp_path, mass=15, geometry=mesh('package://my_description/meshes/hull.obj'))
    assert vehicle(elsewhere, [tmp_path])
    assert vehicle(elsewhere, [package])
    (tmp_path / 'alone').mkdir()
    for name, words in (
        ('package://others/a.obj', "the package 'others' is not found; give --package-path"),
        ('package://my_description/meshes/none.obj', 'no such file'),
        ('../my_description/meshes/hull.obj', 'lies outside of'),
        ('package://my_description/../../secret.obj', 'lies outside of'),
        ('http://a.b/c.obj', 'http:// is not read; allowed: package://'),
    ):
        alone = rov(tmp_path / 'alone', geometry=mesh(name))
        packages = [package] if 'my_description' in name and '..' not in name[:2] else []
        assert words in refusal(alone, packages)


def test_a_xacro_is_expanded_with_its_own_files_only(tmp_path):
    text = ROV.format(
        inertial=INERTIAL.format(mass='${m}', ixx=0.2), geometry=BOX, more=''
    ).replace(
        '<robot name="my-rov">',
        '<robot name="my-rov" xmlns:xacro="http://ros.org/wiki/xacro">'
        '<xacro:include filename="part.xacro"/>',
    )  # fmt: skip
    path = tmp_path / 'rov.urdf.xacro'
    path.write_text(text)
    part = tmp_path / 'part.xacro'
    part.write_text(
        '<robot xmlns:xacro="http://ros.org/wiki/xacro">'
        '<xacro:property name="m" value="${20 + 10}"/></robot>'
    )
    assert vehicle(path).contents.mass.mass == 30
    part.write_text(part.read_text().replace('20 + 10', 'nothing'))
    assert 'rov.urdf.xacro: xacro: ' in refusal(path)
    folder = tmp_path / 'inner'
    folder.mkdir()
    (folder / 'rov.xacro').write_text(text.replace('part.xacro', '../part.xacro'))
    assert 'lies outside of' in refusal(folder / 'rov.xacro')


def test_an_mjcf_model_without_a_free_joint_gets_one(tmp_path):
    write_stl(ellipsoid((0.25, 0.15, 0.1), 2), tmp_path / 'hull.stl')
    path = tmp_path / 'model.xml'
    path.write_text(
        '<mujoco><asset><mesh name="hull" file="hull.stl"/></asset><worldbody>'
        '<body name="sub" pos="1 2 3"><geom type="mesh" mesh="hull" mass="15"/>'
        '<site name="jet" pos="-.2 0 0"/></body></worldbody></mujoco>'
    )
    thruster = {'name': 'jet', 'position': [-0.2, 0, 0], 'direction': [1, 0, 0], 'max_thrust': 9}
    made = vehicle(path, thrusters=[thruster])
    written = write_imported(made, tmp_path / 'out')
    model = Simulation(written.scene).model
    assert model.jnt_type[0] == mujoco.mjtJoint.mjJNT_FREE
    assert float(model.body('sub').mass[0]) == pytest.approx(15)
    np.testing.assert_allclose(model.site('jet').pos, [-0.2, 0, 0])
    path.write_text(path.read_text().replace('hull.stl', '../hull.stl'))
    assert "file '../hull.stl' lies outside of" in refusal(path, thrusters=[thruster])
