# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Draws the way of data through the package for doc/development.md: one node, one autopilot.

    .venv/bin/python -m benchmarks.pictures.render_data_flow
"""

from dataclasses import dataclass

import matplotlib as mpl

from benchmarks.common import ROOT

mpl.use('agg')
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.patches import FancyBboxPatch

OUT = ROOT / 'doc' / 'img'
COLOURS = {
    'outside': '#e6e6e6', 'ros': '#cfe3f7', 'mavlink': '#f7dccf', 'messages': '#e9e0f5',
    'loop': '#fbf0c4', 'simulation': '#d3efd6', 'plugins': '#bfe3c4', 'sensors': '#d3efd6',
    'recording': '#f5d5e2',
}  # fmt: skip
WIDTH, HEIGHT = 3.1, 1.1


@dataclass(frozen=True)
class Box:
    """A box: column and row of its place, what it does, and the file that does it."""

    column: float
    row: float
    title: str
    file: str
    room: str


NODE = {
    'command': Box(0, 1, 'command topics', 'cmd/thrust, wind, ...', 'outside'),
    'inputs': Box(1, 1, 'takes raw bytes,\nrejects, counts', 'ros/inputs.py', 'ros'),
    'reader': Box(1, 2, 'reads CDR,\nchecks bounds', 'messages/commands.py', 'messages'),
    'runner': Box(2, 1, 'one boundary\nat a time', 'loop/runner.py', 'loop'),
    'pacing': Box(2, 2, 'may it step yet?', 'loop/pacing.py', 'loop'),
    'requests': Box(2, 0, 'services, parameters\nwait in a queue', 'loop/request_queue.py',
                    'loop'),
    'simulation': Box(3, 1, 'commands, events,\nsteps, watchdogs', 'simulation/simulation.py',
                      'simulation'),
    'plugins': Box(3, 2, 'MuJoCo step\nwith fluid forces', 'plugins/src/', 'plugins'),
    'snapshot': Box(4, 1, 'state and wrenches\nof this boundary', 'simulation/engine.py',
                    'simulation'),
    'sensors': Box(4, 2, 'what instruments\nread of it', 'sensors/suite.py', 'sensors'),
    'templates': Box(5, 1, 'patches CDR bytes\nin place', 'messages/state_topics.py', 'messages'),
    'outputs': Box(6, 0.5, 'publishes the bytes', 'ros/outputs.py', 'ros'),
    'recorder': Box(6, 1.7, 'writes the\nsame bytes', 'recording/recorder.py', 'recording'),
    'topics': Box(7, 0.5, 'state topics', 'odom, wrench/total, ...', 'outside'),
    'log': Box(7, 1.7, 'log', '*.mcap', 'outside'),
}  # fmt: skip
NODE_ARROWS = (
    'command inputs', 'inputs reader', 'reader inputs', 'inputs runner', 'requests runner',
    'runner pacing', 'runner simulation', 'simulation plugins', 'plugins simulation',
    'simulation snapshot', 'snapshot sensors', 'snapshot templates', 'sensors templates',
    'templates outputs', 'templates recorder', 'outputs topics', 'recorder log',
)  # fmt: skip
AUTOPILOT = {
    'program': Box(0, 1, 'PX4 or ArduPilot', 'its own process', 'outside'),
    'socket': Box(1, 1, 'receives outputs', 'mavlink/sockets.py', 'mavlink'),
    'bridge': Box(2, 1, 'checks an answer,\ncounts, waits', 'px4.py, ardupilot.py', 'mavlink'),
    'mapping': Box(3, 0.4, 'outputs to newton\nand radian', 'mavlink/mapping.py', 'mavlink'),
    'pacing': Box(3, 1.6, 'steps only after\nthe answer', 'loop/autopilot_port.py', 'loop'),
    'simulation': Box(4, 1, 'commands, steps', 'simulation/simulation.py', 'simulation'),
    'sensors': Box(5, 1, 'readings with noise\nand delay', 'sensors/suite.py', 'sensors'),
    'recorder': Box(6, 1, 'commands and\nstates as on ROS', 'recording/recorder.py', 'recording'),
    'messages': Box(5, 2.4, 'ENU/FLU to NED/FRD,\nbytes of the message',
                    'hil_state, json_packets', 'mavlink'),
    'send': Box(1, 2.4, 'sends the state', 'mavlink/link.py', 'mavlink'),
}  # fmt: skip
AUTOPILOT_ARROWS = (
    'program socket', 'socket bridge', 'bridge mapping', 'bridge pacing', 'mapping simulation',
    'pacing simulation', 'simulation sensors', 'sensors messages', 'messages send',
    'send program', 'sensors recorder',
)  # fmt: skip


def centre(box: Box) -> tuple[float, float]:
    """Return the middle of a box on the page."""
    return box.column * (WIDTH + 0.55), -box.row * (HEIGHT + 0.75)


def draw_box(axes: Axes, box: Box) -> None:
    """Draw one box with its two texts."""
    x, y = centre(box)
    axes.add_patch(
        FancyBboxPatch(
            (x - WIDTH / 2, y - HEIGHT / 2), WIDTH, HEIGHT, boxstyle='round,pad=0.04',
            facecolor=COLOURS[box.room], edgecolor='#555', linewidth=0.8,
        )
    )  # fmt: skip
    axes.text(x, y + 0.16, box.title, ha='center', va='center', fontsize=7.5)
    axes.text(
        x, y - 0.36, box.file, ha='center', va='center', fontsize=6, color='#333',
        family='monospace',
    )  # fmt: skip


def draw_arrow(axes: Axes, start: Box, end: Box, both: bool) -> None:
    """Draw an arrow from edge to edge."""
    (x0, y0), (x1, y1) = centre(start), centre(end)
    reach_x, reach_y = WIDTH / 2 + 0.06, HEIGHT / 2 + 0.06
    if abs(x1 - x0) > 0.1:
        side = 1 if x1 > x0 else -1
        points = (x0 + side * reach_x, y0), (x1 - side * reach_x, y1)
    else:
        side = 1 if y1 > y0 else -1
        points = (x0, y0 + side * reach_y), (x1, y1 - side * reach_y)
    axes.annotate(
        '', points[1], points[0],
        arrowprops={'arrowstyle': '<->' if both else '->', 'color': '#333', 'linewidth': 1.1},
    )  # fmt: skip


def draw(name: str, boxes: dict[str, Box], arrows: tuple[str, ...], title: str) -> None:
    """Write one picture into doc/img."""
    figure, axes = plt.subplots(figsize=(15, 3.6))
    for box in boxes.values():
        draw_box(axes, box)
    for arrow in arrows:
        start, end = arrow.split()
        back = f'{end} {start}' in arrows
        if not back or arrow == min(arrow, f'{end} {start}'):
            draw_arrow(axes, boxes[start], boxes[end], back)
    axes.set_title(title, fontsize=10, loc='left')
    axes.set_aspect('equal')
    axes.autoscale_view()
    axes.margins(0.02)
    axes.axis('off')
    figure.savefig(OUT / f'{name}.png', dpi=110, bbox_inches='tight')
    plt.close(figure)


if __name__ == '__main__':
    draw('data_flow_node', NODE, NODE_ARROWS, 'The node: from a command topic to a state topic')
    draw(
        'data_flow_autopilot', AUTOPILOT, AUTOPILOT_ARROWS,
        'An autopilot: one exchange of the lockstep',
    )  # fmt: skip
