# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
What becomes of 100,000 models that load, with all keys of all plugins, under ASan and UBSan.

Each is drawn from a grammar over the keys of the plugins (``test.support.hostile.models``),
stepped with RK4 and implicitfast from its start, and then from states, times and commands that
are no numbers, infinite or huge, with everything read that the library tells. Wrong is a report
of a sanitizer or an assertion of the C++ library, a crash, or more than 10 s of processor time for
one model; 95 % are to load. Fixed seeds. Needs g++ with libasan and libubsan.
Run: ``python -m benchmarks.robustness.valid_models [--quick] [--divide N] [--more SECONDS]
[--processes N]``; with ``--more`` those that follow the ones of the result are judged and added
to it, for so long. The result states how many were planned and how many of them were judged; it
is written every five minutes.
"""

import json
import math
import os
import sys
import time
from collections import Counter, defaultdict
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import mujoco

from benchmarks.common import arguments, write
from benchmarks.plugins.plugin_sanitize import FLAGS, reports, sanitized_copy
from benchmarks.robustness.workers import Found, Worker, in_portions, serve
from fluid_sim_ros.plugins.messages import load_error_line
from fluid_sim_ros.plugins.native import native
from test.support.hostile.models.grammar import BODY, FOIL, MEDIUM, THRUSTER, drawn_model
from test.support.hostile.models.states import used

MODELS, QUICK = 100_000, 100
MOST_SECONDS = 10.0
#: Models that a process is asked for at once.
PORTION = 100
#: Wall time for each second of processor time that is allowed, on a busy machine.
PATIENCE = 10
#: How often the result so far is written [s].
EVERY = 300.0


def judge_model(seed: int) -> Found:
    """Judge the model of a seed."""
    drawn = drawn_model(seed)
    told: Found = {'seed': seed, 'outcome': 'refused'}
    begin = time.process_time()
    try:
        model = mujoco.MjModel.from_xml_string(drawn.xml)
    except ValueError as error:
        told['line'] = load_error_line(error)
    else:
        mujoco.set_mju_user_warning(lambda _: None)
        told['outcome'] = 'finite' if used(model, seed) else 'not finite'
        mujoco.set_mju_user_warning(None)
        told['keys'] = {plugin: sorted(keys) for plugin, keys in drawn.keys.items()}
    told['seconds'] = time.process_time() - begin
    if told['seconds'] > MOST_SECONDS:
        told['outcome'] = 'slow'
    return told


def told_of(portion: list[Found]) -> list[Found]:
    """Return what became of each model; of a crash what the sanitizer said."""
    found = [line for line in portion if 'outcome' in line]
    for line in found:
        if line['outcome'] in ('crash', 'hang'):
            said = reports(line['line']) or [' '.join(line['line'].split())[-500:]]
            line['line'] = said[0]
    return found


def summary(found: list[Found]) -> dict[str, Any]:
    """Return what came of the models."""
    seen: dict[str, Counter[str]] = defaultdict(Counter)
    for line in found:
        for plugin, keys in line.get('keys', {}).items():
            seen[plugin].update(keys)
    wrong = [line for line in found if line['outcome'] in ('crash', 'hang', 'slow')]
    loaded = [line for line in found if line['outcome'] != 'refused']
    missing = {
        plugin: sorted(set(native().plugin_keys(plugin)) - set(seen[plugin]))
        for plugin in (BODY, MEDIUM, FOIL, THRUSTER)
    }
    return {
        'planned': MODELS,
        'models': len(found),
        'wrong': len(wrong),
        'loaded_share': len(loaded) / len(found),
        'outcomes': dict(Counter(line['outcome'] for line in found)),
        'most_seconds': round(max(line['seconds'] for line in found), 2),
        'keys': {plugin: len(keys) for plugin, keys in seen.items()},
        'keys_missing': {plugin: keys for plugin, keys in missing.items() if keys},
        'refused': dict(
            Counter(line['line'][:100] for line in found if line['outcome'] == 'refused')
            .most_common(10)
        ),
        'examples_of_wrong': wrong[:20],
        'flags': FLAGS,
    }  # fmt: skip


def together(before: dict[str, Any], now: dict[str, Any]) -> dict[str, Any]:
    """Return the summary of what was judged before and now."""
    if not before:
        return now
    models = before['models'] + now['models']
    loaded = sum(part['loaded_share'] * part['models'] for part in (before, now))
    missing = {
        plugin: sorted(set(keys) & set(before['keys_missing'].get(plugin, ())))
        for plugin, keys in now['keys_missing'].items()
    }
    return now | {
        'models': models,
        'wrong': before['wrong'] + now['wrong'],
        'loaded_share': loaded / models,
        'outcomes': dict(Counter(before['outcomes']) + Counter(now['outcomes'])),
        'most_seconds': max(before['most_seconds'], now['most_seconds']),
        'keys': {name: max(count, before['keys'][name]) for name, count in now['keys'].items()},
        'keys_missing': {plugin: keys for plugin, keys in missing.items() if keys},
        'refused': dict(Counter(before['refused']) + Counter(now['refused'])),
        'examples_of_wrong': (before['examples_of_wrong'] + now['examples_of_wrong'])[:20],
    }


def main() -> None:
    """Judge, print and write JSON; fail when anything was wrong."""
    options = arguments(
        __doc__, 'valid_models',
        more={
            'divide': 'judge one part in so many', 'processes': 'how many judge at once',
            'more': 'go on with those that follow the ones of the result for so long [s]',
        },
        flags={'worker': 'be a process that judges'},
    )  # fmt: skip
    if options.worker:
        native()
        serve(judge_model)
        return
    options.json = options.json.resolve()
    count = MODELS // (QUICK if options.quick else int(options.divide or 1))
    before = json.loads(options.json.read_text(encoding='utf-8')) if options.more else {}
    seeds = range(before.get('models', 0), count)
    found: list[Found] = []
    written = time.monotonic()
    with TemporaryDirectory() as name:
        folder = Path(name)
        # what Python itself allocates is not looked for; arrays of numpy still come from malloc
        environment = sanitized_copy(folder) | {'PYTHONMALLOC': 'pymalloc'}

        def worker() -> Worker:
            patience = PATIENCE * MOST_SECONDS
            return Worker(__spec__.name, ['--worker'], folder, environment, patience)

        for portion in in_portions(
            worker, seeds, PORTION, float(options.more or math.inf),
            int(options.processes or os.cpu_count() or 1),
        ):  # fmt: skip
            found += told_of(portion)
            if time.monotonic() > written + EVERY:
                write(options.json, together(before, summary(found)))
                written = time.monotonic()
    if not found:
        sys.exit('none is left to judge')
    result = together(before, summary(found))
    print({key: result[key] for key in ('models', 'wrong', 'loaded_share', 'outcomes')})
    write(options.json, result)
    sys.exit(1 if result['wrong'] or result['keys_missing'] else 0)


if __name__ == '__main__':
    main()
