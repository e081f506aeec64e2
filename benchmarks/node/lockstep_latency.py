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
import subprocess
import sys
from pathlib import Path

import rclpy
from geometry_msgs.msg import WrenchStamped
from nav_msgs.msg import Odometry
from rclpy.serialization import serialize_message
from std_msgs.msg import Float64MultiArray

from benchmarks.common import arguments, write
from benchmarks.node.round_trips import RELIABLE, Asker, echo, quantiles

STATES, QUICK_STATES, TURNS = 1000, 300, 5
PERIOD = 0.01
VEHICLE = 'bluerov2_heavy'
ODOMETRY, COMMAND = f'{VEHICLE}/odom', f'{VEHICLE}/cmd/thrust'

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


def answer() -> None:
    """Answer each odometry with constant thrusts until the process is ended."""
    rclpy.init(args=sys.argv)
    node = rclpy.create_node('echo')
    node.create_subscription(
        WrenchStamped, f'{VEHICLE}/wrench/total', lambda _: None, RELIABLE, raw=True
    )
    print('ready', flush=True)
    echo(node, ODOMETRY, COMMAND, Float64MultiArray(data=[0.0] * 8))


def bare(states: int) -> list[float]:
    """Return round trips of a publisher that does nothing else [s]."""
    node = rclpy.create_node('bare')
    asker = Asker(node, ODOMETRY, COMMAND, Float64MultiArray)
    data = serialize_message(Odometry())
    times: list[float] = []
    while len(times) < states:
        took = asker.ask(data, 0.2)
        if took is not None:  # somebody was there
            times.append(took)
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
    rows = {name: quantiles(times) for name, times in found.items()}
    for name, numbers in rows.items():
        numbers['added_us'] = round(numbers['median_us'] - rows['floor']['median_us'], 1)
        print(f'{name:8}', numbers)
    write(options.json, {'states': states * TURNS, 'publish_thread': rows})


if __name__ == '__main__':
    if '--echo' in sys.argv:
        answer()
    else:
        main()
