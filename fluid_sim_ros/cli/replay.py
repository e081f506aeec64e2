# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``fluid_sim replay``: a log onto ROS topics, flown again, or flown again with a change."""

import argparse
import math
import signal
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import Any

from fluid_sim_ros.cli.parser import above
from fluid_sim_ros.cli.shared import Show, fraction, plain_text
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.interruption import exit_code
from fluid_sim_ros.output.progress import LOG_PATIENCE, progress_of_parts, silent

#: Exit code where the log is damaged or a state differs.
DIFFERENT = 1


def add_options(replay: argparse.ArgumentParser) -> None:
    """
    Add the options of ``fluid_sim replay`` to its parser.

    Parameters
    ----------
    replay
        Parser of the subcommand.

    """
    replay.add_argument(
        '--resimulate', action='store_true',
        help='fly its commands again and compare every state (exit code 1: a difference)',
    )  # fmt: skip
    replay.add_argument(
        '--tolerance', type=fraction, default=0.0, metavar='T',
        help='relative difference allowed with --resimulate, such as 1e-9 or 1%% (default 0: the '
        'same bits)',
    )  # fmt: skip
    replay.add_argument(
        '--with', action='append', default=[], metavar='KEY=VALUE', dest='changes',
        help='fly it again with a change, and draw both: integrator, timestep, fluid, wind, '
        'current (X,Y,Z), seed',
    )  # fmt: skip
    replay.add_argument('--rate', type=above(0), default=1.0, help='times real time (default 1)')
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
        '--topics',
        nargs='+',
        default=['*'],
        metavar='PATTERN',
        help='shell patterns, !PATTERN: not these (all)',
    )
    replay.add_argument('--out', metavar='PNG', type=Path, help='where --with draws both flights')


def replay(arguments: argparse.Namespace, show: Show) -> int:
    """
    Run ``fluid_sim replay``; return the exit code.

    Parameters
    ----------
    arguments
        Parsed options.
    show
        Shows table and JSON.

    Returns
    -------
    int
        Exit code.

    """
    if arguments.changes:
        return _what_if(arguments, show)
    if arguments.resimulate:
        return _resimulate(arguments, show)
    return _publish(arguments, show)


def _publish(arguments: argparse.Namespace, show: Show) -> int:
    from fluid_sim_ros.loop.recorder_port import selected
    from fluid_sim_ros.recording.reader import open_log
    from fluid_sim_ros.recording.writing.rosbag2 import recorded_topic
    from fluid_sim_ros.ros import replay as ros
    from fluid_sim_ros.ros.process.this_host import check_domain

    check_domain()
    with progress_of_parts(LOG_PATIENCE) as report:
        log = open_log(arguments.log, report)
    log.report = silent  # it is published at the pace of the flight
    options = ros.ReplayOptions(arguments.rate, arguments.loop, arguments.paused)
    if not 0 <= arguments.begin <= arguments.end:
        raise ConfigError(
            f'--from {arguments.begin:g}, --to {arguments.end:g}: must be 0 or more, and in order'
        )
    begin, end = arguments.begin * 1e9, arguments.end * 1e9
    names = selected([t.name for t in log.topics.values()], arguments.topics, '--topics')
    chosen = [
        recorded_topic(t.name, t.type, t.metadata) for t in log.topics.values() if t.name in names
    ]
    topics = [topic for topic in chosen if ros.is_installed(topic.type)]
    left_out = {t.name: f'{t.type} is not installed' for t in chosen if t not in topics}
    wanted = {topic.name for topic in topics}

    def messages() -> Iterator[tuple[str, int, bytes]]:
        for message in log.messages(wanted):
            if begin <= message.log_ns <= end:
                yield message.topic, message.log_ns, message.data

    count, interrupted = ros.replay(topics, messages, options)
    result = {
        'log': str(log.path), 'published': count, 'left_out': left_out, 'faults': log.faults,
        'interrupted': interrupted,
    }  # fmt: skip
    lines = [f'{count} messages published']
    lines += [f'left out: {name}: {reason}' for name, reason in left_out.items()]
    lines += [f'damaged: {fault}' for fault in log.faults]
    show(arguments.json, plain_text(lines), result)
    if interrupted and not arguments.loop:  # a loop has no other end
        return exit_code(signal.Signals[interrupted])
    return DIFFERENT if log.faults else 0


def _resimulate(arguments: argparse.Namespace, show: Show) -> int:
    from fluid_sim_ros.recording.reader import open_log
    from fluid_sim_ros.recording.replay.resimulate import resimulate

    if not arguments.tolerance >= 0:
        raise ConfigError(f'--tolerance {arguments.tolerance:g}: must be 0 or more')
    with progress_of_parts(LOG_PATIENCE) as report:
        log = open_log(arguments.log, report)
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
        'difference': None if different is None else _plain(asdict(different)),
        'largest': {name: _finite(value) for name, value in outcome.largest.items()},
        'notes': outcome.notes,
    }
    show(arguments.json, plain_text(lines), result)
    return 0 if different is None and outcome.compared else DIFFERENT


def _plain(fields: dict[str, Any]) -> dict[str, Any]:
    """Return fields that JSON can hold: numbers that are not finite as texts."""
    return {
        key: str(value) if isinstance(value, float) and not math.isfinite(value) else value
        for key, value in fields.items()
    }


def _finite(value: float) -> float | None:
    return value if value < float('inf') else None


def _what_if(arguments: argparse.Namespace, show: Show) -> int:
    from fluid_sim_ros.recording.reader import open_log
    from fluid_sim_ros.recording.replay.what_if import compare_flights

    with progress_of_parts(LOG_PATIENCE) as report:
        log = open_log(arguments.log, report)
        out = arguments.out or log.path.with_name(f'{log.path.stem}_what_if.png')
        result = compare_flights(log, arguments.changes, out)
    lines = [
        f'{name}: up to {apart["largest_apart_m"]:.4g} m apart, at '
        f'{apart["largest_apart_at_s"]:.2f} s; {apart["apart_at_end_m"]:.4g} m at the end'
        for name, apart in result['differences'].items()
    ]
    lines += [f'note: {note}' for note in result['notes']]
    lines.append(f'Plots: {", ".join(result["plots"])}')
    show(arguments.json, plain_text(lines), result)
    return 0
