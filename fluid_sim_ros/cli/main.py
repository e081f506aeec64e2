"""
The ``fluid_sim`` command.

Each subcommand imports what it needs when it runs, so that ``fluid_sim --help`` is instant.
Exit codes: 0, 1 (the simulation diverged, an autopilot died or was not heard, the doctor found a
fault, or a log is damaged or not repeated), 2 (wrong input), 130 (interrupted).
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

from fluid_sim_ros import __version__
from fluid_sim_ros.cli import advise, autopilot, chart, logs, stability, sweep, vehicle
from fluid_sim_ros.cli.shared import Show, add_command
from fluid_sim_ros.errors import ConfigError, DivergedError, FluidSimError, needed_for
from fluid_sim_ros.output.json_file import write_json

if TYPE_CHECKING:
    from rich.console import Console

DIVERGED = FAILED = 1
WRONG_INPUT = 2
#: Exit code of a command ended by SIGINT, as shells have it (128 + signal number).
INTERRUPTED = 130


class _Parser(argparse.ArgumentParser):
    """A parser that takes no abbreviated options, and whose errors are one line."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(allow_abbrev=False, **settings)

    def error(self, message: str) -> NoReturn:
        self.exit(WRONG_INPUT, f'{self.prog}: error: {message} (see {self.prog} --help)\n')


def main(argv: Sequence[str] | None = None) -> int:
    """
    Run the command line; return the exit code.

    Parameters
    ----------
    argv
        Words after the program's name; default: those of this process.

    Returns
    -------
    int
        0, 1 or 2 as the module says; 130 after Ctrl-C.

    """
    parser = _build_parser()
    arguments, rest = parser.parse_known_args(argv)
    if rest and arguments.command != 'demo':
        parser.error(f'unknown arguments: {" ".join(rest)}')
    try:
        if arguments.command == 'demo':
            return _demo(rest)
        code: int = arguments.function(arguments)
    except DivergedError as error:
        return _fail(error, DIVERGED)
    except FluidSimError as error:
        return _fail(error, WRONG_INPUT)
    except KeyboardInterrupt:
        return _fail('interrupted', INTERRUPTED)
    return code


def _fail(reason: object, code: int) -> int:
    sys.stderr.write(f'fluid_sim: {reason}\n')
    return code


def _build_parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog='fluid_sim',
        description='MuJoCo with fluid forces for aerial and underwater vehicles.',
    )
    parser.add_argument('--version', action='version', version=f'fluid_sim_ros {__version__}')
    commands = parser.add_subparsers(dest='command', required=True, metavar='COMMAND')

    run = add_command(commands, 'run', 'run a scene without ROS', _run, _show)
    run.add_argument('scene', metavar='SCENE', help='name (fluid_sim scenes) or MJCF or YAML file')
    run.add_argument('--duration', type=float, metavar='S', help='simulated time [s]')
    run.add_argument('--timestep', type=float, metavar='S', help="replaces the model's [s]")
    run.add_argument('--integrator', metavar='NAME', help='Euler, RK4, implicit, implicitfast')
    run.add_argument('--fluid', metavar='MODEL', help='none, inertia, ellipsoid, no_added_mass')
    run.add_argument(
        '--advised',
        action='store_true',
        help="take timestep, integrator and fluid from the scene's advised settings",
    )
    run.add_argument('--seed', type=int, default=0, help='of everything random (default 0)')
    for medium in ('wind', 'current'):
        run.add_argument(
            f'--{medium}', type=float, nargs=3, metavar=('X', 'Y', 'Z'),
            help=f'velocity of the {medium} from the start [m/s], east north up',
        )  # fmt: skip
    run.add_argument('--pacing', choices=('free', 'realtime'), default='free')
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

    add_command(commands, 'scenes', 'list the scenes', _scenes, _show)
    vehicle.add_parser(commands, _show)
    logs.add_parsers(commands, _show)
    for each in (chart, stability, advise):
        each.add_parser(commands, _show)
    sweep.add_parser(commands, _show)

    commands.add_parser(
        'demo', add_help=False, help='quadrotor in a gust: simulator and controller over ROS 2'
    )

    text = 'what is installed, what is missing, what to type'
    doctor = add_command(commands, 'doctor', text, _doctor, _show)
    doctor.add_argument('scene', nargs='?', help='a scene to look at, instead of the machine')
    autopilot.add_doctor_options(doctor)
    return parser


def _run(arguments: argparse.Namespace, show: Show) -> int:
    from fluid_sim_ros.cli.run import run_scene, summary_table
    from fluid_sim_ros.cli.scene import advised_settings
    from fluid_sim_ros.schema.settings import RunSettings

    if arguments.record_topics and not arguments.record:
        raise ConfigError('--record-topics needs --record PATH')
    given = {key: getattr(arguments, key) for key in RunSettings.model_fields}
    settings = RunSettings.checked('--{}', **given)
    if arguments.advised:
        settings = settings.over(advised_settings(arguments.scene))
    result = run_scene(
        arguments.scene,
        duration=arguments.duration,
        settings=settings,
        wind=arguments.wind,
        current=arguments.current,
        realtime=arguments.pacing == 'realtime',
        record=arguments.record,
        record_topics=arguments.record_topics or ['*'],
        allow_assets_from=arguments.allow_assets_from,
        autopilot=autopilot.chosen_run(arguments),
    )
    show(arguments.json, summary_table(result), result)
    if arguments.record and arguments.json != '-':
        for path in result['records']:
            _console().print(f'Log: {path}', soft_wrap=True, markup=False)
    if result.get('record_fault'):  # the flight went on without
        raise ConfigError(result['record_fault'])
    flown = result.get('autopilot')
    if flown is None:
        return INTERRUPTED if result['interrupted'] else 0
    return _fail(flown['fault'], FAILED) if flown['fault'] else 0


def _scenes(arguments: argparse.Namespace, show: Show) -> int:
    from rich.markup import escape
    from rich.table import Table

    from fluid_sim_ros.scene import Scene, scene_names

    table = Table('scene', 'medium', 'advised', 'description', title='Scenes')
    rows = []
    for name in scene_names():
        scene = Scene.load(name)
        advised = scene.advised
        rows.append({
            'name': name, 'medium': scene.medium, 'description': scene.description,
            'advised': None if advised is None else advised.model_dump(exclude_none=True),
        })  # fmt: skip
        words = '' if advised is None else f'{advised.integrator} {advised.timestep * 1e3:g} ms'
        table.add_row(name, scene.medium or '', words, escape(scene.description))
    show(arguments.json, table, rows)
    return 0


def _demo(rest: Sequence[str]) -> int:
    with needed_for('the demo'):
        from fluid_sim_ros.demo.main import main as demo
    return demo(rest)


def _doctor(arguments: argparse.Namespace, show: Show) -> int:
    from fluid_sim_ros.cli import doctor
    from fluid_sim_ros.cli.scene import examine_scene

    if arguments.autopilot:
        table, seen = autopilot.autopilot_table(arguments)
        show(arguments.json, table, seen)
        return _fail(seen['fault'], FAILED) if seen['fault'] else 0
    rows = doctor.examine() if arguments.scene is None else examine_scene(arguments.scene)
    show(arguments.json, doctor.table(rows), [row.as_dict() for row in rows])
    return 0 if doctor.works(rows) else 1


def _show(json_path: str | None, table: Any, result: object) -> None:
    """Print the table, and write the result as JSON where it was asked for."""
    if json_path is not None:
        write_json(json_path, result)
    if json_path != '-':
        _console().print(table, crop=False)  # paths stay whole


def _console() -> 'Console':
    from rich.console import Console

    return Console()
