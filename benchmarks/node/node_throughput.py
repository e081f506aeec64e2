# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Real-time factor of the node: free pacing, rov, 2 ms implicitfast, 100 Hz odom + wrench + clock.

One subscriber process takes all topics. The bare loop (``mj_step`` of the same model) is
timed in this process before and after, and the node's share is against their mean. ``best`` has
the highest real-time factor of all runs, against the fastest bare loop of all. Targets:
real-time factor 150, and 35 % of the bare loop; with RK4 50 %. ``fleets`` has 1, 4 and 10 x500
with odometry and wrench of each at 100 Hz. ``no_thread`` is the same with ``publish.thread:
never``. Where other work keeps the processors busy, wall times say little: the processor times
of a tick (10 ms) say more, of the bare loop, of the thread that steps and of the whole node. With
``--against FOLDER`` the node of another checkout takes part in the same run, in turns.
"""

import json
import os
import subprocess
import sys
import tempfile
import textwrap
import time
from pathlib import Path
from typing import Any

import mujoco

from benchmarks.common import ROOT, arguments, wall_seconds, write
from fluid_sim_ros import Simulation

DOMAIN = '101'
SCENE = 'rov'
FLEETS = (1, 4, 10)
#: A fleet of so many vehicles.
_FLEET = """
medium: air
vehicles:
  swarm: {{model: x500, count: {count}, spacing: 3.0, position: [0, 0, 10], keyframe: hover}}
"""

SUBSCRIBER = textwrap.dedent("""
    import json, rclpy, sys, time
    from geometry_msgs.msg import WrenchStamped
    from nav_msgs.msg import Odometry
    from rclpy.executors import SingleThreadedExecutor
    from rosgraph_msgs.msg import Clock
    rclpy.init()
    node = rclpy.create_node('listener')
    counts = {}
    last = [time.monotonic()]
    def counter(topic):
        counts[topic] = 0
        def take(message):
            counts[topic] += 1
            last[0] = time.monotonic()
        return take
    topics = [(Clock, '/clock')]
    for name in sys.argv[1:]:
        topics += [(Odometry, f'{name}/odom'), (WrenchStamped, f'{name}/wrench/total')]
    for kind, topic in topics:
        node.create_subscription(kind, topic, counter(topic), 10, raw=True)
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    print('ready', flush=True)
    begun = False
    while not (begun and time.monotonic() - last[0] > 1.0):
        executor.spin_once(timeout_sec=0.1)
        begun = begun or any(counts.values())
    print(json.dumps(counts))
""")

# The node with its loop timed: it waits for the subscriber, then runs the whole duration.
NODE = textwrap.dedent("""
    import sys, time
    from fluid_sim_ros.loop import runner
    from fluid_sim_ros.ros import node
    plain = runner.Runner.run
    def timed(self, until=runner.NEVER):
        outputs = self.sinks[0]
        while True:
            outputs.refresh()
            if len(outputs._active) >= WANTED:
                break
            time.sleep(0.05)
        clocks = time.perf_counter, time.thread_time, time.process_time
        start = [clock() for clock in clocks]
        plain(self, until)
        took = [clock() - begun for clock, begun in zip(clocks, start)]
        if hasattr(outputs, 'published'):
            published = {name: n for name, n in outputs.published().items() if n}
        else:  # of an earlier version
            published = {t.name: t.published for t in outputs.topics if t.published}
        print(repr((self.simulation.time, *took, published)), flush=True)
    runner.Runner.run = timed
    sys.exit(node.main(sys.argv))
""")


def bare_loop(scene: str, integrator: str, seconds: float) -> tuple[float, float]:
    """
    Return the real-time factor of mj_step alone, five steps a call.

    And the processor time of a tick [s].
    """
    simulation = Simulation(scene, timestep=0.002, integrator=integrator)
    calls = round(seconds / 0.01)

    def loop() -> None:
        for _ in range(calls):
            mujoco.mj_step(simulation.model, simulation.data, 5)

    begun = time.thread_time()
    wall = wall_seconds(loop)
    return seconds / wall, (time.thread_time() - begun) / calls


def measure(
    seconds: float,
    scene: str = SCENE,
    integrator: str = 'implicitfast',
    thread: str = 'auto',
    folder: Path = ROOT,
) -> dict[str, Any]:
    """Return the node's real-time factor beside that of the bare loop."""
    environment = {
        **os.environ, 'ROS_DOMAIN_ID': DOMAIN, 'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
        'PYTHONPATH': str(folder),
    }  # fmt: skip
    vehicles = list(Simulation(scene).vehicles)
    before, bare_s = bare_loop(scene, integrator, seconds / 4)
    listener = subprocess.Popen(
        [sys.executable, '-c', SUBSCRIBER, *vehicles],
        stdout=subprocess.PIPE, text=True, env=environment, cwd=folder,
    )  # fmt: skip
    assert listener.stdout is not None
    listener.stdout.readline()
    settings = {
        'scene': scene, 'timestep': 0.002, 'integrator': integrator.lower(), 'pacing': 'free',
        'duration': seconds, **({} if thread == 'auto' else {'publish.thread': thread}),
    }  # fmt: skip
    arguments = [part for key, value in settings.items() for part in ('-p', f'{key}:={value}')]
    program = f'WANTED = {1 + 2 * len(vehicles)}\n{NODE}'
    node = subprocess.run(
        [sys.executable, '-c', program, '--ros-args', *arguments],
        capture_output=True, text=True, env=environment, check=False, cwd=folder,
    )  # fmt: skip
    if node.returncode:
        listener.kill()  # it would wait for ever
        raise SystemExit(f'the node ended with code {node.returncode}:\n{node.stderr}')
    simulated, wall, stepping_s, node_s, published = eval(node.stdout.splitlines()[-1], {})  # noqa: S307 - our own repr
    received = json.loads(listener.communicate()[0])
    after, bare_after_s = bare_loop(scene, integrator, seconds / 4)
    bare, bare_s = (before + after) / 2, (bare_s + bare_after_s) / 2
    return {
        'integrator': integrator,
        'vehicles': len(vehicles),
        'real_time_factor': simulated / wall,
        'bare_real_time_factor': bare,
        'share_of_bare': simulated / wall / bare,
        'overhead_us_per_tick': (wall / simulated - 1 / bare) * 0.01 * 1e6,
        'processor_us_per_tick': {
            'bare': 1e6 * bare_s,
            'stepping_thread': 1e4 * stepping_s / simulated,
            'node': 1e4 * node_s / simulated,
        },
        'published': published,
        'received': received,
    }


def fleets(seconds: float) -> dict[str, Any]:
    """Return the same of 1, 4 and 10 vehicles."""
    rows = {}
    with tempfile.TemporaryDirectory() as folder:
        for count in FLEETS:
            scene = Path(folder, f'fleet_{count}.yaml')
            scene.write_text(_FLEET.format(count=count), encoding='utf-8')
            rows[str(count)] = measure(seconds, str(scene))
    return rows


def main() -> None:
    """Measure and write the result."""
    options = arguments(__doc__, 'node_throughput', more={'against': 'another checkout, built'})
    seconds, rounds = (50.0, 1) if options.quick else (60.0, 5)
    kinds: dict[str, dict[str, Any]] = {'runs': {}, 'no_thread': {'thread': 'never'}}
    if options.against:
        kinds['before'] = {'folder': Path(options.against).resolve()}
    found: dict[str, list[dict[str, Any]]] = {}
    for _ in range(rounds):  # in turns
        for integrator, suffix in (('implicitfast', ''), ('RK4', '_rk4')):
            for kind, more in kinds.items():
                row = measure(seconds, integrator=integrator, **more)
                found.setdefault(kind + suffix, []).append(row)
                tell(kind, row)
    best, best_rk4 = (fastest(found, suffix) for suffix in ('', '_rk4'))
    many = fleets(seconds / 2)
    for row in many.values():
        tell('fleet', row)
    write(
        options.json,
        {
            'target_real_time_factor': 150,
            'target_share_of_bare': 0.35,
            'target_share_of_bare_rk4': 0.5,
            'best': best,
            'best_rk4': best_rk4,
            **found,
            'fleets': many,
        },
    )


def fastest(found: dict[str, list[dict[str, Any]]], suffix: str) -> dict[str, Any]:
    """Return the run with the highest real-time factor, beside the fastest bare loop of all."""
    kinds = [name + suffix for name in ('runs', 'no_thread', 'before') if name + suffix in found]
    bare = max(row['bare_real_time_factor'] for kind in kinds for row in found[kind])
    best = max(found['runs' + suffix], key=lambda run: run['real_time_factor'])
    return {
        **best, 'bare_real_time_factor': bare, 'share_of_bare': best['real_time_factor'] / bare
    }  # fmt: skip


def tell(kind: str, row: dict[str, Any]) -> None:
    """Print the main numbers of a run."""
    times = {name: round(us, 1) for name, us in row['processor_us_per_tick'].items()}
    print(
        f'{kind}, {row["integrator"]}, {row["vehicles"]} vehicle(s): real-time factor '
        f'{row["real_time_factor"]:.0f}, {row["share_of_bare"]:.0%} of bare mj_step; processor '
        f'[us per tick]: {times}',
        flush=True,
    )


if __name__ == '__main__':
    main()
