"""
What goes through the pipe from the recorder to its writer process.

A frame is a kind, a length and that many bytes. Messages are packed one behind the other, so that
a tick costs the simulation little more than copying its bytes.
"""

import struct
from collections.abc import Iterator
from typing import NamedTuple

#: Begin a file (JSON), messages, end of the file.
START, MESSAGES, END = b'S', b'M', b'E'
FRAME = struct.Struct('<cI')
#: Channel, step, log time [ns], publish time [ns], size of the data [bytes].
MESSAGE = struct.Struct('<HIQQI')


class Packed(NamedTuple):
    """One message as the writer gets it."""

    channel: int
    step: int
    log_ns: int
    publish_ns: int
    data: bytes


def unpack(payload: bytes | memoryview) -> Iterator[Packed]:
    """Return the messages of a frame, one after another."""
    at, end = 0, len(payload)
    while at < end:
        channel, step, log_ns, publish_ns, size = MESSAGE.unpack_from(payload, at)
        at += MESSAGE.size
        yield Packed(channel, step, log_ns, publish_ns, bytes(payload[at : at + size]))
        at += size
