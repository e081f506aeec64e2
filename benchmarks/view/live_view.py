# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
What the live view costs a simulation in free pacing, and how many pictures reach a browser.

Steps a second without a page, with a page that nobody looks at, and with one that a browser looks
at (its side runs in a process of its own, without drawing), in turns in one run; ratios of the
medians. The same for steps a second of processor time, which other programs disturb less.
Targets: 0.95 and 0.85 or more; 20 pictures a second or more; the first within 5 s of the command.
"""

import json
import re
import statistics
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

from benchmarks.common import ROOT, arguments, write
from fluid_sim_ros.view.simulated import SimulatedSource, ViewOptions
from fluid_sim_ros.view.web.page import Page

SCENES = ('quadrotor', 'wave_buoy')
#: Throughput is measured over so long, so long after the first picture [s].
SLICE, SETTLED = 2.0, 1.5


@contextmanager
def looked_at(url: str, seconds: float) -> Iterator[subprocess.Popen[str]]:
    """Give a process that looks at a page, once it has seen a picture."""
    command = [sys.executable, '-m', 'benchmarks.view.look', url, str(seconds)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=ROOT) as process:
        assert process.stdout is not None
        process.stdout.readline()
        yield process
        process.communicate()


def throughput(source: SimulatedSource) -> tuple[float, float]:
    """Return the steps of a running source a second of wall time, and of processor time."""
    steps, begin, busy = source.simulation.step_count, time.perf_counter(), time.process_time()
    time.sleep(SLICE)
    done = source.simulation.step_count - steps
    return done / (time.perf_counter() - begin), done / (time.process_time() - busy)


def cost(scene: str, rounds: int) -> dict[str, float]:
    """Return the throughputs with a page as shares of that without."""
    rates: dict[str, list[tuple[float, float]]] = {'alone': [], 'page': [], 'browser': []}
    for _ in range(rounds):
        source = SimulatedSource(scene, options=ViewOptions(pace=0.0))
        loop = threading.Thread(target=source.run)
        loop.start()
        rates['alone'].append(throughput(source))
        page = Page(source, '127.0.0.1', 0)
        page.start()
        rates['page'].append(throughput(source))
        with looked_at(page.url, SETTLED + SLICE):
            time.sleep(SETTLED)
            rates['browser'].append(throughput(source))
        source.stop()
        loop.join()
        page.close()
    wall, processor = (
        {name: statistics.median(rate[i] for rate in found) for name, found in rates.items()}
        for i in (0, 1)
    )
    return {
        'steps_per_s': wall['alone'],
        'share_without_browser': wall['page'] / wall['alone'],
        'share_with_browser': wall['browser'] / wall['alone'],
        'share_of_processor_without_browser': processor['page'] / processor['alone'],
        'share_of_processor_with_browser': processor['browser'] / processor['alone'],
    }


def pictures(scene: str, seconds: float) -> dict[str, float]:
    """Return pictures a second in real time, and how soon the first comes after the command."""
    begin = time.time()
    command = [sys.executable, '-m', 'fluid_sim_ros.cli', 'view', scene, '--port', '0']
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True, cwd=ROOT) as view:
        assert view.stderr is not None
        found = re.search(r'http://\S+', view.stderr.readline())
        assert found is not None
        served = time.time() - begin
        look = [sys.executable, '-m', 'benchmarks.view.look', found[0], str(seconds)]
        lines = subprocess.run(look, capture_output=True, text=True, check=True, cwd=ROOT).stdout
        view.terminate()
    first, rate = (json.loads(line) for line in lines.splitlines())
    return {
        'served_after_s': served, 'first_picture_after_s': first['first_at'] - begin, **rate
    }  # fmt: skip


def main() -> None:
    """Measure all, and write the result."""
    given = arguments(__doc__, 'live_view')
    rounds, seconds = (2, 2.0) if given.quick else (7, 8.0)
    result = {
        scene: {**cost(scene, rounds), **pictures(scene, seconds)} for scene in SCENES
    }  # fmt: skip
    write(given.json, {'scenes': result})


if __name__ == '__main__':
    main()
