# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``/tf`` and ``/tf_static``: what moves and what does not, read by an independent reader."""

import numpy as np
import pytest
from rosbags.typesys import Stores, get_typestore
from scipy.spatial.transform import Rotation

from fluid_sim_ros import Simulation
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.messages.state_topics import DEFAULTS, StateTopics
from fluid_sim_ros.messages.transform_topics import TRANSFORMS
from fluid_sim_ros.recording.reader import open_log
from test.support.recorded_flights import record_flight

KINDS = get_typestore(Stores.ROS2_JAZZY)


def transforms(data):
    """Return (parent, child) -> (position [m], rotation) of a message, and its stamp [ns]."""
    message = KINDS.deserialize_cdr(data, TRANSFORMS)
    found, stamps = {}, set()
    for one in message.transforms:
        place, turn = one.transform.translation, one.transform.rotation
        pose = np.array([place.x, place.y, place.z])
        turned = Rotation.from_quat([turn.x, turn.y, turn.z, turn.w])
        found[one.header.frame_id, one.child_frame_id] = (pose, turned)
        stamps.add(one.header.stamp.sec * 10**9 + one.header.stamp.nanosec)
    return found, stamps


def topics_of(simulation, **settings):
    states = StateTopics(simulation, {**DEFAULTS, **settings})
    return states, {topic.name: topic for topic in states.topics}


def test_the_tree_is_that_of_rep_105_and_each_frame_has_one_parent():
    simulation = Simulation('remus100')
    _, topics = topics_of(simulation)
    fixed, moving = (transforms(topics[name].data())[0] for name in ('/tf_static', '/tf'))
    assert ('map', 'remus100/odom') in fixed
    assert [*moving] == [
        ('remus100/odom', 'remus100/base_link'),
        ('remus100/base_link', 'remus100/rudder'), ('remus100/base_link', 'remus100/planes'),
    ]  # fmt: skip
    sensors = {sensor.frame for sensor in topics_of(simulation)[0].suites['remus100'].sensors}
    assert {child for _, child in fixed} == {'remus100/odom', *sensors}
    children = [child for _, child in (*fixed, *moving)]
    assert len(children) == len(set(children))


def test_moving_links_follow_their_joints():
    simulation = Simulation('remus100')
    simulation.set_joints('remus100', [0.2, -0.1])
    states, topics = topics_of(simulation)
    simulation.step(300)
    states.take_state()
    found, stamps = transforms(states.data(topics['/tf']))
    assert stamps == {simulation.time_ns}
    simulation.observe(forces=True)
    model, data = simulation.model, simulation.observed
    place_w, turn_w = found['remus100/odom', 'remus100/base_link']
    moved = 0.0
    for name in ('rudder', 'planes'):
        position_b, turn_b = found['remus100/base_link', f'remus100/{name}']
        body = model.body(name).id
        assert place_w + turn_w.apply(position_b) == pytest.approx(data.xpos[body], abs=1e-9)
        matrix = (turn_w * turn_b).as_matrix()
        assert matrix.ravel() == pytest.approx(data.xmat[body], abs=1e-9)
        moved = max(moved, turn_b.magnitude())
    assert moved > 0.05


def test_fixed_links_and_sensors_stand_on_tf_static(tmp_path):
    path = tmp_path / 'a.xml'
    path.write_text(
        '<mujoco><worldbody><body name="a"><freejoint/><geom size=".1"/>'
        '<body name="mast" pos="0 0 .5" euler="0 0 90"><geom size=".01"/></body>'
        '</body></worldbody></mujoco>'
    )
    _, topics = topics_of(Simulation(path))
    fixed, _ = transforms(topics['/tf_static'].data())
    place, turn = fixed['a/base_link', 'a/mast']
    assert place.tolist() == [0, 0, 0.5]
    assert turn.as_euler('xyz', degrees=True) == pytest.approx([0, 0, 90])
    assert topics['/tf_static'].quality.transient_local and topics['/tf_static'].once
    assert [*transforms(topics['/tf'].data())[0]] == [('a/odom', 'a/base_link')]


@pytest.mark.parametrize(
    ('root', 'fixed', 'moving'),
    [
        ('map', {'sphere/odom'}, {'sphere/base_link'}),
        ('odom', set(), {'sphere/base_link'}),
        ('base_link', set(), set()),
    ],
)
def test_a_node_that_localises_or_estimates_may_own_the_frames_above(root, fixed, moving):
    _, topics = topics_of(Simulation('sphere'), **{'tf.root': root})
    for name, children in (('/tf_static', fixed), ('/tf', moving)):
        found = transforms(topics[name].data())[0] if name in topics else {}
        assert {child for _, child in found} == children


def test_vehicles_of_a_fleet_share_both_topics():
    simulation = Simulation('fleet_mixed')
    _, topics = topics_of(simulation)
    moving, _ = transforms(topics['/tf'].data())
    assert [*moving] == [(f'{name}/odom', f'{name}/base_link') for name in simulation.vehicles]


def test_a_log_begins_with_tf_static_once(tmp_path):
    record_flight(tmp_path / 'a.mcap', 'x500', seconds=0.5, piloted=False)
    log = open_log(tmp_path / 'a.mcap')
    messages = list(log.messages(['/tf_static', '/tf']))
    assert [m.topic for m in messages].count('/tf_static') == 1
    assert messages[0].topic == '/tf_static' and messages[0].log_ns == 0
    assert len(messages) > 20
    profile = log.topic('/tf_static').metadata['offered_qos_profiles']
    assert 'durability: transient_local' in profile
    found, _ = transforms(messages[0].data)
    assert ('x500/base_link', 'x500/imu') in found


def test_an_unknown_root_is_refused_by_the_node():
    from fluid_sim_ros.ros.parameters import simulator

    fault = simulator.parameter_table.check(simulator.TABLE, 'tf.root', 'world')
    assert fault.endswith('allowed: map, odom, base_link')


def test_the_rate_of_tf_is_bounded_by_the_steps():
    with pytest.raises(ConfigError, match=r"'tf.rate'.*above the step rate"):
        StateTopics(Simulation('sphere'), {**DEFAULTS, 'tf.rate': 1e6})
