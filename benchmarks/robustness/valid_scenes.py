# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
What becomes of 20,000 scenes that load, drawn over the schemas of their files.

Each is a scene of one model or a fleet, with winds, currents, waves, sensors, a schedule and a
gait (``test.support.hostile.scenes``). It is stepped with its sensors, taken back to a saved state
and stepped again, commanded, and reset. Wrong is an error that is not of ours, or of many lines, a
crash, another flight from the same state, states that are no numbers without a word, or more than
10 s of processor time; 95 % are to load. Fixed seeds.
Run: ``python -m benchmarks.robustness.valid_scenes [--quick] [--divide N] [--more SECONDS]
[--processes N]``; with ``--more`` those that follow the ones of the result are judged and added
to it, for so long. The result states how many were planned and how many of them were judged.
"""

import json
import math
import os
import sys
import tempfile
import time
import traceback
import warnings
from collections import Counter
from pathlib import Path
from typing import Any

from benchmarks.common import ROOT, arguments, write
from benchmarks.robustness.workers import Found, Worker, in_portions, serve
from fluid_sim_ros.errors import FluidSimError
from test.support.hostile.scenes.scene import drawn_scene
from test.support.hostile.scenes.used import used

SCENES, QUICK = 20_000, 100
MOST_SECONDS = 10.0
#: Scenes that a process is asked for at once.
PORTION = 50
#: Wall time for each second of processor time that is allowed, on a busy machine.
PATIENCE = 10
RIGHT = ('flown', 'diverged', 'refused')


def judge_scene(seed: int, folder: Path) -> Found:
    """Judge the scene of a seed, written into a folder."""
    path, keys = drawn_scene(seed, folder)
    told: Found = {'seed': seed, 'line': '', 'keys': sorted(keys)}
    begin = time.process_time()
    try:
        told['outcome'] = used(path, seed)
    except FluidSimError as error:
        told['line'] = str(error).removeprefix(str(path))
        told['outcome'] = 'refused' if str(error).isprintable() else 'unprintable'
    except Exception as error:  # noqa: BLE001  that is what is looked for
        told['line'] = ' '.join(traceback.format_exception(error)[-3:])[-500:]
        told['outcome'] = 'traceback'
    told['seconds'] = time.process_time() - begin
    if told['seconds'] > MOST_SECONDS:
        told['outcome'] = 'slow'
    return told


def told_of(portion: list[Found]) -> list[Found]:
    """Return what became of each scene."""
    ended = {'keys': []}  # of one that ended its process
    found = [ended | line for line in portion if 'outcome' in line]
    return [line | {'line': ' '.join(line['line'].split())[-500:]} for line in found]


def summary(found: list[Found]) -> dict[str, Any]:
    """Return what came of the scenes."""
    wrong = [line for line in found if line['outcome'] not in RIGHT]
    refused = [line['line'] for line in found if line['outcome'] == 'refused']
    return {
        'scenes': len(found),
        'wrong': len(wrong),
        'outcomes': dict(Counter(line['outcome'] for line in found)),
        'most_seconds': round(max(line['seconds'] for line in found), 2),
        'keys': sorted({key for line in found for key in line['keys']}),
        'refused': dict(Counter(line[:60] for line in refused).most_common(10)),
        'examples_of_wrong': [
            {key: line[key] for key in ('seed', 'outcome', 'line')} for line in wrong[:20]
        ],
    }


def together(before: dict[str, Any], now: dict[str, Any]) -> dict[str, Any]:
    """Return the summary of what was judged before and now."""
    refused = Counter(before['refused']) + Counter(now['refused'])
    return {
        'scenes': before['scenes'] + now['scenes'],
        'wrong': before['wrong'] + now['wrong'],
        'outcomes': dict(Counter(before['outcomes']) + Counter(now['outcomes'])),
        'most_seconds': max(before['most_seconds'], now['most_seconds']),
        'keys': sorted({*before['keys'], *now['keys']}),
        'refused': dict(refused.most_common(10)),
        'examples_of_wrong': (before['examples_of_wrong'] + now['examples_of_wrong'])[:20],
    }


def main() -> None:
    """Judge, print and write JSON; fail when anything was wrong."""
    options = arguments(
        __doc__, 'valid_scenes',
        more={
            'divide': 'judge one part in so many', 'processes': 'how many judge at once',
            'more': 'go on with those that follow the ones of the result for so long [s]',
        },
        flags={'worker': 'be a process that judges'},
    )  # fmt: skip
    if options.worker:
        warnings.simplefilter('ignore')
        with tempfile.TemporaryDirectory() as folder:
            serve(lambda seed: judge_scene(seed, Path(folder)))
        return
    count = SCENES // (QUICK if options.quick else int(options.divide or 1))
    before = json.loads(options.json.read_text(encoding='utf-8')) if options.more else {}

    def worker() -> Worker:
        environment = {'MUJOCO_GL': 'egl', **os.environ}
        return Worker(__spec__.name, ['--worker'], ROOT, environment, PATIENCE * MOST_SECONDS)

    portions = in_portions(
        worker, range(before.get('scenes', 0), count), PORTION, float(options.more or math.inf),
        int(options.processes or os.cpu_count() or 1),
    )  # fmt: skip
    found = [line for portion in portions for line in told_of(portion)]
    if not found:
        sys.exit('none is left to judge')
    result = together(before, summary(found)) if before else summary(found)
    result['loaded_share'] = 1 - result['outcomes'].get('refused', 0) / result['scenes']
    print({key: result[key] for key in ('scenes', 'wrong', 'loaded_share', 'outcomes')})
    write(options.json, {'planned': SCENES, **result})
    sys.exit(1 if result['wrong'] else 0)


if __name__ == '__main__':
    main()
