"""XML of others: read within limits, and xacro expanded in a process of its own."""

import os
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from fluid_sim_ros.errors import ConfigError, MissingExtraError
from fluid_sim_ros.schema.data_file import open_data

#: Largest text of a URDF, MJCF or xacro file [bytes].
LARGEST = 16 * 2**20
#: Wall time of xacro [s].
TIME_LIMIT = 30.0


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
            text = file.read(LARGEST + 1)
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
    if len(text) > LARGEST:
        raise ConfigError(f'{path}: more than {LARGEST >> 20} MiB; meshes belong in files')
    if b'<!ENTITY' in text:
        raise ConfigError(f'{path}: declares entities, which are not read; write their text out')
    try:
        return ElementTree.fromstring(text)
    except (ElementTree.ParseError, ValueError, LookupError) as error:
        raise ConfigError(f'{path}: is no XML ({error})') from None


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
    if not path.is_file():
        raise ConfigError(f'{path}: no such file')
    from fluid_sim_ros.new_vehicle.importing import xacro_process

    command = [sys.executable, '-m', xacro_process.__name__, str(path), *map(str, packages)]
    try:
        done = subprocess.run(
            command, capture_output=True, check=False, stdin=subprocess.DEVNULL,
            timeout=TIME_LIMIT, env=os.environ | {'OMP_NUM_THREADS': '1'},
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        raise ConfigError(f'{path}: not expanded within {TIME_LIMIT:g} s') from None
    if done.returncode:
        words = done.stderr.decode(errors='replace').strip().splitlines() or ['it ended by itself']
        if "No module named 'xacro'" in words[-1]:
            raise MissingExtraError(
                'a xacro file needs xacro, which is not installed; fluid_sim doctor says what to '
                'type'
            )
        raise ConfigError(f'{path}: xacro: {words[-1]}')
    return parse_xml(done.stdout, path)
