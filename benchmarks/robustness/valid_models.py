# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
What becomes of 100,000 models that load, with all keys of all plugins, under ASan and UBSan.

Each is drawn from a grammar over the keys of the plugins (``test.support.hostile.models``),
stepped with RK4 and implicitfast from its start, and then from states, times and commands that
are no numbers, infinite or huge, with everything read that the library tells. Wrong is a report
of a sanitizer or an assertion of the C++ library, a crash, or more than 10 s of processor time for
one model; 95 % are to load. Fixed seeds. Needs g++ with libasan and libubsan.
Run: ``python -m benchmarks.robustness.valid_models [--quick] [--divide N] [--more SECONDS]``; with
``--more`` those that follow the ones of the result are judged and added to it, for so long. The
result states how many were planned and how many of them were judged.
"""

import json
import os
import subprocess
import sys
import time
from collections import Counter, defaultdict
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import mujoco

from benchmarks.common import arguments, write
from benchmarks.plugins.plugin_sanitize import FLAGS, reports, sanitized_copy
from fluid_sim_ros.plugins.messages import load_error_line
from fluid_sim_ros.plugins.native import native
from test.support.hostile.models.grammar import BODY, FOIL, MEDIUM, THRUSTER, drawn_model
from test.support.hostile.models.states import used

MODELS, QUICK = 100_000, 100
MOST_SECONDS = 10.0
#: Models of one process; a crash costs the rest of its portion a new start.
PORTION = 1000


def judge_portion(first: int, last: int) -> None:
    """Judge the models of some seeds; print a line of JSON before and after each."""
    native()
    for seed in range(first, last):
        print(json.dumps({'begun': seed}), flush=True)
        drawn = drawn_model(seed)
        told: dict[str, Any] = {'seed': seed, 'outcome': 'refused'}
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
        print(json.dumps(told), flush=True)


def run_portion(
    first: int, last: int, environment: dict[str, str], folder: Path
) -> list[dict[str, Any]]:
    """Judge some seeds in processes of their own, a new one after each crash."""
    found: list[dict[str, Any]] = []
    while first < last:
        command = [sys.executable, '-m', __spec__.name, '--portion', f'{first} {last}']
        done = subprocess.run(
            command, cwd=folder, env=environment, capture_output=True, text=True, check=False
        )
        lines = [json.loads(line) for line in done.stdout.splitlines() if line.startswith('{')]
        found += [line for line in lines if 'outcome' in line]
        if done.returncode == 0:
            break
        begun = [line['begun'] for line in lines if 'begun' in line]
        seed = begun[-1] if begun else first
        said = reports(done.stderr) or [' '.join(done.stderr.split())[-500:]]
        found.append({'seed': seed, 'outcome': 'crash', 'line': said[0], 'seconds': 0.0})
        first = seed + 1
    return found


def summary(found: list[dict[str, Any]]) -> dict[str, Any]:
    """Return what came of the models."""
    seen: dict[str, Counter[str]] = defaultdict(Counter)
    for line in found:
        for plugin, keys in line.get('keys', {}).items():
            seen[plugin].update(keys)
    wrong = [line for line in found if line['outcome'] in ('crash', 'slow')]
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
            'portion': 'of a process: FIRST LAST', 'divide': 'judge one part in so many',
            'more': 'go on with those that follow the ones of the result for so long [s]',
        },
    )  # fmt: skip
    if options.portion:
        judge_portion(*map(int, options.portion.split()))
        return
    options.json = options.json.resolve()
    count = MODELS // (QUICK if options.quick else int(options.divide or 1))
    before = json.loads(options.json.read_text(encoding='utf-8')) if options.more else {}
    begin = before.get('models', 0)
    size = PORTION // 4 if options.more else PORTION
    with TemporaryDirectory() as name, ThreadPoolExecutor(os.cpu_count()) as pool:
        folder = Path(name)
        # what Python itself allocates is not looked for; arrays of numpy still come from malloc
        environment = sanitized_copy(folder) | {'PYTHONMALLOC': 'pymalloc'}
        end = time.monotonic() + float(options.more or 1e9)

        def judged(first: int) -> list[dict[str, Any]]:
            if time.monotonic() > end:
                return []  # portions begin in order: no later one is judged either
            return run_portion(first, min(first + size, count), environment, folder)

        portions = pool.map(judged, range(begin, count, size))
        found = [line for portion in portions for line in portion]
    result = together(before, summary(found)) if before else summary(found)
    print({key: result[key] for key in ('models', 'wrong', 'loaded_share', 'outcomes')})
    write(options.json, result)
    sys.exit(1 if result['wrong'] or result['keys_missing'] else 0)


if __name__ == '__main__':
    main()
