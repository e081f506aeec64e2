"""
What recording costs the node: free pacing, 100 Hz topics, computed and published in both cases.

The node publishes the same topics with and without a recorder, in turns, in one run of this
script; the cost is the share of the real-time factor (wall) and of the node's own processor time
that recording adds. At each tick the node also gets a thrust command, as the bytes that DDS would
hand over, and applies it; commands are always recorded. Targets: 10 % with RK4 and 15 % with
implicitfast for odometry, total wrench, clock and commands. Also: size per simulated minute beside
a writer that does not compress, and the memory of simulation and writer along a long flight.
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile
import textwrap
from pathlib import Path
from typing import Any

from common import arguments, write
from mcap.writer import CompressionType, Writer

from fluid_sim_ros import Simulation
from fluid_sim_ros.pacing import Pacing
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.recording.sink import RecordingSink
from fluid_sim_ros.runner import NoSource, Runner

DOMAIN = '101'
SCENE = 'rov'
SETS = {
    'odom, wrench/total, clock, commands': ['*/odom', '*/wrench/total', '/clock'],
    'every state topic, commands': ['*'],
}

# The node with its loop timed, every chosen topic published as if somebody subscribed, and a
# thrust command at every tick.
NODE = textwrap.dedent("""
    import sys, time
    from fnmatch import fnmatchcase
    from rclpy.serialization import serialize_message
    from std_msgs.msg import Float64MultiArray
    from fluid_sim_ros import runner
    from fluid_sim_ros.ros import inputs, node, outputs
    patterns = sys.argv.pop(1).split()
    refresh = outputs.Outputs.refresh
    def published(self):
        refresh(self)
        for topic in self.topics:
            chosen = any(fnmatchcase(topic.name, p) for p in patterns)
            topic.subscribed = chosen and topic.publisher is not None
        self._active = [t for t in self.topics if t.subscribed]
    outputs.Outputs.refresh = published
    poll, command = inputs.Inputs.poll, serialize_message(Float64MultiArray(data=[1.0] * 8))
    def commanded(self, simulation):
        poll(self, simulation)
        for entry in self.inputs:
            if entry.topic.endswith('/cmd/thrust'):
                self._offer(simulation, entry, command)
    inputs.Inputs.poll = commanded
    plain = runner.Runner.run
    def timed(self, until=runner.NEVER):
        start, used = time.perf_counter(), time.process_time()
        plain(self, until)
        ended = time.perf_counter() - start, time.process_time() - used
        print(repr((self.simulation.time, *ended)), flush=True)
    runner.Runner.run = timed
    sys.exit(node.main(sys.argv))
""")


def flight(
    integrator: str, topics: list[str], seconds: float, record: Path | None
) -> tuple[float, float]:
    """Return wall and processor seconds per simulated second of the node's loop."""
    settings: dict[str, Any] = {
        'scene': SCENE, 'timestep': 0.002, 'integrator': integrator.lower(), 'pacing': 'free',
        'duration': seconds,
    }  # fmt: skip
    if record is not None:
        settings |= {'record': record, 'record.topics': json.dumps(topics)}
    given = [part for key, value in settings.items() for part in ('-p', f'{key}:={value}')]
    environment = {
        **os.environ, 'ROS_DOMAIN_ID': DOMAIN, 'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST'
    }  # fmt: skip
    done = subprocess.run(
        [sys.executable, '-c', NODE, ' '.join(topics), '--ros-args', *given],
        capture_output=True, text=True, env=environment, check=True,
    )  # fmt: skip
    simulated, wall, used = json.loads(done.stdout.splitlines()[-1].translate(_BRACKETS))
    return wall / simulated, used / simulated


_BRACKETS = str.maketrans('()', '[]')


def cost(integrator: str, topics: list[str], seconds: float, rounds: int) -> dict[str, Any]:
    """Return what recording adds, as medians over pairs of runs."""
    wall, used, factor = [], [], []
    with tempfile.TemporaryDirectory() as folder:
        for number in range(rounds):
            without = flight(integrator, topics, seconds, None)
            path = Path(folder) / f'{number}.mcap'
            recorded = flight(integrator, topics, seconds, path)
            wall.append(1 - without[0] / recorded[0])
            used.append(1 - without[1] / recorded[1])
            factor.append(1 / without[0])
        sizes = size_per_minute(path)
    return {
        'integrator': integrator,
        'real_time_factor_without': statistics.median(factor),
        'cost_of_real_time_factor': statistics.median(wall),
        'cost_of_real_time_factor_runs': wall,
        'cost_of_processor_time': statistics.median(used),
        **sizes,
    }


def size_per_minute(path: Path) -> dict[str, float]:
    """Return the size of a log, and of the same messages without compression [MB/min]."""
    log = open_log(path)
    plain = path.with_suffix('.plain')
    with plain.open('xb') as stream:
        writer = Writer(stream, compression=CompressionType.NONE)
        writer.start(profile='ros2')
        ids = {}
        for topic in log.topics.values():
            schema = writer.register_schema(topic.type, 'ros2msg', topic.definition.encode())
            ids[topic.name] = writer.register_channel(topic.name, 'cdr', schema)
        last = 0
        for message in log.messages():
            last = message.log_ns
            writer.add_message(ids[message.topic], last, message.data, message.publish_ns)
        writer.finish()
    minutes = last / 60e9
    return {
        'mb_per_minute': log.size / 1e6 / minutes,
        'mb_per_minute_uncompressed': plain.stat().st_size / 1e6 / minutes,
    }


def memory(seconds: float) -> dict[str, Any]:
    """Return the resident memory [MiB] of simulation and writer along a flight without ROS."""
    simulation = Simulation('sphere', integrator='implicitfast')
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / 'a.mcap'
        sink = RecordingSink(simulation, path, topics=['*/odom', '*/wrench/total', '/clock'])
        process = sink.recorder._process
        assert process is not None
        runner = Runner(simulation, NoSource(), [sink], Pacing())
        samples = []
        for part in range(1, 11):
            runner.run(until=round(seconds * part / 10 / simulation.timestep))
            samples.append([resident('self'), resident(str(process.pid))])
        sink.close()
        size = path.stat().st_size / 1e6
    return {
        'simulated_s': seconds,
        'megabytes': size,
        'simulation_mib': [round(own, 1) for own, _ in samples],
        'writer_mib': [round(other, 1) for _, other in samples],
    }


def resident(pid: str) -> float:
    """Return a process's resident memory [MiB]."""
    pages = int(Path(f'/proc/{pid}/statm').read_text().split()[1])
    return pages * os.sysconf('SC_PAGE_SIZE') / 2**20


def main() -> None:
    """Measure and write the result."""
    options = arguments(__doc__, 'recording_cost')
    seconds, rounds = (10.0, 1) if options.quick else (60.0, 5)
    results = {}
    for name, topics in SETS.items():
        for integrator in ('RK4', 'implicitfast'):
            result = cost(integrator, topics, seconds, rounds)
            results[f'{name}; {integrator}'] = result
            print(
                f'{name}, {integrator}: {result["cost_of_real_time_factor"]:.1%} of the '
                f'real-time factor, {result["cost_of_processor_time"]:.1%} of processor time, '
                f'{result["mb_per_minute"]:.2f} MB/min '
                f'(uncompressed {result["mb_per_minute_uncompressed"]:.2f})'
            )
    long = memory(60.0 if options.quick else 3600.0)
    print(f'{long["simulated_s"]:g} s: writer {long["writer_mib"]} MiB')
    targets = {'RK4': 0.10, 'implicitfast': 0.15}
    write(options.json, {'targets': targets, 'costs': results, 'memory': long})


if __name__ == '__main__':
    main()
