# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
What recording costs the node: free pacing, 100 Hz topics, computed and published in both cases.

One node flies on and on, in blocks of about a fifth of a second of wall time, by turns with and
without its recorder (off, on, on, off, ...); it publishes the same topics in both. The writer
process is halted in the blocks without. The cost is the share of the real-time factor that a
recorded block loses against its neighbour: the median over all pairs, its standard error and the
quartiles (pairs are short beside the changes of a busy machine). After each recorded block the
node waits until the writer has nothing left to do: the cost with this wait, which a flight has
once at its end, is stated beside it, as the most that its work can come to.
At each tick the node also gets a thrust command, as the bytes that DDS would hand over, and
applies it; commands are always recorded. Targets: 10 % with RK4 and 15 % with implicitfast for
odometry, total wrench, IMU, clock and commands. Also: size per simulated minute beside a plain
writer that does not compress, and the memory of simulation and writer along an hour of flight.
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

from mcap.writer import CompressionType, Writer

from benchmarks.common import arguments, write
from fluid_sim_ros import Simulation
from fluid_sim_ros.loop.pacing import Pacing
from fluid_sim_ros.loop.runner import NoSource, Runner
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.recording.sink import RecordingSink

DOMAIN = '101'
SCENE = 'rov'
STATES = ['*/odom', '*/wrench/total', '*/imu/data_raw', '/clock']
SETS = {
    'odom, wrench/total, imu, clock, commands': STATES,
    'every state topic, commands': ['*'],
}
#: Simulated time of a block [s]: about a fifth of a second of wall time, so that little of the
#: writer's work is left to the wait.
BLOCKS = {'RK4': 8.0, 'implicitfast': 15.0}

# The node with every chosen topic published as if somebody subscribed, a thrust command at every
# tick, and its loop run in blocks that are timed. Prints, for each block and per simulated second,
# [recorded, wall time and processor time of the node, wall time until the writer is done too].
NODE = textwrap.dedent("""
    import fcntl, json, os, signal, sys, termios, time
    from fnmatch import fnmatchcase
    from rclpy.serialization import serialize_message
    from std_msgs.msg import Float64MultiArray
    from fluid_sim_ros.loop import runner
    from fluid_sim_ros.ros import inputs, node, outputs, session
    patterns, blocks = sys.argv.pop(1).split(), int(sys.argv.pop(1))
    seconds = float(sys.argv.pop(1))
    refresh = outputs.Outputs.refresh
    def published(self):
        refresh(self)
        for topic in self.topics:
            chosen = any(fnmatchcase(topic.name, p) for p in patterns)
            topic.subscribed = chosen and topic.publisher is not None
        self.choose()
    outputs.Outputs.refresh = published
    poll, command = inputs.Inputs.poll, serialize_message(Float64MultiArray(data=[1.0] * 8))
    def commanded(self, simulation):
        poll(self, simulation)
        for entry in self.inputs:
            if entry.topic.endswith('/cmd/thrust'):
                self._offer(simulation, entry, command)
    inputs.Inputs.poll = commanded

    def writer_state(tap):
        return open(f'/proc/{tap.writer._process.pid}/stat').read().rsplit(')', 1)[1].split()

    def writer_time(tap):
        fields = writer_state(tap)
        return (int(fields[11]) + int(fields[12])) / os.sysconf('SC_CLK_TCK')

    def in_pipe(tap):
        return int.from_bytes(fcntl.ioctl(tap.writer._pipe, termios.FIONREAD, bytes(4)), 'little')

    def drain(tap):
        tap.flush(now=True)
        while tap.writer._queue or in_pipe(tap) or writer_state(tap)[0] != 'S':
            time.sleep(1e-4)
            tap.flush(now=True)

    def run_blocks(self, until):
        tap, outputs = self.tap, self.outputs
        places = [topic.record for topic in outputs.topics]
        step = round(seconds / self.simulation.timestep)
        self.runner.stopped = False
        results = []
        drain(tap)
        begin = writer_time(tap)
        for number in range(blocks):
            recorded = number % 4 in (1, 2)
            present = tap if recorded else None
            self.tap = outputs.tap = self.inputs.tap = self._diagnostics.tap = present
            for topic, place in zip(outputs.topics, places):
                topic.record = place if recorded else -1
            outputs.choose()
            os.kill(tap.writer._process.pid, signal.SIGCONT if recorded else signal.SIGSTOP)
            start, used = time.perf_counter(), time.process_time()
            self.runner.run(self.simulation.tick + step)
            wall, own = time.perf_counter() - start, time.process_time() - used
            if recorded:
                drain(tap)
            waited = time.perf_counter() - start
            results.append([recorded, wall / seconds, own / seconds, waited / seconds])
        self.tap = outputs.tap = self.inputs.tap = self._diagnostics.tap = tap
        os.kill(tap.writer._process.pid, signal.SIGCONT)
        written = (writer_time(tap) - begin) / (seconds * blocks / 2)
        found = {'dropped': tap.dropped, 'fault': tap.fault, 'writer': written, 'blocks': results}
        print(json.dumps(found), flush=True)
        return True
    session.Session.run = lambda self: run_blocks(self, self._until)
    sys.exit(node.main(sys.argv))
""")


def fly_in_blocks(
    integrator: str, topics: list[str], pairs: int, path: Path
) -> tuple[list[tuple[list[float], list[float]]], float]:
    """
    Return (without, with) for each pair of neighbouring blocks, as ``NODE`` prints them.

    Also the writer's processor time per simulated second.
    """
    settings: dict[str, Any] = {
        'scene': SCENE, 'timestep': 0.002, 'integrator': integrator.lower(), 'pacing': 'free',
        'record.path': path, 'record.topics': json.dumps(topics),
    }  # fmt: skip
    given = [part for key, value in settings.items() for part in ('-p', f'{key}:={value}')]
    environment = {
        **os.environ, 'ROS_DOMAIN_ID': DOMAIN, 'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST'
    }  # fmt: skip
    numbers = [str(2 * (pairs + 1)), str(BLOCKS[integrator])]
    done = subprocess.run(
        [sys.executable, '-c', NODE, ' '.join(topics), *numbers, '--ros-args', *given],
        capture_output=True, text=True, env=environment, check=True,
    )  # fmt: skip
    said = json.loads(done.stdout.splitlines()[-1])
    if said['fault'] or said['dropped']:
        raise RuntimeError(f'the recording is not whole: {said["fault"] or said["dropped"]}')
    blocks = said['blocks'][2:]  # the first pair warms up
    flown = [
        (first, second) if not first[0] else (second, first)
        for first, second in zip(blocks[::2], blocks[1::2], strict=True)
    ]
    return flown, said['writer']


def cost(integrator: str, topics: list[str], pairs: int) -> dict[str, Any]:
    """Return what recording adds, as medians over pairs of blocks."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / 'a.mcap'
        flown, writer = fly_in_blocks(integrator, topics, pairs, path)
        sizes = size_per_minute(path, BLOCKS[integrator] * (pairs + 1))
    wall = [1 - without[1] / recorded[1] for without, recorded in flown]
    used = [1 - without[2] / recorded[2] for without, recorded in flown]
    low, _, high = statistics.quantiles(wall, n=4)
    without = statistics.median(without[1] for without, _ in flown)
    return {
        'integrator': integrator,
        'pairs': pairs,
        'real_time_factor_without': 1 / without,
        'cost_of_real_time_factor': statistics.median(wall),
        # of the median, from the quartiles (1.349 and 1.2533 deviations of normal errors)
        'standard_error': 1.2533 * (high - low) / 1.349 / pairs**0.5,
        'quartiles': [low, high],
        'cost_with_the_wait_for_the_writer': statistics.median(
            1 - without[3] / recorded[3] for without, recorded in flown
        ),
        'cost_of_processor_time': statistics.median(used),
        'writer_processor_time': writer / without,
        **sizes,
    }


def size_per_minute(path: Path, seconds: float) -> dict[str, float]:
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
        for message in log.messages():
            writer.add_message(
                ids[message.topic], message.log_ns, message.data, message.publish_ns
            )
        writer.finish()
    minutes = seconds / 60
    return {
        'mb_per_minute': log.size / 1e6 / minutes,
        'mb_per_minute_uncompressed': plain.stat().st_size / 1e6 / minutes,
    }


def memory(seconds: float) -> dict[str, Any]:
    """Return the resident memory [MiB] of simulation and writer along a flight without ROS."""
    simulation = Simulation(SCENE, integrator='implicitfast')
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / 'a.mcap'
        sink = RecordingSink(simulation, path, topics=STATES)
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
        # from the first tenth of the flight to its end
        'simulation_growth_mib': round(samples[-1][0] - samples[0][0], 1),
        'writer_growth_mib': round(samples[-1][1] - samples[0][1], 1),
    }


def resident(pid: str) -> float:
    """Return a process's resident memory [MiB]."""
    pages = int(Path(f'/proc/{pid}/statm').read_text().split()[1])
    return pages * os.sysconf('SC_PAGE_SIZE') / 2**20


def main() -> None:
    """Measure and write the result."""
    options = arguments(__doc__, 'recording_cost', [*_PARTS, 'memory'])
    parts = options.only or [*_PARTS, 'memory']
    result: dict[str, Any] = {'targets': {'RK4': 0.10, 'implicitfast': 0.15}, 'costs': {}}
    if options.only and options.json.exists():
        kept = json.loads(options.json.read_text(encoding='utf-8'))
        result |= {key: kept[key] for key in ('costs', 'memory') if key in kept}
    for part in parts:
        if part == 'memory':
            result['memory'] = memory(60.0 if options.quick else 3600.0)
            print(f'{result["memory"]["simulated_s"]:g} s: {result["memory"]["writer_mib"]} MiB')
            continue
        topics, integrator = _PARTS[part]
        this = cost(integrator, SETS[topics], 20 if options.quick else 160)
        result['costs'][f'{topics}; {integrator}'] = this
        low, high = this['quartiles']
        print(
            f'{topics}, {integrator}: {this["cost_of_real_time_factor"]:.1%} '
            f'+- {this["standard_error"]:.1%} (quartiles {low:.1%}, {high:.1%}) of the real-time '
            f'factor of {this["real_time_factor_without"]:.0f}, '
            f'{this["cost_with_the_wait_for_the_writer"]:.1%} with the wait for the writer, '
            f'{this["cost_of_processor_time"]:.1%} of processor time, '
            f'{this["mb_per_minute"]:.2f} MB/min '
            f'(uncompressed {this["mb_per_minute_uncompressed"]:.2f})'
        )
    write(options.json, result)


_PARTS = {
    f'{short}_{integrator}': (name, integrator)
    for short, name in zip(('some', 'all'), SETS, strict=True)
    for integrator in BLOCKS
}


if __name__ == '__main__':
    main()
