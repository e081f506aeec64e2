# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``fluid_sim stability``: maps of where integration is stable."""

import argparse
import math
from pathlib import Path
from typing import Any

from fluid_sim_ros.cli import completion
from fluid_sim_ros.cli.shared import Show, add_command, made_folder, unbroken
from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.output.progress import progress_of_parts


def add_parser(commands: Any, show: Show) -> None:
    """
    Add ``stability`` to the parser of ``fluid_sim``.

    Parameters
    ----------
    commands
        Subparsers of ``fluid_sim``.
    show
        Shows table and JSON.

    """
    text = 'map where integration is stable'
    stability = add_command(commands, 'stability', text, _stability, show)
    problem = stability.add_argument(
        'problem',
        metavar='PROBLEM',
        nargs='?',
        help='problem, or scene (name or file); none: list problems and axes',
    )
    completion.completed_by(problem, completion.stability_problems)
    for axis in ('x', 'y'):
        stability.add_argument(f'--{axis}', metavar='AXIS', default='', help='default: its own')
        stability.add_argument(
            f'--{axis}-range', nargs=2, type=float, metavar=('LOW', 'HIGH'), default=()
        )
    stability.add_argument('--cells', type=int, default=24, help='per axis (default 24)')
    integrators = stability.add_argument(
        '--integrators', nargs='+', metavar='NAME', help='default: all five'
    )
    completion.completed_by(integrators, completion.words(*completion.INTEGRATORS))
    stability.add_argument(
        '--set', nargs='+', metavar='AXIS=VALUE', default=[], dest='fixed',
        help='parameters that stay the same over the map',
    )  # fmt: skip
    stability.add_argument(
        '--bisect', action='store_true', help='also find the largest stable timestep at each y'
    )
    stability.add_argument('--restart', action='store_true', help='forget an interrupted run')
    stability.add_argument('--out', metavar='FOLDER', type=Path, default=Path('out/stability'))


def _stability(arguments: argparse.Namespace, show: Show) -> int:
    from rich.console import Group
    from rich.table import Table

    from fluid_sim_ros.lab import results
    from fluid_sim_ros.lab.drawing.stability_chart import draw_map
    from fluid_sim_ros.lab.problems.bodies import FAMILIES
    from fluid_sim_ros.lab.problems.problem import INTEGRATORS
    from fluid_sim_ros.lab.stability.limits import largest_steps
    from fluid_sim_ros.lab.stability.outcomes import OUTCOMES
    from fluid_sim_ros.lab.stability.stability_map import plan, run_map

    if not arguments.problem:
        return _list_stability(arguments, show)
    if arguments.problem not in FAMILIES:
        return _scene(arguments, show)
    head = plan(
        arguments.problem, x=arguments.x, y=arguments.y, x_range=arguments.x_range,
        y_range=arguments.y_range, cells=arguments.cells,
        integrators=arguments.integrators or INTEGRATORS, fixed=_settings(arguments.fixed),
    )  # fmt: skip
    stem = arguments.out / f'{head["problem"]}_{head["x"]}_{head["y"]}'
    with made_folder(arguments.out), progress_of_parts() as report:
        result = run_map(
            head, stem.with_suffix('.jsonl'), restart=arguments.restart, report=report
        )
        if arguments.bisect:
            result['largest_steps'] = largest_steps(head, report)
        suffixes = ('.jsonl', '.json', '.png')
        result['files'] = [str(stem.with_suffix(suffix)) for suffix in suffixes]
        draw_map(result, stem.with_suffix('.png'))
        results.save(result, stem.with_suffix('.json'))
    found = [word for word in OUTCOMES if any(row['outcome'] == word for row in result['map'])]
    table = Table('integrator', *found, title=f'{head["problem"]}: cells by outcome')
    for integrator in head['integrators']:
        words = [row['outcome'] for row in result['map'] if row['integrator'] == integrator]
        table.add_row(integrator, *(str(words.count(word)) for word in found))
    show(arguments.json, Group(table, unbroken(result['files'])), result)
    return 0


def _scene(arguments: argparse.Namespace, show: Show) -> int:
    """Find where the integration of a scene's own manoeuvre fails."""
    from rich.console import Group
    from rich.markup import escape
    from rich.table import Table

    from fluid_sim_ros.lab import results
    from fluid_sim_ros.lab.advisor.reference import OUTCOMES
    from fluid_sim_ros.lab.drawing.scene_limits_chart import draw_limits, limit_words
    from fluid_sim_ros.lab.problems.bodies import FAMILIES
    from fluid_sim_ros.lab.problems.catalogue import is_scene
    from fluid_sim_ros.lab.problems.from_scene import of_scene
    from fluid_sim_ros.lab.problems.problem import INTEGRATORS
    from fluid_sim_ros.lab.stability.scene_limits import scene_limits
    from fluid_sim_ros.scene import scene_names

    name = arguments.problem
    if not is_scene(name):
        raise ConfigError(
            f"'{name}' is no stability problem and no scene; problems: {listed(FAMILIES)}; "
            f'scenes: {listed(scene_names())}, or a file'
        )
    if arguments.y or arguments.y_range or arguments.fixed or arguments.x not in ('', 'timestep'):
        raise ConfigError(
            f"'{name}' is a scene: its one axis is the timestep (--x-range LOW HIGH); --y, "
            '--y-range and --set are for the problems'
        )
    with made_folder(arguments.out) as folder, progress_of_parts() as report:
        result = scene_limits(
            of_scene(name), timesteps=arguments.x_range, cells=arguments.cells,
            integrators=arguments.integrators or INTEGRATORS, report=report,
        )  # fmt: skip
        stem = folder / f'{result["problem"]}_timestep'
        files = [draw_limits(result, stem.with_suffix('.png')), stem.with_suffix('.json')]
        result['files'] = [str(file) for file in files]
        results.save(result, stem.with_suffix('.json'))
    found = [word for word in OUTCOMES if any(row['outcome'] == word for row in result['map'])]
    title = f'{result["problem"]}: timesteps by outcome'
    table = Table('integrator', *found, 'lasts', title=title)
    for row in result['largest_steps']:
        cells = [cell for cell in result['map'] if cell['integrator'] == row['integrator']]
        words = [cell['outcome'] for cell in cells]
        table.add_row(
            row['integrator'], *(str(words.count(word)) for word in found),
            limit_words(row['largest_s'], cells),
        )  # fmt: skip
    note = [escape(f'Note: {result["note"]}.')] if result['note'] else []
    show(arguments.json, Group(table, *note, unbroken(result['files'])), result)
    return 0


def _settings(pairs: list[str]) -> dict[str, float]:
    """Return AXIS=VALUE pairs as numbers."""
    out = {}
    for pair in pairs:
        name, _, value = pair.partition('=')
        try:
            out[name] = float(value)
        except ValueError:
            raise ConfigError(f"--set '{pair}': must be AXIS=NUMBER") from None
        if not math.isfinite(out[name]):
            raise ConfigError(f"--set '{pair}': must be finite")
    return out


def _list_stability(arguments: argparse.Namespace, show: Show) -> int:
    from rich.console import Group
    from rich.table import Table

    from fluid_sim_ros.lab.problems.bodies import AXES, FAMILIES

    problems = Table('problem', 'what coasts', 'x', 'y', title='Stability problems')
    for name, kind in FAMILIES.items():
        problems.add_row(name, kind.title, kind.x, kind.y)
    axes = Table('axis', 'meaning', 'range', title='Axes')
    for name, axis in AXES.items():
        axes.add_row(name, axis.label.replace('[', r'\['), f'{axis.low:g} to {axis.high:g}')
    result = {
        'problems': {name: kind.title for name, kind in FAMILIES.items()},
        'axes': {name: axis.label for name, axis in AXES.items()},
    }
    show(arguments.json, Group(problems, axes), result)
    return 0
