# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The camera: known marks and depths, messages, latency, what it leaves alone, no EGL."""

import math
import os
import subprocess
import sys

import mujoco
import numpy as np
import pytest
from rosbags.typesys import Stores, get_typestore

from fluid_sim_ros import Scene, Simulation
from fluid_sim_ros.messages.sensor_topics import sensor_topics
from fluid_sim_ros.messages.state_topics import DEFAULTS, StateTopics
from fluid_sim_ros.schema.scene import VehicleFile
from fluid_sim_ros.schema.sensors import SensorsFile
from fluid_sim_ros.sensors import SensorSuite
from test.support.paths import ROOT

#: Place and radius of a red ball, world axes; the camera is at (0.3, 0, 1) and looks along x.
MARKS = np.array([[2.3, 0.0, 1.0], [3.3, 0.9, 1.4], [2.8, -0.8, 0.4], [5.3, -2.0, 2.2]])
MODEL = """
<mujoco>
  <option timestep="0.002" gravity="0 0 0"/>
  <visual><headlight ambient="1 1 1" diffuse="0 0 0" specular="0 0 0"/></visual>
  <worldbody>
    {marks}
    <geom name="water" type="box" pos="12 0 0" size="11 9 9" rgba="0 0 1 .2" contype="0" conaffinity="0"/>
    <geom name="wall" type="box" pos="8.4 0 1" size=".1 20 20" {wall} rgba="0 .5 0 1" contype="0" conaffinity="0"/>
    <body name="brick" pos="0 0 1">
      <freejoint/>
      <geom type="box" size=".1 .1 .1" mass="2" contype="0" conaffinity="0"/>
      <site name="front" pos=".3 0 0"/>
      <site name="tilted" pos=".3 0 0" euler="15 -5 8"/>
    </body>
  </worldbody>
</mujoco>
"""  # noqa: E501
STORE = get_typestore(Stores.ROS2_JAZZY)
CAMERA = {'rate': 50, 'site': 'front', 'width': 320, 'height': 240, 'field_of_view': 70}


@pytest.fixture
def scene(tmp_path):
    """Return a function that makes a simulation before marks and a wall."""

    def make(marks=MARKS, wall='', radius=0.05, **camera):
        balls = [
            f'<geom type="sphere" pos="{x} {y} {z}" size="{radius}" rgba="1 0 0 1" '
            'contype="0" conaffinity="0"/>'
            for x, y, z in marks
        ]
        path = tmp_path / 'brick.xml'
        path.write_text(MODEL.format(marks=' '.join(balls), wall=wall))
        sensors = SensorsFile.model_validate({'camera': {**CAMERA, **camera}})
        file = VehicleFile(body='brick', sensors=sensors)
        return Simulation(Scene('brick', path, vehicles={'brick': file}))

    return make


def taken(simulation):
    """Return the camera after one reading was shown by all of its topics."""
    suite = SensorSuite(simulation, 'brick')
    topics = sensor_topics(simulation, suite, 'brick')
    simulation.observe(forces=False)
    data = {topic.name.removeprefix('brick/camera/'): topic.data() for topic in topics}
    return suite.camera, data


def optical(points_w, simulation, site):
    """Return points in optical axes of a site, by the model's own site frame."""
    mujoco.mj_forward(simulation.model, simulation.data)
    rotation = simulation.data.site(site).xmat.reshape(3, 3)
    ahead, left, up = ((points_w - simulation.data.site(site).xpos) @ rotation).T
    return np.stack([-left, -up, ahead], axis=1)


def centroids(camera, expected):
    """Return the centre of the red pixels around each expected place."""
    red = camera.color.reshape(240, 320, 3)
    red = (red[..., 0] > 60) & (red[..., 1] < 60)
    rows, columns = np.nonzero(red)
    found = []
    for column, row in expected:
        near = np.hypot(columns - column, rows - row) < 12
        assert near.any()
        found.append((columns[near].mean(), rows[near].mean()))
    return np.array(found)


@pytest.mark.parametrize('site', ['front', 'tilted'])
def test_marks_are_where_the_pinhole_of_camera_info_has_them(scene, site):
    simulation = scene(site=site, radius=0.02)
    camera, data = taken(simulation)
    info = STORE.deserialize_cdr(data['camera_info'], 'sensor_msgs/msg/CameraInfo')
    k = info.k.reshape(3, 3)
    assert k[0, 0] == pytest.approx(160 / math.tan(math.radians(35)))
    points = optical(MARKS, simulation, site)
    projected = (k @ (points / points[:, 2:]).T).T[:, :2]
    inside = ((projected > 8) & (projected < [311, 231])).all(axis=1)
    assert inside.sum() >= 3
    found = centroids(camera, projected[inside])
    assert np.abs(found - projected[inside]).max() < 1.0


def test_depths_equal_rays_to_1_mm_at_2_m(scene):
    simulation = scene(marks=[], site='tilted', depth=True, color=False, wall='euler="8 25 -30"')
    simulation.model.geom('wall').pos[:] = (2.4, 0, 1)
    camera, _ = taken(simulation)
    depths = camera.depth.reshape(240, 320)
    columns, rows = np.meshgrid(np.arange(320), np.arange(240))
    focal = camera.pinhole.focal
    rays = np.stack([(columns - 159.5) / focal, (rows - 119.5) / focal, np.ones_like(rows)], -1)
    wall = simulation.model.geom('wall')
    rotation = np.empty(9)
    mujoco.mju_quat2Mat(rotation, wall.quat)
    site_w = simulation.data.site('tilted')
    mujoco.mj_forward(simulation.model, simulation.data)
    # in optical axes: a point of the wall's near face, and its normal
    turn = site_w.xmat.reshape(3, 3) @ np.array([[0, 0, 1], [-1, 0, 0], [0, -1, 0]])
    normal = rotation.reshape(3, 3)[:, 0]
    near = np.array(wall.pos) - 0.1 * normal - site_w.xpos
    expected = (near @ normal) / (rays @ turn.T @ normal)
    chosen = np.abs(expected - 2.0) < 0.5
    assert chosen.sum() > 10_000
    assert np.abs(depths - expected)[chosen].max() < 1e-3


def test_a_depth_is_what_a_rangefinder_reads_and_both_look_through_water(scene):
    simulation = scene(marks=[[2.3, 0, 1.0]], radius=0.2, depth=True)
    camera, _ = taken(simulation)
    sensors = SensorsFile.model_validate({
        'rangefinder': {'rate': 50, 'site': 'front', 'direction': [1, 0, 0]},
        'lidar': {'rate': 50, 'site': 'front', 'beams': 3, 'angles': [-5, 5]},
    })  # fmt: skip
    suite = SensorSuite(simulation, 'brick', sensors)
    suite.update()
    middle = camera.depth.reshape(240, 320)[119:121, 159:161].mean()
    assert suite.rangefinder.distance == pytest.approx(1.8, abs=1e-9)
    assert suite.lidar.ranges[1] == pytest.approx(1.8, abs=1e-9)
    assert middle == pytest.approx(1.8, abs=1e-3)


def test_depths_beyond_the_range_are_infinite(scene):
    far, _ = taken(scene(marks=[], depth=True, color=False, depth_range=[0.1, 5]))
    assert np.isposinf(far.depth).all()
    near, _ = taken(scene(marks=[], depth=True, color=False, depth_range=[30, 50]))
    assert np.isneginf(near.depth).all()


def test_the_messages(scene):
    camera, data = taken(scene(depth=True))
    picture = STORE.deserialize_cdr(data['image_raw'], 'sensor_msgs/msg/Image')
    assert (picture.width, picture.height, picture.step) == (320, 240, 960)
    assert (picture.encoding, picture.data.size) == ('rgb8', 960 * 240)
    depths = STORE.deserialize_cdr(data['depth/image_raw'], 'sensor_msgs/msg/Image')
    assert (depths.encoding, depths.step) == ('32FC1', 1280)
    assert np.array_equal(depths.data.view('<f4'), camera.depth)
    assert list(data) == ['image_raw', 'camera_info', 'depth/image_raw', 'depth/camera_info']
    assert bytes(camera.color) in data['image_raw']
    assert all(b'brick/camera_optical_frame\0' in each for each in data.values())


def test_a_picture_shows_where_things_were_when_it_was_taken(scene):
    """With latency: the same picture as of a camera that shows it at once."""
    pictures = {}
    for latency in (0.0, 0.06):
        simulation = scene(latency=latency)
        simulation.data.qvel[:] = (0, 0.5, 0, 0, 0, 0.3)
        suite = SensorSuite(simulation, 'brick')
        for step in range(121):
            suite.update()
            camera = suite.camera
            if camera.fresh and camera.time_ns == 160_000_000:
                assert step * 2_000_000 == 160_000_000 + latency * 1e9
                camera.prepare(camera.readings[0])
                pictures[latency] = camera.color.copy()
            simulation.step()
    assert np.array_equal(pictures[0.0], pictures[0.06])


def test_drawing_changes_nothing_and_only_what_is_wanted_is_drawn(scene):
    ends = []
    for look in (False, True):
        simulation = scene(depth=True)
        simulation.data.qvel[:] = (0.1, 0.2, 0, 0.3, 0, 0.1)
        topics = StateTopics(simulation, DEFAULTS)
        wanted = [t for t in topics.topics if look and t.name == 'brick/camera/image_raw']
        for _ in range(20):
            topics.take_state()
            for topic in wanted:
                if simulation.tick % topic.period == 0:
                    topics.data(topic)
            simulation.step()
        camera = topics.suites['brick'].camera
        assert camera.pictures == (1 if look else 0)
        assert list(camera._offscreen) == (['color'] if look else [])
        ends.append(simulation.data.qpos.tobytes() + simulation.data.qvel.tobytes())
    assert ends[0] == ends[1]


WITHOUT_EGL = """\
import sys
from fluid_sim_ros import Simulation
from fluid_sim_ros.messages.sensor_topics import sensor_topics
from fluid_sim_ros.schema.sensors import SensorsFile
from fluid_sim_ros.sensors import SensorSuite
simulation = Simulation('quadrotor')
name = next(iter(simulation.vehicles))
config = SensorsFile.model_validate({'camera': {'rate': 50, 'depth': True}, 'imu': {'rate': 50}})
topics = sensor_topics(simulation, SensorSuite(simulation, name, config), name)
for _ in range(3):
    simulation.observe(forces=True)
    print([len(topic.data()) > 0 for topic in topics])
    simulation.step(round(0.02 / simulation.timestep))
print(*simulation.warnings.lines, sep='\\n')
"""


def test_without_egl_it_says_so_once_and_everything_else_works():
    environment = {**os.environ, 'PYTHONPATH': str(ROOT), 'PYOPENGL_PLATFORM': 'glx'}
    done = subprocess.run(
        [sys.executable, '-c', WITHOUT_EGL],
        env=environment, capture_output=True, text=True, timeout=60, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr[-2000:]
    *read, line = done.stdout.splitlines()
    # in the order of the schema; the former name of the IMU's topic comes last
    assert read == ['[True, False, True, False, True, True]'] * 3
    assert 'EGL' in line
    assert 'its topics stay silent' in line


@pytest.mark.parametrize(
    ('wrong', 'words'),
    [
        ({'width': 0}, 'width'),
        ({'field_of_view': 180}, 'field_of_view'),
        ({'frame': 'camera'}, 'frame'),
        ({'color': False}, 'one of them'),
        ({'depth_range': [3, 1]}, 'must rise'),
        ({'site': 'nowhere'}, "site 'nowhere' is not on the base body"),
        ({'rate': 1001}, 'rate'),
    ],
)
def test_wrong_input_is_named(scene, wrong, words):
    with pytest.raises(Exception, match=words):
        SensorSuite(scene(**wrong), 'brick')
