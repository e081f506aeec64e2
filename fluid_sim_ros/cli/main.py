# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The ``fluid_sim`` command.

Each subcommand imports what it needs when it runs, so that ``fluid_sim --help`` is instant.
Exit codes: 0, 1 (the simulation diverged, an autopilot died or was not heard, the doctor found a
fault, or a log is damaged or not repeated), 2 (wrong input), 130 and 143 (ended by SIGINT or
SIGTERM), 141 (nobody reads the output any more).
"""

import argparse
import os
import signal
import sys
from collections.abc import Sequence
from typing import Any

from fluid_sim_ros import __version__
from fluid_sim_ros.cli import autopilot, completion, logs, run_command, sweep
from fluid_sim_ros.cli.lab import advise, chart, stability
from fluid_sim_ros.cli.parser import WRONG_INPUT, Parser
from fluid_sim_ros.cli.reality import compare, excite, fit
from fluid_sim_ros.cli.shared import Show, add_command, add_scene, console
from fluid_sim_ros.cli.vehicles import hydro, import_file, new_vehicle, urdf
from fluid_sim_ros.cli.view import command as view
from fluid_sim_ros.errors import (
    MOST_LINE,
    DivergedError,
    FluidSimError,
    needed_for,
    of_machine,
    printable,
)
from fluid_sim_ros.interruption import begin, begun, exit_code, interrupted_by, settle
from fluid_sim_ros.output.json_file import write_json

DIVERGED = FAILED = 1
_COMPLETION = 'For this shell: eval "$(fluid_sim completion bash)"; fish: ... fish | source'
#: Exit code of a command ended by SIGINT, as shells have it (128 + signal number).
INTERRUPTED = 130


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
        As the module says.

    """
    if argv is None:
        begin('fluid_sim')
        # MuJoCo would look for a display as it is imported, in a process of its own: slow, and a
        # traceback on Ctrl-C. What makes pictures asks for its renderer.
        os.environ.setdefault('MUJOCO_GL', 'disable')
    words = sys.argv[1:] if argv is None else list(argv)
    try:
        code = _run(words)
        sys.stdout.flush()
        settle()  # within the block: no moment is left in which nobody takes an interruption
    except KeyboardInterrupt:
        return _fail('interrupted', interrupted_by() or INTERRUPTED)
    except OSError as error:
        if not isinstance(error, BrokenPipeError) and not of_machine(error):
            raise
        _drop_output()
        if isinstance(error, BrokenPipeError):  # whoever read the output has enough of it
            return exit_code(signal.SIGPIPE)
        return _fail(of_machine(error), WRONG_INPUT)
    return code


def _run(words: Sequence[str]) -> int:
    parser = _build_parser()
    completion.complete(parser)
    parser.shows_itself(words)
    arguments, rest = parser.parse_known_args(words)
    if rest and arguments.command != 'demo':
        parser.commands[arguments.command].refuse(rest)
    begun()
    try:
        if arguments.command == 'demo':
            return _demo(rest)
        code: int = arguments.function(arguments)
    except DivergedError as error:
        return _fail(error, DIVERGED)
    except FluidSimError as error:
        return _fail(error, WRONG_INPUT)
    return code


def _drop_output() -> None:
    """Have what is left of the output go nowhere: Python would try once more as it ends."""
    try:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
    except (OSError, ValueError):  # no output of the system's
        return


def _fail(reason: object, code: int) -> int:
    sys.stderr.write(f'fluid_sim: {printable(str(reason), MOST_LINE)}\n')
    return code


def _build_parser() -> Parser:
    parser = Parser(
        prog='fluid_sim',
        description='MuJoCo with fluid forces for aerial and underwater vehicles.',
    )
    parser.add_argument('--version', action='version', version=f'fluid_sim_ros {__version__}')
    commands = parser.add_commands()

    run_command.add_parser(commands, _show)
    add_command(commands, 'scenes', 'list the scenes', _scenes, _show)
    new_vehicle.add_parsers(commands, _show)
    import_file.add_parser(commands, _show)
    hydro.add_parser(commands, _show)
    urdf.add_parser(commands, _show)
    logs.add_parsers(commands, _show)
    for each in (chart, stability, advise):
        each.add_parser(commands, _show)
    compare.add_parser(commands, _show)
    fit.add_parser(commands, _show)
    excite.add_parser(commands, _show)
    sweep.add_parser(commands, _show)
    view.add_parser(commands, _show)

    commands.add_parser(
        'demo', add_help=False, help='quadrotor in a gust: simulator and controller over ROS 2'
    )

    text = 'what is installed, what is missing, what to type'
    doctor = add_command(commands, 'doctor', text, _doctor, _show)
    add_scene(doctor, nargs='?', help='a scene to look at, instead of the machine')
    autopilot.add_doctor_options(doctor)

    text = 'print what makes a shell complete the words of fluid_sim'
    shell = commands.add_parser('completion', help=text, description=text, epilog=_COMPLETION)
    shell.add_argument('shell', metavar='SHELL', choices=completion.SHELLS, help='bash, zsh, fish')
    shell.set_defaults(function=_completion)
    return parser


def _scenes(arguments: argparse.Namespace, show: Show) -> int:
    from fluid_sim_ros.cli.tables import table_of
    from fluid_sim_ros.scene import Scene, scene_names

    rows, cells = [], []
    for name in scene_names():
        scene = Scene.load(name)
        advised = scene.advised
        rows.append({
            'name': name, 'medium': scene.medium, 'description': scene.description,
            'advised': None if advised is None else advised.model_dump(exclude_none=True),
        })  # fmt: skip
        words = '' if advised is None else f'{advised.integrator} {advised.timestep * 1e3:g} ms'
        cells.append((name, words, scene.description))
    show(arguments.json, table_of(('scene', 'advised', 'description'), cells), rows)
    return 0


def _completion(arguments: argparse.Namespace) -> int:
    with needed_for('completion'):
        sys.stdout.write(completion.shell_code(arguments.shell))
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
        console().print(table, crop=False)  # paths stay whole
