# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The parameters that a frame needs, on their way into an autopilot's program."""

import re
from collections.abc import Mapping
from pathlib import Path

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.mavlink.mapping import AutopilotFile

#: PX4's start script takes each ``PX4_PARAM_<NAME>`` of its environment.
_PX4_PREFIX = 'PX4_PARAM_'
_NAME = re.compile(r'[A-Z][A-Z0-9_]*')
#: Sticks in the order of most radio controls: PX4's parameter of each channel.
_STICKS = ('RC_MAP_ROLL', 'RC_MAP_PITCH', 'RC_MAP_THROTTLE', 'RC_MAP_YAW')


def needed_parameters(file: AutopilotFile, own: Mapping[str, float]) -> dict[str, float]:
    """
    Return what an autopilot is to be set to.

    Parameters
    ----------
    file
        The mapping: its parameters and, where PX4 gets the sticks of a radio control or a
        battery, those without which it does not look at them.
    own
        The user's, which replace those of the mapping.

    Returns
    -------
    dict
        Value by name.

    """
    brought: dict[str, float] = {}
    if file.protocol == 'px4' and file.rc:
        count = len(file.rc)
        channels = {name: float(i + 1) for i, name in enumerate(_STICKS[:count])}
        brought = {'RC_CHAN_CNT': float(count), 'COM_RC_IN_MODE': 0.0, **channels}
    if file.protocol == 'px4' and file.battery is not None:
        brought['SIM_BAT_DRAIN'] = 0.0  # else PX4 has a battery of its own besides
    stated = {name: parameter.value for name, parameter in file.parameters.items()}
    return brought | stated | dict(own)


def parameters_line(parameters: Mapping[str, float]) -> str:
    """
    Return parameters in one line.

    Parameters
    ----------
    parameters
        Value by name.

    """
    return ', '.join(f'{name} {value:g}' for name, value in parameters.items())


def parse_parameters(words: list[str]) -> dict[str, float]:
    """
    Read parameters as a user types them.

    Parameters
    ----------
    words
        Each ``NAME=VALUE``.

    Returns
    -------
    dict
        Value by name.

    Raises
    ------
    ConfigError
        If one is written otherwise.

    """
    found = {}
    for word in words:
        name, _, text = word.partition('=')
        try:
            value = float(text)
        except ValueError:
            value = float('nan')
        if not _NAME.fullmatch(name) or not abs(value) < float('inf'):
            raise ConfigError(f'--param {word}: must be NAME=NUMBER, such as FRAME_TYPE=1')
        found[name] = value
    return found


def px4_environment(
    parameters: Mapping[str, float], environment: Mapping[str, str]
) -> dict[str, str]:
    """
    Return the variables that set parameters of PX4; those that the user has set stay.

    Parameters
    ----------
    parameters
        Value by name.
    environment
        That of this process.

    """
    named = {f'{_PX4_PREFIX}{name}': f'{value:g}' for name, value in parameters.items()}
    return {key: text for key, text in named.items() if key not in environment}


def with_defaults(
    arguments: list[str], parameters: Mapping[str, float], folder: Path
) -> list[str]:
    """
    Have ArduPilot read parameters behind the user's own files of defaults.

    Parameters
    ----------
    arguments
        The program and its arguments.
    parameters
        Value by name.
    folder
        Where their file is written.

    Returns
    -------
    arguments
        With ``--defaults USER,OURS``; of a name that stands twice, ArduPilot takes the last.

    """
    if not parameters:
        return arguments
    path = folder / 'parameters.parm'
    path.write_text(''.join(f'{name} {value:g}\n' for name, value in parameters.items()))
    result = list(arguments)
    for i, word in enumerate(result):
        option, _, given = word.partition('=')
        if option == '--defaults':
            if given:
                result[i] = f'{option}={given},{path}'
                return result
            if i + 1 < len(result):
                result[i + 1] += f',{path}'
                return result
    return [*result, '--defaults', str(path)]
