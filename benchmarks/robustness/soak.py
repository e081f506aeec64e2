# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
A long flight at full speed with everything on: what grows, and whether it stays as fast.

The node flies an x500 in turbulence in lockstep with its controller, records every topic, and a
third process, this one, listens. Every 2 s of wall time the memory, file handles, threads and
processor time of node, log writer and controller are noted. The slope of memory is a line through
the second half. The pace at start and end is that of the clock, and depends on what else the
machine does; the processor time of a simulated second does so much less.
``--wall`` says how long it flies [min]; at least an hour of simulated time is wanted.
"""

import itertools
import os
import random
import signal
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.common import arguments, write
from fluid_sim_ros.demo.listener import Listener
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.ros.controllers.states import read_odometry
from test.support.ros_processes import Process, wait_until

SCENE, VEHICLE = 'x500_turbulence', 'x500'
#: Wall time [min]: of a full run, and of a quick one.
WALL, QUICK = 30.0, 0.5
#: Wall time before the first numbers count, and between two looks [s].
WARM_UP, PERIOD = 10.0, 2.0
PAGE_MIB = os.sysconf('SC_PAGE_SIZE') / 2**20
TICK = 1 / os.sysconf('SC_CLK_TCK')


def held(pid: int) -> tuple[float, int, int, float]:
    """Return a process's memory [MiB], file handles, threads, and time so far [s]."""
    folder = Path(f'/proc/{pid}')
    pages = int((folder / 'statm').read_text().split()[1])
    handles = len(list((folder / 'fd').iterdir()))
    # fields 14 and 15 of proc(5), behind the name, in brackets, which may hold anything
    user, system = (folder / 'stat').read_text().rpartition(')')[2].split()[11:13]
    worked = (int(user) + int(system)) * TICK
    return pages * PAGE_MIB, handles, len(list((folder / 'task').iterdir())), worked


def writer_of(pid: int) -> int:
    """Return the process that writes the log of a node."""
    for child in Path(f'/proc/{pid}/task/{pid}/children').read_text().split():
        if b'recording.writing.writer' in Path(f'/proc/{child}/cmdline').read_bytes():
            return int(child)
    raise RuntimeError('the node has no writer')


def fly(folder: Path, wall: float) -> dict[str, Any]:
    """Fly for a wall time [s]; return what was measured."""
    domain = int(os.environ.get('ROS_DOMAIN_ID') or random.SystemRandom().randrange(61, 101))
    os.environ['ROS_DOMAIN_ID'] = str(domain)
    log = folder / 'soak.mcap'
    node = {'scene': SCENE, 'pacing': 'lockstep', 'record.path': log}
    listener = Listener(domain, f'{VEHICLE}/odom')
    with (
        Process('fluid_sim_ros.ros.node', **node) as simulator,
        Process('fluid_sim_ros.ros.controllers.quad', scene=SCENE) as controller,
    ):
        simulated = 0.0

        def take() -> bool:
            nonlocal simulated
            if listener.take(0.05):
                simulated = read_odometry(listener.messages[-1]).stamp_ns * 1e-9
                listener.messages.clear()
                listener.sent_ns.clear()
            return simulated > 0

        wait_until(take, 'the first answered state', 60.0)
        number = simulator._process.pid
        pids = {'node': number, 'writer': writer_of(number), 'controller': controller._process.pid}
        begin = time.monotonic()
        times, held_by = [], {name: [] for name in pids}
        for turn in itertools.count(1):
            while (now := time.monotonic() - begin) < turn * PERIOD:
                take()
            if not (simulator.alive and controller.alive):
                raise RuntimeError(simulator.output[-2000:] + controller.output[-2000:])
            if now > WARM_UP:
                times.append((now, simulated))
                for name, pid in pids.items():
                    held_by[name].append(held(pid))
            if now > wall:
                break
        codes = {}
        for name, process in (('node', simulator), ('controller', controller)):
            process.signal(signal.SIGINT)
            codes[name] = process.wait(120)
    listener.close()
    return {**summary(np.array(times), held_by), 'exit_codes': codes, 'log': about(log)}


def summary(
    times: np.ndarray, held_by: dict[str, list[tuple[float, int, int, float]]]
) -> dict[str, Any]:
    """Return speed at start and end, and what each process held."""
    wall, simulated = times.T
    part = max(1, len(wall) // 10)

    def factor(first: int, last: int) -> float:
        return float((simulated[last] - simulated[first]) / (wall[last] - wall[first]))

    # the first and the last tenth of the simulated time
    span = simulated[-1] - simulated[0]
    begin = int(np.searchsorted(simulated, simulated[0] + span / 10))
    rest = int(np.searchsorted(simulated, simulated[-1] - span / 10)) - 1

    def cost(worked: list[float], first: int, last: int) -> float:
        return float((worked[last] - worked[first]) / (simulated[last] - simulated[first]))

    processes = {}
    half = len(wall) // 2
    for name, samples in held_by.items():
        memory, handles, threads, worked = map(list, zip(*samples, strict=True))
        early, late = cost(worked, 0, begin), cost(worked, rest, -1)
        slope = np.polyfit(simulated[half:] / 3600, memory[half:], 1)[0]
        processes[name] = {
            'resident_mib': [round(memory[0], 1), round(memory[-1], 1)],
            'largest_mib': round(max(memory), 1),
            'slope_kib_per_simulated_hour': round(float(slope) * 1024, 1),
            'handles': [handles[0], handles[-1]],
            'threads': [threads[0], threads[-1]],
            'more_handles_and_threads': handles[-1] - handles[0] + threads[-1] - threads[0],
            'processor_ms_per_simulated_s': [round(early * 1e3, 2), round(late * 1e3, 2)],
            'cost_at_the_end_over_the_start': round(late / early, 3),
        }
    start, end = factor(0, part), factor(-1 - part, -1)
    return {
        'wall_min': round(float(wall[-1]) / 60, 2),
        'simulated_h': round(float(simulated[-1]) / 3600, 3),
        'real_time_factor': {
            'start': round(start, 2), 'end': round(end, 2),
            'end_over_start': round(end / start, 3), 'all': round(factor(0, -1), 2),
        },
        'processes': processes,
    }  # fmt: skip


def about(path: Path) -> dict[str, Any]:
    """Return whether the log is sound, and what it holds."""
    log = open_log(path)
    counts: dict[str, int] = {}
    last = 0
    for message in log.messages():
        counts[message.topic] = counts.get(message.topic, 0) + 1
        last = max(last, message.log_ns)
    return {
        'mib': round(path.stat().st_size / 2**20, 1), 'messages': sum(counts.values()),
        'topics': len(counts), 'faults': log.faults, 'end_h': round(last * 1e-9 / 3600, 3),
    }  # fmt: skip


def main() -> None:
    """Measure and write the result."""
    options = arguments(__doc__, 'soak', more={'wall': f'how long it flies [min] ({WALL:g})'})
    minutes = float(options.wall or (QUICK if options.quick else WALL))
    load = os.getloadavg()[0]
    with tempfile.TemporaryDirectory() as folder:
        result = fly(Path(folder), 60 * minutes)
    write(options.json, {'load_average_before': load, 'scene': SCENE, **result})


if __name__ == '__main__':
    main()
