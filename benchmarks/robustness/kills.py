# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
What is left of programs that are ended by SIGINT, SIGTERM or SIGKILL at random moments.

Each is started, and ended at a moment between its first line and the end that it would have had
by itself: while it loads, in flight, while it ends. Wrong is a traceback, another exit code than
that stated, a process that stays behind, an end that takes longer than 10 s, a log that has a
fault, or more than 1 s of a flight that is lost. SIGINT goes to the whole process group, as from a
terminal.
Run: ``python -m benchmarks.robustness.kills [--quick] [--only PROGRAM ...]``.
"""

import json
import random
import signal
import sys
import tempfile
from collections import Counter
from pathlib import Path

from benchmarks.common import arguments, write
from test.support.kills import MOST_LOST, PATIENCE, Killer

#: How many of each program.
COUNTS = {
    'run': 64, 'run_realtime': 36, 'node': 56, 'demo': 12, 'sweep': 8, 'replay': 8,
    'resimulate': 8, 'chart': 4, 'advise': 4,
}  # fmt: skip
NUMBERS = (signal.SIGINT, signal.SIGTERM, signal.SIGKILL)
QUICK = 10


def main() -> None:
    """Measure and write the result."""
    options = arguments(__doc__, 'kills', tuple(COUNTS))
    chance, kills, lengths = random.Random(20), [], {}
    with tempfile.TemporaryDirectory() as folder:
        killer = Killer(Path(folder))
        for program, count in COUNTS.items():
            if options.only and program not in options.only:
                continue
            lengths[program] = round(killer.length(program), 2)
            for i in range(max(1, count // (QUICK if options.quick else 1))):
                kill = killer.kill(program, NUMBERS[i % 3], chance.uniform(0.0, lengths[program]))
                kills.append(kill)
                if kill.wrong:
                    sys.stderr.write(f'{kill}\n')
    write(options.json, {
        'kills': len(kills),
        'wrong': sum(bool(kill.wrong) for kill in kills),
        'by_signal': dict(Counter(signal.Signals(kill.number).name for kill in kills)),
        'by_phase': dict(Counter(kill.phase for kill in kills)),
        'exit_codes': {
            program: dict(Counter(str(k.code) for k in kills if k.program == program))
            for program in lengths
        },
        'most_end_s': round(max(kill.end_s for kill in kills), 2),
        'patience_s': PATIENCE,
        'most_lost_s': round(max(kill.lost_s for kill in kills), 3),
        'allowed_lost_s': MOST_LOST,
        'length_s': lengths,
        'examples_of_wrong': json.loads(json.dumps(
            [vars(kill) for kill in kills if kill.wrong][:20], default=int
        )),
    })  # fmt: skip


if __name__ == '__main__':
    main()
