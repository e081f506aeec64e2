# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Time from an odometry's publication to the controller's answer, between two processes.

A publisher sends hover states in ping-pong with child processes, in blocks in turns: an echo that
answers with constant bytes (the floor that the middleware sets on this host), and each
controller. What a controller adds is the difference to the echo: of the medians, of the 10 %
quantiles (what it takes when nothing else wants the processors), and of the processor times of
the children for an answer. With ``--against FOLDER`` the controllers of another checkout take
part in the same run.
"""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import rclpy
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.serialization import serialize_message
from sensor_msgs.msg import JointState

from benchmarks.common import ROOT, arguments, write
from benchmarks.node.round_trips import Asker, echo, quantiles
from fluid_sim_ros.control.multirotor import MultirotorController, PoseTarget
from fluid_sim_ros.control.state import State
from fluid_sim_ros.control.underwater import DepthTarget, UnderwaterController
from fluid_sim_ros.simulation.plant import plant_of

ROUNDS, QUICK_ROUNDS, BLOCK, WARM_UP = 5000, 1000, 100, 200
CASES = {
    'echo': ('', 'x500', 1.5),
    'quad_controller': ('fluid_sim_ros.ros.controllers.quad', 'x500', 1.5),
    'rov_controller': ('fluid_sim_ros.ros.controllers.rov', 'bluerov2_heavy', -5.0),
}
_BEFORE = ' before'


def answer() -> None:
    """Answer each odometry with constant bytes until the process is ended."""
    rclpy.init(args=sys.argv)
    _, vehicle, _ = CASES['echo']
    echo(
        rclpy.create_node('echo'), f'{vehicle}/odom', f'{vehicle}/cmd/thrust_stamped',
        JointState(effort=[5.0] * 4),
    )  # fmt: skip


class Partner:
    """
    A child process that answers, and this end of its topics.

    Parameters
    ----------
    node
        Owner of this end.
    module, vehicle, height
        Controller ('' for the echo), its vehicle, and the height at which that hovers [m].
    namespace, folder
        Of its topics, and the checkout that its code is from.

    """

    def __init__(
        self, node: Node, module: str, vehicle: str, height: float, namespace: str, folder: Path
    ) -> None:
        own = [sys.executable, str(Path(__file__)), '--echo']
        command = [sys.executable, '-m', module] if module else own
        self._child = subprocess.Popen(
            [*command, '--ros-args', '-r', f'__ns:=/{namespace}'], stderr=subprocess.DEVNULL,
            cwd=folder, env={**os.environ, 'PYTHONPATH': str(folder)},
        )  # fmt: skip
        self._clock = (~self._child.pid << 3) | 2  # of its processor time, see clock_getcpuclockid
        topic = f'/{namespace}/{vehicle}'
        self._asker = Asker(node, f'{topic}/odom', f'{topic}/cmd/thrust_stamped', JointState)
        self._state = Odometry()
        self._state.pose.pose.position.z = height
        self._state.pose.pose.orientation.w = 1.0
        self._count = 0
        self.times: list[float] = []
        self.processor_s = 0.0

    def begin(self) -> None:
        """Wait for its first answer, and warm up."""
        deadline = time.monotonic() + 60.0
        while self._once(0.2) is None:
            if time.monotonic() > deadline:
                raise SystemExit(f'no answer from {self._child.args}')
        time.sleep(0.3)  # let answers to repeated first states arrive
        self._asker.forget()
        self.block(WARM_UP)
        self.times, self.processor_s = [], 0.0

    def block(self, rounds: int) -> None:
        """Measure round trips."""
        before = time.clock_gettime(self._clock)
        for _ in range(rounds):
            took = self._once(20.0)
            if took is None:
                raise SystemExit(f'no answer from {self._child.args}')
            self.times.append(took)
        self.processor_s += time.clock_gettime(self._clock) - before

    def _once(self, patience: float) -> float | None:
        self._count += 1
        stamp = self._state.header.stamp
        stamp.sec, stamp.nanosec = divmod(10_000_000 * self._count, 1_000_000_000)
        return self._asker.ask(serialize_message(self._state), patience)

    def end(self) -> None:
        """End the child."""
        self._child.send_signal(signal.SIGTERM)
        self._child.wait(10)

    def row(self) -> dict[str, float]:
        """Return its numbers [us]."""
        processor_us = round(1e6 * self.processor_s / len(self.times), 1)
        return quantiles(self.times) | {'processor_us': processor_us}


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
    options = arguments(__doc__, 'controller_latency', more={'against': 'another checkout, built'})
    os.environ.setdefault('ROS_DOMAIN_ID', str(1 + os.getpid() % 100))
    rounds = QUICK_ROUNDS if options.quick else ROUNDS
    rclpy.init(args=[])
    node = rclpy.create_node('odometry_source')
    wanted = {name: (*case, ROOT) for name, case in CASES.items()}
    if options.against:
        folder = Path(options.against).resolve()
        wanted |= {f'{n}{_BEFORE}': (*case, folder) for n, case in CASES.items() if case[0]}
    partners: dict[str, Partner] = {}
    try:
        for i, (name, (*case, folder)) in enumerate(wanted.items()):
            partners[name] = Partner(node, *case, f'case_{i}', folder)
            partners[name].begin()
        for _ in range(rounds // BLOCK):
            for partner in partners.values():
                partner.block(BLOCK)
    finally:
        for partner in partners.values():
            partner.end()
    rclpy.shutdown()
    rows = {name: partner.row() for name, partner in partners.items()}
    floor = rows['echo']
    for name, row in rows.items():
        row['ratio_to_echo'] = round(row['median_us'] / floor['median_us'], 2)
        row['added_us'] = round(row['median_us'] - floor['median_us'], 1)
        row['added_p10_us'] = round(row['p10_us'] - floor['p10_us'], 1)
        row['added_processor_us'] = round(row['processor_us'] - floor['processor_us'], 1)
        print(f'{name:22}', row)
    before = {name: rows.pop(name) for name in list(rows) if name.endswith(_BEFORE)}
    result = {
        'what': 'round trip odometry -> thrust command between two processes, wall time',
        'rounds': rounds,
        'cases': rows,
        **({'before': before} if before else {}),
        'law_step_us': law_steps(rounds),
    }
    write(options.json, result)
    print('law steps [us]  ', result['law_step_us'])


if __name__ == '__main__':
    if '--echo' in sys.argv:
        answer()
    else:
        main()
