"""The options of ``fluid_sim run`` and ``fluid_sim doctor`` that have to do with autopilots."""

import argparse
from typing import TYPE_CHECKING, Any

from fluid_sim_ros.cli.parser import above, at_least
from fluid_sim_ros.errors import ConfigError

if TYPE_CHECKING:
    from rich.table import Table

    from fluid_sim_ros.cli.flight import AutopilotRun

#: What the doctor flies while it looks, and for how long [s].
_SCENE, _SECONDS = 'x500_ground', 10.0
#: Options that have the names of ``AutopilotOptions``.
_OPTIONS = ('vehicle', 'mapping', 'instance', 'port', 'address', 'timeout', 'on_timeout', 'earth')


def add_options(parser: argparse.ArgumentParser) -> None:
    """
    Add what ``chosen_run`` reads.

    Parameters
    ----------
    parser
        Of a subcommand.

    """
    group = parser.add_argument_group('autopilot')
    group.add_argument(
        '--autopilot', choices=('px4', 'ardupilot'), help='fly with it, in lockstep'
    )
    group.add_argument(
        '--exec', metavar='COMMAND', dest='program',
        help='start its program too, with the arguments that it needs besides',
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


def chosen_run(arguments: argparse.Namespace) -> 'AutopilotRun | None':
    """
    Return who flies by the options of ``add_options``, or None.

    Parameters
    ----------
    arguments
        Parsed options.

    Raises
    ------
    ConfigError
        If an option needs ``--autopilot`` and it is not given.

    """
    chosen = {
        name: getattr(arguments, name) for name in _OPTIONS if getattr(arguments, name) is not None
    }
    if arguments.parameters and not arguments.program:
        raise ConfigError('--param needs --exec: only a program that is started gets parameters')
    if not chosen.get('timeout', 1.0) > 0:
        raise ConfigError(f'--timeout {chosen["timeout"]:g}: must be above 0')
    if arguments.autopilot is None:
        given = [*(['exec'] if arguments.program else []), *chosen]
        given += ['home'] if arguments.home else []
        if given:
            option = given[0].replace('_', '-')
            raise ConfigError(f'--{option} needs --autopilot')
        return None
    # heavy: only when it is needed
    from fluid_sim_ros.cli.flight import AutopilotRun
    from fluid_sim_ros.loop.autopilot_port import AutopilotOptions
    from fluid_sim_ros.mavlink.program.parameters import parse_parameters

    options = AutopilotOptions(arguments.autopilot, program=bool(arguments.program), **chosen)
    return AutopilotRun(
        options, arguments.program or '', parse_parameters(arguments.parameters), arguments.home
    )


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

    run = chosen_run(arguments)
    if run is None:
        raise ConfigError('the doctor looks for an autopilot with --autopilot')
    seen = cli_flight.listen_to_autopilot(run, arguments.scene or _SCENE, arguments.seconds)
    table = Table('what', 'found', title=f'fluid_sim doctor --autopilot {arguments.autopilot}')
    for name, value in seen.items():
        shown = '\n'.join(map(str, value)) if isinstance(value, list) else str(value)
        table.add_row(name, escape(shown))
    return table, seen
