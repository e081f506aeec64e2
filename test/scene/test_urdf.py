# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A vehicle's URDF, read by MuJoCo's URDF reader and by urdf_parser_py: nothing has moved."""

import mujoco
import numpy as np
import pytest
import trimesh

from fluid_sim_ros import Simulation, scene_names
from fluid_sim_ros.messages.description_topics import descriptions
from fluid_sim_ros.messages.state_topics import DEFAULTS, StateTopics
from fluid_sim_ros.scene.robot.links import joint_name, vehicle_links
from fluid_sim_ros.scene.robot.urdf import robot_description
from test.scene.test_links import ARM, random_positions
from test.support.urdf_links import by_mujoco, by_urdf_parser

#: Fleets of one kind of vehicle, and weather, add nothing that the others do not have.
SCENES = [s for s in scene_names() if s not in ('fleet_swarm', 'fleet_x500')]


def described(simulation, name):
    """Return the robot description of a vehicle without sensors."""
    read_spec = simulation.scene.read_model
    return robot_description(simulation.model, read_spec, simulation.vehicles[name])


def positions_of(model, data, vehicle, links):
    """Return the position of each joint by its name."""
    found = {}
    for link in links:
        if link.joint_id >= 0:
            start = model.jnt_qposadr[link.joint_id]
            ball = model.jnt_type[link.joint_id] == mujoco.mjtJoint.mjJNT_BALL
            value = data.qpos[start : start + 4].copy() if ball else float(data.qpos[start])
            found[joint_name(model, link.joint_id, vehicle)] = value
    return found


def check_links(simulation, mujoco_reads=True):
    """Compare the places of all links, by each reader, with those of MuJoCo's bodies."""
    model, rng = simulation.model, np.random.default_rng(3)
    data = mujoco.MjData(model)
    data.qpos[:] = random_positions(model, rng)
    mujoco.mj_kinematics(model, data)
    for name, vehicle in simulation.vehicles.items():
        links = vehicle_links(model, vehicle)
        urdf = described(simulation, name).urdf
        positions = positions_of(model, data, vehicle, links)
        found = [by_urdf_parser(urdf, positions)[1]]
        if mujoco_reads:
            reread, moved = by_mujoco(urdf, positions)
            found.append(moved)
        base_w = data.xpos[vehicle.body_id]
        rotation_wb = data.xmat[vehicle.body_id].reshape(3, 3)
        for link in links:
            if link.body_id < 0:
                continue
            turn_wl = data.xmat[link.body_id].reshape(3, 3)
            place_b = rotation_wb.T @ (data.xpos[link.body_id] + turn_wl @ link.shift_b - base_w)
            for poses in found:
                place, turn = poses[f'{name}/{link.name}']
                assert place == pytest.approx(place_b, abs=1e-6)
                assert turn == pytest.approx(rotation_wb.T @ turn_wl, abs=1e-6)
            if mujoco_reads:
                assert_same_mass(model, link, reread, f'{name}/{link.name}')


def assert_same_mass(model, link, reread, name):
    """Mass, centre of mass and inertia about it, in the axes of the body."""
    mine, theirs = link.body_id, reread.body(name).id
    assert reread.body_mass[theirs] == pytest.approx(model.body_mass[mine], rel=1e-9)
    if not model.body_mass[mine]:
        return
    centre = reread.body_ipos[theirs] + link.shift_b
    assert centre == pytest.approx(model.body_ipos[mine], abs=1e-9)
    tensors = [
        turn @ np.diag(m.body_inertia[b]) @ turn.T
        for m, b in ((model, mine), (reread, theirs))
        for turn in [rotation_of(m.body_iquat[b])]
    ]
    assert tensors[1] == pytest.approx(tensors[0], rel=1e-6, abs=1e-9 * tensors[0].max())


def rotation_of(quat_wxyz):
    matrix = np.empty(9)
    mujoco.mju_quat2Mat(matrix, quat_wxyz)
    return matrix.reshape(3, 3)


@pytest.mark.parametrize('scene', SCENES)
def test_links_and_inertias_of_a_scene_survive(scene):
    check_links(Simulation(scene))


def test_links_with_any_joints_survive(tmp_path):
    path = tmp_path / 'arm.xml'
    path.write_text(ARM.replace('type="ball"', 'axis="0 1 1"'), encoding='utf-8')
    check_links(Simulation(path))
    path.write_text(ARM, encoding='utf-8')
    simulation = Simulation(path)
    check_links(simulation, mujoco_reads=False)  # of floating joints it reads those of roots alone
    (note,) = described(simulation, 'arm').notes
    assert note == "joint 'wrist' is a ball joint, which URDF lacks: floating, placed by /tf"
    assert note in described(simulation, 'arm').urdf


def test_geoms_are_where_they_were():
    """Each shape that MuJoCo reads again has a geom of ours at its place."""
    simulation = Simulation('aerosonde')
    model, vehicle = simulation.model, simulation.vehicles['aerosonde']
    reread, _ = by_mujoco(described(simulation, 'aerosonde').urdf, {})
    seen = [
        g for g in range(model.ngeom)
        if model.geom_bodyid[g] == vehicle.body_id and model.geom_group[g] <= 2
    ]  # fmt: skip
    body = reread.body('aerosonde/base_link').id
    theirs = {
        kind: np.array([
            reread.geom_pos[g] for g in range(reread.ngeom)
            if reread.geom_bodyid[g] == body and reread.geom_type[g] == kind
        ])
        for kind in set(reread.geom_type)
    }  # fmt: skip
    kinds = mujoco.mjtGeom
    as_urdf = {
        int(kinds.mjGEOM_ELLIPSOID): kinds.mjGEOM_MESH,
        int(kinds.mjGEOM_CAPSULE): kinds.mjGEOM_CYLINDER,
    }
    for geom in seen:
        kind = int(as_urdf.get(int(model.geom_type[geom]), model.geom_type[geom]))
        distances = np.linalg.norm(theirs[kind] - model.geom_pos[geom], axis=1)
        assert distances.min() < 1e-6, model.geom(geom)
    assert len(seen) > 10


def test_a_capsule_is_a_cylinder_with_two_spheres(tmp_path):
    simulation = model_of(tmp_path, '<geom type="capsule" size=".1 .4" euler="90 0 0"/>')
    robot, _ = by_urdf_parser(described(simulation, 'a').urdf, {})
    _, *shapes = robot.link_map['a/base_link'].visuals  # behind the sphere of every model here
    kinds = [type(shape.geometry).__name__ for shape in shapes]
    assert kinds == ['Cylinder', 'Sphere', 'Sphere']
    assert (shapes[0].geometry.radius, shapes[0].geometry.length) == (0.1, 0.8)
    assert [shape.origin.xyz[1] for shape in shapes] == pytest.approx([0, 0.4, -0.4])


def model_of(folder, geom, assets=''):
    path = folder / 'a.xml'
    path.write_text(
        f'<mujoco><asset>{assets}</asset><worldbody><body name="a"><freejoint/>'
        f'<geom size=".05" pos="0 0 .2"/>{geom}</body></worldbody></mujoco>'
    )
    return Simulation(path)


@pytest.fixture
def mesh_file(tmp_path):
    """Make a file of a body that is neither at its centre nor along its main axes."""
    made = trimesh.creation.box((0.1, 0.2, 0.3))
    made.apply_transform(trimesh.transformations.euler_matrix(0.3, 0.4, 0.5))
    made.apply_translation((0.5, 0.1, -0.2))
    (tmp_path / 'part.stl').write_bytes(made.export(file_type='stl'))
    return tmp_path / 'part.stl'


def test_a_mesh_is_named_by_its_file_and_stands_where_it_did(tmp_path, mesh_file):
    asset = '<mesh name="part" file="part.stl" scale="1 2 .5"/>'
    geom = '<geom type="mesh" mesh="part" pos="1 2 3" euler="10 20 30"/>'
    simulation = model_of(tmp_path, geom, asset)
    description = described(simulation, 'a')
    assert description.notes == ()
    robot, _ = by_urdf_parser(description.urdf, {})
    (mesh,) = [v for v in robot.link_map['a/base_link'].visuals if hasattr(v.geometry, 'scale')]
    assert mesh.geometry.filename == mesh_file.as_uri()
    assert mesh.geometry.scale == [1, 2, 0.5]
    # a viewer shows the vertices of the file, scaled, at the origin of the URDF
    reread, _ = by_mujoco(
        description.urdf.replace(mesh_file.as_uri(), 'part.stl'), {},
        {'part.stl': mesh_file.read_bytes()},
    )  # fmt: skip
    assert centre_of(reread) == pytest.approx(centre_of(simulation.model), abs=1e-6)
    vertices = np.asarray(trimesh.load(mesh_file).vertices) * mesh.geometry.scale
    origin = trimesh.transformations.euler_matrix(*mesh.origin.rpy, axes='sxyz')[:3, :3]
    shown = vertices @ origin.T + mesh.origin.xyz
    centre = centre_of(simulation.model)
    assert (shown.min(0) + shown.max(0)) / 2 == pytest.approx(centre, abs=1e-6)


def centre_of(model):
    """Return the middle of the box around a model's only mesh, in its body [m]."""
    geom = next(g for g in range(model.ngeom) if model.geom_dataid[g] >= 0)
    turned = model.mesh_vert @ rotation_of(model.geom_quat[geom]).T + model.geom_pos[geom]
    return (turned.min(0) + turned.max(0)) / 2


@pytest.mark.parametrize(
    ('asset', 'words'),
    [
        ('<mesh name="part" file="part.stl" refpos="1 0 0"/>', 'has refpos or refquat'),
        (
            '<mesh name="part" vertex="0 0 0 1 0 0 0 1 0 0 0 1"/>',
            'is no file of .stl, .obj, .dae: shown as the box around it',
        ),
    ],
)
def test_a_mesh_that_no_viewer_would_place_right_is_a_box_and_that_is_said(
    tmp_path, mesh_file, asset, words
):
    simulation = model_of(tmp_path, '<geom type="mesh" mesh="part"/>', asset)
    description = described(simulation, 'a')
    (note,) = description.notes
    assert note.startswith("a geom of body 'a': mesh 'part' ") and words in note
    assert '<box' in description.urdf


def test_a_mesh_whose_file_is_gone_is_a_box(tmp_path, mesh_file):
    simulation = model_of(
        tmp_path, '<geom type="mesh" mesh="part"/>', '<mesh name="part" file="part.stl"/>'
    )
    spec = simulation.scene.read_model()
    mesh_file.unlink()
    vehicle = simulation.vehicles['a']
    (note,) = robot_description(simulation.model, lambda: spec, vehicle).notes
    assert f'has no file any more ({mesh_file})' in note


def test_sensors_are_links_and_names_are_those_of_tf():
    simulation = Simulation('remus100')
    suites = StateTopics(simulation, DEFAULTS).suites
    urdf = descriptions(simulation, suites)['remus100'].urdf
    robot, poses = by_urdf_parser(urdf, {})
    assert robot.name == 'remus100' and robot.get_root() == 'remus100/base_link'
    for sensor in suites['remus100'].sensors:
        assert poses[sensor.frame][0] == pytest.approx(sensor.mount.position_b, abs=1e-9)
    assert {joint.name for joint in robot.joints if joint.type != 'fixed'} == {'rudder', 'planes'}


def test_a_description_is_the_same_each_time():
    texts = {described(Simulation('fleet_mixed'), 'rov').urdf for _ in range(2)}
    assert len(texts) == 1
