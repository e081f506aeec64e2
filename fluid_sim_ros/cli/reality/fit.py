# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``fluid_sim fit``: parameters of a model from the logs of flights."""

import argparse
import json
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fluid_sim_ros.cli import completion
from fluid_sim_ros.cli.parser import above
from fluid_sim_ros.cli.reality.compare import add_model, outputs_of, read_log
from fluid_sim_ros.cli.reality.info import mapping_of
from fluid_sim_ros.cli.shared import Show, add_command, plain_text, unbroken
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.output.new_file import new_file
from fluid_sim_ros.output.progress import progress_of_parts
from fluid_sim_ros.schema.data_file import open_data

if TYPE_CHECKING:
    from fluid_sim_ros.flights.flight import Flight
    from fluid_sim_ros.reality.fit import Fitted
    from fluid_sim_ros.reality.fitting.solver import Task


def add_parser(commands: Any, show: Show) -> None:
    """
    Add ``fit`` to the parser of ``fluid_sim``.

    Parameters
    ----------
    commands
        Subparsers of ``fluid_sim``.
    show
        Shows table and JSON.

    """
    text = 'fit parameters of a model to logged flights, with standard errors'
    parser = add_command(commands, 'fit', text, _fit, show)
    logs = parser.add_argument('logs', metavar='LOG', nargs='+', help='that are fitted to')
    completion.completed_by(logs, completion.files(*completion.FLIGHTS))
    add_model(parser)
    parser.add_argument(
        '--parameters', metavar='NAME', nargs='*', default=[], help='none: list those of the model'
    )
    parser.add_argument(
        '--test', metavar='LOG', nargs='+', default=[],
        help='flights left out: errors by horizon before and after',
    )  # fmt: skip
    parser.add_argument(
        '--cross', action='store_true', help='fit again without each flight in turn'
    )
    parser.add_argument(
        '--window', type=above(0), default=0.5, metavar='S', help='[s] (default .5)'
    )
    parser.add_argument(
        '--start', choices=('free', 'measured'), default='free',
        help='states at the begin of windows: unknown, too (default), or as measured, which '
        'predicts best where the model is not quite right',
    )  # fmt: skip
    parser.add_argument(
        '--knots', type=above(0), default=5.0, metavar='S',
        help='longest time between two knots of slow_wind or slow_current [s] (default 5)',
    )  # fmt: skip
    parser.add_argument(
        '--walk', type=above(0), default=0.1, metavar='W',
        help='how strongly they walk at random [m/s per square root of a second] (default .1)',
    )  # fmt: skip
    parser.add_argument('--from', dest='begin', type=float, default=0.0, metavar='S')
    parser.add_argument('--to', dest='end', type=float, default=float('inf'), metavar='S')
    parser.add_argument(
        '--resume', metavar='FILE', type=Path,
        help='values are kept here after each step; where it is there, the fit goes on from it',
    )  # fmt: skip
    parser.add_argument('--patch', metavar='FILE', type=Path, help='YAML of values and sources')
    parser.add_argument('--apply', metavar='FILE', type=Path, help='MJCF: a copy with the values')


def _fit(arguments: argparse.Namespace, show: Show) -> int:
    from fluid_sim_ros.reality.driven import comparable_scene
    from fluid_sim_ros.reality.fit import fit
    from fluid_sim_ros.reality.fitting.solver import Task
    from fluid_sim_ros.reality.parameters import all_parameters
    from fluid_sim_ros.reality.patch import write_model, write_patch

    scene = comparable_scene(arguments.model)
    if not arguments.parameters:
        known = all_parameters(scene)
        lines = [f'{p.name}: {p.value:.6g} {p.unit}' for p in known]
        show(arguments.json, plain_text(lines), [p.name for p in known])
        return 0
    mapping = mapping_of(arguments.mapping)
    flights = [read_log(log, mapping, arguments.smooth) for log in arguments.logs]
    tested = [read_log(log, mapping, arguments.smooth) for log in arguments.test]
    task = Task(
        arguments.model, tuple(arguments.parameters), arguments.window, begin=arguments.begin,
        end=arguments.end, outputs=outputs_of(flights[0], mapping, arguments.model),
        values=_kept(arguments.resume), start=arguments.start,
        knots=arguments.knots, walk=arguments.walk,
    )  # fmt: skip
    with progress_of_parts() as report:
        found = fit(flights, task, report, _keeper(arguments.resume))
        result = found.numbers() | {'model': arguments.model, 'logs': arguments.logs}
        result['test'] = {f.name: _before_after(f, task, found) for f in tested}
        if arguments.cross and len(flights) > 1:
            result['cross_validation'] = {}
            for flight in flights:
                others = [each for each in flights if each is not flight]
                again = fit(others, task, report)
                result['cross_validation'][flight.name] = _before_after(flight, task, again)
    files = []
    if arguments.patch is not None:
        files.append(write_patch(found, arguments.logs, arguments.patch))
    if arguments.apply is not None:
        files.append(write_model(scene, found, arguments.logs, arguments.apply))
    show(arguments.json, _table(result, files), result)
    return 0


def _kept(path: Path | None) -> dict[str, float]:
    if path is None or not path.exists():
        return {}
    try:
        with open_data(path) as file:
            content = json.loads(file.read())
        return {str(name): float(value) for name, value in content.items()}
    except (ValueError, AttributeError, TypeError, OSError, RecursionError, OverflowError):
        raise ConfigError(f'--resume {path}: holds no values of a fit') from None


def _keeper(path: Path | None) -> Callable[[dict[str, float]], None]:
    def keep(values: dict[str, float]) -> None:
        if path is not None:
            with new_file(path) as file:
                file.write_text(json.dumps(values, indent=1) + '\n', encoding='utf-8')

    return keep


def _before_after(flight: 'Flight', task: 'Task', found: 'Fitted') -> dict[str, Any]:
    """Return the errors of a flight by horizon, with the model as it is and as it was fitted."""
    from fluid_sim_ros.reality.compare import Part, compare
    from fluid_sim_ros.reality.fitting.delays import in_time
    from fluid_sim_ros.reality.parameters import edit_of

    part = Part(task.begin, task.end)
    edit = edit_of(found.parameters, found.values)
    before = compare(flight, task.model, task.outputs, part).numbers
    flight = in_time(flight, found.parameters, found.values)
    after = compare(flight, task.model, task.outputs, part, edit).numbers
    return {
        'before': before['horizons'],
        'after': after['horizons'],
        'baselines': after['baselines'],
        'residuals': after['residuals'],
    }


def _table(result: dict[str, Any], files: list[Path]) -> Any:
    from rich.console import Group
    from rich.table import Column, Table

    rms = result['residual_rms']
    title = f'{result["windows"]} windows, residual {rms["before"]:.3g} to {rms["after"]:.3g}'
    name = Column('parameter', overflow='fold')  # what tells two knots apart stands at the end
    table = Table(name, 'value', 'standard error', 'before', 'unit', title=title)
    for key, p in result['parameters'].items():
        table.add_row(
            key, f'{p["value"]:.6g}', f'{p["standard_error"]:.2g}', f'{p["before"]:.6g}',
            p['unit'],
        )  # fmt: skip
    lines = list(result['lines'])
    for part in ('test', 'cross_validation'):
        for name, found in result.get(part, {}).items():
            for horizon, errors in found['after'].items():
                old, new = found['before'][horizon], errors
                lines.append(
                    f'{name}, left out, after {horizon} s: {_three(old)} before, {_three(new)} now'
                )
    return Group(table, plain_text(lines), unbroken(files))


def _three(errors: dict[str, Any]) -> str:
    keys = (('position_m', 'm'), ('velocity_m_s', 'm/s'), ('attitude_deg', 'deg'))
    return ', '.join(f'{errors[key]["median"]:.3g} {unit}' for key, unit in keys)
