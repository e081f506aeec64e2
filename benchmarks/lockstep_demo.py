"""
Real-time factor of the demo: node and Python controller as two processes in lockstep at 100 Hz.

A third process records odometry, wrench, thrust and wind. Several runs; the median counts, and the
recorded states of all runs must be equal to the bit. Target: real-time factor 20.
"""

import hashlib
import json
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from common import arguments, write


def run(folder: Path, seconds: float) -> dict[str, object]:
    """Return the demo's summary."""
    # without the log of `fluid_sim demo`: recording has a benchmark of its own
    start = 'import sys; from fluid_sim_ros.ros.demo import main; main(sys.argv[1:])'
    command = [sys.executable, '-c', start, '--out', str(folder), '--duration', str(seconds)]
    subprocess.run(command, check=True, capture_output=True)
    summary: dict[str, object] = json.loads((folder / 'summary.json').read_text())
    return summary


def same_for_all(summary: dict[str, object]) -> str:
    """Return a digest of what must not differ between runs: everything that was measured."""
    kept = {k: v for k, v in summary.items() if k.startswith(('error_', 'largest_', 'states_'))}
    return hashlib.sha256(json.dumps(kept, sort_keys=True).encode()).hexdigest()[:16]


def main() -> None:
    """Measure and write the result."""
    options = arguments(__doc__, 'lockstep_demo')
    count = 2 if options.quick else 7
    with tempfile.TemporaryDirectory() as folder:
        runs = [run(Path(folder) / str(i), 30.0) for i in range(count)]
    factors = [float(str(r['real_time_factor'])) for r in runs]
    digests = {same_for_all(r) for r in runs}
    print(f'real-time factor: median {statistics.median(factors):.1f}, {factors}')
    write(
        options.json,
        {
            'target_real_time_factor': 20,
            'median_real_time_factor': statistics.median(factors),
            'real_time_factors': factors,
            'results_equal_to_the_bit': len(digests) == 1,
        },
    )
    if len(digests) != 1:
        raise SystemExit('the runs differ')


if __name__ == '__main__':
    main()
