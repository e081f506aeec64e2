# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The command line of a node's executable: its help, and words that ROS does not take."""

import re
import shutil
import textwrap
from collections.abc import Sequence
from typing import Any

import rclpy
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import remove_ros_args

from fluid_sim_ros.errors import ConfigError, did_you_mean
from fluid_sim_ros.ros.parameters.files import check_parameter_files
from fluid_sim_ros.ros.parameters.table import Table
from fluid_sim_ros.ros.process.this_host import check_domain

_HELP = ('-h', '--help')


def asks_for_help(arguments: Sequence[str]) -> bool:
    """
    Return whether a command line asks for help.

    Parameters
    ----------
    arguments
        Command line with the program's name.

    Returns
    -------
    bool
        Whether ``-h`` or ``--help`` stands before the arguments of ROS.

    """
    before = list(arguments[1:])
    if '--ros-args' in before:
        before = before[: before.index('--ros-args')]
    return any(word in _HELP for word in before)


def help_text(name: str, summary: str, table: Table) -> str:
    """
    Return the help of an executable.

    Parameters
    ----------
    name
        Its name.
    summary
        What it does.
    table
        Its parameters.

    Returns
    -------
    str
        Usage, summary, and every parameter with its default, as wide as the terminal.

    """
    width = min(shutil.get_terminal_size((80, 24)).columns, 100)
    lines = [
        f'usage: {name} [-h] [--ros-args [-p NAME:=VALUE ...] [--params-file FILE]]',
        '',
        *textwrap.wrap(summary, width),
        '',
        'parameters (* may change while it runs):',
    ]
    for parameter, declared in table.items():
        mark = '*' if declared.live else ' '
        lines.append(f' {mark}{parameter} (default: {_shown(declared.default)})')
        text = declared.description
        if declared.choices:
            text += f'; one of: {", ".join(choice or "(empty)" for choice in declared.choices)}'
        lines += textwrap.wrap(text, width, initial_indent=' ' * 6, subsequent_indent=' ' * 6)
    lines += ['', f'example: {name} --ros-args -p {next(iter(table))}:=...']
    return '\n'.join(lines) + '\n'


def start_ros(arguments: Sequence[str]) -> None:
    """
    Check a command line and start ROS with it, without signal handlers of its own.

    Parameters
    ----------
    arguments
        Command line with the program's name.

    Raises
    ------
    ConfigError
        If ROS_DOMAIN_ID, a parameter file or an argument is wrong.

    """
    check_domain()
    check_parameter_files(arguments)
    try:
        unknown = remove_ros_args(list(arguments))[1:]
        if unknown:
            raise ConfigError(_unknown(unknown[0]))
        rclpy.init(args=list(arguments), signal_handler_options=SignalHandlerOptions.NO)
    except RuntimeError as error:  # what rclpy's own errors derive from
        # without places in the source of ROS, and what says no more than that it failed
        reason = re.split(r', at /|\[rcl\]', str(error))[0]
        reason = re.sub(r'^.*?(Couldn.t parse|\[)', r'cannot use \1', reason)
        reason = re.sub(r'Couldn.t parse ', '', reason)
        raise ConfigError(f'command line: {reason}') from None


def _unknown(word: str) -> str:
    meant = did_you_mean(word, [*_HELP, '--ros-args'])
    return (
        f"argument '{word}' is not known{meant} parameters are given as "
        '--ros-args -p name:=value (see --help)'
    )


def _shown(default: Any) -> str:
    if isinstance(default, str):
        return default or 'empty'
    if isinstance(default, list):
        return '[' + ', '.join(map(str, default)) + ']'
    return str(default).lower() if isinstance(default, bool) else f'{default:g}'
