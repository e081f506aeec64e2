# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The links of a vehicle stand where MuJoCo has its bodies, at every position of the joints."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.scene.robot.links import link_pose, vehicle_links

#: Each kind of joint, several of one body, joints beside the body's origin, references, bodies
#: without names and of a name that is taken.
ARM = """
<mujoco model="arm">
  <worldbody>
    <body name="arm" pos="0 0 1">
      <freejoint/>
      <geom size=".1"/>
      <body name="elbow" pos=".3 .1 0" euler="10 20 30">
        <joint name="yaw" axis="0 0 1" pos=".1 0 .2" ref="25"/>
        <joint name="reach" type="slide" axis="1 1 0" pos="0 .3 0" ref=".4"/>
        <joint name="roll" axis="1 0 0" pos="-.1 .05 0"/>
        <geom size=".05" pos="0 .1 0"/>
        <body pos="0 .2 0" euler="0 90 0">
          <geom size=".04"/>
          <body name="hand" pos=".1 0 0"><joint name="wrist" type="ball" pos="0 0 .1"/>
            <geom size=".03"/></body>
        </body>
      </body>
      <body name="imu" pos="0 0 .1"><geom size=".01"/></body>
      <body name="base_link" pos="0 0 -.1"><joint axis="0 1 0"/><geom size=".01"/></body>
    </body>
    <body name="stone"><freejoint/><geom size=".1"/></body>
  </worldbody>
</mujoco>
"""
#: Also bodies with two joints (a wing), and joints beside the body's origin (links of a swimmer).
SCENES = ('swimmer', 'fly_wing', 'fish', 'remus100', 'aerosonde', 'fleet_mixed', 'water_pendulum')


@pytest.fixture
def arm(tmp_path):
    path = tmp_path / 'arm.xml'
    path.write_text(ARM, encoding='utf-8')
    return Simulation(path)


def rotation(quat_wxyz):
    matrix = np.empty(9)
    mujoco.mju_quat2Mat(matrix, quat_wxyz)
    return matrix.reshape(3, 3)


def largest_error(model, vehicle, links, data):
    """Return how far a link is from where MuJoCo has its body [m, or of a rotation matrix]."""
    base = vehicle.body_id
    poses = {'base_link': (data.xpos[base], data.xmat[base].reshape(3, 3))}
    errors = []
    for link in links[1:]:
        position_p, quat_pl = link_pose(model, link, data.qpos)
        parent_w, rotation_wp = poses[link.parent]
        place = parent_w + rotation_wp @ position_p
        poses[link.name] = (place, rotation_wp @ rotation(quat_pl))
        if link.body_id >= 0:
            rotation_wb = data.xmat[link.body_id].reshape(3, 3)
            origin_w = data.xpos[link.body_id] + rotation_wb @ link.shift_b
            errors += [np.abs(origin_w - place).max()]
            errors += [np.abs(rotation_wb - poses[link.name][1]).max()]
    return max(errors, default=0.0)


def random_positions(model, rng):
    """Return positions of all joints, shape (nq,); quaternions are of length 1."""
    qpos = rng.uniform(-2.0, 2.0, model.nq)
    for joint in range(model.njnt):
        kind, start = model.jnt_type[joint], model.jnt_qposadr[joint]
        if kind in (mujoco.mjtJoint.mjJNT_FREE, mujoco.mjtJoint.mjJNT_BALL):
            start += 3 * (kind == mujoco.mjtJoint.mjJNT_FREE)
            qpos[start : start + 4] /= np.linalg.norm(qpos[start : start + 4])
    return qpos


def check(simulation, taken=()):
    model, rng = simulation.model, np.random.default_rng(5)
    data = mujoco.MjData(model)
    for _ in range(20):
        data.qpos[:] = random_positions(model, rng)
        mujoco.mj_kinematics(model, data)
        for vehicle in simulation.vehicles.values():
            links = vehicle_links(model, vehicle, taken)
            assert largest_error(model, vehicle, links, data) < 1e-12


def test_each_kind_of_joint_carries_its_link_to_where_the_body_is(arm):
    check(arm, taken=['imu'])


@pytest.mark.parametrize('scene', SCENES)
def test_links_of_a_scene_are_where_its_bodies_are(scene):
    check(Simulation(scene))


def test_every_body_of_the_vehicle_is_a_link_of_its_own_name(arm):
    links = vehicle_links(arm.model, arm.vehicles['arm'], taken=['imu'])
    tree = {link.name: link.parent for link in links}
    assert tree == {
        'base_link': '', 'yaw': 'base_link', 'reach': 'yaw', 'elbow': 'reach', 'body2': 'elbow',
        'hand': 'body2', 'imu_link': 'base_link', 'base_link_link': 'base_link',
    }  # fmt: skip
    carried = [link.body_id for link in links if link.body_id >= 0]
    assert len(carried) == len(set(carried)) == 6  # the stone is none of the vehicle's
    assert [link.name for link in links if link.joint_id < 0] == ['base_link', 'body2', 'imu_link']


def test_names_of_a_fleet_are_without_its_prefix():
    simulation = Simulation('fleet_mixed')
    for vehicle in simulation.vehicles.values():
        assert not any('/' in link.name for link in vehicle_links(simulation.model, vehicle))
