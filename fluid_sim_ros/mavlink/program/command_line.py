# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What starts an autopilot's program: the user's command, and what the bridge knows better."""

import shlex
from collections.abc import Mapping, Sequence
from pathlib import Path

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.loop.autopilot_port import AutopilotOptions
from fluid_sim_ros.mavlink.program.parameters import with_defaults

#: So fast that ArduPilot never waits for its own clock: the bridge sets the pace.
_SPEEDUP = 100
HEADING_EAST = 90  # [deg]: the identity attitude
#: ArduPilot's first serial port, for a ground station: by default it waits for one ("tcp:0:wait")
#: before it sends anything.
_SERIAL0, _WITHOUT_WAITING = ('--serial0', '--uartA'), 'tcp:0'


def command_line(
    command: str,
    options: AutopilotOptions,
    parameters: Mapping[str, float],
    home: Sequence[float],
    folder: Path,
) -> list[str]:
    """
    Return the arguments that start an autopilot; ArduPilot's parameters become a file.

    Parameters
    ----------
    command
        What the user would type, as one line; ``~`` as a shell has it.
    options
        Protocol, instance and address.
    parameters
        Value by name; PX4 gets them otherwise.
    home
        Latitude and longitude [deg], altitude [m], heading [deg].
    folder
        Where the file of parameters is written.

    Returns
    -------
    arguments
        The program and its arguments.

    Raises
    ------
    ConfigError
        If the command cannot be read.

    """
    try:
        arguments = [_expanded(word) for word in shlex.split(command)]
    except ValueError as error:
        raise ConfigError(f'--exec {command}: {error}') from None
    if not arguments:
        raise ConfigError('--exec: names no program')
    if options.protocol == 'px4':
        return [*arguments, '-d', '-i', str(options.instance)]
    place = ','.join(map(str, home))
    added = ['--model', f'JSON:{options.address}', '--home', place,
             '--speedup', str(_SPEEDUP), '-I', str(options.instance)]  # fmt: skip
    if options.port:
        added += ['--sim-port-out', str(options.port)]
    if not has_option(arguments, *_SERIAL0):
        added += [_SERIAL0[0], _WITHOUT_WAITING]
    return with_defaults([*arguments, *added], parameters, folder)


def _expanded(word: str) -> str:
    # a path only where it must be: it would drop the ./ of a program in the present folder
    return str(Path(word).expanduser()) if word.startswith('~') else word


def has_option(arguments: list[str], *names: str) -> bool:
    """
    Return whether a command has one of these options, with its value behind a space or ``=``.

    Parameters
    ----------
    arguments
        The program and its arguments.
    *names
        Options, such as ``--defaults``.

    """
    return any(word.partition('=')[0] in names for word in arguments)
