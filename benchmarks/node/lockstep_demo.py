# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Real-time factor of the demo: node and Python controller as two processes in lockstep at 100 Hz.

A third process listens to the odometry; the simulator flies without a log, and with the one that
``fluid_sim demo`` makes. Several runs of each, in turn; the medians count, and what was heard must
be equal to the bit. Target: real-time factor 20.
"""

import statistics
import tempfile
from pathlib import Path

from benchmarks.common import arguments, write
from fluid_sim_ros.demo.flight import Heard, fly_demo

_SECONDS = 30.0


def agree(one: Heard, other: Heard) -> bool:
    """Return whether every state that both runs heard is the same to the bit."""
    # CDR: the stamp stands in bytes 4 to 12
    first = {data[4:12]: data for data in one.odometry}
    common = [data for data in other.odometry if data[4:12] in first]
    return bool(common) and all(first[data[4:12]] == data for data in common)


def main() -> None:
    """Measure and write the result."""
    options = arguments(__doc__, 'lockstep_demo')
    count = 2 if options.quick else 7
    runs: dict[str, list[Heard]] = {'without_log': [], 'with_log': []}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for _ in range(count):
            runs['without_log'].append(fly_demo(folder, _SECONDS))
            runs['with_log'].append(fly_demo(folder, _SECONDS, folder / 'flight.mcap'))
            (folder / 'flight.mcap').unlink()
    result: dict[str, object] = {'target_real_time_factor': 20}
    for kind, flights in runs.items():
        factors = [round(_SECONDS / flight.wall, 2) for flight in flights]
        result[kind] = {
            'median_real_time_factor': statistics.median(factors),
            'real_time_factors': factors,
            'states_heard_of_3001': [len(set(flight.odometry)) for flight in flights],
        }
        print(f'{kind}: real-time factor: median {statistics.median(factors):.1f}, {factors}')
    every = [*runs['without_log'], *runs['with_log']]
    same = all(agree(every[0], flight) for flight in every[1:])
    write(options.json, {**result, 'results_equal_to_the_bit': same})
    if not same:
        raise SystemExit('the runs differ')


if __name__ == '__main__':
    main()
