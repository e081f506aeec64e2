# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The options of ``fluid_sim run`` and ``fluid_sim doctor`` that have to do with autopilots."""

import argparse
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from fluid_sim_ros.cli.parser import above, at_least
from fluid_sim_ros.errors import ConfigError, listed

if TYPE_CHECKING:
    from rich.table import Table

    from fluid_sim_ros.cli.flight import AutopilotRun
    from fluid_sim_ros.loop.autopilot_port import AutopilotOptions
    from fluid_sim_ros.scene import Scene

#: What the doctor flies while it looks, and for how long [s].
_SCENE, _SECONDS = 'x500_ground', 10.0
#: Options that have the names of ``AutopilotOptions``.
_OPTIONS = ('vehicle', 'mapping', 'instance', 'port', 'address', 'timeout', 'on_timeout', 'earth')


def add_options(parser: argparse.ArgumentParser) -> None:
    """
    Add what ``chosen_runs`` reads.

    Parameters
    ----------
    parser
        Of a subcommand.

    """
    group = parser.add_argument_group('autopilot')
    group.add_argument(
        '--autopilot', choices=('px4', 'ardupilot', 'none'),
        help='fly with it, in lockstep; none: also without those of the scene file',
    )  # fmt: skip
    group.add_argument(
        '--exec', metavar='COMMAND', dest='programs', action='append', default=[],
        help='start its program too, with the arguments that it needs besides; VEHICLE=COMMAND '
        'or PROTOCOL=COMMAND, repeated, where the scene file states several',
    )  # fmt: skip
    group.add_argument(
        '--param', metavar='NAME=VALUE', dest='parameters', action='append', default=[],
        help="set it in that program, also in place of the mapping's; may be repeated",
    )  # fmt: skip
    group.add_argument(
        '--home', type=float, nargs=4, metavar=('LAT', 'LON', 'ALT', 'HEADING'), default=[],
        help="where it starts [deg] [deg] [m] [deg] (default the scene's, heading as it begins)",
    )  # fmt: skip
    group.add_argument(
        '--earth',
        choices=('wgs84', 'sphere'),
        help='of what PX4 gets: wgs84 (default), or its own sphere',
    )
    group.add_argument('--vehicle', metavar='NAME', help='that it flies (default the only one)')
    group.add_argument(
        '--mapping', metavar='NAME', help='of config/autopilots, or a file (default by vehicle)'
    )
    group.add_argument(
        '--instance', type=at_least(0, int), metavar='N', help='number on this host (default 0)'
    )
    group.add_argument(
        '--timeout', type=float, metavar='S',
        help='wall time that a silent one is waited for (default 60); simulated time stands still',
    )  # fmt: skip
    group.add_argument(
        '--on-timeout', choices=('hold', 'continue', 'stop'),
        help='then: wait on, go on with thrust at rest (default), or end the run',
    )  # fmt: skip
    group.add_argument(
        '--port', type=int, metavar='P', help='to listen on, 1 to 65535 (default by instance)'
    )
    group.add_argument(
        '--address', metavar='A', help='to listen on (default 127.0.0.1: this host only)'
    )


def add_doctor_options(parser: argparse.ArgumentParser) -> None:
    """
    Add what ``autopilot_table`` reads.

    Parameters
    ----------
    parser
        Of ``fluid_sim doctor``.

    """
    add_options(parser)
    parser.add_argument(
        '--seconds', type=above(0), default=_SECONDS, metavar='S',
        help=f'wall time to look (default {_SECONDS:g})',
    )  # fmt: skip


def chosen_runs(arguments: argparse.Namespace, scene: 'Scene') -> 'list[AutopilotRun]':
    """
    Return who flies: by the options of ``add_options``, or else as the scene file says.

    Parameters
    ----------
    arguments
        Parsed options.
    scene
        What is flown.

    Returns
    -------
    list
        One for each vehicle that has an autopilot.

    Raises
    ------
    ConfigError
        If an option needs ``--autopilot`` and it is not given, or does not fit the scene.

    """
    if arguments.parameters and not arguments.programs:
        raise ConfigError('--param needs --exec: only a program that is started gets parameters')
    if arguments.autopilot not in (None, 'none'):
        return [_chosen_run(arguments)]
    # heavy: only when it is needed
    from fluid_sim_ros.loop.autopilot_fleet import autopilots_of

    chosen = _given(arguments)
    stated = [] if arguments.autopilot == 'none' else autopilots_of(scene)
    if not stated:
        given = [*(['exec'] if arguments.programs else []), *chosen]
        given += ['param'] if arguments.parameters else []
        given += ['home'] if arguments.home else []
        if given:
            option = given[0].replace('_', '-')
            raise ConfigError(f'--{option} needs --autopilot')
        return []
    from fluid_sim_ros.cli.flight import AutopilotRun

    for option in ('vehicle', 'mapping', 'instance', 'port'):
        if option in chosen:
            raise ConfigError(
                f'--{option} needs --autopilot: the scene file states that of each vehicle'
            )
    if arguments.parameters:
        raise ConfigError(
            "--param needs --autopilot: state them as 'parameters' of a vehicle's autopilot"
        )
    programs = _programs(arguments.programs, stated)
    return [
        AutopilotRun(replace(pilot, program=bool(program), **chosen), program, arguments.home)
        for pilot, program in zip(stated, programs, strict=True)
    ]


def _given(arguments: argparse.Namespace) -> dict[str, Any]:
    """Return those of the bridge's options that were given."""
    chosen = {
        name: getattr(arguments, name) for name in _OPTIONS if getattr(arguments, name) is not None
    }
    if not chosen.get('timeout', 1.0) > 0:
        raise ConfigError(f'--timeout {chosen["timeout"]:g}: must be above 0')
    return chosen


def _programs(given: list[str], options: 'Sequence[AutopilotOptions]') -> list[str]:
    """Return the command that starts the program of each autopilot, '' for none."""
    commands: dict[str, str] = {}
    names = [name for each in options for name in (each.vehicle, each.protocol)]
    for word in given:
        name, _, command = word.partition('=')
        if not command or name not in names:
            name, command = '', word
        if name in commands:
            raise ConfigError(
                f'--exec {word}: is the second for the same; write VEHICLE=COMMAND, with one of: '
                f'{listed(dict.fromkeys(names))}'
            )
        commands[name] = command
    found = [
        commands.get(each.vehicle) or commands.get(each.protocol) or commands.get('', '')
        for each in options
    ]
    return [
        command.replace('{vehicle}', each.vehicle).replace('{instance}', str(each.instance))
        for command, each in zip(found, options, strict=True)
    ]


def _chosen_run(arguments: argparse.Namespace) -> 'AutopilotRun':
    """Return who flies by the options alone."""
    # heavy: only when it is needed
    from fluid_sim_ros.cli.flight import AutopilotRun
    from fluid_sim_ros.loop.autopilot_port import AutopilotOptions
    from fluid_sim_ros.mavlink.program.parameters import parse_parameters

    chosen = _given(arguments)
    if len(arguments.programs) > 1:
        raise ConfigError(
            '--exec is given twice: with --autopilot there is one program; several autopilots '
            'stand in the scene file (doc/fleets.md)'
        )
    program = ''.join(arguments.programs)
    options = AutopilotOptions(
        arguments.autopilot, program=bool(program),
        parameters=parse_parameters(arguments.parameters), **chosen,
    )  # fmt: skip
    return AutopilotRun(options, program, arguments.home)


def autopilot_table(arguments: argparse.Namespace) -> 'tuple[Table, dict[str, Any]]':
    """
    Listen for an autopilot; return what was seen of it as a table and ready for JSON.

    Parameters
    ----------
    arguments
        Parsed options of ``add_doctor_options``.

    Returns
    -------
    table, seen
        For the terminal, and ready for JSON.

    Raises
    ------
    ConfigError
        If no autopilot is named, or an option is wrong.

    """
    from rich.markup import escape
    from rich.table import Table

    from fluid_sim_ros.cli import flight as cli_flight

    if arguments.autopilot in (None, 'none'):
        raise ConfigError('the doctor looks for an autopilot with --autopilot px4 or ardupilot')
    run = _chosen_run(arguments)
    seen = cli_flight.listen_to_autopilot(run, arguments.scene or _SCENE, arguments.seconds)
    table = Table('what', 'found', title=f'fluid_sim doctor --autopilot {arguments.autopilot}')
    for name, value in seen.items():
        shown = '\n'.join(map(str, value)) if isinstance(value, list) else str(value)
        table.add_row(name, escape(shown))
    return table, seen
