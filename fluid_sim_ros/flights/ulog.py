# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""PX4's logs (ULog), by pyulog."""

from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from fluid_sim_ros.errors import listed, needed_for
from fluid_sim_ros.flights.flight import FlightError, RawLog, Stream
from fluid_sim_ros.flights.strangers import reason_of, silent
from fluid_sim_ros.schema.data_file import open_data
from fluid_sim_ros.schema.limits import limit

MAGIC = b'ULog\x01\x12\x35'
#: Length of the head of a file [bytes].
_HEADER = 16
#: Most reads: an honest log takes two of each message, which has 3 bytes or more.
_READS_PER_BYTE, _READS = 4, 100_000
#: Facts that are shown, by their key in the log.
_ABOUT = {'ver_hw': 'hardware', 'sys_name': 'software', 'ver_sw_branch': 'branch'}
_PARAMETERS = {'SYS_AUTOSTART': 'airframe', 'MAV_TYPE': 'MAV_TYPE'}


class _Bounded:
    """
    A file that is read no more often than an honest log needs.

    In a damaged one pyulog 1.2 goes back to the same place for ever.
    """

    def __init__(self, stream: BinaryIO, size: int) -> None:
        self._read = stream.read
        self.seek, self.tell, self.close = stream.seek, stream.tell, stream.close
        self._left = _READS_PER_BYTE * size + _READS

    def read(self, size: int = -1) -> bytes:
        self._left -= 1
        if self._left < 0:
            raise FlightError('it leads back to the same place again and again')
        return self._read(size)


def read_ulog(path: Path) -> RawLog:
    """
    Read a log of PX4.

    Parameters
    ----------
    path
        Of the file.

    Returns
    -------
    RawLog
        One stream per topic; a second instance is ``TOPIC#1``.

    Raises
    ------
    FlightError
        If pyulog finds no log in it.

    """
    with needed_for('a log of PX4'):
        from pyulog import ULog

    try:
        with silent(), open_data(path) as stream:
            log: Any = ULog(_Bounded(stream, path.stat().st_size))
    except Exception as error:  # noqa: BLE001  pyulog raises anything on a damaged log
        raise FlightError(f'{path}: no ULog that pyulog reads ({reason_of(error)})') from None
    streams, untimed = {}, []
    for topic in log.data_list:
        columns = {
            name: np.asarray(values, dtype=np.float64)
            for name, values in topic.data.items()
            if name != 'timestamp' and np.issubdtype(np.asarray(values).dtype, np.number)
        }
        name = topic.name if not topic.multi_id else f'{topic.name}#{topic.multi_id}'
        if 'timestamp' not in topic.data:
            untimed.append(name)
            continue
        times = np.asarray(topic.data['timestamp'], dtype=np.float64) * 1e-6
        streams[name] = Stream(times, columns)
    cut = _cut_off(path)
    lost = sum(drop.duration for drop in log.dropouts) * 1e-3
    faults = [f'{len(log.dropouts)} dropouts of the logger, {lost:.2f} s together'] * bool(lost)
    if getattr(log, '_file_corrupt', False):
        faults.append('damaged: what pyulog could read is read')
    if cut:
        faults.append('damaged: cut off within a message; what is before is read')
    if untimed:
        faults.append(f'topics without a timestamp, which are left out: {listed(untimed)}')
    about = {words: str(log.msg_info_dict[key]) for key, words in _ABOUT.items()
             if key in log.msg_info_dict}  # fmt: skip
    about |= {words: f'{log.initial_parameters[key]:g}' for key, words in _PARAMETERS.items()
              if key in log.initial_parameters}  # fmt: skip
    return RawLog(path, 'PX4 ULog', 'px4', streams, about, tuple(faults))


def _cut_off(path: Path) -> bool:
    """Return whether the last message of a log is not whole; each begins with its length."""
    with open_data(path) as file:
        content = file.read(limit('flight_bytes'))
    at, end = _HEADER, len(content)
    while at + 3 <= end:
        at += 3 + int.from_bytes(content[at : at + 2], 'little')
    return at != end
