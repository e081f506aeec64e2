# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
What becomes of hostile files: 20,000 logs with right checksums, 2,000 files of each other kind.

Logs are mutated record by record (``test.support.hostile.logs``) and opened by the commands that
open logs, each with its share; YAML, NPZ, NetCDF, CSV and MJCF files are loaded as a scene; files
of other software and settings (``test.support.hostile.foreign``) are opened as they are. Right is
a result, or an error of ours on one printable line; wrong is a traceback, a crash, more than 10 s
of processor time (or a minute of wall time) in each of three attempts, memory beyond four times
the file and 256 MiB, a file touched outside of the working folder, or text that a terminal acts
on. Fixed seeds.
Run: ``python -m benchmarks.robustness.hostile_files [--quick] [--only KIND ...] [--divide N]
[--more SECONDS] [--processes N]``; with ``--more`` those that follow the ones of the result are
judged and added to it, for so long, a quarter of it for logs. The result states how many were
planned and how many of them were judged.
"""

import contextlib
import json
import math
import os
import sys
import tempfile
import time
import warnings
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from benchmarks.common import ROOT, arguments, write
from benchmarks.robustness.workers import Found, Worker, in_portions, serve
from test.support.hostile.files import KINDS, hostile_file
from test.support.hostile.foreign.kinds import KINDS as FOREIGN
from test.support.hostile.foreign.kinds import foreign_file, opened
from test.support.hostile.judge import MOST_WALL, Outside, Verdict, judged
from test.support.hostile.trials import Trials

LOGS, FILES = 20_000, 2_000
QUICK = 20
#: Files that a process is asked for at once.
PORTION = 25
#: One trial of so many is the process that the product starts; the others are forks of one.
REAL_TRIALS = 10
#: A file is slow when it is so many times: others on the same core take processor time, too.
ATTEMPTS = 3
#: What is said of a ULog that pyulog would read for ever.
ENDLESS = 'leads back to the same place'
#: Wall time allowed for one file on a busy machine [s].
PATIENCE = 10 * MOST_WALL
#: How often the result of a kind so far is written [s].
EVERY = 300.0
#: Share of the time of ``--more`` that logs have.
LOGS_SHARE = 0.25


def judge_files(kind: str) -> None:
    """Judge the files of a kind whose seeds standard input asks for."""
    warnings.simplefilter('ignore')
    with tempfile.TemporaryDirectory() as folder:
        trials = Trials(Path(folder))
        watched = Path(folder) / 'watched'
        watched.mkdir()
        outside = Outside(watched)
        if kind == 'log':
            judge = _judge_log(Path(folder))
        elif kind in KINDS:
            judge = _judge_file(kind)
        else:
            judge = _judge_foreign(kind, outside)

        def judge_one(seed: int) -> Found:
            trials.real = seed % REAL_TRIALS == 0
            for _ in range(ATTEMPTS):
                os.chdir(outside.working)
                verdict, command = judge(seed, outside.working)
                os.chdir('/')
                if outside.changed() or outside.told(verdict):
                    verdict.outcome = 'outside'
                outside.clear()
                if verdict.outcome != 'slow':
                    break
            return vars(verdict) | {'seed': seed, 'command': command}

        serve(judge_one, lambda: {'children': trials.peak})
        trials.close()


def _judge_log(folder: Path) -> Any:
    from fluid_sim_ros.recording.reader import open_log
    from test.support.hostile.commands import COMMANDS, command_of, judged_log
    from test.support.hostile.logs import Mutator
    from test.support.recorded_flights import record_flight

    record_flight(folder / 'flight.mcap', 'quadrotor', seconds=0.5, seed=1)
    # the libraries that draw take 260 MiB, whatever is drawn; what it prints is no worker's line
    with contextlib.redirect_stdout(sys.stderr):
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


def told_of(kind: str, portion: list[Found]) -> list[Found]:
    """Return what became of each file, and what trials took."""
    ended = {'memory': 0, 'command': kind}  # of one that ended its process
    return [
        ended | line | {'line': ' '.join(line['line'].split())[-300:]} if 'outcome' in line
        else line
        for line in portion
    ]  # fmt: skip


def summary(found: list[Found]) -> dict[str, Any]:
    """Return what came of the files of a kind."""
    verdicts = [line for line in found if 'outcome' in line]
    wrong = [line for line in verdicts if line['outcome'] not in ('read', 'refused')]
    return {
        'files': len(verdicts),
        'wrong': len(wrong),
        'outcomes': dict(Counter(line['outcome'] for line in verdicts)),
        'commands': dict(Counter(line['command'] for line in verdicts)),
        'endless': sum(ENDLESS in line['line'] for line in verdicts),
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


def together(before: dict[str, Any] | None, now: dict[str, Any]) -> dict[str, Any]:
    """Return the summary of a kind, of what was judged before and now."""
    if before is None:
        return now
    most = ('most_seconds', 'most_memory_mib', 'most_memory_of_a_trial_mib')
    return before | {
        'files': before['files'] + now['files'],
        'wrong': before['wrong'] + now['wrong'],
        'outcomes': dict(Counter(before['outcomes']) + Counter(now['outcomes'])),
        'commands': dict(Counter(before['commands']) + Counter(now['commands'])),
        'endless': before.get('endless', 0) + now['endless'],
        **{key: max(before[key], now[key]) for key in most},
        'examples_of_wrong': (before['examples_of_wrong'] + now['examples_of_wrong'])[:20],
    }


def judged_kind(kind: str, seeds: range, seconds: float, processes: int) -> Iterator[list[Found]]:
    """Judge the files of some seeds, for so long [s]; yield what became of each portion."""

    def worker() -> Worker:
        environment = {'MUJOCO_GL': 'egl', **os.environ}  # MuJoCo chooses when it is imported
        return Worker(__spec__.name, ['--worker', kind], ROOT, environment, PATIENCE)

    for portion in in_portions(worker, seeds, PORTION, seconds, processes):
        yield told_of(kind, portion)


def main() -> None:
    """Measure and write the result."""
    kinds = ('log', *KINDS, *FOREIGN)
    options = arguments(
        __doc__, 'hostile_files', kinds,
        more={
            'worker': 'be a process that judges a KIND', 'divide': 'judge one part in so many',
            'processes': 'how many judge at once',
            'more': 'go on with those that follow the ones of the result for so long [s]',
        },
    )  # fmt: skip
    if options.worker:
        judge_files(options.worker)
        return
    options.json = options.json.resolve()
    kept: dict[str, Any] = {}
    if (options.only or options.more) and options.json.exists():
        kept = json.loads(options.json.read_text(encoding='utf-8')).get('kinds', {})
    result = dict(kept)
    chosen = list(options.only or kinds)
    others = len(chosen) - ('log' in chosen)
    share = {kind: 1.0 for kind in chosen}
    if others:
        share['log'] = others * LOGS_SHARE / (1 - LOGS_SHARE)
    end = time.monotonic() + float(options.more or math.inf)
    for at, kind in enumerate(chosen):
        planned = LOGS if kind == 'log' else FILES
        count = planned // (QUICK if options.quick else int(options.divide or 1))
        before = kept.get(kind) if options.more else None
        left = share[kind] / sum(share[name] for name in chosen[at:])
        found: list[Found] = []
        written = time.monotonic()
        for portion in judged_kind(
            kind, range(before['files'] if before else 0, count),
            left * (end - time.monotonic()), int(options.processes or os.cpu_count() or 1),
        ):  # fmt: skip
            found += portion
            if time.monotonic() > written + EVERY:
                result[kind] = together(before, {'planned': planned, **summary(found)})
                _write(options.json, result)
                written = time.monotonic()
        if found:
            part = result[kind] = together(before, {'planned': planned, **summary(found)})
            print(kind, {key: part[key] for key in ('files', 'outcomes', 'most_seconds')})
            _write(options.json, result)


def _write(path: Path, result: dict[str, Any]) -> None:
    write(path, {
        'files': sum(kind['files'] for kind in result.values()),
        'wrong': sum(kind['wrong'] for kind in result.values()),
        'kinds': result,
    })  # fmt: skip


if __name__ == '__main__':
    main()
