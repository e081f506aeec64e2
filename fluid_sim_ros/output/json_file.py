"""Results as JSON."""

import json
import sys
from pathlib import Path

from fluid_sim_ros.errors import ConfigError


def write_json(path: str, result: object) -> None:
    """
    Write a result as JSON to a file, or with ``-`` to standard output.

    Parameters
    ----------
    path
        Of the file, or ``-``.
    result
        What json can write; NaN and infinity are a ValueError.

    Raises
    ------
    ConfigError
        If the file cannot be written.

    """
    text = json.dumps(result, indent=2, allow_nan=False) + '\n'
    if path == '-':
        sys.stdout.write(text)
        return
    try:
        Path(path).write_text(text, encoding='utf-8')
    except OSError as error:
        raise ConfigError(f'{path}: cannot be written ({error.strerror})') from None
