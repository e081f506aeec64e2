# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Results as JSON."""

import errno
import json
import os
import sys

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
        # a pipe that nobody reads would be waited for
        flags = os.O_WRONLY | os.O_CREAT | os.O_TRUNC | os.O_CLOEXEC | os.O_NONBLOCK
        handle = os.open(path, flags, 0o666)
        os.set_blocking(handle, True)
        with os.fdopen(handle, 'w', encoding='utf-8') as file:
            file.write(text)
    except OSError as error:
        reason = 'nobody reads it' if error.errno == errno.ENXIO else error.strerror
        raise ConfigError(f'{path}: cannot be written ({reason})') from None
