# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Time from a state's publication to its answer within the node in lockstep, with and without thread.

The answers come from an echo that sends constant bytes (``lockstep.match: count``). ``floor`` is
the same echo and the same message from a bare publisher that does nothing else. From the first
byte at the middleware to the answer taken: median and 99 %, over runs in turns. A subscriber
wants the wrenches, too, which the node evaluates while the echo answers.
"""

import json
import os
import statistics
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import rclpy
from geometry_msgs.msg import WrenchStamped
from nav_msgs.msg import Odometry
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.serialization import serialize_message
from std_msgs.msg import Float64MultiArray

from benchmarks.common import arguments, write

STATES, QUICK_STATES, TURNS = 1000, 300, 5
RELIABLE = QoSProfile(depth=10, reliability=ReliabilityPolicy.RELIABLE)
PERIOD = 0.01

# The node; each time from the begin of a tick's messages to the answer, as JSON at its end.
NODE = """
import json, sys, time
from fluid_sim_ros.loop.pacing import Lockstep
from fluid_sim_ros.ros import node
from fluid_sim_ros.ros.outputs import Outputs
write, meet, begun, times = Outputs.write, Lockstep.meet, [0.0], []
def timed_write(self, simulation):
    begun[0] = time.perf_counter()
    write(self, simulation)
def timed_meet(self, simulation, source):
    met = meet(self, simulation, source)
    if met:
        times.append(time.perf_counter() - begun[0])
    return met
Outputs.write, Lockstep.meet = timed_write, timed_meet
code = node.main(sys.argv)
print(json.dumps(times))
sys.exit(code)
"""


def echo() -> None:
    """Answer each odometry with constant thrusts until the process is ended."""
    rclpy.init(args=sys.argv)
    node = rclpy.create_node('echo')
    vehicle = 'bluerov2_heavy'
    inward = node.create_subscription(
        Odometry, f'{vehicle}/odom', lambda _: None, RELIABLE, raw=True
    )
    node.create_subscription(
        WrenchStamped, f'{vehicle}/wrench/total', lambda _: None, RELIABLE, raw=True
    )
    outward = node.create_publisher(Float64MultiArray, f'{vehicle}/cmd/thrust', RELIABLE).handle
    answer = serialize_message(Float64MultiArray(data=[0.0] * 8))
    waiting = _rclpy.WaitSet(1, 0, 0, 0, 0, 0, node.context.handle)
    print('ready', flush=True)
    while rclpy.ok():
        waiting.clear_entities()
        waiting.add_subscription(inward.handle)
        waiting.wait(int(5e7))
        while inward.handle.take_message(Odometry, True):
            outward.publish_raw(answer)


def bare(states: int) -> list[float]:
    """Return round trips of a publisher that does nothing else [s]."""
    node = rclpy.create_node('bare')
    source = node.create_publisher(Odometry, 'bluerov2_heavy/odom', RELIABLE).handle
    answers = node.create_subscription(
        Float64MultiArray, 'bluerov2_heavy/cmd/thrust', lambda _: None, RELIABLE, raw=True
    ).handle
    waiting = _rclpy.WaitSet(1, 0, 0, 0, 0, 0, node.context.handle)
    data = serialize_message(Odometry())
    times = []
    while len(times) < states:
        begin = time.perf_counter()
        source.publish_raw(data)
        while not (answered := answers.take_message(Float64MultiArray, True)):
            waiting.clear_entities()
            waiting.add_subscription(answers)
            waiting.wait(int(1e8))
            if time.perf_counter() > begin + 0.2:  # nobody was there yet
                break
        if answered:
            times.append(time.perf_counter() - begin)
    node.destroy_node()
    return times


def in_the_node(thread: str, states: int) -> list[float]:
    """Return the times of a node in lockstep [s]."""
    settings = {
        'scene': 'rov', 'pacing': 'lockstep', 'lockstep.match': 'count',
        'lockstep.period': PERIOD, 'duration': states * PERIOD, 'publish.thread': thread,
    }  # fmt: skip
    words = [part for key, value in settings.items() for part in ('-p', f'{key}:={value}')]
    done = subprocess.run(
        [sys.executable, '-c', NODE, '--ros-args', *words],
        capture_output=True, text=True, check=False, timeout=300,
    )  # fmt: skip
    if done.returncode:
        raise SystemExit(done.stderr)
    times: list[float] = json.loads(done.stdout.splitlines()[-1])
    return times


def row(times: list[float]) -> dict[str, Any]:
    """Return median and 99 % quantile [us]."""
    ordered = sorted(times)
    return {
        'median_us': round(1e6 * statistics.median(ordered), 1),
        'p10_us': round(1e6 * ordered[len(ordered) // 10], 1),
        'p99_us': round(1e6 * ordered[int(0.99 * len(ordered))], 1),
    }


def main() -> None:
    """Measure and write the result."""
    options = arguments(__doc__, 'lockstep_latency')
    os.environ.setdefault('ROS_DOMAIN_ID', str(1 + os.getpid() % 100))
    states = QUICK_STATES if options.quick else STATES
    rclpy.init(args=[])
    child = subprocess.Popen(
        [sys.executable, str(Path(__file__)), '--echo'], stdout=subprocess.PIPE, text=True
    )
    assert child.stdout is not None
    child.stdout.readline()
    found: dict[str, list[float]] = {'floor': [], 'never': [], 'always': []}
    try:
        for _ in range(TURNS):
            found['floor'] += bare(states)
            for thread in ('never', 'always'):
                found[thread] += in_the_node(thread, states)[10:]
    finally:
        child.terminate()
        child.wait(10)
    rclpy.shutdown()
    rows = {name: row(times) for name, times in found.items()}
    for name, numbers in rows.items():
        numbers['added_us'] = round(numbers['median_us'] - rows['floor']['median_us'], 1)
        print(f'{name:8}', numbers)
    write(options.json, {'states': states * TURNS, 'publish_thread': rows})


if __name__ == '__main__':
    if '--echo' in sys.argv:
        echo()
    else:
        main()
