# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The records of an MCAP file: their layout, and their fields read within bounds.

The format is https://mcap.dev/spec (version 0).
"""

import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass

import zstandard

from fluid_sim_ros.errors import printable
from fluid_sim_ros.recording.damage import BadRecordError
from fluid_sim_ros.schema.limits import check_limit

MAGIC = b'\x89MCAP0\r\n'
HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK = 1, 2, 3, 4, 5, 6
CHUNK_INDEX, ATTACHMENT, DATA_END = 8, 9, 15
#: Records that hold nothing we need: message index, attachment index, statistics, metadata,
#: metadata index, summary offset.
OTHERS = (7, 10, 11, 12, 13, 14)
RECORD = struct.Struct('<BQ')
#: A checksum that a writer did not make.
UNCHECKED = bytes(4)
MESSAGE_HEAD = struct.Struct('<HIQQ')
FOOTER_SIZE = RECORD.size + 20


@dataclass
class Chunk:
    """
    Where a chunk stands: its record (``at``), and in the file its compressed data (``offset``).

    The size of its content, uncompressed [bytes], is what its head states.
    """

    at: int
    offset: int
    size: int
    compression: bytes
    uncompressed_size: int
    crc: int


class Fields:
    """
    Reads the fields of a record within its bounds.

    Parameters
    ----------
    data
        The record, without its head.

    """

    def __init__(self, data: bytes) -> None:
        self._data = data
        self._at = 0

    @property
    def left(self) -> int:
        """Bytes that were not read yet."""
        return len(self._data) - self._at

    def take(self, size: int) -> bytes:
        """
        Return the next bytes.

        Parameters
        ----------
        size
            How many.

        Returns
        -------
        bytes
            The bytes.

        Raises
        ------
        BadRecordError
            Where the record ends before.

        """
        if size > self.left:
            raise BadRecordError('its fields are longer than the record')
        self._at += size
        return self._data[self._at - size : self._at]

    def uint16(self) -> int:
        """Return an unsigned 16-bit integer."""
        return int.from_bytes(self.take(2), 'little')

    def block(self, width: int = 4) -> bytes:
        """
        Return bytes that stand behind their length.

        Parameters
        ----------
        width
            Bytes of the length.

        Returns
        -------
        bytes
            The bytes.

        Raises
        ------
        BadRecordError
            Where the record ends before.

        """
        return self.take(int.from_bytes(self.take(width), 'little'))

    def string(self) -> str:
        """Return a string."""
        try:
            return self.block().decode()
        except UnicodeDecodeError:
            raise BadRecordError('a string is not UTF-8') from None


def read_attachment(record: bytes) -> tuple[str, bytes]:
    """
    Return an attachment's name and content, its checksum verified.

    Parameters
    ----------
    record
        An attachment record, without its head.

    Returns
    -------
    name, data
        Name and content.

    Raises
    ------
    BadRecordError
        If a field or the checksum is wrong.

    """
    fields = Fields(record)
    fields.take(16)
    name = fields.string()
    fields.string()
    data = fields.block(8)
    if zlib.crc32(record[: len(record) - fields.left]) != int.from_bytes(fields.take(4), 'little'):
        raise BadRecordError('its checksum is wrong')
    return name, data


def read_chunk_head(record: bytes, at: int) -> Chunk:
    """
    Return where the data of a chunk stands.

    Parameters
    ----------
    record
        A chunk record, without its head; its first 64 bytes are enough.
    at
        Where the record begins in the file.

    Returns
    -------
    Chunk
        The place of its data, which may reach beyond the record.

    Raises
    ------
    BadRecordError
        If it is too short.

    """
    fields = Fields(record[:64])
    fields.take(16)
    uncompressed_size = int.from_bytes(fields.take(8), 'little')
    crc = int.from_bytes(fields.take(4), 'little')
    compression = fields.block()
    size = int.from_bytes(fields.take(8), 'little')
    offset = at + RECORD.size + 16 + 8 + 4 + 4 + len(compression) + 8
    return Chunk(at, offset, size, compression, uncompressed_size, crc)


def decompress(chunk: Chunk, data: bytes) -> bytes:
    """
    Return a chunk's content, its checksum verified.

    Parameters
    ----------
    chunk
        Says how the data are compressed.
    data
        Compressed.

    Returns
    -------
    bytes
        Records, one behind the other.

    Raises
    ------
    BadRecordError
        If the data are damaged, or the compression is not known.
    LimitError
        If the content is larger than ``log_chunk_bytes``.

    """
    stated = len(data)
    if chunk.compression == b'zstd':
        try:
            stated = zstandard.frame_content_size(data)
        except zstandard.ZstdError:
            raise BadRecordError('its data do not decompress') from None
    elif chunk.compression:
        name = printable(chunk.compression.decode(errors='replace'), 40)
        raise BadRecordError(f"compression '{name}' is not known; allowed: zstd")
    if stated != chunk.uncompressed_size or len(data) != chunk.size:
        raise BadRecordError('its sizes do not agree')
    check_limit('log_chunk_bytes', stated, 'its content')
    content = data
    if chunk.compression:
        try:
            content = zstandard.decompress(data)
        except zstandard.ZstdError:
            raise BadRecordError('its data do not decompress') from None
    if chunk.crc and zlib.crc32(content) != chunk.crc:  # 0: its writer made none
        raise BadRecordError('its checksum is wrong')
    return content


def records(content: bytes) -> Iterator[tuple[int, int, int]]:
    """
    Return (kind, begin, end) of the records in a chunk or a summary.

    Parameters
    ----------
    content
        Records, one behind the other.

    Yields
    ------
    kind, begin, end
        Kind of a record, and where its fields stand.

    Raises
    ------
    BadRecordError
        If the last one reaches beyond the content.

    """
    at, end = 0, len(content)
    unpack, size = RECORD.unpack_from, RECORD.size
    while at < end:
        if at + size > end:
            raise BadRecordError(f'a record is cut at byte {at} of its content')
        kind, length = unpack(content, at)
        at += size
        after = at + length
        if after > end:
            raise BadRecordError(f'the record at byte {at - size} of its content is too long')
        yield kind, at, after
        at = after
