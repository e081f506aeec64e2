# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Live viewers over the real protocol: channels and schemas of the log, services, parameters."""

import json
import socket
import subprocess
import sys
import time
from contextlib import contextmanager

import pytest

pytest.importorskip('foxglove', reason='the extra foxglove is not installed')

from fluid_sim_ros import Simulation
from fluid_sim_ros.cli.foxglove import LiveRun
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.messages.definitions import definition
from fluid_sim_ros.messages.state_topics import DEFAULTS, StateTopics
from fluid_sim_ros.recording.reader import open_log
from test.support.camera_scene import camera_scene
from test.support.foxglove_client import foxglove_client
from test.support.paths import ROOT


@contextmanager
def running(tmp_path, *options):
    """Give the port of a run in a process of its own."""
    command = [sys.executable, '-m', 'fluid_sim_ros.cli', 'run', 'quadrotor', '--hold',
               '--pacing', 'realtime', '--foxglove', '0', *options]  # fmt: skip
    with subprocess.Popen(
        command, cwd=ROOT, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True
    ) as run:
        for line in run.stderr:
            if 'ws://127.0.0.1:' in line:
                break
        try:
            yield int(line.rpartition(':')[2])
        finally:
            run.terminate()
            run.communicate()


def test_a_viewer_sees_reads_and_commands_a_run(tmp_path):
    record = tmp_path / 'flight.mcap'
    with running(tmp_path, '--record', str(record)) as port, foxglove_client(port) as client:
        odometry = client.subscribe('/x500/odom')
        thrust = client.subscribe('/x500/cmd/thrust')
        described = client.subscribe('/x500/robot_description')
        for number in (odometry, thrust, described):
            client.wait_for(lambda c, n=number: any(m[0] == n for m in c.messages))
        assert client.info['capabilities'].count('services') == 1

        assert client.call('/fluid_sim/pause', {'data': True})['success']
        answer = client.call('/fluid_sim/step')
        assert answer['success'] and 'step' in answer['message']
        refused = client.call('/fluid_sim/pause', {'data': 'yes'})
        assert not refused['success'] and 'true' in refused['message']
        assert client.call('/fluid_sim/pause', {'data': False})['success']

        client.send('getParameters', parameterNames=[], id='all')
        client.wait_for(lambda c: 'timestep' in c.parameters)
        assert client.parameters['scene'] == 'quadrotor'
        wind = {'name': 'wind', 'value': [3.0, 0.0, 0.0], 'type': 'float64_array'}
        seed = {'name': 'seed', 'value': 7}
        client.send('setParameters', parameters=[wind, seed], id='set')
        client.wait_for(lambda c: c.parameters.get('wind') == [3.0, 0.0, 0.0])
        assert client.parameters['seed'] == 0  # read only: what holds is read back

    # the log has the wind too: the flight is repeated to the bit
    command = [sys.executable, '-m', 'fluid_sim_ros.cli', 'replay', str(record), '--resimulate']
    done = subprocess.run(
        [*command, '--json', '-'], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert json.loads(done.stdout)['identical'], done.stdout
    topics = {t.name: t for t in open_log(record).topics.values()}
    for name, channel in client.channels.items():
        assert channel['schemaName'] == topics[name].type
        assert channel['schema'] == topics[name].definition
        assert (channel['encoding'], channel['schemaEncoding']) == ('cdr', 'ros2msg')
    assert set(topics) - set(client.channels) <= {'/fluid_sim/events'}


def test_a_reset_begins_a_new_session_and_nobody_looking_costs_no_message():
    simulation = Simulation('quadrotor')
    live = LiveRun(simulation, 0)
    try:
        live.sink.write(simulation)
        assert live.sink._active == []
        with foxglove_client(live.sink.port) as client:
            number = client.subscribe('/x500/wrench/drag')
            client.wait_for(lambda c: live.sink._topics and _send(live, simulation, c, number))
            client.wait_for(lambda c: len(c.sessions) == 1)
            simulation.reset()
            live.sink.restart()
            client.wait_for(lambda c: len(c.sessions) == 2)
    finally:
        live.sink.close()


def _send(live, simulation, client, number):
    live.sink._refreshed_at = 0.0
    simulation.step(live.sink.period - simulation.tick % live.sink.period)
    live.sink.write(simulation)
    return any(message[0] == number for message in client.messages)


def test_a_viewer_sees_pictures_which_are_drawn_only_then(tmp_path):
    simulation = Simulation(camera_scene(tmp_path))
    live = LiveRun(simulation, 0)
    camera = live.sink._states.suites['x500'].camera
    try:
        with foxglove_client(live.sink.port) as client:
            number = client.subscribe('/x500/camera/camera_info')
            client.wait_for(lambda c: _send(live, simulation, c, number))
            assert camera._drawn == set()
            number = client.subscribe('/x500/camera/image_raw')
            client.wait_for(lambda c: _send(live, simulation, c, number))
            assert client.channels['/x500/camera/image_raw']['schemaName'] == (
                'sensor_msgs/msg/Image'
            )
    finally:
        live.sink.close()
    picture = next(data for n, _, data in client.messages if n == number)
    assert len(picture) > 64 * 48 * 3 and b'rgb8' in picture
    assert list(camera._offscreen) == ['color']


def test_a_port_in_use_is_one_line():
    live = LiveRun(Simulation('quadrotor'), 0)
    try:
        with pytest.raises(ConfigError, match='choose another'):
            LiveRun(Simulation('quadrotor'), live.sink.port)
    finally:
        live.sink.close()


def test_each_topic_has_its_definition():
    topics = StateTopics(Simulation('rov'), DEFAULTS).topics
    assert all(definition(topic.type).text for topic in topics)


@pytest.mark.ros
@pytest.mark.usefixtures('ros_domain')
def test_a_node_serves_viewers_too():
    pytest.importorskip('rclpy', reason='ROS is not here')
    from test.support.ros_processes import NODE, Forked

    with bound_port() as port, Forked(NODE, scene='quadrotor', **{'foxglove.port': port}) as node:
        while 'ws://127.0.0.1' not in node.output:
            assert node.alive
            time.sleep(0.05)
        with foxglove_client(port) as client:
            number = client.subscribe('/x500/odom')
            client.wait_for(lambda c: any(m[0] == number for m in c.messages))
            assert client.call('/fluid_sim/pause', {'data': True})['success']
            assert client.call('/fluid_sim/reset')['success']
            client.send('getParameters', parameterNames=['pacing'], id='some')
            client.wait_for(lambda c: c.parameters.get('pacing') == 'realtime')


@contextmanager
def bound_port():
    """Give a port that was free a moment ago."""
    with socket.socket() as probe:
        probe.bind(('127.0.0.1', 0))
        number = probe.getsockname()[1]
    yield number
