# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The node with an autopilot: topics, wind, reset and log go on as without, over real DDS."""

import signal
import threading

import pytest
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Joy
from std_srvs.srv import Trigger

from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.recording.replay.resimulate import resimulate
from test.support.autopilots.ardupilot_stand_in import Copter, Link, padded
from test.support.autopilots.autopilot_peers import free_port
from test.support.autopilots.px4_pilots import Quad
from test.support.autopilots.px4_stand_in import Px4
from test.support.ros_processes import Peer, node, stamp_ns, wait_until

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]


class Pilot(threading.Thread):
    """A stand-in that flies in a thread until ``done``."""

    def __init__(self, fly):
        super().__init__(daemon=True)
        self._fly = fly
        self.done = threading.Event()
        self.start()

    def run(self):
        self._fly(self.done)


def fly_px4(port, heard=None):
    def fly(done):
        px4, quad, controls = Px4(port), Quad((0.0, 0.0, -2.0), 0.77), [0.0] * 4
        while not done.is_set():
            controls = quad.controls(px4, px4.exchange(controls))
            if heard is not None:
                heard.update(px4.latest)
        px4.close()

    return Pilot(fly)


def fly_ardupilot(port):
    def fly(done):
        link, copter, pulses = Link(port), Copter((0.0, 0.0, -2.0), 0.77), padded([1000] * 4)
        while not done.is_set():
            pulses = copter.pulses(link.exchange(pulses))
        link.close()

    return Pilot(fly)


@pytest.mark.parametrize(('protocol', 'fly'), [('px4', fly_px4), ('ardupilot', fly_ardupilot)])
def test_a_node_that_an_autopilot_flies(tmp_path, protocol, fly):
    log, port = tmp_path / 'flight.mcap', free_port(protocol)
    settings = {
        'scene': 'x500_ground', 'pacing': 'realtime', 'realtime.factor': 3.0, 'record.path': log,
        'autopilot.protocol': protocol, 'autopilot.port': port,
    }  # fmt: skip
    with Peer() as peer:
        peer.watch_diagnostics()
        odometry = peer.collect(Odometry, 'x500/odom')
        with node(**settings) as process:
            wait_until(lambda: 'autopilot' in peer.diagnostics, 'diagnostics')
            assert peer.diagnostics['autopilot'][1].startswith('waiting for')
            wind = peer.publisher(TwistStamped, 'wind')
            pilot = fly(port)
            wait_until(lambda: odometry and odometry[-1].pose.pose.position.z > 1.0, 'take-off')
            command = TwistStamped()
            command.twist.linear.x = 4.0
            wind.publish(command)
            wait_until(lambda: odometry[-1].pose.pose.position.x > 0.05, 'the wind')
            wait_until(lambda: peer.diagnostics['autopilot'][1] == 'in lockstep', 'lockstep')
            before = stamp_ns(odometry[-1])
            peer.call(Trigger, 'fluid_sim_node/reset')
            wait_until(lambda: stamp_ns(odometry[-1]) < before, 'the reset')
            pilot.done.set()
            pilot.join()
            process.signal(signal.SIGINT)
            assert process.wait() == 0
    outcome = resimulate(open_log(log))
    assert outcome.commands > 200
    assert outcome.compared > 1000
    assert outcome.difference is None


def test_sticks_on_a_topic_reach_px4(tmp_path):
    log, port, heard = tmp_path / 'flight.mcap', free_port('px4'), {}
    settings = {
        'scene': 'x500_ground', 'pacing': 'realtime', 'record.path': log,
        'autopilot.protocol': 'px4', 'autopilot.port': port, 'autopilot.sticks_timeout': 0.0,
    }  # fmt: skip
    with Peer() as peer, node(**settings) as process:
        peer.watch_diagnostics()
        wait_until(lambda: 'autopilot' in peer.diagnostics, 'diagnostics')
        sticks, pilot = peer.publisher(Joy, 'x500/cmd/sticks'), fly_px4(port, heard)
        sticks.publish(Joy(axes=[float('nan')]))
        wait_until(lambda: 'holds a value that is not finite' in process.output, 'the refusal')
        sticks.publish(Joy(axes=[0.0, 0.25, -1.0], buttons=[0, 1]))
        wait_until(lambda: heard.get('RC_CHANNELS', {}).get('chan2_raw') == 1625, 'sticks')
        pilot.done.set()
        pilot.join()
        process.signal(signal.SIGINT)
        assert process.wait() == 0
    assert [heard['RC_CHANNELS'][f'chan{i}_raw'] for i in range(1, 6)] == [
        1500, 1625, 1000, 1000, 2000
    ]  # fmt: skip
    kept = open_log(log)
    assert kept.topic('/x500/cmd/sticks').type == 'sensor_msgs/msg/Joy'
    assert sum(message.topic == '/x500/cmd/sticks' for message in kept.messages()) == 2


@pytest.mark.parametrize(
    ('settings', 'line'),
    [
        ({'pacing': 'lockstep'}, 'an autopilot is a lockstep of its own; use free or realtime'),
        ({'thrust.unit': 'normalized'}, "'thrust.unit': with an autopilot it must be newton"),
    ],
)
def test_parameters_that_do_not_go_with_an_autopilot(settings, line):
    settings = {'scene': 'x500_ground', 'autopilot.protocol': 'px4',
                'autopilot.port': free_port('px4'), **settings}  # fmt: skip
    with node(**settings) as process:
        assert process.wait() != 0
    assert line in process.output
