"""
``fluid_sim demo``: a quadrotor holds its place in a gust, over real ROS 2.

The simulator and the controller run as two processes in lockstep; this process records what they
publish, prints a table and writes plots and a summary.
"""

import argparse
import json
import math
import os
import secrets
import signal
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from geometry_msgs.msg import TwistStamped, WrenchStamped
from nav_msgs.msg import Odometry
from rich.console import Console
from sensor_msgs.msg import JointState

from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.ros import demo_plots
from fluid_sim_ros.ros.children import Child
from fluid_sim_ros.ros.demo_summary import (
    SCENE,
    VEHICLE,
    WAYPOINTS,
    Recording,
    gust_of_scene,
    summary,
    table,
    targets,
)
from fluid_sim_ros.ros.recorder import Recorder
from fluid_sim_ros.ros.states import read_odometry

#: Domains to choose from: above those that people and tests use, and with UDP ports below the
#: ephemeral ports of Linux.
_DOMAINS = range(61, 101)
#: Longest wait for the first state, and for the next one during the run [s, wall].
_START_PATIENCE, _PATIENCE = 30.0, 15.0
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


#: Name of the flight's log in the folder of the results.
LOG = 'flight.mcap'


def main(
    argv: Sequence[str] | None = None,
    evaluate: Callable[[Path], dict[str, Any]] | None = None,
) -> int:
    """
    Run the demo; returns the exit code.

    With ``evaluate`` the simulator records the flight; it is called with the log and returns what
    the summary shall say of it under ``log``, with the lines to show under ``lines``.
    """
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
    log = None
    if evaluate is not None:
        log = out / LOG
        log.unlink(missing_ok=True)
    recording = record(out, options.duration, log)
    result = summary(recording)
    lines = []
    if evaluate is not None and log is not None:
        result['log'] = evaluate(log)
        lines = result['log'].pop('lines')
    pictures = [
        demo_plots.trajectory(recording, targets(recording), out / 'trajectory.png'),
        demo_plots.wrench(recording, out / 'wrench.png'),
    ]
    text = json.dumps(result, indent=2) + '\n'
    (out / 'summary.json').write_text(text, encoding='utf-8')
    console.print(table(result))
    console.print(f'Plots: {", ".join(map(str, pictures))}', soft_wrap=True)
    for line in lines:
        console.print(line, soft_wrap=True, markup=False)
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


def record(out: Path, duration: float, log: Path | None = None) -> Recording:
    """
    Run simulator and controller and return what they published; the simulator records to ``log``.

    Raises
    ------
    FluidSimError
        If a process dies or stops answering; the line holds the last it wrote.

    """
    # nobody outside this host is asked, neither by this process nor by its children
    os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
    topics = {f'{VEHICLE}/{leaf}': kind for leaf, kind in _TOPICS.items()}
    with (
        _recorder(topics) as (recorder, domain),
        _children(out, domain, duration, log) as children,
    ):
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

    def __init__(self, out: Path, domain: int, duration: float, log: Path | None) -> None:
        self._out = out
        self._environment = {'ROS_DOMAIN_ID': str(domain), 'ROS_LOG_DIR': str(out / 'ros_log')}
        self.simulator = self._start(
            'fluid_sim_node', 'fluid_sim_ros.ros.node',
            scene=SCENE, pacing='lockstep', duration=repr(duration),
            **({} if log is None else {'record': log}),
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


def _on_sigterm(number: int, frame: Any) -> None:
    """Leave by an exception, so that the children are stopped on the way out."""
    raise SystemExit(128 + number)


@contextmanager
def _children(out: Path, domain: int, duration: float, log: Path | None) -> Iterator[_Children]:
    before = signal.signal(signal.SIGTERM, _on_sigterm)
    children = _Children(out, domain, duration, log)
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
        signal.signal(signal.SIGTERM, before)


if __name__ == '__main__':
    try:
        sys.exit(main())
    except FluidSimError as failure:
        sys.stderr.write(f'fluid_sim demo: {failure}\n')
        sys.exit(2)
