# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``fluid_sim sweep``: many runs of one scene with different numbers."""

import argparse
from pathlib import Path
from typing import Any

from fluid_sim_ros.cli import completion
from fluid_sim_ros.cli.shared import Show, add_command, unbroken
from fluid_sim_ros.output.progress import progress_bar

FAILED = 1


def add_parser(commands: Any, show: Show) -> None:
    """
    Add the subcommand to the parser of ``fluid_sim``.

    Parameters
    ----------
    commands
        Subparsers of ``fluid_sim``.
    show
        Shows table and JSON.

    """
    text = 'run a scene many times with different numbers, into a Parquet table'
    parser = add_command(commands, 'sweep', text, _sweep, show)
    file = parser.add_argument('file', metavar='FILE', type=Path, help='YAML file of the sweep')
    completion.completed_by(file, completion.files('yaml', 'yml'))
    parser.add_argument(
        '--out', metavar='FOLDER', type=Path,
        help='results; one that was begun goes on (default out/sweep/ and the name of FILE)',
    )  # fmt: skip
    parser.add_argument(
        '--workers', type=int, metavar='N',
        help='default: one per core; with --device: worlds at a time (4096 on a GPU)',
    )  # fmt: skip
    parser.add_argument(
        '--ray', metavar='ADDRESS',
        help='run on a Ray cluster; local: as processes of this machine',
    )  # fmt: skip
    parser.add_argument(
        '--device', metavar='NAME',
        help='fly a scene of stock MuJoCo as worlds of mujoco_warp on cuda:0, ... or cpu (slow), '
        'in single precision',
    )  # fmt: skip


def _sweep(arguments: argparse.Namespace, show: Show) -> int:
    from rich.markup import escape

    from fluid_sim_ros.sweep.run_sweep import run_sweep
    from fluid_sim_ros.sweep.sweep_file import read_sweep

    sweep = read_sweep(arguments.file)
    out = arguments.out or Path('out/sweep') / arguments.file.stem
    with progress_bar('{task.completed}/{task.total}') as progress:
        # Warp compiles kernels before the first step, a minute in a fresh cache
        what = f'runs on {arguments.device} (kernels are compiled first)'
        task = progress.add_task(escape(what) if arguments.device else 'runs', total=None)
        result = run_sweep(
            sweep, out, workers=arguments.workers, ray_address=arguments.ray,
            device=arguments.device,
            report=lambda done, total: progress.update(task, completed=done, total=total),
        )  # fmt: skip
    show(arguments.json, _table(result), result)
    return FAILED if result['status'].get('failed') else 0


def _table(result: dict[str, Any]) -> Any:
    from rich.console import Group
    from rich.markup import escape

    from fluid_sim_ros.cli.tables import short, table_of

    lines = [f'warning: {line}' for line in result['warnings']]
    if result['runs_with_warnings']:
        lines.append(
            f'{result["runs_with_warnings"]} runs with warnings (column warnings), such as '
            f'{result["first_warning"]}'
        )
    check = result.get('against_cpu')
    if check is not None:
        share = check['largest_relative']
        lines.append(
            f'{result["device"]}; {check["runs"]} runs flown again on the processor: '
            + ('all at rest' if share is None else f'at most {share:.2g} of a value apart')
        )
    ends = ', '.join(f'{count} {status}' for status, count in result['status'].items())
    rows = [
        (name, *(short(numbers[key]) for key in ('min', 'median', 'max')))
        for name, numbers in result['columns'].items()
    ]
    constant = [f'{row[0]} {row[1]}' for row in rows if len({*row[1:]}) == 1]
    if constant and len(constant) < len(rows):
        rows = [row for row in rows if len({*row[1:]}) > 1]
        lines.append(f'The same in every run: {", ".join(constant)}')
    table = table_of(
        ('column', 'min', 'median', 'max'), rows,
        title=f'{escape(result["scene"])}: {result["runs"]} runs ({ends}) in '
        f'{result["wall_s"]:.1f} s',
    )  # fmt: skip
    return Group(table, *map(escape, lines), 'Every row:', unbroken([result['table']]))
