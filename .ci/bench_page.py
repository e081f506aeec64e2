# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Write BENCHMARKS.md from the results of the benchmarks.

What it shows of each result stands in benchmarks/key_numbers.yaml. The committed results become
the page at the top (also ``make docs``; a test fails when it is not what would be written);
another folder, the argument, gets its own.
"""

import ast
import importlib
import json
import operator
import os
import re
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import yaml

ROOT = Path(__file__).resolve().parents[1]
RESULTS = ROOT / 'benchmarks' / 'results'
KEY_NUMBERS = ROOT / 'benchmarks' / 'key_numbers.yaml'
PAGE = ROOT / 'BENCHMARKS.md'
COMPARISONS = {'<=': operator.le, '>=': operator.ge}
#: Of the measurement, not of what was measured.
CONDITIONS = ('commit', 'date', 'mujoco', 'python', 'cores', 'cpu', 'os', 'load_average', 'what')

HEAD = """# Benchmarks

Every script of [benchmarks/](benchmarks) with its key numbers; `make bench FULL=1` runs them all
and writes this page, `make docs` writes it again from their results. Times are ratios in one run,
or say what they are. A result was measured at the commit beside it.
"""


class Shown:
    """One key number: what it is, its value, whether it meets its target (None: no target)."""

    def __init__(self, result: dict[str, Any], entry: dict[str, Any]) -> None:
        self.what, self.target = entry['what'], entry.get('target', '')
        values = list(leaves(result, entry['at']))
        if not values:
            raise ValueError(f'{entry["what"]}: nothing at {entry["at"]}')
        if entry.get('count'):
            values = [sum(map(bool, values))]
        if 'over' in entry:
            under = leaves(result, entry['over'])
            values = [a / b for a, b in zip(values, under, strict=True)]
        self.value = worst(values, self.target)
        self.met = meets(self.value, self.target)


def leaves(node: Any, path: Sequence[Any]) -> Iterator[Any]:
    """Yield what is at a path of keys; '*' takes all that has the rest of the path."""
    if not path:
        yield node
        return
    key, rest = path[0], path[1:]
    if key == '*':
        for child in node.values() if isinstance(node, dict) else node:
            yield from leaves(child, rest)
    elif isinstance(node, dict) and key in node:
        yield from leaves(node[key], rest)


def worst(values: Sequence[Any], target: str) -> Any:
    """Return the value that counts of several."""
    if isinstance(values[0], bool):
        return all(values)
    known = [value for value in values if value is not None]
    if not known:
        return None
    return min(known) if target.startswith('>=') else max(known, key=abs)


def meets(value: Any, target: str) -> bool | None:
    """Return whether a value meets its target; None without one."""
    if not target:
        return None
    if target == 'yes':
        return value is True
    sign, bound = target.split()
    return value is not None and bool(COMPARISONS[sign](abs(value), float(bound)))


def shown(
    name: str, result: dict[str, Any], entries: dict[str, Any], *, complete: bool
) -> list[Shown]:
    """Return the key numbers of a result; all of them, or those that a short run has."""
    if name in entries:
        rows = entries[name].get('numbers', [])
        return [Shown(result, row) for row in rows if complete or [*leaves(result, row['at'])]]
    return [
        Shown(result, {'what': key.replace('_', ' '), 'at': [key]})
        for key, value in result.items()
        if key not in CONDITIONS and isinstance(value, (bool, int, float))
    ]


def number(value: Any) -> str:
    """Return a value as it stands in a table."""
    if value is None:
        return 'none'
    if isinstance(value, bool):
        return 'yes' if value else 'no'
    return f'{value:.3g}' if abs(value) < 1e4 else f'{value:.4g}'


def script_of(name: str) -> Path | None:
    """Return the script of a benchmark, which stands in the folder of its subject."""
    return next((ROOT / 'benchmarks').glob(f'*/{name}.py'), None)


def table_of(name: str, result: dict[str, Any]) -> str:
    """Return the table that a benchmark's own ``table(result)`` makes of its result, or ''."""
    script = script_of(name)
    if script is None or '\ndef table(' not in script.read_text(encoding='utf-8'):
        return ''
    module = importlib.import_module(f'benchmarks.{script.parent.name}.{name}')
    return str(module.table(result)).strip()


def description(name: str, count: int) -> str:
    """Return the first paragraphs of a benchmark's docstring."""
    script = script_of(name)
    if script is None:
        return ''
    text = ast.get_docstring(ast.parse(script.read_text(encoding='utf-8'))) or ''
    paragraphs = [' '.join(part.split()) for part in text.split('\n\n')]
    kept = [re.split(r'\s*Run:', part)[0] for part in paragraphs[:count]]
    return '\n\n'.join(part.replace('``', '`').replace('*', r'\*') for part in kept if part)


def section(name: str, result: dict[str, Any], entries: dict[str, Any], folder: Path) -> str:
    """Return the part of the page about one result; links lead from ``folder``'s page."""
    entry, here = entries.get(name, {}), page_of(folder).parent
    parts = [f'## {name}', description(name, entry.get('paragraphs', 2))]
    numbers = shown(name, result, entries, complete=folder == RESULTS)
    if numbers:
        rows = [
            f'| {row.what} | {number(row.value)} | {row.target} | {verdict(row.met)} |'
            for row in numbers
        ]
        parts.append('\n'.join(['| What | Value | Target | Met |', '|---|---|---|---|', *rows]))
    if table := table_of(name, result):
        parts.append(table)
    pictures = [folder / f'{name}.png', *sorted(folder.glob(f'{name}_*.png'))]
    pictures += [ROOT / path for path in entry.get('pictures', [])]
    parts += [
        f'![{path.stem}]({os.path.relpath(path, here)})' for path in pictures if path.exists()
    ]
    source = os.path.relpath(script_of(name) or ROOT / 'benchmarks', here)
    data = os.path.relpath(folder / f'{name}.json', here)
    load = f', load average {result["load_average"]:.1f}' if 'load_average' in result else ''
    measured = f'{result.get("date", "date unknown")[:10]}, commit {commit(result)}{load}'
    parts.append(f'[{name}.py]({source}), [{name}.json]({data}); {measured}.')
    return '\n\n'.join(part for part in parts if part)


def verdict(met: bool | None) -> str:
    """Return whether a target is met, in a word."""
    return '' if met is None else 'yes' if met else '**no**'


def commit(result: dict[str, Any]) -> str:
    """Return the short commit of a result."""
    return str(result.get('commit', 'unknown'))[:12]


def machines(results: dict[str, dict[str, Any]]) -> str:
    """Return one line for each machine and its versions, and what was measured there."""
    found: dict[str, list[str]] = {}
    for name, result in results.items():
        cpu = result.get('cpu', 'processor not recorded')
        software = ', '.join(
            f'{label} {result[key]}'
            for key, label in (('mujoco', 'MuJoCo'), ('python', 'Python'))
            if key in result
        )
        cores = f'{result["cores"]} cores' if 'cores' in result else 'cores not recorded'
        line = '; '.join(filter(None, (cpu, cores, result.get('os', ''), software)))
        found.setdefault(line, []).append(name)
    rows = [f'| {line} | {", ".join(names)} |' for line, names in found.items()]
    return '\n'.join(['| Measured on | Benchmarks |', '|---|---|', *rows])


def summary(results: dict[str, dict[str, Any]], entries: dict[str, Any]) -> str:
    """Return the table of contents, with the targets that are met."""
    rows = []
    for name, result in results.items():
        rows_of = shown(name, result, entries, complete=False)
        aimed = [row.met for row in rows_of if row.met is not None]
        targets = f'{sum(aimed)} of {len(aimed)}' if aimed else ''
        title = description(name, 1).rstrip('.')
        rows.append(f'| [{name}](#{name}) | {title} | {targets} |')
    return '\n'.join(['| Benchmark | What it measures | Targets met |', '|---|---|---|', *rows])


def page_of(folder: Path) -> Path:
    """Return where the page of a folder of results stands."""
    return PAGE if folder == RESULTS else folder / PAGE.name


def page(folder: Path = RESULTS) -> str:
    """Return the whole page of a folder of results."""
    entries = yaml.safe_load(KEY_NUMBERS.read_text(encoding='utf-8'))
    results = {
        path.stem: json.loads(path.read_text(encoding='utf-8'))
        for path in sorted(folder.glob('*.json'))
    }
    head = HEAD
    if folder != RESULTS:
        top = os.path.relpath(ROOT / 'benchmarks', folder)
        head = head.replace('(benchmarks)', f'({top})') + '\nShort runs: the numbers are rough.\n'
    parts = [head.strip(), machines(results), summary(results, entries)]
    parts += [section(name, result, entries, folder) for name, result in results.items()]
    return '\n\n'.join(parts) + '\n'


def main(folder: Path = RESULTS) -> None:
    """Write the page of a folder of results where it is not up to date."""
    target, new = page_of(folder), page(folder)
    if not target.exists() or target.read_text(encoding='utf-8') != new:
        target.write_text(new, encoding='utf-8')
        print(f'docs: wrote {os.path.relpath(target)}')


if __name__ == '__main__':
    main(*(Path(path).resolve() for path in sys.argv[1:]))
