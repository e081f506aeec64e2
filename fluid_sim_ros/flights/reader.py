# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Reads the log of a flight in any of the formats, and makes it the one form."""

from pathlib import Path

from fluid_sim_ros.errors import printable
from fluid_sim_ros.flights import bag, bitcraze, dataflash, table, ulog
from fluid_sim_ros.flights.assemble import flight_of
from fluid_sim_ros.flights.flight import Flight, FlightError, RawLog
from fluid_sim_ros.flights.mapping import FlightMap, over_default
from fluid_sim_ros.schema.data_file import open_data
from fluid_sim_ros.schema.limits import check_limit, limit

#: Endings of files that this room reads, besides folders of bags.
ENDINGS = ('.ulg', '.bin', '.usd', '.csv', '.parquet', '.mcap', '.db3')


def read_log(path: Path, mapping: FlightMap | None = None) -> tuple[RawLog, FlightMap]:
    """
    Read the streams of a log, and return them with the mapping that holds.

    Parameters
    ----------
    path
        A file, or the folder of a bag.
    mapping
        The user's, over that of the format.

    Returns
    -------
    RawLog, FlightMap
        What is in it, and which columns are which quantity.

    Raises
    ------
    FlightError
        If it is no log of a known format, or a damaged one.
    LimitError
        If it is larger than what is read.

    """
    head, size = _head(path)
    check_limit('flight_bytes', size, f'{path}: size')
    suffix = path.suffix.lower()
    if head.startswith(ulog.MAGIC):
        raw = ulog.read_ulog(path)
    elif head[:3] == dataflash.MAGIC:
        known = over_default(mapping, 'ardupilot')
        wanted = {place.stream for places in known.signals.values() for place in places}
        raw = dataflash.read_dataflash(path, wanted)
    elif head[:1] == bytes([bitcraze.MAGIC]):
        with open_data(path) as file:
            raw = bitcraze.read_bitcraze(path, file.read(limit('flight_bytes')))
    elif path.is_dir() or suffix in ('.mcap', '.db3'):
        raw = bag.read_bag(path)
    elif suffix in ('.csv', '.parquet'):
        clock = over_default(mapping, 'table').time
        raw = table.read_table(path, clock.column, clock.unit)
    else:
        raise FlightError(
            f'{path}: no log of a known format; known: PX4 ULog (.ulg), ArduPilot DataFlash '
            '(.bin), Bitcraze uSD (.usd), ROS 2 bag or MCAP, CSV, Parquet'
        )
    return raw, over_default(mapping, raw.format)


def _head(path: Path) -> tuple[bytes, int]:
    shown = printable(str(path), 1000)
    if path.is_dir():
        return b'', sum(file.stat().st_size for file in path.iterdir() if file.is_file())
    try:
        with open_data(path) as file:
            head = file.read(16)
    except OSError as error:
        raise FlightError(f'{shown}: {error.strerror or error}') from None
    if not head:
        raise FlightError(f'{shown}: the file is empty')
    return head, path.stat().st_size


def read_flight(path: Path | str, mapping: FlightMap | None = None) -> Flight:
    """
    Read a flight.

    Parameters
    ----------
    path
        A file, or the folder of a bag.
    mapping
        Which columns are which quantity, over that of the format (``config/flights``).

    Returns
    -------
    Flight
        All signals that the log has; ``Flight.missing`` says what is not there.

    Raises
    ------
    FlightError
        If the log cannot be read, or a stated column is not in it.

    """
    raw, known = read_log(Path(path), mapping)
    return flight_of(raw, known, named=frozenset(mapping.signals) if mapping else frozenset())
