# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
What is checked of the parameters of a command line before ROS reads them.

ROS drops what is meant for another node without a word, and reads lists of mappings as something
else; both are said here.
"""

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.schema.yaml_file import read_yaml

_KEY = 'ros__parameters'
_RULE = re.compile(r'(?:([^:]+):)?([^:]+):=')


def check_parameter_files(arguments: Sequence[str]) -> None:
    """
    Refuse parameter files that the ROS parser would read as something else without a word.

    Parameters
    ----------
    arguments
        Command line of the process.

    Raises
    ------
    ConfigError
        If a ``--params-file`` is missing or holds more than flat ROS parameters.

    """
    for path in _files(arguments):
        for _, parameters in _sections(path):
            _check_flat(path, '', parameters)


def lost_parameters(arguments: Sequence[str], node: str) -> list[str]:
    """
    Return what a command line sets for other nodes only.

    Parameters
    ----------
    arguments
        Command line of the process, whose files were checked.
    node
        Full name of the node, ``/namespace/name``.

    Returns
    -------
    list
        One line for each file that has nothing for the node, and for each parameter of another.

    """
    lines = []
    for path in _files(arguments):
        names = [name for name, _ in _sections(path)]
        if not any(_is_for(name, node) for name in names):
            leaf = node.rpartition('/')[2]
            hint = f'; call it {node}'
            if any(name.rpartition('/')[2] == leaf for name in names):
                hint += f', or /**/{leaf} for every namespace'
            lines.append(
                f'{path} sets no parameter of this node, {node}, which has its defaults; it is '
                f'for: {listed(names)}{hint}'
            )
    for flag, value in pairwise(arguments):
        rule = _RULE.match(value) if flag in ('-p', '--param') else None
        if rule and rule[1] and not _is_for(rule[1], node):
            lines.append(
                f"parameter '{rule[2]}' is set for another node, '{rule[1]}', and not for this "
                f'one, {node}'
            )
    return lines


def _files(arguments: Sequence[str]) -> list[Path]:
    return [Path(value) for flag, value in pairwise(arguments) if flag == '--params-file']


def _is_for(name: str, node: str) -> bool:
    """Return whether ROS takes a name in a file, with its wildcards, for a node."""
    tokens = name.strip('/').split('/')
    pattern = ''.join(
        '(/[^/]+)*' if token == '**' else '/[^/]+' if token == '*' else f'/{re.escape(token)}'
        for token in tokens
    )
    return re.fullmatch(pattern, node) is not None


def _sections(path: Path) -> list[tuple[str, dict[str, Any]]]:
    """Return the nodes in a file, with namespaces and wildcards, and their parameters."""
    if not path.is_file():
        raise ConfigError(f'{path}: no such parameter file')
    content = read_yaml(path)
    if not isinstance(content, dict) or not content:
        raise ConfigError(f'{path}: needs <node name>: {_KEY}: <parameters>')
    return list(_walk(path, '', content))


def _walk(path: Path, above: str, content: dict[str, Any]) -> Iterator[tuple[str, dict[str, Any]]]:
    for key, body in content.items():
        name = f'{above}/{str(key).strip("/")}'
        if not isinstance(body, dict) or not body:
            raise ConfigError(
                f"{path}: '{key}' holds no '{_KEY}' mapping; this looks like a scene or vehicle "
                "file, which belongs in the parameter 'scene'"
            )
        if _KEY not in body:  # a namespace
            yield from _walk(path, name, body)
        elif isinstance(body[_KEY], dict):
            yield name, body[_KEY]
        else:
            raise ConfigError(f"{path}: '{key}': '{_KEY}' holds no parameters")


def _check_flat(path: Path, prefix: str, parameters: dict[str, Any]) -> None:
    for key, value in parameters.items():
        name = f'{prefix}{key}'
        if isinstance(value, dict):
            _check_flat(path, f'{name}.', value)
        elif isinstance(value, list) and any(isinstance(v, dict | list) for v in value):
            raise ConfigError(
                f"{path}: parameter '{name}' is a list of mappings or lists, which ROS cannot "
                'hold; scenes and vehicles have files of their own (config/scenes)'
            )
