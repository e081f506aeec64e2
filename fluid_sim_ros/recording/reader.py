"""
Reads MCAP logs, whole or damaged: every value comes from a part whose checksum is right.

The format is https://mcap.dev/spec (version 0). Messages stand in compressed chunks, each with a
checksum; what is before a damaged or missing part is read, and so is what comes after it where
the index at the file's end (or the length of the damaged part) says where to go on.
"""

import struct
import zlib
from collections.abc import Collection, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import zstandard

from fluid_sim_ros.errors import listed
from fluid_sim_ros.recording.description import LogError, RunDescription

MAGIC = b'\x89MCAP0\r\n'
_HEADER, _FOOTER, _SCHEMA, _CHANNEL, _MESSAGE, _CHUNK = 1, 2, 3, 4, 5, 6
_CHUNK_INDEX, _ATTACHMENT, _DATA_END = 8, 9, 15
#: Records that hold nothing we need: message index, attachment index, statistics, metadata,
#: metadata index, summary offset.
_OTHERS = (7, 10, 11, 12, 13, 14)
_RECORD = struct.Struct('<BQ')
_MESSAGE_HEAD = struct.Struct('<HIQQ')
_FOOTER_SIZE = _RECORD.size + 20
#: A chunk that claims to be larger is damaged; ours are closed at 1 MiB [bytes].
_LARGEST_CHUNK = 1 << 28


class LogMessage(NamedTuple):
    """One message: topic, step, simulated time [ns], wall time [ns], CDR bytes."""

    topic: str
    step: int
    log_ns: int
    publish_ns: int
    data: bytes


@dataclass(frozen=True)
class LogTopic:
    """A topic of a log."""

    name: str
    type: str
    definition: str
    metadata: dict[str, str]


@dataclass
class _Chunk:
    """Where a chunk's compressed data stands."""

    offset: int
    size: int
    compression: bytes
    uncompressed_size: int
    crc: int


class _BadRecordError(Exception):
    """A record does not hold what its kind must hold."""


@dataclass
class Log:
    """
    An opened log.

    Attributes
    ----------
    path, size
        The file and its size [bytes].
    faults
        One line for each part that is damaged or missing; empty for a sound file.
    complete
        Whether the file was ended properly.
    topics
        By channel id.
    attachments
        By name.

    """

    path: Path
    size: int = 0
    faults: list[str] = field(default_factory=list)
    complete: bool = False
    library: str = ''
    topics: dict[int, LogTopic] = field(default_factory=dict)
    attachments: dict[str, bytes] = field(default_factory=dict)
    _schemas: dict[int, tuple[str, str]] = field(default_factory=dict)
    _chunks: list[_Chunk] = field(default_factory=list)

    def messages(self, topics: Collection[str] | None = None) -> Iterator[LogMessage]:
        """Return every message of some topics (default: all) in the order of the file."""
        wanted = {
            number: topic.name
            for number, topic in self.topics.items()
            if topics is None or topic.name in topics
        }
        with self.path.open('rb') as stream:
            for chunk in self._chunks:
                stream.seek(chunk.offset)
                content = _decompress(chunk, stream.read(chunk.size))
                for kind, begin, end in _records(content):
                    if kind != _MESSAGE:
                        continue
                    channel, step, log_ns, wall_ns = _MESSAGE_HEAD.unpack_from(content, begin)
                    name = wanted.get(channel)
                    if name is not None:
                        data = content[begin + _MESSAGE_HEAD.size : end]
                        yield LogMessage(name, step, log_ns, wall_ns, data)

    def topic(self, name: str) -> LogTopic:
        """
        Return a topic by name.

        Raises
        ------
        LogError
            With the names that exist.

        """
        for topic in self.topics.values():
            if topic.name == name:
                return topic
        names = listed(sorted(t.name for t in self.topics.values()))
        raise LogError(f"{self.path}: no topic '{name}'; it has: {names}")

    def description(self) -> RunDescription:
        """Return the run's description, or raise LogError."""
        try:
            return RunDescription.of_attachments(self.attachments)
        except LogError as error:
            raise LogError(f'{self.path}: {error}') from None


def open_log(path: str | Path) -> Log:
    """
    Open a log file, or the one log in a folder, and check every checksum in it.

    Raises
    ------
    LogError
        If there is no such file or it is no MCAP file; damage is no error, see ``Log.faults``.

    """
    path = Path(path)
    if path.is_dir():
        inside = sorted(path.glob('*.mcap'))
        if len(inside) != 1:
            raise LogError(f'{path}: holds {len(inside)} .mcap files, needs one')
        path = inside[0]
    try:
        content = path.read_bytes() if path.stat().st_size < _SMALL else _mapped(path)
    except OSError as error:
        raise LogError(f'{path}: {error.strerror}') from None
    if not len(content):
        raise LogError(f'{path}: the file is empty')
    if content[: len(MAGIC)] != MAGIC[: len(content)] or len(content) < len(MAGIC):
        raise LogError(f'{path}: not an MCAP file')
    log = Log(path, len(content))
    _Scan(log, content).run()
    return log


#: Files below this are read at once, larger ones are mapped [bytes].
_SMALL = 1 << 26


def _mapped(path: Path) -> bytes:
    import mmap

    with path.open('rb') as stream:
        # supports all that is done with it below: length, slices, struct.unpack_from
        return mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ)  # type: ignore[return-value]


class _Scan:
    """Goes through a file once: finds chunks, attachments and faults."""

    def __init__(self, log: Log, content: bytes) -> None:
        self._log = log
        self._content = content
        self._seen: set[int] = set()

    def run(self) -> None:
        content = self._content
        at, end = len(MAGIC), len(content)
        ended = False
        while at < end and not ended:
            if end - at < _RECORD.size:
                break
            kind, size = _RECORD.unpack_from(content, at)
            after = at + _RECORD.size + size
            if after > end:
                break
            ended = kind == _DATA_END
            self._take(kind, at, after)
            at = after
        if ended:
            self._check_end(at)
        else:
            self._fault(
                f'the file ends (or is damaged) at byte {at} of {end}: what followed there, and '
                'the index, are missing'
            )
            self._read_index()

    def _fault(self, line: str) -> None:
        self._log.faults.append(line)

    def _take(self, kind: int, at: int, after: int) -> None:
        begin, content = at + _RECORD.size, self._content
        try:
            if kind == _HEADER:
                fields = _Fields(content[begin:after])
                fields.string()
                self._log.library = fields.string()
            elif kind == _CHUNK:
                self._take_chunk(at, begin, after)
            elif kind == _ATTACHMENT:
                name, data = _attachment(content[begin:after])
                self._log.attachments[name] = data
            elif kind == _DATA_END:
                stated = struct.unpack_from('<I', content, begin)[0] if after - begin == 4 else 0
                if stated != zlib.crc32(memoryview(content)[:at]):
                    self._fault('the checksum of the data section is wrong: something is damaged')
            elif kind not in _OTHERS:
                self._fault(f'unknown record of kind {kind} at byte {at}')
        except _BadRecordError as error:
            self._fault(f'{_KINDS.get(kind, "record")} at byte {at}: {error}')

    def _take_chunk(self, at: int, begin: int, after: int) -> None:
        chunk = _chunk(self._content, begin, after)
        data = self._content[chunk.offset : chunk.offset + chunk.size]
        content = _decompress(chunk, data)
        for kind, first, last in _records(content):
            if kind == _SCHEMA:
                self._take_schema(content[first:last])
            elif kind == _CHANNEL:
                self._take_channel(content[first:last])
            else:  # they stand before the messages
                break
        self._log._chunks.append(chunk)
        self._seen.add(at)

    def _take_schema(self, record: bytes) -> None:
        fields = _Fields(record)
        number = fields.uint16()
        name = fields.string()
        fields.string()
        self._log._schemas[number] = (name, fields.block().decode())

    def _take_channel(self, record: bytes) -> None:
        fields = _Fields(record)
        number, schema = fields.uint16(), fields.uint16()
        topic = fields.string()
        fields.string()
        pairs = _Fields(fields.block())
        metadata = {}
        while pairs.left:
            key = pairs.string()
            metadata[key] = pairs.string()
        kind, text = self._log._schemas.get(schema, ('', ''))
        self._log.topics[number] = LogTopic(topic, kind, text, metadata)

    def _check_end(self, at: int) -> None:
        """Check the summary, and read what only it still knows."""
        if self._read_index():
            self._log.complete = True
        elif at:
            self._fault('the index at the end of the file is missing or damaged')

    def _read_index(self) -> bool:
        """Use the summary if its checksum is right: channels, and chunks that were not seen."""
        content, size = self._content, self._log.size
        foot = size - len(MAGIC) - _FOOTER_SIZE
        if foot < len(MAGIC) or content[size - len(MAGIC) :] != MAGIC:
            return False
        kind, length = _RECORD.unpack_from(content, foot)
        if (kind, length) != (_FOOTER, 20):
            return False
        start, _, crc = struct.unpack_from('<QQI', content, foot + _RECORD.size)
        if not len(MAGIC) <= start <= foot or zlib.crc32(content[start : size - 12]) != crc:
            return False
        lost = []
        for kind, first, last in _records(content[start:foot]):
            record = content[start + first : start + last]
            if kind == _SCHEMA:
                self._take_schema(record)
            elif kind == _CHANNEL:
                self._take_channel(record)
            elif kind == _CHUNK_INDEX:
                offset, length = struct.unpack_from('<QQ', record, 16)
                if offset not in self._seen:
                    lost.append((offset, offset + length))
        for at, after in lost:
            self._rescue(at, after)
        self._log._chunks.sort(key=lambda chunk: chunk.offset)
        return True

    def _rescue(self, at: int, after: int) -> None:
        """Read a chunk that the index names and the scan did not reach."""
        try:
            self._take_chunk(at, at + _RECORD.size, after)
        except _BadRecordError as error:
            line = f'chunk at byte {at}: {error}'
            if line not in self._log.faults:
                self._fault(line)


_KINDS = {_HEADER: 'header', _CHUNK: 'chunk', _ATTACHMENT: 'attachment', _DATA_END: 'data end'}


class _Fields:
    """Reads the fields of a record within its bounds."""

    def __init__(self, data: bytes) -> None:
        self._data = data
        self._at = 0

    @property
    def left(self) -> int:
        return len(self._data) - self._at

    def take(self, size: int) -> bytes:
        if size > self.left:
            raise _BadRecordError('its fields are longer than the record')
        self._at += size
        return self._data[self._at - size : self._at]

    def uint16(self) -> int:
        return int.from_bytes(self.take(2), 'little')

    def block(self, width: int = 4) -> bytes:
        return self.take(int.from_bytes(self.take(width), 'little'))

    def string(self) -> str:
        try:
            return self.block().decode()
        except UnicodeDecodeError:
            raise _BadRecordError('a string is not UTF-8') from None


def _attachment(record: bytes) -> tuple[str, bytes]:
    fields = _Fields(record)
    fields.take(16)
    name = fields.string()
    fields.string()
    data = fields.block(8)
    if zlib.crc32(record[: len(record) - fields.left]) != int.from_bytes(fields.take(4), 'little'):
        raise _BadRecordError('its checksum is wrong')
    return name, data


def _chunk(content: bytes, begin: int, after: int) -> _Chunk:
    fields = _Fields(content[begin : min(after, begin + 64)])
    fields.take(16)
    uncompressed_size = int.from_bytes(fields.take(8), 'little')
    crc = int.from_bytes(fields.take(4), 'little')
    compression = fields.block()
    size = int.from_bytes(fields.take(8), 'little')
    offset = begin + 16 + 8 + 4 + 4 + len(compression) + 8
    if offset + size > after:
        raise _BadRecordError('its data are longer than the record')
    return _Chunk(offset, size, compression, uncompressed_size, crc)


def _decompress(chunk: _Chunk, data: bytes) -> bytes:
    """Return a chunk's content, its checksum verified."""
    content = data
    if chunk.compression == b'zstd':
        try:
            stated = zstandard.frame_content_size(data)
            if stated != chunk.uncompressed_size or stated > _LARGEST_CHUNK:
                raise _BadRecordError('its sizes do not agree')
            content = zstandard.decompress(data)
        except zstandard.ZstdError:
            raise _BadRecordError('its data do not decompress') from None
    elif chunk.compression:
        raise _BadRecordError(f'compression {chunk.compression!r} is not known; allowed: zstd')
    if zlib.crc32(content) != chunk.crc:
        raise _BadRecordError('its checksum is wrong')
    return content


def _records(content: bytes) -> Iterator[tuple[int, int, int]]:
    """Return (kind, begin, end) of the records in a chunk or a summary."""
    at, end = 0, len(content)
    unpack, size = _RECORD.unpack_from, _RECORD.size
    while at + size <= end:
        kind, length = unpack(content, at)
        at += size
        yield kind, at, at + length
        at += length
