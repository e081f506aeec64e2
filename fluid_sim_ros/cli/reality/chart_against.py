# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``fluid_sim chart --against LOG``: which effect of a model is worth its cost on a flight."""

import argparse
from pathlib import Path
from typing import Any

from fluid_sim_ros.cli import completion
from fluid_sim_ros.cli.parser import above
from fluid_sim_ros.cli.reality.compare import outputs_of
from fluid_sim_ros.cli.reality.info import mapping_of
from fluid_sim_ros.cli.shared import Show, made_folder, plain_text, unbroken
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.output.new_file import new_file
from fluid_sim_ros.output.progress import progress_of_parts


def add_against(chart: argparse.ArgumentParser) -> None:
    """
    Add the options of ``--against`` to ``chart``.

    Parameters
    ----------
    chart
        Its parser.

    """
    group = chart.add_argument_group('against a flight')
    log = group.add_argument(
        '--against', metavar='LOG', help='chart the effects of --model against this flight'
    )
    completion.completed_by(log, completion.files(*completion.FLIGHTS))
    model = group.add_argument(
        '--model', metavar='NAME', help='scene, MJCF or YAML, with --against'
    )
    completion.completed_by(model, completion.scenes)
    mapping = group.add_argument('--mapping', metavar='FILE', type=Path, help='as for compare')
    completion.completed_by(mapping, completion.files('.yaml', '.yml'))
    group.add_argument('--horizon', type=above(0), default=0.5, metavar='S', help='[s] (.5)')


def chart_flight(arguments: argparse.Namespace, show: Show) -> int:
    """
    Chart a model against a flight.

    Parameters
    ----------
    arguments
        Of ``chart``.
    show
        Shows table and JSON.

    Returns
    -------
    int
        0.

    """
    import json

    from fluid_sim_ros.flights.reader import read_flight
    from fluid_sim_ros.reality.charting.against import (
        INTEGRATORS,
        TIMESTEPS,
        Chosen,
        chart_against,
    )
    from fluid_sim_ros.reality.charting.against_picture import draw_against

    if arguments.model is None:
        raise ConfigError('--against LOG: needs --model NAME')
    if arguments.problem or arguments.saved:
        raise ConfigError('--against LOG: takes no PROBLEM and no --from')
    mapping = mapping_of(arguments.mapping)
    flight = read_flight(arguments.against, mapping)
    steps = tuple(arguments.timesteps or (TIMESTEPS[1:4] if arguments.quick else TIMESTEPS))
    chosen = Chosen(
        arguments.horizon, integrators=tuple(arguments.integrators or INTEGRATORS),
        timesteps=steps,
    )  # fmt: skip
    outputs = outputs_of(flight, mapping, arguments.model)
    with progress_of_parts() as report:
        result = chart_against(flight, arguments.model, outputs, chosen, report)
    with made_folder(arguments.out) as folder:
        stem = folder / f'{Path(arguments.model).stem}_against_{Path(arguments.against).stem}'
        numbers = stem.with_suffix('.json')
        with new_file(numbers) as file:
            file.write_text(json.dumps(result, indent=1) + '\n', encoding='utf-8')
        files = [numbers, draw_against(result, stem.with_suffix('.png'))]
    result['files'] = [str(file) for file in files]
    show(arguments.json, _table(result, files), result)
    return 0


def _table(result: dict[str, Any], files: list[Path]) -> Any:
    from rich.console import Group
    from rich.table import Table

    title = (
        f'{result["model"]} against {Path(result["log"]).name}: medians after '
        f'{result["horizon_s"]:g} s, {result["windows"]} windows'
    )
    table = Table('with', 'position [m]', 'velocity [m/s]', 'attitude [deg]', title=title)
    for name, gap in {**result['rungs'], 'velocity held': result['hold_velocity']}.items():
        cells = (gap[key] for key in ('position_m', 'velocity_m_s', 'attitude_deg'))
        table.add_row(name, *('-' if cell is None else f'{cell:.3g}' for cell in cells))
    lines = [*result['words'], *(f'note: {line}' for line in result['notes'])]
    return Group(table, plain_text(lines), unbroken(files))
