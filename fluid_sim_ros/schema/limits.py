# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
What a file may ask for at most: sizes, depths, counts and ratios, each with a name.

They stop files that are made to exhaust memory or time; honest files stay far below. Who has a
larger one raises a limit with the environment variable ``FLUID_SIM_LIMITS``, such as
``FLUID_SIM_LIMITS=scene_events=1e6,yaml_bytes=1e9``.
"""

import os
from dataclasses import dataclass
from functools import cache

from fluid_sim_ros.errors import ConfigError, LimitError, listed, printable

VARIABLE = 'FLUID_SIM_LIMITS'


@dataclass(frozen=True)
class Limit:
    """One limit: its number, and what it bounds."""

    most: int
    what: str


LIMITS = {
    'yaml_bytes': Limit(16 << 20, 'size of a YAML file [bytes]'),
    'yaml_depth': Limit(40, 'levels of a YAML file'),
    'yaml_values': Limit(1_000_000, 'values of a YAML file, aliases written out'),
    'scene_events': Limit(100_000, 'events of a scene, or pending winds and currents'),
    'fleet_vehicles': Limit(1000, 'vehicles of a scene'),
    'csv_bytes': Limit(64 << 20, 'size of a CSV file [bytes]'),
    'csv_rows': Limit(500_000, 'rows of a CSV file'),
    'grid_bytes': Limit(1 << 30, 'numbers of a grid of wind or current [bytes]'),
    'expansion': Limit(100, 'times that compressed data may grow, beyond 32 MiB'),
    'log_chunk_bytes': Limit(64 << 20, 'size of a chunk of a log, decompressed [bytes]'),
    'log_values': Limit(2_000_000, 'values of a JSON text in a log'),
    'log_depth': Limit(20, 'levels of messages in a message'),
    'log_columns': Limit(10_000, 'fields of a topic as a table'),
    'log_layouts': Limit(5000, 'different lengths of the arrays and texts of a topic'),
    'log_table_bytes': Limit(64 << 20, 'table of a topic beyond 10 times its messages [bytes]'),
    'log_definition_bytes': Limit(1 << 20, 'size of a message definition [bytes]'),
    'log_steps': Limit(200_000, 'steps of a repeated flight, beyond 1000 for each message'),
    'log_attachment_bytes': Limit(1 << 30, 'files of a model in a log together [bytes]'),
    'model_elements': Limit(100_000, 'elements of the model in a log, replicas counted'),
    'model_bytes': Limit(128 << 20, 'memory for the model in a log, beyond 100 times its files'),
    'model_seconds': Limit(6, 'time to load the model in a log, beyond 2 s per MB [s]'),
    'flight_bytes': Limit(1 << 30, 'size of a log of other software [bytes]'),
    'flight_messages': Limit(20_000_000, 'messages of a log of other software'),
    'flight_samples': Limit(5_000_000, 'samples of a signal of a flight'),
    'mesh_bytes': Limit(300 << 20, 'size of a mesh file [bytes]'),
    'mesh_triangles': Limit(1_000_000, 'triangles of a mesh file'),
    'mesh_pieces': Limit(20_000, 'meshes of a scene in a mesh file'),
    'mesh_memory': Limit(256 << 20, 'memory to read a mesh, beyond 100 times its file [bytes]'),
    'mesh_seconds': Limit(10, 'processor time to read a mesh, beyond 4 s per MB [s]'),
    'xml_bytes': Limit(16 << 20, 'size of a URDF, xacro or MJCF file that is imported [bytes]'),
    'xml_depth': Limit(300, 'levels of such a file'),
    'xml_elements': Limit(5000, 'elements of such a file'),
    'xml_files': Limit(1000, 'files that an imported MJCF model includes'),
    'xacro_bytes': Limit(192 << 20, 'memory to expand a xacro file [bytes]'),
    'xacro_seconds': Limit(8, 'processor time to expand a xacro file [s]'),
    'sweep_runs': Limit(10_000_000, 'runs of a sweep, 300 bytes each in memory'),
    'result_bytes': Limit(64 << 20, 'size of a result that is read again [bytes]'),
    'drawn_vehicles': Limit(100, 'vehicles of a log that are drawn'),
    'film_pictures': Limit(100_000, 'pictures of a film'),
}
#: Compressed data may grow to this much, whatever its size [bytes].
_EXPANSION_BASE = 32 << 20


def limit(name: str) -> int:
    """
    Return the number of a limit, as the user set it.

    Parameters
    ----------
    name
        One of ``LIMITS``.

    Returns
    -------
    int
        In the unit that ``LIMITS`` states.

    Raises
    ------
    ConfigError
        If the environment variable does not read ``NAME=NUMBER,...``.

    """
    return _stated(os.environ.get(VARIABLE, '')).get(name, LIMITS[name].most)


@cache
def _stated(text: str) -> dict[str, int]:
    found = {}
    for pair in filter(None, text.replace(' ', '').split(',')):
        name, _, number = pair.partition('=')
        if name not in LIMITS:
            raise ConfigError(
                f"{VARIABLE}: '{printable(name)}' is no limit; limits: {listed(LIMITS)}"
            )
        try:
            found[name] = int(float(number))
        except (ValueError, OverflowError):
            raise ConfigError(f'{VARIABLE}: {printable(pair)}: needs {name}=NUMBER') from None
    return found


def check_limit(name: str, value: float, what: str) -> None:
    """
    Refuse what is beyond a limit.

    Parameters
    ----------
    name
        One of ``LIMITS``.
    value
        What a file asks for, in the unit of the limit.
    what
        What has it; the message begins with it.

    Raises
    ------
    LimitError
        If it is beyond.

    """
    if value > (most := limit(name)):
        raise beyond(name, most, f'{what}: {value:.6g}')


def beyond(name: str, most: int, what: str) -> LimitError:
    """
    Return the error of what is beyond a limit.

    Parameters
    ----------
    name
        One of ``LIMITS``.
    most
        What it allows, in its unit.
    what
        What has how much.

    """
    return LimitError(
        f'{what} is beyond the limit {name} = {most} ({LIMITS[name].what}); '
        f'{VARIABLE}={name}=NUMBER raises it'
    )


def expanded_size(compressed: int) -> int:
    """
    Return how large compressed data may become.

    Parameters
    ----------
    compressed
        Its size [bytes].

    Returns
    -------
    int
        [bytes].

    """
    return _EXPANSION_BASE + limit('expansion') * compressed
