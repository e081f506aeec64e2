# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
An MCAP file being written from messages that are packed already.

The same file as that of ``mcap.writer.Writer``, but messages arrive as finished records (see
``wire``), many at a time: what costs that writer several microseconds a message costs one here.
"""

import struct
import zlib
from typing import IO, Any

import zstandard
from mcap.data_stream import RecordBuilder
from mcap.opcode import Opcode
from mcap.records import (
    Attachment,
    AttachmentIndex,
    Channel,
    ChunkIndex,
    DataEnd,
    Footer,
    Header,
    Metadata,
    MetadataIndex,
    Schema,
    Statistics,
    SummaryOffset,
)

from fluid_sim_ros.recording.writing import wire

_MAGIC = b'\x89MCAP0\r\n'
#: Logs are 1 % smaller at the default of 3, which takes a fifth longer.
_ZSTD_LEVEL = 1
_CHUNK_HEAD = struct.Struct('<BQQQQII4sQ')
_INDEX_HEAD = struct.Struct('<BQHI')


class McapFile:
    """
    One file; ``start`` first, then schemas and channels, messages, ``finish``.

    Parameters
    ----------
    stream
        Binary stream at its start, open for writing.

    Attributes
    ----------
    counts
        Messages per channel id.
    first_ns, last_ns
        Earliest and latest log time of a message [ns].

    """

    def __init__(self, stream: IO[bytes]) -> None:
        self._stream = stream
        self._at = 0
        self._crc = 0
        self._schemas: list[Schema] = []
        self._channels: list[Channel] = []
        self._attachments: list[AttachmentIndex] = []
        self._metadata: list[MetadataIndex] = []
        self._chunks: list[ChunkIndex] = []
        self._new = RecordBuilder()  # schemas and channels for the next chunk
        self._content: list[bytes] = []
        self.chunk_size = 0
        self._places: dict[int, list[int]] = {}
        self.counts: dict[int, int] = {}
        self.first_ns, self.last_ns = 0, 0
        self._compressor = zstandard.ZstdCompressor(level=_ZSTD_LEVEL)

    def _write(self, data: bytes) -> None:
        self._crc = zlib.crc32(data, self._crc)
        self._stream.write(data)
        self._at += len(data)

    def _write_record(self, record: Any) -> tuple[int, int]:
        """Write a record; return where it stands and its length."""
        at, builder = self._at, RecordBuilder()
        record.write(builder)
        data = builder.end()
        self._write(data)
        return at, len(data)

    def start(self, profile: str, library: str) -> None:
        """
        Write the head.

        Parameters
        ----------
        profile
            Of the file, such as ``ros2``.
        library
            Who writes it.

        """
        self._write(_MAGIC)
        self._write_record(Header(profile=profile, library=library))

    def attach(self, name: str, kind: str, data: bytes, create_ns: int) -> None:
        """
        Write an attachment.

        Parameters
        ----------
        name
            Of the attachment.
        kind
            Media type.
        data
            Its content.
        create_ns
            Wall time [ns].

        """
        record = Attachment(
            create_time=create_ns, log_time=0, name=name, media_type=kind, data=data
        )
        at, length = self._write_record(record)
        self._attachments.append(
            AttachmentIndex(
                offset=at, length=length, create_time=create_ns, log_time=0,
                data_size=len(data), name=name, media_type=kind,
            )
        )  # fmt: skip

    def add_metadata(self, name: str, pairs: dict[str, str]) -> None:
        """
        Write a metadata record.

        Parameters
        ----------
        name
            Of the record.
        pairs
            Text by key.

        """
        at, length = self._write_record(Metadata(name=name, metadata=pairs))
        self._metadata.append(MetadataIndex(offset=at, length=length, name=name))

    def add_schema(self, name: str, text: bytes) -> int:
        """
        Register a ``ros2msg`` schema.

        Parameters
        ----------
        name
            Message type.
        text
            Its definition.

        Returns
        -------
        int
            Its id.

        """
        schema = Schema(id=len(self._schemas) + 1, data=text, encoding='ros2msg', name=name)
        self._schemas.append(schema)
        schema.write(self._new)
        return len(self._schemas)

    def add_channel(self, topic: str, schema: int, pairs: dict[str, str]) -> int:
        """
        Register a CDR channel.

        Parameters
        ----------
        topic
            Full name.
        schema
            Id of its schema.
        pairs
            Metadata.

        Returns
        -------
        int
            Its id.

        """
        number = len(self._channels) + 1
        channel = Channel(
            id=number, topic=topic, message_encoding='cdr', schema_id=schema, metadata=pairs
        )
        self._channels.append(channel)
        channel.write(self._new)
        self.counts[number] = 0
        return number

    # ---- chunks ----------------------------------------------------------------------------

    def add(self, payload: bytes) -> None:
        """
        Add packed messages to the open chunk.

        Parameters
        ----------
        payload
            Message records one behind the other, as ``wire.head`` and data make them.

        """
        if not self._content:
            head = self._new.end()
            self._content.append(head)
            self.chunk_size = len(head)
        unpack, size, places = wire.PLACE.unpack_from, wire.RECORD_HEAD, self._places
        at, end, base = 0, len(payload), self.chunk_size
        while at < end:
            length, channel, log_ns = unpack(payload, at)
            try:
                places[channel] += (log_ns, base + at)
            except KeyError:
                places[channel] = [log_ns, base + at]
            at += size + length
        self._content.append(payload)
        self.chunk_size = base + end

    def close_chunk(self) -> None:
        """Write the open chunk, if any, and its index."""
        places, self._places = self._places, {}
        if not places:
            return
        content = b''.join(self._content)
        self._content, self.chunk_size = [], 0
        data = self._compressor.compress(content)
        first = min(min(entries[::2]) for entries in places.values())
        last = max(max(entries[::2]) for entries in places.values())
        if not self._chunks:
            self.first_ns = first
        self.first_ns, self.last_ns = min(self.first_ns, first), max(self.last_ns, last)
        begin = self._at
        head = _CHUNK_HEAD.pack(
            Opcode.CHUNK, _CHUNK_HEAD.size - wire.RECORD_HEAD + len(data), first, last,
            len(content), zlib.crc32(content), 4, b'zstd', len(data),
        )  # fmt: skip
        self._write(head + data)
        length = self._at - begin
        offsets = {}
        for channel, entries in places.items():
            offsets[channel] = self._at
            size = 8 * len(entries)
            index = _INDEX_HEAD.pack(Opcode.MESSAGE_INDEX, 6 + size, channel, size)
            self._write(index + struct.pack(f'<{len(entries)}Q', *entries))
            self.counts[channel] += len(entries) // 2
        self._chunks.append(
            ChunkIndex(
                message_start_time=first, message_end_time=last, chunk_start_offset=begin,
                chunk_length=length, message_index_offsets=offsets,
                message_index_length=self._at - begin - length, compression='zstd',
                compressed_size=len(data), uncompressed_size=len(content),
            )
        )  # fmt: skip

    # ---- end -------------------------------------------------------------------------------

    def finish(self) -> None:
        """Close the last chunk; write summary and footer."""
        self.close_chunk()
        self._write_record(DataEnd(self._crc))
        start, builder, offsets = self._at, RecordBuilder(), []
        groups: list[tuple[int, list[Any]]] = [
            (Opcode.SCHEMA, self._schemas), (Opcode.CHANNEL, self._channels),
            (Opcode.STATISTICS, [self._statistics()]), (Opcode.CHUNK_INDEX, self._chunks),
            (Opcode.ATTACHMENT_INDEX, self._attachments),
            (Opcode.METADATA_INDEX, self._metadata),
        ]  # fmt: skip
        for opcode, records in groups:
            begin = builder.count
            for record in records:
                record.write(builder)
            if records:
                offsets.append(SummaryOffset(opcode, start + begin, builder.count - begin))
        offset_start = start + builder.count
        for offset in offsets:
            offset.write(builder)
        summary = builder.end()
        foot = struct.pack('<BQQQ', Opcode.FOOTER, 20, start, offset_start)
        self._write(summary)
        self._write_record(Footer(start, offset_start, zlib.crc32(summary + foot)))
        self._write(_MAGIC)

    def _statistics(self) -> Statistics:
        return Statistics(
            attachment_count=len(self._attachments),
            channel_count=len(self._channels),
            channel_message_counts={n: count for n, count in self.counts.items() if count},
            chunk_count=len(self._chunks),
            message_count=sum(self.counts.values()),
            metadata_count=len(self._metadata),
            message_start_time=self.first_ns,
            message_end_time=self.last_ns,
            schema_count=len(self._schemas),
        )
