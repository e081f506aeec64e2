# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Nothing leaves this host: a peer beside it, with a cable between, reaches no part of ROS."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from fluid_sim_ros.ros.process import this_host
from fluid_sim_ros.ros.process.this_host import FAST_DDS_PROFILES, PROFILE, stay_on_this_host
from test.support.network_namespaces import HERE, two_hosts

#: Runs as the user of another shell does: ROS as it comes, with a static peer where one is told.
_STRANGER = """
import sys, time
import rclpy
from nav_msgs.msg import Odometry
from std_msgs.msg import Float64MultiArray
rclpy.init()
node = rclpy.create_node('stranger')
command = node.create_publisher(Float64MultiArray, '/x500/cmd/thrust', 10)
heard = []
node.create_subscription(Odometry, '/x500/odom', heard.append, 10)
end = time.monotonic() + float(sys.argv[1])
while time.monotonic() < end and not (heard and command.get_subscription_count()):
    rclpy.spin_once(node, timeout_sec=0.1)
print('reached' if heard and command.get_subscription_count() else 'alone')
"""
#: Asks the UDP ports that the first participants of a domain use whether something listens.
_PROBE = """
import os, socket, sys, time
base = 7400 + 250 * int(os.environ['ROS_DOMAIN_ID'])

def refused(port):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.settimeout(0.3)
        probe.connect((sys.argv[1], port))
        probe.send(b'RTPS')
        try:
            probe.recv(1)
        except ConnectionRefusedError:
            return True
        except TimeoutError:
            return False

# the kernel answers so many probes a second, no more: what is silent is asked again
silent = [*range(base, base + 34), *range(7000, 7006)]
for _ in range(4):
    silent = [port for port in silent if not refused(port)]
    time.sleep(0.2 if silent else 0)
print(silent)
"""


def _environment(**values):
    """Return what a shell has that says nothing of where ROS shall go."""
    names = ('ROS_AUTOMATIC_DISCOVERY_RANGE', *FAST_DDS_PROFILES)
    return {**{k: v for k, v in os.environ.items() if k not in names}, **values}


def _ask(where, code, *arguments, **environment):
    done = subprocess.run(
        [*where, sys.executable, '-c', code, *map(str, arguments)], capture_output=True,
        text=True, check=True, timeout=120, env=_environment(**environment),
    )  # fmt: skip
    return done.stdout.strip()


@pytest.fixture(name='hosts')
def _hosts():
    with two_hosts() as hosts:
        yield hosts


def _node(where, tmp_path, **environment):
    """Start the node there; its shared memory is that of this host, its network is not."""
    process = subprocess.Popen(
        [*where, sys.executable, '-m', 'fluid_sim_ros.ros.node'], stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, text=True, env=_environment(**environment),
    )  # fmt: skip
    for line in process.stdout:
        if 'realtime pacing' in line:
            return process
    raise AssertionError('the node has not started')


@pytest.mark.ros
@pytest.mark.usefixtures('ros_domain')
@pytest.mark.parametrize('range_of_node', ['', 'SUBNET'])
def test_a_peer_of_another_host_reaches_the_node_only_where_it_was_opened(
    hosts, tmp_path, range_of_node
):
    here, there = hosts
    opened = {'ROS_AUTOMATIC_DISCOVERY_RANGE': range_of_node} if range_of_node else {}
    process = _node(here, tmp_path, **opened)
    try:
        ports = _ask(there, _PROBE, HERE)
        # a user's own tools on the same host need no setting
        assert _ask(here, _STRANGER, 30) == 'reached'
        peer = {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'SUBNET', 'ROS_STATIC_PEERS': HERE}
        if range_of_node:  # so that what follows can fail
            assert ports != '[]'
            assert _ask(there, _STRANGER, 30, **peer) == 'reached'
        else:
            assert ports == '[]'
            assert _ask(there, _STRANGER, 3, **peer) == 'alone'
    finally:
        process.terminate()
        process.wait(20)


@pytest.fixture
def _fresh(monkeypatch, tmp_path):
    for name in (*this_host._CHOICES, 'ROS_AUTOMATIC_DISCOVERY_RANGE'):
        monkeypatch.setenv(name, '')  # so that the original is put back
        monkeypatch.delenv(name)
    monkeypatch.chdir(tmp_path)
    return monkeypatch


@pytest.mark.usefixtures('_fresh')
def test_a_shell_that_says_nothing_stays_on_this_host():
    stay_on_this_host()
    assert os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] == 'LOCALHOST'
    assert {os.environ[name] for name in FAST_DDS_PROFILES} == {str(PROFILE)}
    assert not this_host.opened()
    assert '<address>127.0.0.1</address>' in PROFILE.read_text()


@pytest.mark.parametrize(
    ('name', 'value'),
    [
        ('ROS_AUTOMATIC_DISCOVERY_RANGE', 'SUBNET'), ('ROS_STATIC_PEERS', '192.0.2.7'),
        ('FASTRTPS_DEFAULT_PROFILES_FILE', 'mine.xml'), ('FASTDDS_BUILTIN_TRANSPORTS', 'UDPv4'),
    ],
)  # fmt: skip
def test_what_the_user_has_chosen_wins(_fresh, name, value):
    _fresh.setenv(name, value)
    stay_on_this_host()
    assert os.environ[name] == value
    assert str(PROFILE) not in {os.environ.get(other) for other in FAST_DDS_PROFILES}
    assert this_host.opened() == name


def test_a_profile_in_the_working_folder_wins(_fresh):
    Path('DEFAULT_FASTRTPS_PROFILES.xml').write_text('<dds/>')
    stay_on_this_host()
    assert not any(name in os.environ for name in FAST_DDS_PROFILES)


@pytest.mark.ros
def test_the_middleware_has_taken_the_profile():
    """Every test of this project runs with it; no socket of ROS takes from the network."""
    code = """
import os, pathlib, re, subprocess, sys
import rclpy
from fluid_sim_ros.ros.process.command_line import start_ros
start_ros(['node'])
node = rclpy.create_node('node')
table = pathlib.Path('/proc/self/net/udp').read_text().splitlines()[1:]
own = {os.readlink(p) for p in pathlib.Path('/proc/self/fd').iterdir() if p.is_symlink()}
for row in map(str.split, table):
    if f'socket:[{row[9]}]' in own:
        address, port = row[1].split(':')
        print(address, int(port, 16))
"""
    rows = [line.split() for line in _ask([], code).splitlines()]
    assert rows
    first = 7400 + 250 * int(os.environ['ROS_DOMAIN_ID'])
    listening = {address for address, port in rows if first <= int(port) < first + 250}
    assert listening == {'0100007F'}  # 127.0.0.1, in the kernel's byte order
