# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Services of simulation_interfaces, and tf2_msgs, with types built by ROS's own generators."""

import os
import re
import shutil
import signal
import subprocess
import sys
import textwrap

import pytest
from std_srvs.srv import Trigger

from fluid_sim_ros.messages.transform_topics import TRANSFORMS
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.recording.replay.resimulate import resimulate
from fluid_sim_ros.ros.standard.services import SERVICES
from test.support import rosidl_package, standard_types
from test.support.recorded_flights import events_of
from test.support.ros_processes import Peer, node

#: Compiling takes half a minute.
pytestmark = [
    pytest.mark.ros, pytest.mark.full, pytest.mark.usefixtures('ros_domain'),
    pytest.mark.skipif(shutil.which('c++') is None, reason='needs a C++ compiler'),
]  # fmt: skip


@pytest.fixture(scope='module')
def standard(tmp_path_factory):
    """Build simulation_interfaces; return the environment in which it is installed."""
    folder = tmp_path_factory.mktemp('standard')
    types = standard_types
    return rosidl_package.build('simulation_interfaces', types.TEXTS, types.NEEDS, folder)


@pytest.fixture
def installed(standard, monkeypatch):
    for name, value in standard.items():
        monkeypatch.setenv(name, value)


#: Calls services in a process of its own, as the types were not there when this one began.
CLIENT = """
import sys, time, math
import rclpy
from simulation_interfaces import msg, srv
rclpy.init()
node = rclpy.create_node('client')
clients = {}
def call(name, kind, **fields):
    client = clients.get(name) or clients.setdefault(name, node.create_client(kind, name))
    assert client.wait_for_service(30.0), name
    time.sleep(0.2)
    future = client.call_async(kind.Request(**fields))
    rclpy.spin_until_future_complete(node, future, timeout_sec=30.0)
    return future.result()
def state():
    return call('get_simulation_state', srv.GetSimulationState).state.state
def set_state(number):
    wanted = msg.SimulationState(state=number)
    return call('set_simulation_state', srv.SetSimulationState, state=wanted).result
S, R = msg.SimulationState, msg.Result
"""


def run_client(text):
    """Run lines behind CLIENT; return what they print."""
    script = CLIENT + textwrap.dedent(text) + '\nrclpy.shutdown()\n'
    done = subprocess.run(
        [sys.executable, '-c', script], capture_output=True, text=True, check=False, timeout=120
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_features_states_steps_and_resets(installed):
    with node(scene='sphere', pacing='realtime') as process:
        run_client("""
        features = call('get_simulator_features', srv.GetSimulatorFeatures).features
        F = msg.SimulatorFeatures
        assert F.SIMULATION_RESET in features.features and F.SPAWNING not in features.features
        assert 'neither spawned nor deleted' in features.custom_info
        assert state() == S.STATE_PLAYING
        assert call('step_simulation', srv.StepSimulation, steps=3).result.result == \\
            R.RESULT_INCORRECT_STATE
        assert set_state(S.STATE_PAUSED).result == R.RESULT_OK and state() == S.STATE_PAUSED
        assert set_state(S.STATE_PAUSED).result == 101
        def seconds():
            found = call('get_entity_state', srv.GetEntityState, entity='sphere')
            stamp = found.state.header.stamp
            return stamp.sec + 1e-9 * stamp.nanosec
        before = seconds()
        assert call('step_simulation', srv.StepSimulation, steps=1200).result.result == R.RESULT_OK
        assert abs(seconds() - before - 2.4) < 1e-6, seconds() - before
        assert call('step_simulation', srv.StepSimulation, steps=0).result.result == \\
            R.RESULT_OPERATION_FAILED
        assert set_state(S.STATE_STOPPED).result == R.RESULT_OK
        assert state() == S.STATE_STOPPED and seconds() == 0.0
        assert set_state(S.STATE_PLAYING).result == R.RESULT_OK and state() == S.STATE_PLAYING
        reset = lambda scope: call('reset_simulation', srv.ResetSimulation, scope=scope).result
        assert reset(0).result == reset(255).result == reset(3).result == R.RESULT_OK
        answer = reset(1)
        assert answer.result == R.RESULT_FEATURE_UNSUPPORTED, answer
        assert 'time and state are reset together' in answer.error_message
        assert set_state(S.STATE_QUITTING).result == R.RESULT_OK
        """)
        assert process.wait() == 0


def test_entities_are_listed_read_and_placed_and_the_flight_can_be_repeated(installed, tmp_path):
    path = tmp_path / 'a.mcap'
    with node(scene='fleet_mixed', record__path=path) as process:
        run_client("""
        names = call('get_entities', srv.GetEntities).entities
        assert names == ['one', 'two', 'rov'], names
        chosen = msg.EntityFilters(filter='^r')
        found = call('get_entities_states', srv.GetEntitiesStates, filters=chosen)
        assert found.entities == ['rov'] and found.states[0].header.frame_id == 'map'
        tags = msg.EntityFilters(tags=msg.TagsFilter(tags=['a']))
        assert call('get_entities', srv.GetEntities, filters=tags).result.result == \\
            R.RESULT_FEATURE_UNSUPPORTED
        wrong = msg.EntityFilters(filter='(')
        assert call('get_entities', srv.GetEntities, filters=wrong).result.result == \\
            R.RESULT_OPERATION_FAILED
        answer = call('get_entity_state', srv.GetEntityState, entity='rob').result
        assert answer.result == R.RESULT_NOT_FOUND and 'rov' in answer.error_message, answer
        new = msg.EntityState()
        new.pose.position.x, new.pose.position.z = 7.0, -3.0
        new.twist.linear.x = 9.0
        def place(**more):
            return call('set_entity_state', srv.SetEntityState, state=new, **more).result
        assert set_state(S.STATE_PAUSED).result == R.RESULT_OK
        assert place(entity='rov', set_pose=True).result == R.RESULT_OK
        got = call('get_entity_state', srv.GetEntityState, entity='rov').state
        assert (got.pose.position.x, got.pose.position.z) == (7.0, -3.0)
        assert abs(got.twist.linear.x) < 5.0
        new.header.frame_id = 'one/odom'
        assert place(entity='rov', set_pose=True).result == R.RESULT_FEATURE_UNSUPPORTED
        assert set_state(S.STATE_PLAYING).result == R.RESULT_OK
        time.sleep(0.3)
        """)
        process.signal(signal.SIGINT)
        assert process.wait() == 0
    log = open_log(path)
    events = events_of(message.data for message in log.messages(['/fluid_sim/events']))
    (placed,) = [event['place'] for event in events if 'place' in event]
    assert placed['entity'] == 'rov' and placed['twist'] is None
    outcome = resimulate(log)
    assert outcome.difference is None and outcome.compared > 100


def test_without_the_package_there_are_no_such_services():
    with Peer() as peer, node(scene='sphere'):
        peer.call(Trigger, 'fluid_sim_node/reset')
        names = {name for name, _ in peer.node.get_service_names_and_types()}
    assert not names & {f'/{name}' for table in SERVICES.values() for name in table}


def test_a_listener_with_the_real_tf2_msgs_hears_what_the_wheels_publish(tmp_path):
    """Built by ROS's generators, in a process of its own; the node has none."""
    text = 'geometry_msgs/TransformStamped[] transforms\n'
    needs = ('geometry_msgs', 'std_msgs', 'builtin_interfaces')
    extra = rosidl_package.build('tf2_msgs', {'msg/TFMessage': text}, needs, tmp_path)
    script = textwrap.dedent("""
    import time, rclpy
    from rclpy.qos import DurabilityPolicy, QoSProfile
    from tf2_msgs.msg import TFMessage
    rclpy.init()
    node = rclpy.create_node('listener')
    found = {'/tf': [], '/tf_static': []}
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    node.create_subscription(TFMessage, '/tf', found['/tf'].append, 10)
    node.create_subscription(TFMessage, '/tf_static', found['/tf_static'].append, latched)
    end = time.monotonic() + 30
    while not all(found.values()) and time.monotonic() < end:
        rclpy.spin_once(node, timeout_sec=0.1)
    for name, (first, *_) in found.items():
        print(name, *(f'{t.header.frame_id}>{t.child_frame_id}' for t in first.transforms))
    print({str(i.topic_type_hash) for i in node.get_publishers_info_by_topic('/tf')})
    rclpy.shutdown()
    """)
    with node(scene='remus100'):
        done = subprocess.run(
            [sys.executable, '-c', script], env={**os.environ, **extra}, capture_output=True,
            text=True, check=False, timeout=120,
        )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert re.search(r'/tf .*remus100/base_link>remus100/rudder', done.stdout), done.stdout
    assert re.search(r'/tf_static .*map>remus100/odom', done.stdout), done.stdout
    assert 'incompatible' not in done.stderr
    assert TRANSFORMS.startswith('tf2_msgs')
