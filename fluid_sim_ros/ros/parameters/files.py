"""What is checked of parameter files before ROS reads them."""

from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import yaml

from fluid_sim_ros.errors import ConfigError


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
    for flag, value in pairwise(arguments):
        if flag == '--params-file':
            _check_parameter_file(Path(value))


def _check_parameter_file(path: Path) -> None:
    if not path.is_file():
        raise ConfigError(f'{path}: no such parameter file')
    try:
        content = yaml.safe_load(path.read_text(encoding='utf-8'))
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise ConfigError(f'{path}: not valid YAML: {" ".join(str(error).split())}') from None
    if not isinstance(content, dict):
        raise ConfigError(f'{path}: needs <node name>: ros__parameters: <parameters>')
    for node, body in content.items():
        parameters = body.get('ros__parameters') if isinstance(body, dict) else None
        if not isinstance(parameters, dict):
            raise ConfigError(
                f"{path}: '{node}' holds no 'ros__parameters' mapping; this looks like a scene or "
                "vehicle file, which belongs in the parameter 'scene'"
            )
        _check_flat(path, '', parameters)


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
