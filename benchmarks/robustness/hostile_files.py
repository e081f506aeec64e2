# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
What becomes of hostile files: 20,000 logs with right checksums, 2,000 files of each other kind.

Logs are mutated record by record (``test.support.hostile.logs``) and opened by the commands that
open logs, each with its share; YAML, NPZ, NetCDF, CSV and MJCF files are loaded as a scene; files
of other software and settings (``test.support.hostile.foreign``) are opened as they are. Right is
a result, or an error of ours on one printable line; wrong is a traceback, a crash, more than
10 s of processor time (or a minute of wall time), memory beyond four times the file and 256 MiB, a
file touched outside of the working folder, or text that a terminal acts on. Fixed seeds.
Run: ``python -m benchmarks.robustness.hostile_files [--quick] [--only KIND ...] [--divide N]
[--more SECONDS]``; with ``--more`` those that follow the ones of the result are judged and added
to it, for so long, a quarter of it for logs. The result states how many were planned and how many
of them were judged.
"""

import json
import math
import os
import subprocess
import sys
import tempfile
import time
import warnings
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from benchmarks.common import ROOT, arguments, write
from test.support.hostile.files import KINDS, hostile_file
from test.support.hostile.foreign.kinds import KINDS as FOREIGN
from test.support.hostile.foreign.kinds import foreign_file, opened
from test.support.hostile.judge import MOST_WALL, Outside, Trials, Verdict, judged

LOGS, FILES = 20_000, 2_000
QUICK = 20
#: Files that one process opens, also where time is limited; a crash costs the rest of its portion.
PORTION, SMALL_PORTION = 250, 50
#: Share of the time of ``--more`` that logs have.
LOGS_SHARE = 0.25


def judge_portion(kind: str, first: int, last: int) -> None:
    """Judge the files of some seeds; print a line of JSON for each before and after."""
    warnings.simplefilter('ignore')
    with tempfile.TemporaryDirectory() as folder:
        trials = Trials(Path(folder) / 'peaks')
        watched = Path(folder) / 'watched'
        watched.mkdir()
        outside = Outside(watched)
        if kind == 'log':
            judge = _judge_log(Path(folder))
        elif kind in KINDS:
            judge = _judge_file(kind)
        else:
            judge = _judge_foreign(kind, outside)
        for seed in range(first, last):
            print(json.dumps({'begun': seed}), flush=True)
            os.chdir(outside.working)
            verdict, command = judge(seed, outside.working)
            os.chdir('/')
            if outside.changed() or outside.told(verdict):
                verdict.outcome = 'outside'
            outside.clear()
            told = vars(verdict) | {'seed': seed, 'command': command}
            print(json.dumps(told), flush=True)
        print(json.dumps({'children': trials.peak()}), flush=True)


def _judge_log(folder: Path) -> Any:
    from fluid_sim_ros.recording.reader import open_log
    from test.support.hostile.commands import COMMANDS, command_of, judged_log
    from test.support.hostile.logs import Mutator
    from test.support.recorded_flights import record_flight

    record_flight(folder / 'flight.mcap', 'quadrotor', seconds=0.5, seed=1)
    # the libraries that draw take 260 MiB, whatever is drawn
    COMMANDS['render'][1](folder / 'flight.mcap', folder)
    mutator = Mutator(open_log(folder / 'flight.mcap'))

    def judge(seed: int, working: Path) -> tuple[Verdict, str]:
        command = command_of(seed)
        return judged_log(mutator.log(seed), command, working), command

    return judge


def _judge_file(kind: str) -> Any:
    from fluid_sim_ros.scene import Scene

    def judge(seed: int, working: Path) -> tuple[Verdict, str]:
        path = hostile_file(kind, seed, working)
        size = sum(file.stat().st_size for file in working.iterdir())
        return judged(lambda: Scene.load(path).compile(), size), 'load'

    return judge


def _judge_foreign(kind: str, outside: Outside) -> Any:
    def judge(seed: int, working: Path) -> tuple[Verdict, str]:
        path = foreign_file(kind, seed, working, outside.kept)
        return judged(lambda: opened(kind, path, seed), path.stat().st_size), 'open'

    return judge


def run_portion(kind: str, first: int, last: int) -> list[dict[str, Any]]:
    """Judge some seeds in processes of their own, a new one after each crash."""
    found = []
    while first < last:
        command = [sys.executable, '-m', __spec__.name, '--portion', f'{kind} {first} {last}']
        patience = MOST_WALL * (last - first)
        done = subprocess.run(
            command, cwd=ROOT, capture_output=True, text=True, timeout=patience, check=False,
            env={'MUJOCO_GL': 'egl', **os.environ},  # MuJoCo chooses when it is imported
        )  # fmt: skip
        lines = [json.loads(line) for line in done.stdout.splitlines() if line.startswith('{')]
        found += [line for line in lines if 'begun' not in line]
        begun = [line['begun'] for line in lines if 'begun' in line]
        if done.returncode == 0:
            break
        seed = begun[-1] if begun else first
        words = ' '.join(done.stderr.split())[-300:]
        found.append(
            {'outcome': 'crash', 'line': words, 'seconds': 0.0, 'memory': 0, 'seed': seed,
             'command': kind}
        )  # fmt: skip
        first = seed + 1
    return found


def summary(found: list[dict[str, Any]]) -> dict[str, Any]:
    """Return what came of the files of a kind."""
    verdicts = [line for line in found if 'outcome' in line]
    wrong = [line for line in verdicts if line['outcome'] not in ('read', 'refused')]
    return {
        'files': len(verdicts),
        'wrong': len(wrong),
        'outcomes': dict(Counter(line['outcome'] for line in verdicts)),
        'commands': dict(Counter(line['command'] for line in verdicts)),
        'most_seconds': round(max(line['seconds'] for line in verdicts), 2),
        'most_memory_mib': round(max(line['memory'] for line in verdicts) / 2**20),
        'most_memory_of_a_trial_mib': round(
            max((line['children'] for line in found if 'children' in line), default=0) / 2**20
        ),
        'examples_of_wrong': [
            {key: line[key] for key in ('seed', 'command', 'outcome', 'line')}
            for line in wrong[:20]
        ],
    }


def together(before: dict[str, Any], now: dict[str, Any]) -> dict[str, Any]:
    """Return the summary of a kind, of what was judged before and now."""
    most = ('most_seconds', 'most_memory_mib', 'most_memory_of_a_trial_mib')
    return before | {
        'files': before['files'] + now['files'],
        'wrong': before['wrong'] + now['wrong'],
        'outcomes': dict(Counter(before['outcomes']) + Counter(now['outcomes'])),
        'commands': dict(Counter(before['commands']) + Counter(now['commands'])),
        **{key: max(before[key], now[key]) for key in most},
        'examples_of_wrong': (before['examples_of_wrong'] + now['examples_of_wrong'])[:20],
    }


def judged_kind(
    kind: str, pool: ThreadPoolExecutor, first: int, last: int, seconds: float
) -> list[dict[str, Any]]:
    """Judge the files of some seeds, for so long [s]; return what was printed of each."""
    end = time.monotonic() + seconds
    size = PORTION if math.isinf(seconds) else SMALL_PORTION

    def portion(begin: int) -> list[dict[str, Any]]:
        if time.monotonic() > end:
            return []  # portions begin in order: no later one is judged either
        return run_portion(kind, begin, min(begin + size, last))

    return [line for lines in pool.map(portion, range(first, last, size)) for line in lines]


def main() -> None:
    """Measure and write the result."""
    kinds = ('log', *KINDS, *FOREIGN)
    options = arguments(
        __doc__, 'hostile_files', kinds,
        more={
            'portion': 'of a process: KIND FIRST LAST', 'divide': 'judge one part in so many',
            'more': 'go on with those that follow the ones of the result for so long [s]',
        },
    )  # fmt: skip
    if options.portion:
        kind, first, last = options.portion.split()
        judge_portion(kind, int(first), int(last))
        return
    kept: dict[str, Any] = {}
    if (options.only or options.more) and options.json.exists():
        kept = json.loads(options.json.read_text(encoding='utf-8')).get('kinds', {})
    chosen = options.only or kinds
    others = float(options.more or math.inf) * (1 - LOGS_SHARE) / max(1, len(chosen) - 1)
    result = dict(kept)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for kind in chosen:
            planned = LOGS if kind == 'log' else FILES
            count = planned // (QUICK if options.quick else int(options.divide or 1))
            before = kept.get(kind) if options.more else None
            first = before['files'] if before else 0
            seconds = (
                float(options.more) * LOGS_SHARE if options.more and kind == 'log' else others
            )
            found = judged_kind(kind, pool, first, count, seconds)
            if not found:
                continue
            now = {'planned': planned, **summary(found)}
            result[kind] = together(before, now) if before else now
            print(kind, {key: result[kind][key] for key in ('files', 'outcomes', 'most_seconds')})
            write(options.json, {
                'files': sum(kind['files'] for kind in result.values()),
                'wrong': sum(kind['wrong'] for kind in result.values()),
                'kinds': result,
            })  # fmt: skip


if __name__ == '__main__':
    main()
