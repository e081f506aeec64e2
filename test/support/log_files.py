# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Logs whose content is ours to choose: every record as stated, every checksum right."""

import json
import struct
import zlib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import zstandard

from fluid_sim_ros.recording.description import MODEL, RUN
from fluid_sim_ros.recording.log import Log
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.recording.records import MAGIC

HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK = 1, 2, 3, 4, 5, 6
ATTACHMENT, DATA_END = 9, 15


def record(kind: int, content: bytes) -> bytes:
    """Return a record with its head."""
    return struct.pack('<BQ', kind, len(content)) + content


def text(value: str | bytes) -> bytes:
    """Return a text behind its length."""
    data = value.encode() if isinstance(value, str) else value
    return struct.pack('<I', len(data)) + data


def schema(number: int, name: str, definition: str | bytes, encoding: str = 'ros2msg') -> bytes:
    """Return a schema record."""
    content = struct.pack('<H', number) + text(name) + text(encoding) + text(definition)
    return record(SCHEMA, content)


def channel(
    number: int, of: int, topic: str | bytes, metadata: Mapping[str, str] | None = None
) -> bytes:
    """Return a channel record."""
    pairs = b''.join(text(key) + text(value) for key, value in (metadata or {}).items())
    return record(
        CHANNEL, struct.pack('<HH', number, of) + text(topic) + text('cdr') + text(pairs)
    )


def message(number: int, step: int, log_ns: int, data: bytes, publish_ns: int = 0) -> bytes:
    """Return a message record."""
    return record(MESSAGE, struct.pack('<HIQQ', number, step, log_ns, publish_ns) + data)


def attachment(name: str | bytes, data: bytes) -> bytes:
    """Return an attachment record."""
    content = bytes(16) + text(name) + text('application/octet-stream')
    content += struct.pack('<Q', len(data)) + data
    return record(ATTACHMENT, content + struct.pack('<I', zlib.crc32(content)))


def chunk(content: bytes, compression: str = 'zstd') -> bytes:
    """Return a chunk record."""
    data = zstandard.ZstdCompressor(level=1).compress(content) if compression else content
    head = bytes(16) + struct.pack('<QI', len(content), zlib.crc32(content))
    return record(CHUNK, head + text(compression) + struct.pack('<Q', len(data)) + data)


def log_of(records: Iterable[bytes], summary: bytes = b'') -> bytes:
    """Return a log of records with right checksums; its summary is that of the caller."""
    data = MAGIC + record(HEADER, text('ros2') + text('test')) + b''.join(records)
    data += record(DATA_END, struct.pack('<I', zlib.crc32(data)))
    start = len(data)
    foot = struct.pack('<BQQQ', FOOTER, 20, start, 0)
    return data + summary + foot + struct.pack('<I', zlib.crc32(summary + foot)) + MAGIC


def records_of(log: Log) -> tuple[dict[str, bytes], list[bytes], list[bytes]]:
    """Return a log's attachments, its schemas and channels, and its messages, as records."""
    numbers: dict[str, int] = {}
    heads, channels = [], {}
    for number, topic in log.topics.items():
        if topic.type not in numbers:
            numbers[topic.type] = len(numbers) + 1
            heads.append(schema(numbers[topic.type], topic.type, topic.definition))
        channels[topic.name] = number
        heads.append(channel(number, numbers[topic.type], topic.name, topic.metadata))
    messages = [
        message(channels[m.topic], m.step, m.log_ns, m.data, m.publish_ns) for m in log.messages()
    ]
    return dict(log.attachments), heads, messages


def rewritten(
    source: Path,
    target: Path,
    *,
    run: Mapping[str, Any] | None = None,
    scene: Mapping[str, Any] | None = None,
    files: Mapping[str, bytes] | None = None,
    attachments: Mapping[str, bytes | None] | None = None,
    messages: Iterable[bytes] | None = None,
) -> Path:
    """
    Write a log that says something else than another one; every checksum is right.

    Parameters
    ----------
    source, target
        The other one, and where to.
    run, scene
        Keys of ``run.json``, and of the scene in it, to put in; None takes one away.
    files
        The model's files, in place of those of the log.
    attachments
        Attachments to put in; None takes one away.
    messages
        Message records, in place of those of the log.

    """
    found, heads, recorded = records_of(open_log(source))
    if run is not None or scene is not None:
        stated = json.loads(found[RUN])
        for part, changes in ((stated, run), (stated['scene'], scene)):
            for key, value in (changes or {}).items():
                part[key] = value
        found[RUN] = json.dumps(stated).encode()
    if files is not None:
        found = {name: data for name, data in found.items() if not name.startswith(MODEL)}
        found |= {MODEL + name: data for name, data in files.items()}
    for name, data in (attachments or {}).items():
        found.pop(name, None)
        if data is not None:
            found[name] = data
    recorded = list(messages) if messages is not None else recorded
    content = b''.join([*heads, *recorded])
    target.write_bytes(
        log_of([*(attachment(name, data) for name, data in found.items()), chunk(content)])
    )
    return target
