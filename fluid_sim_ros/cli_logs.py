"""The subcommands of ``fluid_sim`` that work on logs."""

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import Any

from fluid_sim_ros.errors import MissingExtraError

#: Shows a table, or writes a result as JSON: (path or None, table, result).
Show = Callable[[str | None, Any, object], None]

DAMAGED = 1


def add_parsers(commands: Any, show: Show, json_help: str) -> None:
    """Add the subcommands to the parser of ``fluid_sim``."""

    def add(name: str, text: str, function: Callable[..., int]) -> argparse.ArgumentParser:
        parser: argparse.ArgumentParser = commands.add_parser(name, help=text, description=text)
        parser.add_argument('log', metavar='LOG', help='.mcap file, or the folder of one')
        parser.add_argument('--json', metavar='PATH', help=json_help)
        parser.set_defaults(function=lambda arguments: _needing_mcap(function, arguments, show))
        return parser

    add('info', 'what is in a log, and whether it is sound', _info)
    repair = add('repair', 'write all that is sound in a damaged log to a new one', _repair)
    repair.add_argument('out', metavar='OUT', type=Path, help='.mcap file, or a folder: a bag')


def _needing_mcap(
    function: Callable[[argparse.Namespace, Show], int], arguments: argparse.Namespace, show: Show
) -> int:
    try:
        return function(arguments, show)
    except ModuleNotFoundError as error:
        if error.name is None or error.name.startswith('fluid_sim_ros'):
            raise
        raise MissingExtraError(
            f'{arguments.command} needs {error.name}, which is not installed; '
            'fluid_sim doctor says what to type'
        ) from None


def _info(arguments: argparse.Namespace, show: Show) -> int:
    from rich.console import Group
    from rich.markup import escape
    from rich.table import Column, Table

    from fluid_sim_ros.recording.inspect import info

    result = info(arguments.log)
    table = Table(
        Column('topic', overflow='fold'), Column('type', overflow='fold'), 'messages', 'rate',
        title=f'{result["path"]}: {result["bytes"] / 1e6:.2f} MB, '
        f'{result["begin_s"]:.2f} to {result["end_s"]:.2f} s',
    )  # fmt: skip
    for name, topic in result['topics'].items():
        rate = topic['rate_hz']
        shown = '' if rate is None else f'{rate:g} Hz'
        table.add_row(name, topic['type'], str(topic['messages']), shown)
    run = result['run']
    lines = [result['run_fault']] if run is None else [
        f'scene {run["scene"]}, seed {run["seed"]}, timestep {run["timestep"]:g} s, '
        f'{run["integrator"]}; fluid_sim_ros {run["versions"]["fluid_sim_ros"]}, '
        f'MuJoCo {run["versions"]["mujoco"]}'
    ]  # fmt: skip
    lines += [f'damaged: {fault}' for fault in result['faults']] or ['sound: every checksum holds']
    show(arguments.json, Group(table, *map(escape, lines)), result)
    return DAMAGED if result['faults'] else 0


def _repair(arguments: argparse.Namespace, show: Show) -> int:
    from rich.markup import escape

    from fluid_sim_ros.recording.inspect import repair

    result = repair(arguments.log, arguments.out)
    lost = ''.join(f'\nlost: {line}' for line in result['lost'])
    text = f'{result["path"]}: {result["messages"]} messages, {result["bytes"]} bytes{lost}'
    show(arguments.json, escape(text), result)
    return 0
