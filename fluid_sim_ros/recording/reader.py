"""
Reads MCAP logs, whole or damaged: every value comes from a part whose checksum is right.

The format is https://mcap.dev/spec (version 0). Messages stand in compressed chunks, each with a
checksum; what is before a damaged or missing part is read, and so is what comes after it where
the index at the file's end (or the length of the damaged part) says where to go on.
"""

import struct
import zlib
from pathlib import Path

from fluid_sim_ros.recording.description import LogError
from fluid_sim_ros.recording.log import Log, LogTopic
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
    BadRecordError,
    Fields,
    decompress,
    read_attachment,
    read_chunk_head,
    records,
)


def open_log(path: str | Path) -> Log:
    """
    Open a log file, or the one log in a folder, and check every checksum in it.

    Parameters
    ----------
    path
        Log file, or a folder with one.

    Returns
    -------
    Log
        What is in it.

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
        self._schemas: dict[int, tuple[str, str]] = {}  # type and definition

    def run(self) -> None:
        content = self._content
        at, end = len(MAGIC), len(content)
        ended = False
        while at < end and not ended:
            if end - at < RECORD.size:
                break
            kind, size = RECORD.unpack_from(content, at)
            after = at + RECORD.size + size
            if after > end:
                break
            ended = kind == DATA_END
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
        begin, content = at + RECORD.size, self._content
        try:
            if kind == HEADER:
                fields = Fields(content[begin:after])
                fields.string()
                self._log.library = fields.string()
            elif kind == CHUNK:
                self._take_chunk(at, begin, after)
            elif kind == ATTACHMENT:
                name, data = read_attachment(content[begin:after])
                self._log.attachments[name] = data
            elif kind == DATA_END:
                stated = struct.unpack_from('<I', content, begin)[0] if after - begin == 4 else 0
                if stated != zlib.crc32(memoryview(content)[:at]):
                    self._fault('the checksum of the data section is wrong: something is damaged')
            elif kind not in OTHERS:
                self._fault(f'unknown record of kind {kind} at byte {at}')
        except BadRecordError as error:
            self._fault(f'{_KINDS.get(kind, "record")} at byte {at}: {error}')

    def _take_chunk(self, at: int, begin: int, after: int) -> None:
        chunk = read_chunk_head(self._content, begin, after)
        data = self._content[chunk.offset : chunk.offset + chunk.size]
        content = decompress(chunk, data)
        for kind, first, last in records(content):
            if kind == SCHEMA:
                self._take_schema(content[first:last])
            elif kind == CHANNEL:
                self._take_channel(content[first:last])
            else:  # they stand before the messages
                break
        self._log.chunks.append(chunk)
        self._seen.add(at)

    def _take_schema(self, record: bytes) -> None:
        fields = Fields(record)
        number = fields.uint16()
        name = fields.string()
        fields.string()
        self._schemas[number] = (name, fields.block().decode())

    def _take_channel(self, record: bytes) -> None:
        fields = Fields(record)
        number, schema = fields.uint16(), fields.uint16()
        topic = fields.string()
        fields.string()
        pairs = Fields(fields.block())
        metadata = {}
        while pairs.left:
            key = pairs.string()
            metadata[key] = pairs.string()
        kind, text = self._schemas.get(schema, ('', ''))
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
        foot = size - len(MAGIC) - FOOTER_SIZE
        if foot < len(MAGIC) or content[size - len(MAGIC) :] != MAGIC:
            return False
        kind, length = RECORD.unpack_from(content, foot)
        if (kind, length) != (FOOTER, 20):
            return False
        start, _, crc = struct.unpack_from('<QQI', content, foot + RECORD.size)
        if not len(MAGIC) <= start <= foot or zlib.crc32(content[start : size - 12]) != crc:
            return False
        lost = []
        for kind, first, last in records(content[start:foot]):
            record = content[start + first : start + last]
            if kind == SCHEMA:
                self._take_schema(record)
            elif kind == CHANNEL:
                self._take_channel(record)
            elif kind == CHUNK_INDEX:
                offset, length = struct.unpack_from('<QQ', record, 16)
                if offset not in self._seen:
                    lost.append((offset, offset + length))
        for at, after in lost:
            self._rescue(at, after)
        self._log.chunks.sort(key=lambda chunk: chunk.offset)
        return True

    def _rescue(self, at: int, after: int) -> None:
        """Read a chunk that the index names and the scan did not reach."""
        try:
            self._take_chunk(at, at + RECORD.size, after)
        except BadRecordError as error:
            line = f'chunk at byte {at}: {error}'
            if line not in self._log.faults:
                self._fault(line)


_KINDS = {HEADER: 'header', CHUNK: 'chunk', ATTACHMENT: 'attachment', DATA_END: 'data end'}
