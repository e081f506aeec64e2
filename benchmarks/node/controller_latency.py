# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Time from an odometry's publication to the controller's answer, between two processes.

A publisher sends hover states in ping-pong with a child process: first with an echo that answers
with constant bytes (the floor that the middleware sets on this host), then with each controller.
The ratio to the echo is what the controller adds. Run:
``python -m benchmarks.node.controller_latency [--quick] [--json PATH]``.
"""

import argparse
import os
import signal
import statistics
import subprocess
import sys
import time
from pathlib import Path

import rclpy
from nav_msgs.msg import Odometry
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.serialization import serialize_message
from sensor_msgs.msg import JointState

from benchmarks.common import RESULTS, write
from fluid_sim_ros.control.multirotor import MultirotorController, PoseTarget
from fluid_sim_ros.control.state import State
from fluid_sim_ros.control.underwater import DepthTarget, UnderwaterController
from fluid_sim_ros.simulation.plant import plant_of

RESULT = RESULTS / 'controller_latency.json'
ROUNDS, QUICK_ROUNDS, WARM_UP = 5000, 1000, 200
RELIABLE = QoSProfile(depth=10, reliability=ReliabilityPolicy.RELIABLE)
CASES = {
    'echo': (None, 'x500', 1.5),
    'quad_controller': ('fluid_sim_ros.ros.controllers.quad', 'x500', 1.5),
    'rov_controller': ('fluid_sim_ros.ros.controllers.rov', 'bluerov2_heavy', -5.0),
}


def echo() -> None:
    """Answer each odometry with constant bytes until the process is ended."""
    rclpy.init(args=[])
    node = rclpy.create_node('echo')
    inward = node.create_subscription(Odometry, 'x500/odom', lambda _: None, RELIABLE, raw=True)
    outward = node.create_publisher(JointState, 'x500/cmd/thrust_stamped', RELIABLE).handle
    answer = serialize_message(JointState(effort=[5.0] * 4))
    waiting = _rclpy.WaitSet(1, 0, 0, 0, 0, 0, node.context.handle)
    while rclpy.ok():
        waiting.clear_entities()
        waiting.add_subscription(inward.handle)
        waiting.wait(int(5e7))
        while inward.handle.take_message(Odometry, True):
            outward.publish_raw(answer)


def ping_pong(vehicle: str, height: float, rounds: int) -> list[float]:
    """Return the time of each round trip [s]."""
    node = rclpy.create_node('odometry_source')
    source = node.create_publisher(Odometry, f'{vehicle}/odom', RELIABLE).handle
    answers = node.create_subscription(
        JointState, f'{vehicle}/cmd/thrust_stamped', lambda _: None, RELIABLE, raw=True
    )
    waiting = _rclpy.WaitSet(1, 0, 0, 0, 0, 0, node.context.handle)
    state = Odometry()
    state.pose.pose.position.z = height
    state.pose.pose.orientation.w = 1.0
    times = []
    for i in range(rounds + WARM_UP):
        state.header.stamp.sec, state.header.stamp.nanosec = divmod(10_000_000 * i, 1_000_000_000)
        data = serialize_message(state)
        begin = time.perf_counter()
        source.publish_raw(data)
        deadline = begin + 20.0
        while not answers.handle.take_message(JointState, True):
            waiting.clear_entities()
            waiting.add_subscription(answers.handle)
            waiting.wait(int(1e8))
            now = time.perf_counter()
            if now > deadline:
                raise SystemExit(f'no answer from the controller of {vehicle}')
            if i == 0:
                source.publish_raw(data)  # the child may have joined after the first
        times.append(time.perf_counter() - begin)
        if i == 0:
            time.sleep(0.3)  # let answers to repeated first states arrive
            while answers.handle.take_message(JointState, True):
                pass
    node.destroy_node()
    return times[WARM_UP:]


def measure(module: str | None, vehicle: str, height: float, rounds: int) -> list[float]:
    """Run one child and return the round-trip times [s]."""
    own = [sys.executable, str(Path(__file__)), '--echo']
    command = [sys.executable, '-m', module] if module else own
    child = subprocess.Popen(command, stderr=subprocess.DEVNULL)
    try:
        return ping_pong(vehicle, height, rounds)
    finally:
        child.send_signal(signal.SIGTERM)
        child.wait(10)


def law_steps(rounds: int) -> dict[str, float]:
    """Return the time of one step of each control law, without ROS [us]."""
    quad = MultirotorController(plant_of('quadrotor', '')[0])
    rov = UnderwaterController(plant_of('rov', '')[0])
    pose, still = ((0.1, 0.2, 1.4), (1.0, 0.01, 0.02, 0.03)), (0.0, 0.0, 0.0)
    laws = {
        'MultirotorController': lambda t: quad.step(
            State(t, *pose, still, still), PoseTarget((0, 0, 1.5), 0.1)
        ),
        'UnderwaterController': lambda t: rov.step(
            State(t, *pose, still, still), DepthTarget(-1.5, 0.1)
        ),
    }
    result = {}
    for name, law in laws.items():
        best = float('inf')
        for block in range(5):
            begin = time.perf_counter()
            for i in range(rounds):
                law((block * rounds + i) * 0.01)
            best = min(best, (time.perf_counter() - begin) / rounds)
        result[name] = round(1e6 * best, 1)
    return result


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or '').split('\n\n')[0])
    parser.add_argument('--json', type=Path, default=RESULT, help='where to write the result')
    parser.add_argument('--quick', action='store_true', help=f'{QUICK_ROUNDS} rounds each')
    parser.add_argument('--echo', action='store_true', help=argparse.SUPPRESS)
    options = parser.parse_args()
    os.environ.setdefault('ROS_DOMAIN_ID', str(1 + os.getpid() % 100))
    os.environ.setdefault('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    if options.echo:
        echo()
    rounds = QUICK_ROUNDS if options.quick else ROUNDS
    rclpy.init(args=[])
    rows: dict[str, dict[str, float]] = {}
    for name, (module, vehicle, height) in CASES.items():
        times = sorted(measure(module, vehicle, height, rounds))
        median = statistics.median(times)
        rows[name] = {
            'median_us': round(1e6 * median, 1),
            'p99_us': round(1e6 * times[int(0.99 * len(times))], 1),
        }
        rows[name]['ratio_to_echo'] = round(rows[name]['median_us'] / rows['echo']['median_us'], 2)
        rows[name]['added_us'] = round(rows[name]['median_us'] - rows['echo']['median_us'], 1)
        print(f'{name:16}', rows[name])
    rclpy.shutdown()
    result = {
        'what': 'round trip odometry -> thrust command between two processes, wall time',
        'rounds': rounds,
        'cases': rows,
        'law_step_us': law_steps(rounds),
    }
    write(options.json, result)
    print('law steps [us]  ', result['law_step_us'])


if __name__ == '__main__':
    main()
