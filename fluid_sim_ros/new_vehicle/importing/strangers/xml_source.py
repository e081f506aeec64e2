# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""XML of others: read within limits, and xacro expanded in a process of its own."""

import os
import signal
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any
from xml.parsers import expat

from fluid_sim_ros.errors import ConfigError, MissingExtraError
from fluid_sim_ros.schema.data_file import open_data
from fluid_sim_ros.schema.limits import beyond, check_limit, limit

#: Wall time of xacro beyond that of the processor, on a busy machine [s].
_PATIENCE = 30.0


def read_xml(path: Path) -> ElementTree.Element:
    """
    Return the root of an XML file.

    Parameters
    ----------
    path
        The file.

    Returns
    -------
    Element
        Of the file as it stands.

    Raises
    ------
    ConfigError
        If it cannot be read, is too large, declares entities, or is no XML.

    """
    try:
        with open_data(path) as file:
            text = file.read(limit('xml_bytes') + 1)
    except FileNotFoundError:
        raise ConfigError(f'{path}: no such file') from None
    except OSError as error:
        raise ConfigError(f'{path}: {error.strerror or error}') from None
    return parse_xml(text, path)


def parse_xml(text: bytes, path: Path) -> ElementTree.Element:
    """
    Return the root of XML text.

    Parameters
    ----------
    text
        Of the file.
    path
        For errors.

    Returns
    -------
    Element
        The root.

    Raises
    ------
    ConfigError
        If it is too large, declares entities, or is no XML.

    """
    check_limit('xml_bytes', len(text), f'{path}: size (meshes belong in files)')
    try:
        _check(text, path)
        return ElementTree.fromstring(text)
    except (ElementTree.ParseError, expat.ExpatError, ValueError, LookupError) as error:
        raise ConfigError(f'{path}: is no XML ({error})') from None


def _check(text: bytes, path: Path) -> None:
    """Refuse XML that declares entities, in any encoding, is nested too deeply, or large."""
    depth = count = 0

    def entity(*_: Any) -> None:
        raise ConfigError(f'{path}: declares entities, which are not read; write their text out')

    def start(*_: Any) -> None:
        nonlocal depth, count
        depth, count = depth + 1, count + 1
        check_limit('xml_depth', depth, f'{path}: levels')
        check_limit('xml_elements', count, f'{path}: elements')

    def end(_: str) -> None:
        nonlocal depth
        depth -= 1

    parser = expat.ParserCreate()
    parser.EntityDeclHandler = entity
    parser.StartElementHandler, parser.EndElementHandler = start, end
    parser.Parse(text, True)


def expand_xacro(path: Path, packages: list[Path]) -> ElementTree.Element:
    """
    Return the root of what a xacro file expands to.

    Parameters
    ----------
    path
        The file.
    packages
        Folders of packages, for ``$(find NAME)``.

    Returns
    -------
    Element
        The root.

    Raises
    ------
    ConfigError
        If it does not expand: with xacro's own words.
    MissingExtraError
        Without xacro.

    """
    read_xml(path)
    from fluid_sim_ros.new_vehicle.importing.strangers import xacro_process

    command = [sys.executable, '-m', xacro_process.__name__, str(path), *map(str, packages)]
    try:
        done = subprocess.run(
            command, capture_output=True, check=False, stdin=subprocess.DEVNULL,
            timeout=limit('xacro_seconds') + _PATIENCE, env=os.environ | {'OMP_NUM_THREADS': '1'},
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        raise _too_long(path) from None
    if -done.returncode in (signal.SIGXCPU, signal.SIGKILL):
        raise _too_long(path)
    if done.returncode:
        words = done.stderr.decode(errors='replace').strip().splitlines() or ['it ended by itself']
        if "No module named 'xacro'" in words[-1]:
            raise MissingExtraError(
                'a xacro file needs xacro, which is not installed; fluid_sim doctor says what to '
                'type'
            )
        if words[-1].startswith('MemoryError'):
            most = limit('xacro_bytes')
            raise beyond('xacro_bytes', most, f'{path}: the memory to expand it')
        raise ConfigError(f'{path}: xacro: {words[-1]}')
    return parse_xml(done.stdout, path)


def _too_long(path: Path) -> ConfigError:
    return beyond('xacro_seconds', limit('xacro_seconds'), f'{path}: the time to expand it')
