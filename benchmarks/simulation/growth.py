# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
What more of something costs: vehicles, thrusters, waves, panels, topics of a log, subscribers.

Of each, models or runs of several sizes take turns in one run; the fastest processor time of the
thread counts (of the process and its children for logs). "More" is what one more costs between two
neighbouring sizes. Growth is that of the largest two over that of the smallest two: 1 is linear,
less is better; above 1.25 something grows faster than its number. Vehicles are x500, stepped ten
steps a call as the node does; beside ours stands ``mj_step`` of the same model.
Run: ``python -m benchmarks.simulation.growth [--quick] [--json PATH] [--only NAME ...]``.
"""

import json
import os
import resource
import subprocess
import sys
import tempfile
import textwrap
from collections.abc import Callable, Mapping
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from benchmarks.common import arguments, thread_seconds, write
from fluid_sim_ros import Simulation
from test.support.foil_models import foil_world
from test.support.plugin_models import body_plugin, config, ellipsoid, free_body, load, world

Counts = tuple[int, ...]
Costs = dict[int, float]
ROTOR = {
    'curve': 'quadratic', 'thrust_coefficient': 8.5e-6, 'torque_ratio': 0.016, 'rotor_drag': 8e-5,
    'time_constant': [0.0125, 0.025], 'rad_s_max': 1000,
}  # fmt: skip
DOMAIN = '104'
TOPICS = ('odom', 'wrench/total', 'wrench/drag', 'wrench/viscous')  # all at 100 Hz


def fleet(count: int, folder: Path) -> Simulation:
    """Return x500 that hover on a grid."""
    path = folder / f'fleet_{count}.yaml'
    path.write_text(
        'description: x500 on a grid\nmedium: air\nvehicles:\n  v: {model: x500, '
        f'count: {count}, spacing: 3.0, position: [0, 0, 10], keyframe: hover}}\n'
    )
    return Simulation(path)


def rotors(count: int) -> str:
    """Return MJCF of a body with thrusters that have all that they can have."""
    sites, instances, actuators = '', '', ''
    for i in range(count):
        sites += f'<site name="r{i}" pos="{0.1 * i} 0 0"/>'
        instances += f'<instance name="r{i}">{config(ROTOR)}</instance>'
        names = f'plugin="fluid_sim.thruster" instance="r{i}" site="r{i}"'
        actuators += f'<plugin {names} gear="0 0 1 0 0 0" actdim="2"/>'
        actuators += f'<plugin {names} gear="0 0 0 0 0 1"/>'
    inside = f'<inertial pos="0 0 0" mass="2" diaginertia=".1 .1 .1"/>{sites}'
    mjcf = world(free_body(inside), extra=f'<actuator>{actuators}</actuator>')
    return mjcf.replace(
        '</extension>', f'<plugin plugin="fluid_sim.thruster">{instances}</plugin></extension>'
    )


def waves(count: int) -> str:
    """Return MJCF of a buoy in a random sea."""
    inside = ellipsoid([0.3, 0.2, 0.1], 500) + body_plugin(volume='auto', added_mass='auto')
    sea = {
        'density': 1025, 'surface': 0, 'waves': 'jonswap .5 4', 'wave_components': count,
        'density_above': 1.2, 'wave_repeat': 1000,
    }  # fmt: skip
    return world(free_body(inside), medium=sea, gravity=(0, 0, -9.81))


def panels(count: int) -> str:
    """Return MJCF of a wing in panels."""
    return foil_world({'span': 0.5, 'chord': 0.1, 'panels': count})


def fastest(work: Mapping[int, Callable[[], object]], rounds: int) -> Costs:
    """Return the least processor time of each, taken in turns [s]."""
    best = dict.fromkeys(work, np.inf)
    for _ in range(rounds):
        for count, each in work.items():
            best[count] = min(best[count], thread_seconds(each))
    return {count: float(seconds) for count, seconds in best.items()}


def of_models(
    make: Callable[[int], str], counts: tuple[int, ...], rounds: int
) -> dict[int, float]:
    """Return microseconds per step of models."""
    steps = 50
    work: dict[int, Callable[[], object]] = {}
    for count in counts:
        model, data = load(make(count))
        data.qvel[:3], data.ctrl[:] = (1, 0.2, 0.1), 2.0
        work[count] = partial(mujoco.mj_step, model, data, steps)
    return {count: 1e6 * s / steps for count, s in fastest(work, 4 * rounds).items()}


def of_fleets(counts: Counts, rounds: int, *, ours: bool) -> Costs:
    """Return microseconds per step of fleets."""
    work: dict[int, Callable[[], object]] = {}
    with tempfile.TemporaryDirectory() as folder:
        for count in counts:
            simulation = fleet(count, Path(folder))
            model, data = simulation.model, simulation.data
            own = partial(simulation.step, 10)
            block = own if ours else partial(mujoco.mj_step, model, data, 10)
            work[count] = partial(_repeat, block, max(1, 40 // count))
    best = fastest(work, rounds)
    return {count: 1e6 * s / (10 * max(1, 40 // count)) for count, s in best.items()}


def _repeat(block: Callable[[], object], times: int) -> None:
    for _ in range(times):
        block()


def of_logs(counts: Counts, rounds: int) -> Costs:
    """Return microseconds per simulated second of runs that record so many topics at 100 Hz."""
    seconds, best = 120.0, dict.fromkeys(counts, np.inf)
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(max(1, rounds // 13)):
            for count in counts:
                chosen = [f'*/{name}' for name in TOPICS[:count]]
                command = [
                    sys.executable, '-m', 'fluid_sim_ros.cli', 'run', 'x500', '--duration',
                    str(seconds), '--json', f'{folder}/o.json', '--record', f'{folder}/log.mcap',
                    '--record-topics', *chosen,
                ]  # fmt: skip
                Path(folder, 'log.mcap').unlink(missing_ok=True)
                before = _children()
                subprocess.run(command, check=True, capture_output=True)
                best[count] = min(best[count], _children() - before)
    return {count: 1e6 * float(s) / seconds for count, s in best.items()}


def _children() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


# Publishes odometry as bytes to subscribers in this process; prints processor time per message.
PUBLISHER = textwrap.dedent("""
    import json, sys, time
    import rclpy
    from nav_msgs.msg import Odometry
    from rclpy.serialization import serialize_message
    rclpy.init()
    node = rclpy.create_node('growth')
    publisher = node.create_publisher(Odometry, 'odom', 10)
    message, found = serialize_message(Odometry()), {}
    for count in json.loads(sys.argv[1]):
        taken = [node.create_subscription(Odometry, 'odom', print, 10) for _ in range(count)]
        while publisher.get_subscription_count() < count:
            time.sleep(0.05)
        best = float('inf')
        for _ in range(int(sys.argv[2])):
            start = time.thread_time()
            for _ in range(200):
                publisher.publish(message)
            best = min(best, (time.thread_time() - start) / 200)
        found[count] = best * 1e6
        for each in taken:
            node.destroy_subscription(each)
        while publisher.get_subscription_count():
            time.sleep(0.05)
    print(json.dumps(found))
    rclpy.shutdown()
""")


def of_subscribers(counts: Counts, rounds: int) -> Costs:
    """Return microseconds of the publishing thread per message."""
    done = subprocess.run(
        [sys.executable, '-c', PUBLISHER, json.dumps(counts), str(rounds)],
        env={**os.environ, 'ROS_DOMAIN_ID': DOMAIN}, check=True, capture_output=True, text=True,
    )  # fmt: skip
    found: dict[str, float] = json.loads(done.stdout.splitlines()[-1])
    return {int(count): cost for count, cost in found.items()}


def growth(cost: Mapping[int, float]) -> dict[str, Any]:
    """Return what one more costs between neighbours, and how that grows."""
    more = [(cost[b] - cost[a]) / (b - a) for a, b in pairwise(cost)]
    return {
        'cost': {str(count): value for count, value in cost.items()},
        'one_more': more,
        'growth': more[-1] / more[0],
    }


#: Name -> what is counted, unit of the cost, sizes and how they are measured.
FLEETS: Counts = (1, 2, 5, 10, 20, 50, 100)
PARTS: dict[str, tuple[str, Counts, Callable[[Counts, int], Costs]]] = {
    'vehicle': ('us a step', FLEETS, partial(of_fleets, ours=True)),
    'vehicle, mj_step': ('us a step', FLEETS, partial(of_fleets, ours=False)),
    'thruster': ('us a step', (1, 2, 4, 8, 16, 32), partial(of_models, rotors)),
    'wave component': ('us a step', (8, 16, 32, 64, 128, 256), partial(of_models, waves)),
    'foil panel': ('us a step', (1, 2, 4, 8, 16, 32), partial(of_models, panels)),
    'log topic': ('us a second', (1, 2, 4), of_logs),
    'subscriber': ('us a message', (1, 2, 4, 8, 16), of_subscribers),
}


def table(result: Mapping[str, Any]) -> str:
    """Return the costs as a table in Markdown."""
    lines = [
        '| One more | cost of one more, few to many | growth |', '|---|---|---|',
    ]  # fmt: skip
    for name, part in result['parts'].items():
        counts, more = list(part['cost']), part['one_more']
        few, many = (
            f'{cost:.0f}' if cost >= 100 else f'{cost:.2g}' for cost in more[:: len(more) - 1]
        )
        costs = f'{few} ({counts[0]} to {counts[1]}) to {many}'
        sizes = f'({counts[-2]} to {counts[-1]})'
        lines.append(f'| {name} | {costs} {sizes} {part["unit"]} | {part["growth"]:.2f} |')
    return '\n'.join(lines)


def draw(parts: Mapping[str, Any], path: Path) -> None:
    """Draw the cost of each number over that of one."""
    import matplotlib as mpl

    mpl.use('Agg')
    from matplotlib import pyplot as plt

    from fluid_sim_ros.lab.drawing.colors import COLORS
    from fluid_sim_ros.lab.drawing.style import STYLE, save_figure

    with plt.rc_context(STYLE):
        figure, axes = plt.subplots(figsize=(8, 5), layout='constrained')
        for (name, part), color in zip(parts.items(), COLORS, strict=False):
            counts = np.array([int(count) for count in part['cost']])
            cost = np.array(list(part['cost'].values()))
            style = '--' if 'mj_step' in name else '-'
            axes.loglog(counts / counts[0], cost / cost[0], style, marker='o', ms=4, color=color)
            axes.loglog([], [], style, color=color, label=f'{name}, from {counts[0]}')
        ends = np.array([1, 100])
        axes.loglog(ends, ends, ':', color='#555555', label='in proportion')
        axes.set(xlabel='times as many', ylabel='times the cost', title='What more of it costs')
        axes.legend(fontsize=8)
        save_figure(figure, path)


def main() -> None:
    """Measure, print, write JSON and picture."""
    options = arguments(__doc__, 'growth', tuple(PARTS))
    rounds = 8 if options.quick else 40
    kept = json.loads(options.json.read_text())['parts'] if options.only else {}
    parts: dict[str, Any] = {}
    for name, (unit, counts, measure) in PARTS.items():
        if options.only and name not in options.only:
            if name in kept:
                parts[name] = kept[name]
            continue
        sizes = counts[: 4 if options.quick else None]
        parts[name] = {'unit': unit, **growth(measure(sizes, rounds))}
        found = parts[name]
        more = ', '.join(f'{value:.3g}' for value in found['one_more'])
        print(f'{name} [{unit}]: one more {more}; growth {found["growth"]:.2f}')
    own = {name: part['growth'] for name, part in parts.items() if 'mj_step' not in name}
    write(options.json, {'parts': parts, 'largest_growth': max(own.values())})
    if not options.quick:
        draw(parts, options.json.with_suffix('.png'))


if __name__ == '__main__':
    main()
