# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``fluid_sim info`` for logs of other software: what is in them for a comparison."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fluid_sim_ros.cli.shared import Show, plain_text

if TYPE_CHECKING:
    from fluid_sim_ros.flights.mapping import FlightMap

#: Exit code where the log is damaged.
DAMAGED = 1


def is_foreign(path: Path) -> bool:
    """
    Return whether a log is of other software, by its ending or its content.

    Parameters
    ----------
    path
        Of the log.

    """
    from fluid_sim_ros.flights.reader import ENDINGS

    if path.is_dir():
        return not any(path.glob('*.mcap')) and any(path.glob('*.db3'))
    return path.suffix.lower() in ENDINGS and path.suffix.lower() != '.mcap'


def is_sound_bag(path: Path, result: dict[str, Any]) -> bool:
    """
    Return whether an MCAP file is whole, holds messages, and is of other software.

    Parameters
    ----------
    path
        Of the log, or its folder.
    result
        As ``recording.inspect.info`` returns it: what is damaged is told by that alone.

    """
    from fluid_sim_ros.flights.bag import of_others

    if result['faults'] or result['run'] is not None:
        return False
    if not any(topic['messages'] for topic in result['topics'].values()):
        return False
    files = sorted(path.glob('*.mcap')) if path.is_dir() else [path]
    return of_others(files[0])


def mapping_of(path: Path | None) -> 'FlightMap | None':
    """
    Return the mapping that the user names, or None for that of the format.

    Parameters
    ----------
    path
        Of the file; None: none was named.

    """
    from fluid_sim_ros.flights.mapping import read_mapping

    return None if path is None else read_mapping(path)


def flight_info(arguments: argparse.Namespace, show: Show) -> int:
    """
    Show what is in the log of a flight.

    Parameters
    ----------
    arguments
        With ``log``, ``mapping`` and ``json``.
    show
        Shows table and JSON.

    Returns
    -------
    int
        0, or 1 where it is damaged.

    """
    from fluid_sim_ros.flights.about import about_flight
    from fluid_sim_ros.flights.reader import read_flight

    result = about_flight(read_flight(arguments.log, mapping_of(arguments.mapping)))
    show(arguments.json, _table(result), result)
    return DAMAGED if any('damaged' in fault for fault in result['faults']) else 0


def _table(result: dict[str, Any]) -> Any:
    from rich.console import Group
    from rich.table import Column, Table

    title = f'{result["path"]}: {result["kind"]}, {result["duration_s"]:.2f} s'
    table = Table(
        'signal', Column('from', overflow='fold'), 'samples', 'rate', 'gaps', 'jumps',
        title=plain_text([title]),
    )  # fmt: skip
    for name, signal in result['signals'].items():
        cells = (
            name, signal['source'].partition(':')[0] + (', truth' if signal['truth'] else ''),
            str(signal['samples']), f'{signal["rate_hz"]:.4g} Hz', str(signal['gaps'] or ''),
            str(signal['outliers'] or ''),
        )  # fmt: skip
        table.add_row(*(plain_text([cell]) for cell in cells))
    lines = [f'{key}: {value}' for key, value in result['about'].items()]
    lines += [_clock(clock) for clock in result['clocks']]
    lines += [f'damaged: {line}' if 'damaged' not in line else line for line in result['faults']]
    lines += result['notes']
    lines += [f'odd: {line}' for line in result['findings']]
    lines += [f'missing for a comparison: {line}' for line in result['missing']]
    if not result['missing']:
        lines.append('complete for a comparison: fluid_sim compare LOG --model NAME')
    return Group(table, plain_text(lines))


def _clock(clock: dict[str, Any]) -> str:
    share = f'{100 * clock["unexplained"]:.0f} % unexplained'
    if clock['offset_s'] is None:
        return f'{clock["what"]}: {share}'
    return f'{clock["what"]}: {1e3 * clock["offset_s"]:+.1f} ms apart, {share}'
