"""
``fluid_sim demo``: a quadrotor holds its place in a gust, over real ROS 2.

The simulator and the controller run as two processes in lockstep; this process records what they
publish, prints a table and writes plots and a summary.
"""

import argparse
import json
import math
import secrets
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from geometry_msgs.msg import TwistStamped, WrenchStamped
from nav_msgs.msg import Odometry
from numpy.typing import NDArray
from rich.console import Console
from rich.table import Table
from sensor_msgs.msg import JointState

from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.ros import demo_plots
from fluid_sim_ros.ros.children import Child
from fluid_sim_ros.ros.recorder import Recorder
from fluid_sim_ros.ros.states import read_odometry
from fluid_sim_ros.scene import Scene

SCENE, VEHICLE = 'quadrotor', 'x500'
#: x, y, z [m], yaw [rad], hold [s]: home, and after 3 s a place to the north-east, looking at it.
WAYPOINTS = ((0.0, 0.0, 1.5, 0.0, 3.0), (3.0, 2.0, 2.5, 0.6, 0.0))
#: Domains to choose from: their UDP ports stay below the ephemeral ports of Linux.
_DOMAINS = range(1, 101)
#: Longest wait for the first state, and for the next one during the run [s, wall].
_START_PATIENCE, _PATIENCE = 30.0, 15.0
#: Settling time before an error counts as that of the hold, after a waypoint or gust [s].
_SETTLED = 5.0
#: Sleep between two looks at what has arrived [s].
_PAUSE = 0.05
_TOPICS = {
    'odom': Odometry,
    'wrench/total': WrenchStamped,
    'wrench/drag': WrenchStamped,
    'wrench/viscous': WrenchStamped,
    'medium/wind': TwistStamped,
    'joint_states': JointState,
}
_ODOMETRY = f'{VEHICLE}/odom'

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Recording:
    """
    What was published: rows by time, first column the stamp [s].

    Attributes
    ----------
    odometry
        Position [m], quaternion wxyz, velocity [m/s] and rate [rad/s] in base_link axes.
    fluid, drag, viscous
        Force [N] and torque [N m] of the fluid on the vehicle, base_link axes.
    wind
        Velocity of the air at the vehicle [m/s], world axes (and three zeros).
    thrust
        Thrust of each rotor [N].
    gust
        Begin and end [s].
    wall
        Wall time from the first state after time 0 to the last [s].

    """

    odometry: Array
    fluid: Array
    drag: Array
    viscous: Array
    wind: Array
    thrust: Array
    gust: tuple[float, float]
    wall: float


def main(argv: Sequence[str] | None = None) -> int:
    """Run the demo; returns the exit code."""
    options = _parser().parse_args(argv)
    if not (math.isfinite(options.duration) and options.duration > 0):
        raise FluidSimError(f'--duration {options.duration:g}: must be finite and above 0 s')
    console = Console(stderr=options.json == '-')
    out: Path = options.out
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FluidSimError(f'--out {out}: {error.strerror}') from None
    console.print(
        f'Simulator and controller as two ROS 2 processes, {options.duration:g} simulated seconds '
        '...'
    )
    recording = record(out, options.duration)
    result = summary(recording)
    pictures = [
        demo_plots.trajectory(recording, targets(recording), out / 'trajectory.png'),
        demo_plots.wrench(recording, out / 'wrench.png'),
    ]
    text = json.dumps(result, indent=2) + '\n'
    (out / 'summary.json').write_text(text, encoding='utf-8')
    console.print(_table(result))
    console.print(f'Plots: {", ".join(map(str, pictures))}', soft_wrap=True)
    console.print(f'Summary: {out / "summary.json"}; logs: {out}/*.log', soft_wrap=True)
    _write_json(options.json, text)
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog='fluid_sim demo', description=(__doc__ or '').strip())
    parser.add_argument(
        '--out', type=Path, default=Path('out/demo'), help='folder of the results (%(default)s)'
    )
    parser.add_argument(
        '--duration', type=float, default=30.0, metavar='S', help='simulated time (%(default)s s)'
    )
    parser.add_argument('--json', metavar='PATH', help='also write the summary; - = stdout')
    return parser


def _write_json(path: str | None, text: str) -> None:
    if path == '-':
        sys.stdout.write(text)
    elif path:
        Path(path).write_text(text, encoding='utf-8')


# ---- the run ---------------------------------------------------------------------------------


def record(out: Path, duration: float) -> Recording:
    """
    Run simulator and controller and return what they published.

    Raises
    ------
    FluidSimError
        If a process dies or stops answering; the line holds the last it wrote.

    """
    topics = {f'{VEHICLE}/{leaf}': kind for leaf, kind in _TOPICS.items()}
    with _recorder(topics) as (recorder, domain), _children(out, domain, duration) as children:
        _follow(recorder, children)
        rows = [recorder.rows(topic) for topic in topics]
        wall = _wall_time(recorder)
    odometry, fluid, drag, viscous, wind, thrust = rows
    return Recording(odometry, fluid, drag, viscous, wind, thrust, gust_of_scene(), wall)


def _follow(recorder: Recorder, children: '_Children') -> None:
    """Take messages until the simulator ends."""
    # in lockstep the simulator holds at time 0 until the controller is there, so that no state
    # is missed once every topic has delivered
    _wait_for(
        recorder, children, lambda: all(recorder.messages.values()),
        'the simulator has published no state',
    )  # fmt: skip
    children.start_controller()
    _wait_for(
        recorder, children, lambda: _last_stamp_ns(recorder) > 0,
        'the controller has answered no state',
    )  # fmt: skip
    heard = time.perf_counter()
    while children.simulator.running:
        children.check()
        if recorder.take(_PAUSE):
            heard = time.perf_counter()
        elif time.perf_counter() - heard > _PATIENCE:
            raise FluidSimError(
                f'no state for {_PATIENCE:g} s of wall time; {children.simulator.last_words()}'
            )
    while recorder.take(_PAUSE):
        pass
    children.check()


def _last_stamp_ns(recorder: Recorder) -> int:
    return read_odometry(recorder.messages[_ODOMETRY][-1]).stamp_ns


def _wall_time(recorder: Recorder) -> float:
    """Return the wall time from the first state after time 0 to the last [s]."""
    messages, sent_ns = recorder.messages[_ODOMETRY], recorder.sent_ns[_ODOMETRY]
    moving = next(i for i, data in enumerate(messages) if read_odometry(data).stamp_ns > 0)
    return (sent_ns[-1] - sent_ns[moving]) * 1e-9


def _wait_for(
    recorder: Recorder, children: '_Children', ready: Callable[[], bool], complaint: str
) -> None:
    deadline = time.perf_counter() + _START_PATIENCE
    while not ready():
        recorder.take(_PAUSE)
        children.check()
        if time.perf_counter() > deadline:
            raise FluidSimError(
                f'{complaint} within {_START_PATIENCE:g} s; {children.last_words()}'
            )


@contextmanager
def _recorder(topics: dict[str, type]) -> Iterator[tuple[Recorder, int]]:
    """Make a recorder in a ROS domain in which nobody else is."""
    start = secrets.randbelow(len(_DOMAINS))
    for i in range(len(_DOMAINS)):
        domain = _DOMAINS[(start + i) % len(_DOMAINS)]
        recorder = Recorder(domain, topics)
        recorder.take(0.2)  # give discovery a moment
        if len(recorder.node.get_node_names()) > 1:
            recorder.close()
            continue
        try:
            yield recorder, domain
        finally:
            recorder.close()
        return
    raise FluidSimError(f'every ROS domain from {_DOMAINS[0]} to {_DOMAINS[-1]} is in use')


class _Children:
    """The simulator, and the controller once it is started."""

    def __init__(self, out: Path, domain: int, duration: float) -> None:
        self._out = out
        self._environment = {
            'ROS_DOMAIN_ID': str(domain), 'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST'
        }  # fmt: skip
        self.simulator = self._start(
            'fluid_sim_node', 'fluid_sim_ros.ros.node',
            scene=SCENE, pacing='lockstep', duration=repr(duration),
        )  # fmt: skip
        self.controller: Child | None = None

    def start_controller(self) -> None:
        plan = [number for waypoint in WAYPOINTS for number in waypoint]
        self.controller = self._start(
            'quad_controller', 'fluid_sim_ros.ros.quad_controller', scene=SCENE, waypoints=plan
        )

    def _start(self, name: str, module: str, **parameters: Any) -> Child:
        arguments = ['--ros-args']
        for key, value in parameters.items():
            arguments += ['-p', f'{key}:={value}']
        return Child(name, module, arguments, self._environment, self._out / f'{name}.log')

    def all(self) -> list[Child]:
        return [child for child in (self.simulator, self.controller) if child is not None]

    def check(self) -> None:
        self.simulator.check()
        if self.controller is not None:
            self.controller.check()
            if not self.controller.running and self.simulator.running:
                raise FluidSimError(f'the controller ended early; {self.controller.last_words()}')

    def last_words(self) -> str:
        return self.all()[-1].last_words()


@contextmanager
def _children(out: Path, domain: int, duration: float) -> Iterator[_Children]:
    children = _Children(out, domain, duration)
    try:
        yield children
        for child in children.all():
            code = child.stop()
            if code:
                raise FluidSimError(
                    f'{child.name} ended with exit code {code}; {child.last_words()}'
                )
    finally:
        for child in children.all():
            child.stop()


# ---- what it shows ---------------------------------------------------------------------------


def gust_of_scene() -> tuple[float, float]:
    """Return begin and end of the gust in the scene's schedule [s]."""
    events = [event for event in Scene.load(SCENE).schedule if event.wind is not None]
    return events[0].at, events[-1].at


def targets(recording: Recording) -> Array:
    """Return where the vehicle should be at each state [m], shape (n, 3)."""
    switch = WAYPOINTS[0][4]
    late = recording.odometry[:, 0] >= switch
    return np.where(late[:, None], WAYPOINTS[1][:3], WAYPOINTS[0][:3])


def summary(recording: Recording) -> dict[str, Any]:
    """Return the numbers of the table, with units in their names."""
    times = recording.odometry[:, 0]
    error = np.linalg.norm(recording.odometry[:, 1:4] - targets(recording), axis=1)
    begin, end = recording.gust
    settled = WAYPOINTS[0][4] + _SETTLED
    force = np.linalg.norm(recording.fluid[:, 1:4], axis=1)
    largest = int(force.argmax())
    simulated = float(times[-1] - times[0])
    return {
        'scene': SCENE,
        'simulated_s': simulated,
        'wall_s': round(recording.wall, 3),
        'real_time_factor': round(simulated / recording.wall, 2),
        'states_received': len(recording.odometry),
        'wrenches_received': len(recording.fluid),
        'waypoint': list(WAYPOINTS[1][:3]),
        'gust_m_s': float(np.abs(recording.wind[:, 1:4]).max()),
        'error_before_gust_m': _largest(error, times, settled, begin),
        'error_in_gust_m': _largest(error, times, begin, end),
        'error_in_gust_settled_m': _largest(error, times, begin + _SETTLED, end),
        'error_after_gust_m': _largest(error, times, end, math.inf),
        'error_after_gust_settled_m': _largest(error, times, end + _SETTLED, math.inf),
        'largest_fluid_force_n': float(force[largest]),
        'largest_fluid_force_at_s': float(recording.fluid[largest, 0]),
    }


def _largest(error: Array, times: Array, begin: float, end: float) -> float | None:
    inside = (times >= begin) & (times < end)
    return float(error[inside].max()) if inside.any() else None


def _table(result: dict[str, Any]) -> Table:
    table = Table(title='Quadrotor in a gust, over ROS 2', show_header=False)
    table.add_column('quantity')
    table.add_column('value', justify='right')

    def centimetres(key: str) -> str:
        value = result[key]
        return '-' if value is None else f'{100 * value:.1f} cm'

    rows = (
        ('simulated time', f'{result["simulated_s"]:.2f} s'),
        ('wall time', f'{result["wall_s"]:.2f} s'),
        ('real-time factor', f'{result["real_time_factor"]:.1f}'),
        ('states received', str(result['states_received'])),
        ('position error before the gust, settled', centimetres('error_before_gust_m')),
        (f'largest in the gust of {result["gust_m_s"]:.0f} m/s', centimetres('error_in_gust_m')),
        ('  in the gust, settled', centimetres('error_in_gust_settled_m')),
        ('largest after the gust', centimetres('error_after_gust_m')),
        ('  after the gust, settled', centimetres('error_after_gust_settled_m')),
        (
            'largest fluid force',
            f'{result["largest_fluid_force_n"]:.2f} N '
            f'at {result["largest_fluid_force_at_s"]:.2f} s',
        ),
    )
    for row in rows:
        table.add_row(*row)
    return table


if __name__ == '__main__':
    try:
        sys.exit(main())
    except FluidSimError as failure:
        sys.stderr.write(f'fluid_sim demo: {failure}\n')
        sys.exit(2)
