# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
What a vehicle of a fleet costs: 1, 4, 16 and 50 of them in one model, and ten in the node.

Time per vehicle and step, stepped as the node does: five steps a call, then all states are read.
``call`` is that without reading, ``long`` one call of 100 steps. All counts take turns in one run,
and the medians of their ratios to a fleet of one count. Target: within 25 % of one vehicle. What
grows is MuJoCo's own: ``mj_transmission`` makes a dense Jacobian over all degrees of freedom for
each actuator at a site, and an x500 has eight of those. ``stock``: processor time of as many free
bodies without any plugin, bare and with eight motors of MuJoCo at sites each. The node runs free
with ten x500 and the odometry of all of them at 100 Hz to one subscriber. ``lockstep`` has an x500
for each of several PX4 that answer at once, all in one lockstep: speed, and processor time of an
exchange.
"""

import json
import multiprocessing
import os
import statistics
import subprocess
import sys
import tempfile
import textwrap
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import mujoco

from benchmarks.common import arguments, wall_seconds, write
from benchmarks.node.autopilot_bridge import px4_peer
from fluid_sim_ros import Simulation
from test.support.autopilots.fleet_peers import FleetFlight

COUNTS = (1, 4, 16, 50)
MODELS = {'x500': 'position: [0, 0, 10], keyframe: hover', 'bluerov2': 'position: [0, 0, -5]'}
TARGET = 1.25
DOMAIN, VEHICLES = '103', 10

SUBSCRIBER = textwrap.dedent(f"""
    import rclpy, time
    from nav_msgs.msg import Odometry
    from rclpy.executors import SingleThreadedExecutor
    rclpy.init()
    node = rclpy.create_node('listener')
    counts = [0] * {VEHICLES}
    last = [0.0]
    def counter(i):
        def take(message):
            counts[i] += 1
            last[0] = time.monotonic()
        return take
    for i in range({VEHICLES}):
        node.create_subscription(Odometry, f'v_{{i + 1}}/odom', counter(i), 10, raw=True)
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    print('ready', flush=True)
    while not (last[0] and time.monotonic() - last[0] > 1.0):
        executor.spin_once(timeout_sec=0.1)
    print(counts)
""")

# The node with its loop timed: it waits for the subscriber, then runs the whole duration.
NODE = textwrap.dedent(f"""
    import sys, time
    from fluid_sim_ros.loop import runner
    from fluid_sim_ros.ros import node
    plain = runner.Runner.run
    def timed(self, until=runner.NEVER):
        outputs = self.sinks[0]
        while True:
            outputs.refresh()
            if len(outputs._active) >= {VEHICLES}:
                break
            time.sleep(0.05)
        start = time.perf_counter()
        plain(self, until)
        print(repr((self.simulation.time, time.perf_counter() - start)), flush=True)
    runner.Runner.run = timed
    sys.exit(node.main(sys.argv))
""")


def scene_of(model: str, count: int, folder: Path) -> Path:
    """Return the file of a scene with so many vehicles 3 m apart."""
    path = folder / f'{model}_{count}.yaml'
    entry = f'model: {model}, {MODELS[model]}, count: {count}, spacing: 3'
    path.write_text(f'vehicles: {{v: {{{entry}}}}}\n', encoding='utf-8')
    return path


def loops(simulation: Simulation, steps: int) -> dict[str, Callable[[], None]]:
    """Return the ways in which steps are taken."""

    def as_node() -> None:
        for _ in range(steps // 5):
            simulation.step(5)
            simulation.observe(forces=False)

    def call() -> None:
        for _ in range(steps // 5):
            simulation.step(5)

    def long() -> None:
        for _ in range(steps // 100):
            simulation.step(100)

    return {'as_node': as_node, 'call': call, 'long': long}


def cost(model: str, folder: Path, rounds: int) -> dict[str, Any]:
    """Return the cost of each count [us per vehicle and step] and its ratio to one vehicle."""
    scenes = {0: Simulation(model)}  # the scene of the model alone
    scenes |= {count: Simulation(scene_of(model, count, folder)) for count in COUNTS}
    times: dict[str, dict[int, list[float]]] = {}
    for _ in range(rounds):
        for count, simulation in scenes.items():
            steps = 4000 // max(1, count) // 100 * 100 or 100
            for way, loop in loops(simulation, steps).items():
                simulation.reset()
                per_vehicle = wall_seconds(loop) / steps / max(1, count) * 1e6
                times.setdefault(way, {}).setdefault(count, []).append(per_vehicle)
    return {
        way: {
            str(count) if count else 'single scene': {
                'us_per_vehicle_step': statistics.median(values),
                'ratio': statistics.median(
                    value / one for value, one in zip(values, of_count[1], strict=True)
                ),
            }
            for count, values in of_count.items()
        }
        for way, of_count in times.items()
    }


def stock_model(count: int, motors: int) -> mujoco.MjModel:
    """Return free bodies like an x500, without a plugin, each with motors of MuJoCo at sites."""
    bodies, actuators = [], []
    for i in range(count):
        sites = ''.join(
            f'<site name="s{i}_{k}" pos="{0.17 * (-1) ** k} .17 .06"/>' for k in range(motors)
        )
        actuators += [f'<general site="s{i}_{k}" gear="0 0 1 0 0 .016"/>' for k in range(motors)]
        bodies.append(
            f'<body pos="{3 * i} 0 10"><freejoint/><inertial pos="0 0 0" mass="2" '
            f'diaginertia=".02 .02 .04"/>{sites}</body>'
        )
    return mujoco.MjModel.from_xml_string(
        '<mujoco><option timestep=".002" integrator="implicitfast" density="1.225" '
        f'viscosity="1.79e-5"/><worldbody>{"".join(bodies)}</worldbody>'
        f'<actuator>{"".join(actuators)}</actuator></mujoco>'
    )


def stock(rounds: int) -> dict[str, Any]:
    """Return the processor time of bare bodies and of bodies with motors, over that of one."""
    result: dict[str, Any] = {}
    for name, motors in (('bodies', 0), ('with eight motors', 8)):
        models = {count: stock_model(count, motors) for count in COUNTS}
        data = {count: mujoco.MjData(model) for count, model in models.items()}
        times: dict[int, list[float]] = {count: [] for count in COUNTS}
        for _ in range(rounds):
            for count, model in models.items():
                start, steps = time.process_time(), max(200, 4000 // count)
                mujoco.mj_step(model, data[count], steps)
                times[count].append((time.process_time() - start) / steps / count * 1e6)
        result[name] = {
            str(count): {
                'us_per_body_step': statistics.median(values),
                'ratio': statistics.median(
                    value / one for value, one in zip(values, times[1], strict=True)
                ),
            }
            for count, values in times.items()
        }
    return result


def node(folder: Path, seconds: float) -> dict[str, Any]:
    """Return the real-time factor of the node with ten vehicles, and what arrived."""
    environment = {
        **os.environ, 'ROS_DOMAIN_ID': DOMAIN, 'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST'
    }  # fmt: skip
    with subprocess.Popen(
        [sys.executable, '-c', SUBSCRIBER], stdout=subprocess.PIPE, text=True, env=environment
    ) as listener:
        assert listener.stdout is not None
        listener.stdout.readline()
        settings = {
            'scene': scene_of('x500', VEHICLES, folder), 'pacing': 'free', 'duration': seconds
        }  # fmt: skip
        given = [part for key, value in settings.items() for part in ('-p', f'{key}:={value}')]
        done = subprocess.run(
            [sys.executable, '-c', NODE, '--ros-args', *given],
            capture_output=True, text=True, env=environment, check=True,
        )  # fmt: skip
        simulated, wall = eval(done.stdout.splitlines()[-1], {})  # noqa: S307 - our own repr
        received = json.loads(listener.communicate()[0])
    return {
        'vehicles': VEHICLES, 'odometry_hz': 100, 'real_time_factor': simulated / wall,
        'messages_per_s': sum(received) / wall, 'received_share': sum(received) / (
            VEHICLES * 100 * simulated
        ),
    }  # fmt: skip


def lockstep(count: int, folder: Path, seconds: float) -> dict[str, float]:
    """Return the speed with so many PX4, and the processor time of each of their exchanges."""
    path = folder / f'px4_{count}.yaml'
    entry = f'model: x500, keyframe: ground, autopilot: px4, count: {count}, spacing: 3'
    path.write_text(f'vehicles: {{v: {{{entry}}}}}\n', encoding='utf-8')
    flight = FleetFlight(path)
    peers = [
        multiprocessing.Process(target=px4_peer, args=(port,), daemon=True)
        for port in flight.ports.values()
    ]
    for peer in peers:
        peer.start()
    flight.runner.run(100)  # the first answers, and caches
    begin, spent = time.perf_counter(), time.thread_time()
    flight.runner.run(100 + round(seconds / 0.002))
    wall, spent = time.perf_counter() - begin, time.thread_time() - spent
    for bridge in flight.bridges.values():
        bridge.close()
    for peer in peers:
        peer.terminate()
        peer.join()
    return {
        'real_time_factor': seconds / wall,
        'us_per_exchange_and_vehicle': spent / (seconds * 250 * count) * 1e6,
    }


def main() -> None:
    """Measure and write the result."""
    options = arguments(__doc__, 'fleet', ('cost', 'stock', 'node', 'lockstep'))
    chosen = options.only or ['cost', 'stock', 'node', 'lockstep']
    result = json.loads(options.json.read_text('utf-8')) if options.only else {}
    rounds, seconds = (5, 2.0) if options.quick else (25, 10.0)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        measured: dict[str, Callable[[], Any]] = {
            'cost': lambda: {model: cost(model, folder, rounds) for model in MODELS},
            'stock': lambda: stock(rounds),
            'node': lambda: node(folder, 10.0 if options.quick else 60.0),
            'lockstep': lambda: {str(n): lockstep(n, folder, seconds) for n in (1, 2, 4, 8)},
        }
        result |= {'target_ratio': TARGET} | {part: measured[part]() for part in chosen}
    for model, ways in result['cost'].items():
        for way, rows in ways.items():
            shown = ', '.join(f'{n}: {r["us_per_vehicle_step"]:.2f}' for n, r in rows.items())
            print(f'{model}, {way}: {shown} us; 50 over one {rows["50"]["ratio"]:.3f}')
    for kind, rows in result['stock'].items():
        print(f'stock MuJoCo, {kind}: 50 over one {rows["50"]["ratio"]:.3f}')
    print(f'node with {VEHICLES}: {result["node"]["real_time_factor"]:.1f} times real time')
    for count, row in result['lockstep'].items():
        print(f'{count} PX4 in one lockstep: {row["real_time_factor"]:.1f} times real time')
    stamps = ('commit', 'date', 'mujoco', 'python', 'cpu', 'cores', 'os', 'load_average')
    write(options.json, {key: value for key, value in result.items() if key not in stamps})


if __name__ == '__main__':
    main()
