# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""ArduPilot's logs (DataFlash, ``.bin``), by pymavlink's DFReader."""

from collections.abc import Collection
from pathlib import Path
from typing import Any

import numpy as np

from fluid_sim_ros.errors import FluidSimError, needed_for, printable
from fluid_sim_ros.flights.flight import FlightError, RawLog, Stream
from fluid_sim_ros.flights.strangers import reason_of, silent, silent_native
from fluid_sim_ros.schema.limits import check_limit

#: Begin of a message, and the type that describes types.
MAGIC = b'\xa3\x95\x80'
#: Fields that number the instances of a message.
_INSTANCES = ('I', 'C', 'Instance', 'IMU')


def read_dataflash(path: Path, wanted: Collection[str]) -> RawLog:
    """
    Read a log of ArduPilot.

    Parameters
    ----------
    path
        Of the file.
    wanted
        Types of messages that are read; of the others only the number is known. A second
        instance is ``TYPE[1]``.

    Returns
    -------
    RawLog
        One stream per type.

    Raises
    ------
    FlightError
        If DFReader finds no log in it.

    """
    with needed_for('a log of ArduPilot'):
        from pymavlink.DFReader import DFReader_binary

    try:
        with silent_native():
            log: Any = DFReader_binary(str(path))
    except Exception as error:  # noqa: BLE001  DFReader raises anything, Exception itself too
        raise FlightError(f'{path}: no log that DFReader reads ({reason_of(error)})') from None
    names = {form.name: form for form in log.formats.values()}
    rows: dict[str, list[tuple[float, ...]]] = {}
    fields: dict[str, list[str]] = {}
    about: dict[str, str] = {}
    faults: list[str] = []
    types = [name for name in names if name in {w.partition('[')[0] for w in wanted} | {'VER'}]
    count = 0
    try:
        while (message := _next(log, types)) is not None:
            count += 1
            kind, content = message.get_type(), message.to_dict()
            if kind == 'VER':
                about['software'] = printable(content.get('FWS', ''), 100)
                continue
            number = next((content[i] for i in _INSTANCES if content.get(i)), 0)
            stream = f'{kind}[{number}]' if number else kind
            numeric = fields.setdefault(stream, [
                key for key, value in content.items()
                if isinstance(value, int | float) and key != 'TimeUS'
            ])  # fmt: skip
            rows.setdefault(stream, []).append(
                (content.get('TimeUS', 0), *(content[key] for key in numeric))
            )
            check_limit('flight_messages', count, f'{path}: messages')
    except FluidSimError:
        raise
    except Exception as error:  # noqa: BLE001  as above
        faults.append(f'damaged: {reason_of(error)}; what is before is read')
    if _cut_off(log):
        faults.append('damaged: cut off within a message; what is before is read')
    streams = {}
    for stream, found in rows.items():
        table = np.array(found, dtype=np.float64)
        columns = {key: table[:, 1 + i] for i, key in enumerate(fields[stream])}
        streams[stream] = Stream(table[:, 0] * 1e-6, columns)
    return RawLog(path, 'ArduPilot DataFlash', 'ardupilot', streams, about, tuple(faults))


def _cut_off(log: Any) -> bool:
    """Return whether the file ends within a message; DFReader knows where the whole ones are."""
    last = max(
        (places[-1] + log.formats[kind].len for kind, places in enumerate(log.offsets)
         if places and kind in log.formats),
        default=0,
    )  # fmt: skip
    rest = bytes(log.data_map[last : log.data_len])
    return last > log.data_len or rest.startswith(MAGIC[:2])


def _next(log: Any, types: list[str]) -> Any:
    """Return the next message, or None; DFReader prints a line for each byte that it skips."""
    with silent():
        return log.recv_match(type=types)
