"""The subcommands of ``fluid_sim`` that work on logs."""

import argparse
import math
import os
from collections.abc import Callable, Iterator
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fluid_sim_ros.errors import ConfigError, MissingExtraError

if TYPE_CHECKING:
    from fluid_sim_ros.recording.reader import Log

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

    plot = add('plot', 'draw a log: PNG pictures and one interactive HTML file', _plot)
    plot.add_argument('--out', metavar='FOLDER', type=Path, help='default: beside the log')
    film = add('render', 'make a film of a log: .mp4, .gif, or the last picture as .png', _render)
    film.add_argument('--out', metavar='FILE', type=Path, help='default: LOG with .mp4')
    film.add_argument('--size', type=int, nargs=2, metavar=('W', 'H'), default=(640, 480))
    film.add_argument('--fps', type=float, default=30.0, help='pictures per second (default 30)')
    film.add_argument('--speed', type=float, default=1.0, help='times real time (default 1)')
    film.add_argument(
        '--at', type=float, metavar='S', help='simulated time of a .png [s] (default the end)'
    )
    film.add_argument('--vehicle', default='', metavar='NAME', help='that is followed')
    film.add_argument('--camera', default='', metavar='NAME', help='of the model')
    export = add('export', 'write a log as tables, one file per topic', _export)
    kinds = export.add_mutually_exclusive_group(required=True)
    kinds.add_argument('--csv', metavar='FOLDER', type=Path, help='text, every digit kept')
    kinds.add_argument('--parquet', metavar='FOLDER', type=Path, help='needs pyarrow')
    replay = add('replay', 'publish a log on ROS topics, or fly it again', _replay)
    replay.add_argument(
        '--resimulate', action='store_true',
        help='fly its commands again and compare every state (exit code 1: a difference)',
    )  # fmt: skip
    replay.add_argument(
        '--tolerance', type=float, default=0.0, metavar='T',
        help='relative difference allowed with --resimulate (default 0: the same bits)',
    )  # fmt: skip
    replay.add_argument(
        '--with', action='append', default=[], metavar='KEY=VALUE', dest='changes',
        help='fly it again with a change, and draw both: integrator, timestep, fluid, wind, '
        'current (X,Y,Z), seed',
    )  # fmt: skip
    replay.add_argument('--rate', type=float, default=1.0, help='times real time (default 1)')
    replay.add_argument('--loop', action='store_true', help='begin anew at the end')
    replay.add_argument(
        '--paused', action='store_true', help='begin paused; ~/pause and ~/step go on'
    )
    replay.add_argument(
        '--from', type=float, default=0.0, dest='begin', metavar='S', help='simulated time [s]'
    )
    replay.add_argument(
        '--to', type=float, default=math.inf, dest='end', metavar='S', help='simulated time [s]'
    )
    replay.add_argument(
        '--topics', nargs='+', default=['*'], metavar='PATTERN', help='shell patterns (all)'
    )
    replay.add_argument('--out', metavar='PNG', type=Path, help='where --with draws both flights')


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


def _plot(arguments: argparse.Namespace, show: Show) -> int:
    from rich.markup import escape

    from fluid_sim_ros.recording import pictures
    from fluid_sim_ros.recording.inspect import about
    from fluid_sim_ros.recording.reader import open_log
    from fluid_sim_ros.recording.report import write_report
    from fluid_sim_ros.recording.tracks import read_tracks

    log = open_log(arguments.log)
    tracks = read_tracks(log)
    folder = _folder(arguments.out, log.path)
    files = [
        pictures.overview(track, tracks, folder / f'{log.path.stem}_{_file_name(track.name)}.png')
        for track in tracks.vehicles
    ]
    files.append(write_report(tracks, about(log), folder / f'{log.path.stem}.html'))
    result = {'log': str(log.path), 'files': [str(file) for file in files], 'faults': log.faults}
    lines = [*(str(file) for file in files), *(f'damaged: {fault}' for fault in log.faults)]
    show(arguments.json, escape('\n'.join(lines)), result)
    return DAMAGED if log.faults else 0


def _export(arguments: argparse.Namespace, show: Show) -> int:
    from rich.markup import escape

    from fluid_sim_ros.recording.export import export
    from fluid_sim_ros.recording.reader import open_log

    log = open_log(arguments.log)
    kind = 'csv' if arguments.csv else 'parquet'
    files = export(log, _folder(arguments.csv or arguments.parquet, log.path), kind)
    result = {'log': str(log.path), 'files': files, 'faults': log.faults}
    lines = [*files, *(f'damaged: {fault}' for fault in log.faults)]
    show(arguments.json, escape('\n'.join(lines)), result)
    return DAMAGED if log.faults else 0


def _render(arguments: argparse.Namespace, show: Show) -> int:
    # before MuJoCo is imported: no display is needed
    os.environ.setdefault('MUJOCO_GL', 'egl')
    from rich.console import Console
    from rich.markup import escape
    from rich.progress import Progress

    from fluid_sim_ros.recording.reader import open_log
    from fluid_sim_ros.recording.render import FilmOptions, render

    log = open_log(arguments.log)
    out = arguments.out or log.path.with_suffix('.mp4')
    _folder(out.parent, log.path)
    width, height = arguments.size
    options = FilmOptions(
        width, height, arguments.fps, arguments.speed, arguments.vehicle, arguments.camera,
        arguments.at,
    )  # fmt: skip
    with Progress(console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task('rendering', total=1.0)
        count = render(log, out, options, lambda done: progress.update(task, completed=done))
    result = {'log': str(log.path), 'file': str(out), 'pictures': count, 'faults': log.faults}
    show(arguments.json, escape(f'{out}: {count} pictures'), result)
    return DAMAGED if log.faults else 0


def _folder(given: Path | None, log: Path) -> Path:
    """Return the folder for what is made of a log, made when it is not there."""
    folder = given or log.parent
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ConfigError(f'--out {folder}: {error.strerror}') from None
    return folder


def _file_name(vehicle: str) -> str:
    return vehicle.replace('/', '_')


def _replay(arguments: argparse.Namespace, show: Show) -> int:
    from fluid_sim_ros.recording.reader import open_log

    log = open_log(arguments.log)
    if arguments.changes:
        return _what_if(log, arguments, show)
    if arguments.resimulate:
        return _resimulate(log, arguments, show)
    return _publish(log, arguments, show)


def _publish(log: 'Log', arguments: argparse.Namespace, show: Show) -> int:
    from fnmatch import fnmatchcase

    from fluid_sim_ros.recorder_tap import RecordedTopic
    from fluid_sim_ros.ros.parameters import check_domain
    from fluid_sim_ros.ros.replay import ReplayOptions, is_installed, replay

    check_domain()
    options = ReplayOptions(arguments.rate, arguments.loop, arguments.paused)
    begin, end = arguments.begin * 1e9, arguments.end * 1e9
    chosen = [
        RecordedTopic(t.name, t.type)
        for t in log.topics.values()
        if any(fnmatchcase(t.name, pattern) for pattern in arguments.topics)
    ]
    topics = [topic for topic in chosen if is_installed(topic.type)]
    left_out = {t.name: f'{t.type} is not installed' for t in chosen if t not in topics}
    names = {topic.name for topic in topics}

    def messages() -> Iterator[tuple[str, int, bytes]]:
        for message in log.messages(names):
            if begin <= message.log_ns <= end:
                yield message.topic, message.log_ns, message.data

    count = replay(topics, messages, options)
    result = {
        'log': str(log.path), 'published': count, 'left_out': left_out, 'faults': log.faults
    }  # fmt: skip
    lines = [f'{count} messages published']
    lines += [f'left out: {name}: {reason}' for name, reason in left_out.items()]
    show(arguments.json, '\n'.join(lines), result)
    return DAMAGED if log.faults else 0


def _resimulate(log: 'Log', arguments: argparse.Namespace, show: Show) -> int:
    from rich.markup import escape

    from fluid_sim_ros.recording.resimulate import resimulate

    if not arguments.tolerance >= 0:
        raise ConfigError(f'--tolerance {arguments.tolerance:g}: must be 0 or more')
    outcome = resimulate(log, arguments.tolerance)
    different = outcome.difference
    lines = [
        f'{outcome.commands} commands fed in, {outcome.compared} states compared',
        *(f'note: {note}' for note in outcome.notes),
    ]
    if different is not None:
        lines.append(f'first difference: {different}')
    elif outcome.largest:
        lines.append(f'largest difference {max(outcome.largest.values()):.3g}, as tolerated')
    else:
        lines.append('every state is the same to the last bit')
    result = {
        'log': str(log.path),
        'commands': outcome.commands,
        'compared': outcome.compared,
        'identical': not outcome.largest,
        'difference': None if different is None else asdict(different),
        'largest': {name: _finite(value) for name, value in outcome.largest.items()},
        'notes': outcome.notes,
    }
    show(arguments.json, escape('\n'.join(lines)), result)
    return 0 if different is None and outcome.compared else DAMAGED


def _finite(value: float) -> float | None:
    return value if value < float('inf') else None


def _what_if(log: 'Log', arguments: argparse.Namespace, show: Show) -> int:
    from rich.markup import escape

    from fluid_sim_ros.recording.what_if import compare_flights

    out = arguments.out or log.path.with_name(f'{log.path.stem}_what_if.png')
    result = compare_flights(log, arguments.changes, out)
    lines = [
        f'{name}: up to {apart["largest_apart_m"]:.4g} m apart, at '
        f'{apart["largest_apart_at_s"]:.2f} s; {apart["apart_at_end_m"]:.4g} m at the end'
        for name, apart in result['differences'].items()
    ]
    lines += [f'note: {note}' for note in result['notes']]
    lines.append(f'Plots: {", ".join(result["plots"])}')
    show(arguments.json, escape('\n'.join(lines)), result)
    return 0
