# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The subcommands of ``fluid_sim`` that work on logs."""

import argparse
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

from fluid_sim_ros.cli import completion
from fluid_sim_ros.cli import replay as cli_replay
from fluid_sim_ros.cli.parser import above
from fluid_sim_ros.cli.shared import Show, add_command, made_folder, plain_text
from fluid_sim_ros.output.new_file import file_names
from fluid_sim_ros.output.progress import LOG_PATIENCE, progress_bar, progress_of_parts, silent

DAMAGED = 1


def add_parsers(commands: Any, show: Show) -> None:
    """
    Add the subcommands to the parser of ``fluid_sim``.

    Parameters
    ----------
    commands
        Subparsers of ``fluid_sim``.
    show
        Shows table and JSON.

    """

    def add(name: str, text: str, function: Callable[..., int]) -> argparse.ArgumentParser:
        parser = add_command(commands, name, text, function, show)
        log = parser.add_argument('log', metavar='LOG', help='.mcap file, or the folder of one')
        completion.completed_by(log, completion.files('mcap'))
        return parser

    text = 'what is in a log, ours or of other software, and whether it is sound'
    about = add('info', text, _info)
    about.add_argument(
        '--mapping', metavar='FILE', type=Path, help='of a log of other software: what is where'
    )
    repair = add('repair', 'write all that is sound in a damaged log to a new one', _repair)
    repair.add_argument('out', metavar='OUT', type=Path, help='.mcap file, or a folder: a bag')

    plot = add('plot', 'draw a log: PNG pictures and one interactive HTML file', _plot)
    plot.add_argument('--out', metavar='FOLDER', type=Path, help='default: beside the log')
    film = add('render', 'make a film of a log: .mp4, .gif, or the last picture as .png', _render)
    film.add_argument('--out', metavar='FILE', type=Path, help='default: LOG with .mp4')
    film.add_argument(
        '--size', type=above(0, int), nargs=2, metavar=('W', 'H'), default=(640, 480),
        help='pixels (default 640 480)',
    )  # fmt: skip
    film.add_argument('--fps', type=above(0), default=30.0, help='pictures a second (default 30)')
    film.add_argument('--speed', type=above(0), default=1.0, help='times real time (default 1)')
    film.add_argument(
        '--at', type=float, metavar='S', help='simulated time of a .png [s] (default the end)'
    )
    film.add_argument('--vehicle', default='', metavar='NAME', help='that is followed')
    film.add_argument('--camera', default='', metavar='NAME', help='of the model')
    film.add_argument(
        '--from', type=float, nargs=3, dest='viewpoint',
        metavar=('AZIMUTH', 'ELEVATION', 'DISTANCE'),
        help='follow it from there: [deg], [deg], and in sizes of the vehicle (120 -20 4)',
    )  # fmt: skip
    export = add('export', 'write a log as tables, one file per topic', _export)
    kinds = export.add_mutually_exclusive_group(required=True)
    kinds.add_argument('--csv', metavar='FOLDER', type=Path, help='text, every digit kept')
    kinds.add_argument('--parquet', metavar='FOLDER', type=Path, help='needs pyarrow')
    cli_replay.add_options(
        add('replay', 'publish a log on ROS topics, or fly it again', cli_replay.replay)
    )


def _info(arguments: argparse.Namespace, show: Show) -> int:
    from rich.console import Group
    from rich.table import Column, Table

    from fluid_sim_ros.cli.reality.info import flight_info, is_foreign, is_sound_bag

    if arguments.mapping or is_foreign(Path(arguments.log)):
        return flight_info(arguments, show)
    from fluid_sim_ros.recording.inspect import info

    with progress_of_parts(LOG_PATIENCE) as report:
        result = info(arguments.log, report)
    if is_sound_bag(Path(arguments.log), result):
        return flight_info(arguments, show)
    table = Table(
        Column('topic', no_wrap=True), Column('type', overflow='fold'), 'messages', 'rate',
        title=plain_text([
            f'{result["path"]}: {result["bytes"] / 1e6:.2f} MB, '
            f'{result["begin_s"]:.2f} to {result["end_s"]:.2f} s'
        ]),
    )  # fmt: skip
    for name, topic in result['topics'].items():
        rate = topic['rate_hz']
        shown = '' if rate is None else f'{rate:g} Hz'
        row = (name, topic['type'].rpartition('/')[2], str(topic['messages']), shown)
        table.add_row(*(plain_text([cell]) for cell in row))
    run = result['run']
    lines = [result['run_fault']] if run is None else [
        f'scene {run["scene"]}, seed {run["seed"]}, timestep {run["timestep"]:g} s, '
        f'{run["integrator"]}; fluid_sim_ros {run["versions"]["fluid_sim_ros"]}, '
        f'MuJoCo {run["versions"]["mujoco"]}'
    ]  # fmt: skip
    lines += [f'damaged: {fault}' for fault in result['faults']] or ['sound: every checksum holds']
    show(arguments.json, Group(table, plain_text(lines)), result)
    return DAMAGED if result['faults'] else 0


def _repair(arguments: argparse.Namespace, show: Show) -> int:
    from fluid_sim_ros.recording.inspect import repair

    with progress_of_parts(LOG_PATIENCE) as report:
        result = repair(arguments.log, arguments.out, report=report)
    lines = [f'{result["path"]}: {result["messages"]} messages, {result["bytes"]} bytes']
    lines += [f'lost: {line}' for line in result['lost']]
    show(arguments.json, plain_text(lines), result)
    return 0


def _plot(arguments: argparse.Namespace, show: Show) -> int:
    from fluid_sim_ros.recording.inspect import about
    from fluid_sim_ros.recording.pictures import plots as pictures
    from fluid_sim_ros.recording.pictures.report import write_report
    from fluid_sim_ros.recording.pictures.tracks import read_tracks
    from fluid_sim_ros.recording.reader import open_log

    with progress_of_parts(LOG_PATIENCE) as report:
        log = open_log(arguments.log, report)
        tracks = read_tracks(log)
        names = file_names(track.name for track in tracks.vehicles)
        with made_folder(arguments.out or log.path.parent) as folder:
            stem = folder / log.path.stem
            files: list[Path] = []
            for track, name in zip(tracks.vehicles, names, strict=True):
                report('pictures', len(files), len(names) + 1)
                place = stem.with_name(f'{stem.name}_{name}.png')
                files.append(pictures.overview(track, tracks, place))
            report('pictures', len(files), len(names) + 1)
            files.append(write_report(tracks, about(log), stem.with_name(f'{stem.name}.html')))
            report('pictures', len(files), len(files))
    result = {'log': str(log.path), 'files': [str(file) for file in files], 'faults': log.faults}
    lines = [*(str(file) for file in files), *(f'damaged: {fault}' for fault in log.faults)]
    show(arguments.json, plain_text(lines), result)
    return DAMAGED if log.faults else 0


def _export(arguments: argparse.Namespace, show: Show) -> int:
    from fluid_sim_ros.recording.export import export, left_out
    from fluid_sim_ros.recording.reader import open_log

    kind = 'csv' if arguments.csv else 'parquet'
    with progress_of_parts(LOG_PATIENCE) as report:
        log = open_log(arguments.log, report)
        with made_folder(arguments.csv or arguments.parquet, f'--{kind}') as folder:
            files = export(log, folder, kind)
    result = {'log': str(log.path), 'files': files, 'faults': log.faults}
    lines = [*files, *(f'no table: {name} (pictures, points)' for name in left_out(log))]
    lines += [*(f'damaged: {fault}' for fault in log.faults)]
    show(arguments.json, plain_text(lines), result)
    return DAMAGED if log.faults else 0


def _render(arguments: argparse.Namespace, show: Show) -> int:
    # before MuJoCo is imported: no display is needed
    if os.environ.get('MUJOCO_GL', 'disable') == 'disable':
        os.environ['MUJOCO_GL'] = 'egl'
    from fluid_sim_ros.recording.pictures.render import FilmOptions, render
    from fluid_sim_ros.recording.reader import open_log

    with progress_of_parts(LOG_PATIENCE) as report:
        log = open_log(arguments.log, report)
    log.report = silent  # the film has a bar of its own
    out = arguments.out or log.path.with_suffix('.mp4')
    width, height = arguments.size
    options = FilmOptions(
        width, height, arguments.fps, arguments.speed, arguments.vehicle, arguments.camera,
        arguments.at, tuple(arguments.viewpoint) if arguments.viewpoint else None,
    )  # fmt: skip
    with made_folder(out.parent), progress_bar('{task.percentage:.0f} %') as progress:
        task = progress.add_task('rendering', total=1.0)
        count = render(log, out, options, lambda done: progress.update(task, completed=done))
    result = {'log': str(log.path), 'file': str(out), 'pictures': count, 'faults': log.faults}
    lines = [f'{out}: {count} pictures', *(f'damaged: {fault}' for fault in log.faults)]
    show(arguments.json, plain_text(lines), result)
    return DAMAGED if log.faults else 0
