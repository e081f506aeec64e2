# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``fluid_sim run``: its options, and what it shows."""

import argparse
import signal
import sys
from pathlib import Path
from typing import Any

from fluid_sim_ros.cli import autopilot, completion
from fluid_sim_ros.cli.parser import at_least
from fluid_sim_ros.cli.shared import Show, add_command, add_scene, console
from fluid_sim_ros.errors import ConfigError

#: Exit code where the autopilot ended the run.
FAILED = 1


def add_parser(commands: Any, show: Show) -> None:
    """
    Add ``run`` to the parser of ``fluid_sim``.

    Parameters
    ----------
    commands
        Subparsers of ``fluid_sim``.
    show
        Shows table and JSON.

    """
    run = add_command(commands, 'run', 'run a scene without ROS', _run, show)
    add_scene(run)
    run.add_argument(
        '--duration', type=float, metavar='S',
        help="simulated time [s], above 0 (default the scene's)",
    )  # fmt: skip
    run.add_argument('--keyframe', metavar='NAME', help="start at it (default the scene's)")
    run.add_argument(
        '--timestep', type=float, metavar='S', help="replaces the model's [s], above 0"
    )
    completion.completed_by(
        run.add_argument('--integrator', metavar='NAME', help=', '.join(completion.INTEGRATORS)),
        completion.words(*completion.INTEGRATORS),
    )
    completion.completed_by(
        run.add_argument('--fluid', metavar='MODEL', help=', '.join(completion.FLUIDS)),
        completion.words(*completion.FLUIDS),
    )
    run.add_argument(
        '--advised', action='store_true',
        help="take timestep, integrator and fluid from the scene's advised settings",
    )  # fmt: skip
    run.add_argument(
        '--seed', type=int, default=0, help='of everything random, a whole number (default 0)'
    )
    for medium in ('wind', 'current'):
        run.add_argument(
            f'--{medium}', type=float, nargs=3, metavar=('X', 'Y', 'Z'),
            help=f'velocity of the {medium} from the start [m/s], east north up',
        )  # fmt: skip
    run.add_argument(
        '--hold', action='store_true',
        help='have each vehicle with thrusters held where it begins, by the laws of the example '
        'controllers',
    )  # fmt: skip
    run.add_argument(
        '--pacing', choices=('free', 'realtime'), default='free',
        help='as fast as it goes (default), or with the clock and a line of what happens',
    )  # fmt: skip
    run.add_argument(
        '--foxglove', nargs='?', type=at_least(0, int), const=8765, metavar='PORT',
        help='serve Foxglove and Lichtblick live on this machine (default port 8765; 0: one that '
        'is free)',
    )  # fmt: skip
    run.add_argument('--record', metavar='PATH', help='record to PATH.mcap, or a folder: a bag')
    run.add_argument(
        '--record-topics', metavar='PATTERN', nargs='+',
        help='shell patterns of the topics to record, !PATTERN: not these (default all)',
    )  # fmt: skip
    run.add_argument(
        '--allow-assets-from', metavar='DIR', action='append', type=Path, default=[],
        help='folder outside of the model\'s whose files a log may hold, if the model names them',
    )  # fmt: skip
    autopilot.add_options(run)


def _run(arguments: argparse.Namespace, show: Show) -> int:
    from fluid_sim_ros.cli.run import flown_by, run_scene, summary_table
    from fluid_sim_ros.cli.scene import advised_settings
    from fluid_sim_ros.scene import Scene
    from fluid_sim_ros.schema.settings import RunSettings

    if arguments.record_topics and not arguments.record:
        raise ConfigError('--record-topics needs --record PATH')
    scene = Scene.load(arguments.scene)
    pilots = autopilot.chosen_runs(arguments, scene)
    if arguments.hold and arguments.autopilot not in (None, 'none'):
        raise ConfigError('--hold and --autopilot: two cannot command at once; give one of them')
    if arguments.hold and pilots:
        raise ConfigError(
            "--hold: the scene's autopilots command; --autopilot none leaves them out"
        )
    given = {key: getattr(arguments, key) for key in RunSettings.model_fields}
    settings = RunSettings.checked('--{}', **given)
    if arguments.advised:
        settings = settings.over(advised_settings(arguments.scene))
    result = run_scene(
        scene,
        duration=arguments.duration,
        keyframe=arguments.keyframe,
        settings=settings,
        wind=arguments.wind,
        current=arguments.current,
        realtime=arguments.pacing == 'realtime',
        hold=arguments.hold,
        record=arguments.record,
        record_topics=arguments.record_topics or ['*'],
        allow_assets_from=arguments.allow_assets_from,
        autopilot=pilots,
        foxglove=None if arguments.foxglove is None else int(arguments.foxglove),
    )
    show(arguments.json, summary_table(result), result)
    if arguments.record and arguments.json != '-':
        for path in result['records']:
            console().print(f'Log: {path}', soft_wrap=True, markup=False)
    if result.get('record_fault'):  # the flight went on without
        raise ConfigError(result['record_fault'])
    flown = flown_by(result)
    if not flown:
        ended = result['interrupted']
        return 128 + signal.Signals[ended] if ended else 0
    # with an autopilot an interruption is how a run ends
    for fault in dict.fromkeys(each['fault'] for each in flown.values() if each['fault']):
        sys.stderr.write(f'fluid_sim: {fault}\n')
        return FAILED
    return 0
