# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``fluid_sim compare``: a model against the log of a flight."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fluid_sim_ros.cli import completion
from fluid_sim_ros.cli.parser import above
from fluid_sim_ros.cli.reality.info import mapping_of
from fluid_sim_ros.cli.shared import Show, add_command, made_folder, plain_text, unbroken
from fluid_sim_ros.output.progress import LOG_PATIENCE, progress_of_parts

if TYPE_CHECKING:
    from fluid_sim_ros.flights.flight import Flight
    from fluid_sim_ros.flights.mapping import FlightMap, Output
    from fluid_sim_ros.output.progress import Report
    from fluid_sim_ros.reality.compare import Part


def add_parser(commands: Any, show: Show) -> None:
    """
    Add ``compare`` to the parser of ``fluid_sim``.

    Parameters
    ----------
    commands
        Subparsers of ``fluid_sim``.
    show
        Shows table and JSON.

    """
    text = 'fly a logged flight again with a model, and measure the gap'
    parser = add_command(commands, 'compare', text, _compare, show)
    log = parser.add_argument('log', metavar='LOG', help='of any software; see fluid_sim info LOG')
    completion.completed_by(log, completion.files(*completion.FLIGHTS))
    add_model(parser)
    add_part(parser)
    parser.add_argument('--out', metavar='FOLDER', type=Path, help='picture and page go here')


def add_model(parser: argparse.ArgumentParser) -> None:
    """
    Add ``--model`` and ``--mapping``.

    Parameters
    ----------
    parser
        Of a subcommand.

    """
    model = parser.add_argument(
        '--model', metavar='NAME', required=True, help='scene (fluid_sim scenes), MJCF or YAML'
    )
    completion.completed_by(model, completion.scenes)
    parser.add_argument(
        '--mapping', metavar='FILE', type=Path,
        help='which columns are what; default: config/flights of the format',
    )  # fmt: skip
    parser.add_argument(
        '--smooth', action='store_true',
        help='state from pose, gyro and accelerometer together, of later samples, too; for a pose '
        'that was measured (motion capture), not estimated',
    )  # fmt: skip


def read_log(log: str, mapping: 'FlightMap | None', smooth: bool) -> 'Flight':
    """
    Return the flight of a log, with its state smoothed where that is asked for.

    Parameters
    ----------
    log
        Path.
    mapping
        The user's.
    smooth
        Whether ``--smooth`` was given.

    """
    from fluid_sim_ros.flights.reader import read_flight
    from fluid_sim_ros.flights.smooth import smoothed

    flight = read_flight(log, mapping)
    return smoothed(flight).flight if smooth else flight


def add_part(parser: argparse.ArgumentParser) -> None:
    """
    Add what part of a flight is used, and with which settings.

    Parameters
    ----------
    parser
        Of a subcommand.

    """
    parser.add_argument('--from', dest='begin', type=float, default=0.0, metavar='S')
    parser.add_argument('--to', dest='end', type=float, default=float('inf'), metavar='S')
    parser.add_argument(
        '--horizons', nargs='+', type=above(0), metavar='S',
        help='lengths of the windows [s] (default .1 .25 .5 1)',
    )  # fmt: skip
    parser.add_argument('--timestep', type=above(0), metavar='S', help="[s] (default the model's)")
    parser.add_argument('--integrator', metavar='NAME', help="default the model's")
    parser.add_argument(
        '--fluid', metavar='RUNG', help='none, inertia, ellipsoid, no_added_mass, inflow'
    )


def part_of(arguments: argparse.Namespace) -> 'Part':
    """
    Return the part that the options name.

    Parameters
    ----------
    arguments
        Of a subcommand with ``add_part``.

    """
    from fluid_sim_ros.reality.compare import HORIZONS, Part
    from fluid_sim_ros.schema.settings import RunSettings

    settings = RunSettings.checked(
        '--{}', timestep=arguments.timestep, integrator=arguments.integrator,
        fluid=arguments.fluid,
    )  # fmt: skip
    horizons = tuple(arguments.horizons or HORIZONS)
    return Part(arguments.begin, arguments.end, horizons, settings)


def outputs_of(flight: 'Flight', mapping: 'FlightMap | None', model: str) -> tuple['Output', ...]:
    """
    Return what the outputs of an autopilot drive: by the mapping, or as config/autopilots says.

    Parameters
    ----------
    flight
        That was read.
    mapping
        The user's.
    model
        Scene that is compared.

    """
    from fluid_sim_ros.errors import FluidSimError
    from fluid_sim_ros.flights.mapping import Output
    from fluid_sim_ros.mavlink.mapping import load_mapping
    from fluid_sim_ros.scene import Scene

    if mapping is not None and (mapping.actuators or mapping.thrusters):
        return tuple(mapping.actuators)
    protocol = flight.raw.format
    signal = flight.actuators
    # what a mapping of config/autopilots takes: PX4's controls, ArduPilot's pulses
    takes = {'px4': 'normalized', 'ardupilot': 'pulse'}.get(protocol)
    if signal is None or signal.quantity != takes:
        return ()
    names = list(Scene.load(model).vehicles or {})
    try:
        file, _ = load_mapping(protocol, flight.vehicle or (names[0] if names else ''))
    except FluidSimError:  # none for this vehicle: by the order of the model, with a note
        return ()
    return tuple(
        Output(output=a.output, thruster=a.thruster, input=list(a.input), curve=a.curve)
        for a in file.actuators
        if a.thruster and a.curve in ('rotor_speed', 'thrust')
    )


def _compare(arguments: argparse.Namespace, show: Show) -> int:
    from fluid_sim_ros.reality.compare import compare

    mapping = mapping_of(arguments.mapping)
    flight = read_log(arguments.log, mapping, arguments.smooth)
    outputs = outputs_of(flight, mapping, arguments.model)
    with progress_of_parts(LOG_PATIENCE) as report:
        found = compare(flight, arguments.model, outputs, part_of(arguments), report=report)
        replayed = _replayed(arguments.log, report)
    if replayed is not None:
        found.numbers['replay'] = replayed
    files: list[Path] = []
    if arguments.out is not None:
        from fluid_sim_ros.reality.report import draw, write_report

        with made_folder(arguments.out) as folder:
            stem = folder / Path(arguments.log).stem
            picture = draw(found, stem.with_suffix('.png'))
            files = [picture, write_report(found, picture, stem.with_suffix('.html'))]
    found.numbers['files'] = [str(file) for file in files]
    show(arguments.json, _table(found.numbers, files), found.numbers)
    return 0


def _replayed(log: str, report: 'Report') -> dict[str, Any] | None:
    """Return how far an exact repetition of a log of ours is from it; None for one of others."""
    from fluid_sim_ros.errors import FluidSimError
    from fluid_sim_ros.recording.reader import open_log
    from fluid_sim_ros.recording.replay.resimulate import resimulate

    if not log.lower().endswith('.mcap'):
        return None
    try:
        result = resimulate(open_log(log, report))
    except FluidSimError:  # a log without our run in it
        return None
    return {
        'messages': result.compared, 'identical': result.difference is None,
        'largest': max(result.largest.values(), default=0.0), 'notes': result.notes,
    }  # fmt: skip


def _table(numbers: dict[str, Any], files: list[Path]) -> Any:
    from rich.console import Group
    from rich.table import Table

    used = numbers['windows']['used']
    title = f'{numbers["model"]} against {Path(numbers["log"]).name}: {used} windows, medians'
    table = Table(
        'after', 'position [m]', 'velocity [m/s]', 'attitude [deg]', 'hold velocity [m]',
        'rigid body [m]', title=plain_text([title]),
    )  # fmt: skip
    for horizon, errors in numbers['horizons'].items():
        held, rigid = (
            numbers['baselines'][name]['horizons'][horizon]['position_m']['median']
            for name in ('hold_velocity', 'rigid_body')
        )
        cells = [errors[key]['median'] for key in ('position_m', 'velocity_m_s', 'attitude_deg')]
        table.add_row(
            f'{horizon} s', *('-' if c is None else f'{c:.3g}' for c in (*cells, held, rigid))
        )
    lines = list(numbers['words'])
    replay = numbers.get('replay')
    if replay is not None:
        same = 'every byte the same' if replay['identical'] else f'{replay["largest"]:.2g} apart'
        lines.append(f'flown again exactly: {replay["messages"]} messages, {same}')
    lines += [f'note: {line}' for line in numbers['notes']]
    lines += [f'left out: {n} windows {why}' for why, n in numbers['windows']['left_out'].items()]
    return Group(table, plain_text(lines), unbroken(files))
