# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
What goes through the pipe from the recorder to its writer process.

A frame is a kind, a length and that many bytes. Messages are packed one behind the other as the
records that the file will hold, so that they cost both sides little more than copying.
"""

import struct

#: Begin a file (JSON), messages, end of the file.
START, MESSAGES, END = b'S', b'M', b'E'
FRAME = struct.Struct('<cI')
#: What stands before a message's data, as in the file: kind of record, length of what follows it,
#: channel, step, log time [ns], publish time [ns].
MESSAGE = struct.Struct('<BQHIQQ')
#: The part of it that an index needs: length, channel, log time.
PLACE = struct.Struct('<xQH4xQ')
#: Bytes of a record before those that its length counts.
RECORD_HEAD = 9
MESSAGE_KIND = 5
#: Bytes that the length counts before the data.
FIXED = MESSAGE.size - RECORD_HEAD


def head(topic: int, step: int, log_ns: int, publish_ns: int, size: int) -> bytes:
    """
    Return what stands before the data of a message.

    Parameters
    ----------
    topic
        Place of the topic; channels count from 1.
    step
        Step count of the simulation.
    log_ns, publish_ns
        Simulated and wall time [ns].
    size
        Of the data [bytes].

    Returns
    -------
    bytes
        The head.

    """
    return MESSAGE.pack(MESSAGE_KIND, FIXED + size, topic + 1, step, log_ns, publish_ns)
