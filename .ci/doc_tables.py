# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Write the tables of the documentation that are made from the project itself, and BENCHMARKS.md.

A table stands between ``<!-- begin NAME -->`` and ``<!-- end NAME -->``. Run by ``make docs``; a
test fails when a table in the documentation is not what would be written.
"""

import ast
import json
import re
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import bench_page  # a script beside this one
import reference_pages
import site_pages

from fluid_sim_ros.mavlink.mapping import load_mapping
from fluid_sim_ros.ros.parameters import simulator as parameters
from fluid_sim_ros.scene import Scene, scene_names
from test.packaging.layers import LEAVES, ORDER

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / 'fluid_sim_ros'


def scenes() -> str:
    """Return the table of scenes."""
    rows = [f'| `{name}` | {Scene.load(name).description} |' for name in scene_names()]
    return '\n'.join(['| Scene | What happens |', '|---|---|', *rows])


def node_parameters() -> str:
    """Return the table of the node's parameters."""
    rows = [_parameter_row(name, declared) for name, declared in parameters.TABLE.items()]
    head = ['| Parameter | Default | Live | Description |', '|---|---|---|---|']
    return '\n'.join([*head, *rows])


def _parameter_row(name: str, declared: Any) -> str:
    default = declared.default
    if isinstance(default, bool):
        default = str(default).lower()
    default = '(empty)' if default in ('', ['']) else f'`{default}`'
    live = 'yes' if declared.live else 'at start' if declared.names_place else 'no'
    return f'| `{name}` | {default} | {live} | {declared.description} |'


def accuracy() -> str:
    """Return the table of stock MuJoCo against this package, by the benchmark's result."""
    return _table_of('plugin_stock_vs_ours')


def advice() -> str:
    """Return the table of the advisor's choices, by the benchmark's result."""
    return _table_of('lab_advise')


def added_mass() -> str:
    """Return the table of added masses from meshes, by the benchmark's result."""
    return _table_of('hydro_accuracy')


def validation() -> str:
    """Return the table of models against measurements, by the benchmark's result."""
    return _table_of('validation')


def step_profile() -> str:
    """Return the table of where a step's time goes, by the benchmark's result."""
    return _table_of('step_profile')


def step_stages() -> str:
    """Return the table of what of MuJoCo's step each scene takes, by the benchmark's result."""
    return _table_of('step_stages')


def growth() -> str:
    """Return the table of what more of something costs, by the benchmark's result."""
    return _table_of('growth')


def exchange() -> str:
    """Return the table of what an exchange with an autopilot takes, by the benchmark's result."""
    return _table_of('autopilot_bridge')


def _table_of(name: str) -> str:
    path = bench_page.RESULTS / f'{name}.json'
    return bench_page.table_of(name, json.loads(path.read_text(encoding='utf-8')))


def autopilot_parameters(protocol: str) -> str:
    """Return the table of the parameters that the mappings of a protocol carry."""
    rows = []
    for path in sorted((ROOT / 'config' / 'autopilots').glob(f'{protocol}_*.yaml')):
        file, _ = load_mapping(protocol, '', str(path))
        vehicle, reason = path.stem.removeprefix(f'{protocol}_'), ''
        for name, entry in file.parameters.items():
            reason = reason if entry.reason == 'as above' else entry.reason
            rows.append(f'| {vehicle} | `{name}` | {entry.value:g} | {reason} |')
            vehicle = ''
    return '\n'.join(['| Vehicle | Parameter | Value | Why |', '|---|---|---|---|', *rows])


def rooms() -> str:
    """Return the package's tree in the order of imports, with what each room says of itself."""
    lines = []
    for room in ORDER:
        for path in _modules_of(room):
            depth = len(path.parts) - (2 if path.name == '__init__.py' else 1)
            name = path.parent.name + '/' if path.name == '__init__.py' else path.name
            words = (
                ast.get_docstring(ast.parse((PACKAGE / path).read_text())) or ''
            ).splitlines()[0]
            leaf = ' (leaf)' if room in LEAVES and depth == 0 else ''
            lines.append(f'{"  " * depth + name:<16} {words.rstrip(".").replace("``", "")}{leaf}')
    return '\n'.join(['```text', *lines, '```'])


def _modules_of(room: str) -> list[Path]:
    """Return a room's file, or the ``__init__.py`` of its folder and of those inside."""
    if (PACKAGE / f'{room}.py').exists():
        return [Path(f'{room}.py')]
    folders = sorted((PACKAGE / room).rglob('__init__.py'))
    return [path.relative_to(PACKAGE) for path in folders]


TABLES: dict[str, tuple[str, Callable[[], str]]] = {
    'scenes': ('doc/scenes.md', scenes),
    'accuracy': ('doc/accuracy.md', accuracy),
    'advice': ('doc/lab_methods.md', advice),
    'added mass': ('doc/hydro.md', added_mass),
    'validation': ('doc/validation.md', validation),
    'questions': ('doc/development.md', site_pages.questions),
    'step profile': ('doc/speed.md', step_profile),
    'step stages': ('doc/speed.md', step_stages),
    'growth': ('doc/speed.md', growth),
    'exchange': ('doc/speed.md', exchange),
    'rooms': ('doc/development.md', rooms),
    'parameters': ('doc/parameters.md', node_parameters),
    'command line': ('doc/reference/command_line.md', reference_pages.command_line),
    'python names': ('doc/reference/python.md', reference_pages.python_names),
    'scene files': ('doc/reference/scene_files.md', reference_pages.scene_files),
    'sweep files': ('doc/reference/sweep_files.md', reference_pages.sweep_files),
    'mapping files': ('doc/reference/mapping_files.md', reference_pages.mapping_files),
    'px4 parameters': ('doc/autopilot_px4.md', partial(autopilot_parameters, 'px4')),
    'ardupilot parameters': (
        'doc/autopilot_ardupilot.md',
        partial(autopilot_parameters, 'ardupilot'),
    ),
}


def with_table(text: str, name: str, table: str) -> str:
    """Return a page's text with one table replaced; ValueError where its marks are missing."""
    begin, end = f'<!-- begin {name} -->', f'<!-- end {name} -->'
    pattern = re.compile(f'{re.escape(begin)}.*?{re.escape(end)}', re.DOTALL)
    if not pattern.search(text):
        raise ValueError(f'no {begin} ... {end}')
    return pattern.sub(lambda _: f'{begin}\n{table}\n{end}', text)


def main() -> int:
    """Write every table that is not up to date."""
    for name, (page, table) in TABLES.items():
        path = ROOT / page
        old = path.read_text(encoding='utf-8')
        new = with_table(old, name, table())
        if new != old:
            path.write_text(new, encoding='utf-8')
            print(f'docs: wrote the table {name} of {page}')
    bench_page.main()
    return 0


if __name__ == '__main__':
    sys.exit(main())
