# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Reads MCAP logs, whole or damaged: every value comes from a part whose checksum is right.

The format is https://mcap.dev/spec (version 0). Messages stand in compressed chunks, each with a
checksum; what is before a damaged or missing part is read, and so is what comes after it where
the index at the file's end (or the length of the damaged part) says where to go on. One record is
in memory at a time; what a log may grow to is bounded (``schema.limits``).
"""

import os
import struct
import zlib
from pathlib import Path

from fluid_sim_ros.errors import printable
from fluid_sim_ros.output.progress import Report, silent
from fluid_sim_ros.recording.channels import Channels
from fluid_sim_ros.recording.damage import BadRecordError, LogError, reading
from fluid_sim_ros.recording.log import Log
from fluid_sim_ros.recording.records import (
    ATTACHMENT,
    CHANNEL,
    CHUNK,
    CHUNK_INDEX,
    DATA_END,
    FOOTER,
    FOOTER_SIZE,
    HEADER,
    MAGIC,
    OTHERS,
    RECORD,
    SCHEMA,
    UNCHECKED,
    Fields,
    decompress,
    read_attachment,
    read_chunk_head,
    records,
)
from fluid_sim_ros.schema.data_file import open_handle
from fluid_sim_ros.schema.limits import beyond, expanded_size, limit

#: Faults that are listed one by one.
_MOST_FAULTS = 100
_PIECE = 1 << 20
#: What the first pass over a file is called.
_CHECKING = 'checking [kB]'


def open_log(path: str | Path, report: Report = silent) -> Log:
    """
    Open a log file, or the one log in a folder, and check every checksum in it.

    Parameters
    ----------
    path
        Of the file or the folder.
    report
        Is told how far this and each later pass over the file is.

    Returns
    -------
    Log
        What is in it; what is damaged, see ``Log.faults``.

    Raises
    ------
    LogError
        If there is no such file, it is no MCAP file, or it goes beyond a limit.

    """
    path = Path(path)
    with reading(path):
        if path.is_dir():
            inside = sorted(path.glob('*.mcap'))
            if len(inside) != 1:
                raise LogError(f'holds {len(inside)} .mcap files, needs one')
            path = inside[0]
    try:
        handle = open_handle(path)
    except (OSError, ValueError) as error:
        reason = getattr(error, 'strerror', None) or str(error)
        raise LogError(f'{printable(str(path), 1000)}: {reason}') from None
    try:
        with reading(path):
            return _scanned(path, handle, report)
    finally:
        os.close(handle)


def _scanned(path: Path, handle: int, report: Report) -> Log:
    status = os.fstat(handle)
    start = os.pread(handle, len(MAGIC), 0)
    if not start:
        raise LogError('the file is empty')
    if start != MAGIC:
        raise LogError('not an MCAP file')
    log = Log(path, status.st_size, report=report)
    _Scan(log, handle).run()
    return log


class _Scan:
    """Goes through a file once: finds chunks, attachments and faults."""

    def __init__(self, log: Log, handle: int) -> None:
        self._log, self._handle = log, handle
        self._seen: set[int] = set()
        self._channels = Channels(log.topics)
        self._expanded = 0
        self._faults = 0
        self._crc = zlib.crc32(MAGIC)

    def run(self) -> None:
        at, end = len(MAGIC), self._log.size
        ended = False
        while at < end and not ended:
            self._log.report(_CHECKING, at // 1000, end // 1000)
            if end - at < RECORD.size:
                break
            head = self._bytes(at, RECORD.size)
            kind, size = RECORD.unpack(head)
            after = at + RECORD.size + size
            if after > end:
                break
            ended = kind == DATA_END
            self._take(kind, at, after, head)
            at = after
        self._log.report(_CHECKING, end // 1000, end // 1000)
        if ended:
            if not self._read_index():
                self._fault('the index at the end of the file is missing or damaged')
            else:
                self._log.complete = True
        else:
            self._fault(
                f'the file ends (or is damaged) at byte {at} of {end}: what followed there, and '
                'the index, are missing'
            )
            self._read_index()
        for line in self._channels.left_out:
            self._fault(line)
        if self._faults > _MOST_FAULTS:
            self._log.faults.append(f'and {self._faults - _MOST_FAULTS} more faults')

    def _bytes(self, at: int, size: int) -> bytes:
        data = os.pread(self._handle, size, at)
        while len(data) < size:  # a read takes 2 GiB at most
            more = os.pread(self._handle, size - len(data), at + len(data))
            if not more:
                raise LogError('the file became shorter while it was read')
            data += more
        return data

    def _fault(self, line: str) -> None:
        self._faults += 1
        if self._faults <= _MOST_FAULTS:
            self._log.faults.append(line)

    def _take(self, kind: int, at: int, after: int, head: bytes) -> None:
        """Take the record between two places, and what it adds to the file's checksum."""
        before = self._crc
        begin, place = at + RECORD.size, f'{_KINDS.get(kind, "record")} at byte {at}'
        self._crc = zlib.crc32(head, self._crc)
        if kind not in _KINDS:
            for piece in range(begin, after, _PIECE):
                size = min(_PIECE, after - piece)
                self._crc = zlib.crc32(self._bytes(piece, size), self._crc)
            if kind not in OTHERS:
                self._fault(f'unknown record of kind {kind} at byte {at}')
            return
        record = self._bytes(begin, after - begin)
        self._crc = zlib.crc32(record, self._crc)
        try:
            with reading(self._log.path, place):
                self._take_record(kind, at, record, before)
        except LogError as error:
            if not isinstance(error.__cause__, BadRecordError):
                raise
            self._fault(f'{place}: {error.__cause__}')

    def _take_record(self, kind: int, at: int, record: bytes, crc: int) -> None:
        if kind == HEADER:
            fields = Fields(record)
            fields.string()
            self._log.library = fields.string()
        elif kind == CHUNK:
            self._take_chunk(at, record)
        elif kind == ATTACHMENT:
            name, data = read_attachment(record)
            if name in self._log.attachments:
                raise BadRecordError(f"there is another attachment '{printable(name)}' before it")
            self._log.attachments[name] = data
        elif record not in (struct.pack('<I', crc), UNCHECKED):
            raise BadRecordError('the checksum of the data section is wrong: something is damaged')

    def _take_chunk(self, at: int, record: bytes) -> None:
        chunk = read_chunk_head(record, at)
        first = chunk.offset - at - RECORD.size
        if chunk.size != len(record) - first:
            raise BadRecordError('its data are longer or shorter than the record')
        content = decompress(chunk, record[first:])
        self._expanded += len(content)
        if self._expanded > (most := expanded_size(self._log.size)):
            words = f'{self._expanded} bytes of messages in a file of {self._log.size}'
            raise beyond('expansion', limit('expansion'), f'{words} (allowed: {most})')
        for kind, begin, end in records(content):
            if kind == SCHEMA:
                self._channels.take_schema(content[begin:end])
            elif kind == CHANNEL:
                self._channels.take_channel(content[begin:end])
            else:  # they stand before the messages
                break
        self._log.chunks.append(chunk)
        self._seen.add(at)

    # ---- the index at the end --------------------------------------------------------------

    def _read_index(self) -> bool:
        """Use the summary if its checksum is right: channels, and chunks that were not seen."""
        size = self._log.size
        foot = size - len(MAGIC) - FOOTER_SIZE
        if foot < len(MAGIC) or self._bytes(size - len(MAGIC), len(MAGIC)) != MAGIC:
            return False
        footer = self._bytes(foot, FOOTER_SIZE)
        if RECORD.unpack_from(footer) != (FOOTER, 20):
            return False
        start, _, crc = struct.unpack_from('<QQI', footer, RECORD.size)
        if not len(MAGIC) <= start <= foot:
            return False
        summary = self._bytes(start, foot - start)
        if crc and zlib.crc32(footer[:-4], zlib.crc32(summary)) != crc:
            return False
        try:
            with reading(self._log.path, f'index at byte {start}'):
                lost = self._indexed(summary)
        except LogError as error:
            if not isinstance(error.__cause__, BadRecordError):
                raise
            self._fault(f'index at byte {start}: {error.__cause__}')
            return False
        allowed = 2 * size  # entries may lie, and name one place many times
        for at, length in sorted(lost.items()):
            allowed -= length
            if allowed < 0:
                self._fault('the index names more chunks than the file can hold')
                break
            self._rescue(at, length)
        self._log.chunks.sort(key=lambda chunk: chunk.at)
        return True

    def _indexed(self, summary: bytes) -> dict[int, int]:
        """Take the channels of the summary; return place and length of chunks not seen yet."""
        lost = {}
        for kind, first, last in records(summary):
            if kind == SCHEMA:
                self._channels.take_schema(summary[first:last])
            elif kind == CHANNEL:
                self._channels.take_channel(summary[first:last])
            elif kind == CHUNK_INDEX:
                if last - first < 32:
                    raise BadRecordError('an entry is too short')
                at, length = struct.unpack_from('<QQ', summary, first + 16)
                if at not in self._seen:
                    lost[at] = length
        return lost

    def _rescue(self, at: int, length: int) -> None:
        """Read a chunk that the index names and the scan did not reach."""
        place = f'chunk at byte {at}'
        try:
            with reading(self._log.path, place):
                if not RECORD.size <= length <= self._log.size - at:
                    raise BadRecordError('it would reach beyond the file')
                record = self._bytes(at + RECORD.size, length - RECORD.size)
                self._take_chunk(at, record)
        except LogError as error:
            if not isinstance(error.__cause__, BadRecordError):
                raise
            line = f'{place}: {error.__cause__}'
            if line not in self._log.faults:
                self._fault(line)


_KINDS = {HEADER: 'header', CHUNK: 'chunk', ATTACHMENT: 'attachment', DATA_END: 'data end'}
