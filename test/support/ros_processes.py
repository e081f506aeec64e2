# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A real node in a process of its own, and a peer in the test's process, over real DDS."""

import math
import re
import signal
import subprocess
import sys
import threading
import time
from collections import deque
from itertools import takewhile
from pathlib import Path

import numpy as np
import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

from test.support.forked import Fork

#: Longest wait for something that takes well under a second on an idle machine [s].
PATIENCE = 30.0
NODE = 'fluid_sim_ros.ros.node'


class Process:
    """A Python module run as a process; its output is kept and shown when a test fails."""

    def __init__(self, module, *arguments, **parameters):
        words = list(arguments)
        if parameters and '--ros-args' not in words:
            words.append('--ros-args')
        for key, value in parameters.items():
            words += ['-p', f'{key}:={_yaml(value)}']
        self.lines = []
        self._process = self._start(module, words)
        self.pid = self._process.pid
        self._reader = threading.Thread(target=self._read)
        self._reader.start()

    def _start(self, module, words):
        return subprocess.Popen(
            [sys.executable, '-m', module, *words], stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, text=True,
        )  # fmt: skip

    def _read(self):
        for line in self._process.stdout:
            self.lines.append(line.rstrip())

    @property
    def output(self):
        return '\n'.join(self.lines)

    @property
    def alive(self):
        return self._process.poll() is None

    def signal(self, number):
        self._process.send_signal(number)

    def wait(self, timeout=PATIENCE):
        """Return the exit code."""
        code = self._process.wait(timeout)
        self._reader.join()
        return code

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.alive:
            self.signal(signal.SIGINT)
            try:
                self.wait(10)
            except subprocess.TimeoutExpired:
                self._process.kill()
        self._reader.join()
        sys.stdout.write(self.output)


class Forked(Process):
    """As ``Process``, without the time that a fresh one takes to import: see ``forked``."""

    def _start(self, module, words):
        return Fork(module, *words)


def _yaml(value):
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, Path):
        return str(value)
    return value


def node(start=Forked, **parameters):
    """Start the simulator node; keys use ``__`` for the dot of a parameter name."""
    return start(NODE, **{key.replace('__', '.'): value for key, value in parameters.items()})


def controller(kind, **parameters):
    """Start an example controller: ``quad``, ``rov``, ``auv`` or ``plane``."""
    return Forked(f'fluid_sim_ros.ros.controllers.{kind}', **parameters)


class Peer:
    """A ROS node in this process, with a context of its own and an executor in a thread."""

    def __init__(self, name='peer', **settings):
        self.context = Context()
        rclpy.init(context=self.context)
        self.node = rclpy.create_node(name, context=self.context, **settings)
        self._executor = SingleThreadedExecutor(context=self.context)
        self._executor.add_node(self.node)
        self._thread = threading.Thread(target=self._spin)
        self._thread.start()
        self.diagnostics = {}
        self._clients = {}

    def _spin(self):
        while self.context.ok() and not getattr(self, '_closing', False):
            self._executor.spin_once(timeout_sec=0.05)

    def collect(self, message, topic, depth=1000, reliable=True, latched=False):
        """Return a list that fills with the messages of a topic."""
        received = []
        qos = QoSProfile(
            depth=depth,
            reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
            durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
        )
        self.node.create_subscription(message, topic, received.append, qos)
        return received

    def publisher(self, message, topic, depth=1):
        """Return a publisher that has found its subscriber."""
        publisher = self.node.create_publisher(message, topic, depth)
        wait_until(lambda: publisher.get_subscription_count() > 0, f'a subscriber of {topic}')
        return publisher

    def watch_diagnostics(self):
        """Keep the newest diagnostic status of each part in ``diagnostics``."""

        def take(message):
            for status in message.status:
                part = status.name.partition(': ')[2]
                values = {pair.key: pair.value for pair in status.values}
                level = int.from_bytes(status.level, 'little')
                self.diagnostics[part] = (level, status.message, values)

        self.node.create_subscription(DiagnosticArray, '/diagnostics', take, 10)

    def call(self, service, name, **fields):
        """Call a service and return its response."""
        # one for all calls: an answer to a new one is lost while its peer has not found it yet
        if name not in self._clients:
            self._clients[name] = self.node.create_client(service, name)
            assert self._clients[name].wait_for_service(PATIENCE), f'no service {name}'
            time.sleep(0.2)
        client = self._clients[name]
        assert client.wait_for_service(PATIENCE), f'no service {name}'
        future = client.call_async(service.Request(**fields))
        wait_until(future.done, f'an answer of {name}')
        return future.result()

    def close(self):
        self._closing = True
        self._thread.join()
        self._executor.shutdown()
        self.node.destroy_node()
        rclpy.shutdown(context=self.context)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def wait_until(condition, what, timeout=PATIENCE):
    """Wait until a condition holds, or fail saying what was waited for."""
    deadline = time.monotonic() + timeout
    while not condition():
        if time.monotonic() > deadline:
            raise AssertionError(f'waited {timeout:g} s in vain for {what}')
        time.sleep(0.01)


def place_of(odometry):
    """Return position [m] and heading [rad], shape (4,)."""
    p, q = odometry.pose.pose.position, odometry.pose.pose.orientation
    return np.array([p.x, p.y, p.z, 2 * math.atan2(q.z, q.w)])


def reach(states, seconds):
    """Wait until the states have come this far; return the place then, since any reset."""
    wait_until(lambda: states and stamp_ns(states[-1]) > seconds * 1e9, f'{seconds} s')
    later = takewhile(lambda state: stamp_ns(state) > seconds * 1e9, reversed(list(states)))
    return place_of(deque(later, maxlen=1).pop())


def stamp_ns(message):
    """Return a message's stamp [ns]."""
    stamp = message.header.stamp if hasattr(message, 'header') else message.clock
    return stamp.sec * 1_000_000_000 + stamp.nanosec


def error_lines(output):
    """Return the error lines of a node's output."""
    return [line for line in output.splitlines() if re.search(r'error:|\[ERROR\]|Traceback', line)]
