# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""ROS 2 bags and MCAP files of any software: messages flattened to columns, by rosbags."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from fluid_sim_ros.errors import FluidSimError, needed_for, printable
from fluid_sim_ros.flights.flight import FlightError, RawLog, Stream
from fluid_sim_ros.flights.own_log import run_of, with_schedule
from fluid_sim_ros.schema.data_file import open_data
from fluid_sim_ros.schema.limits import check_limit

#: Longer arrays (covariances, images) are left out.
_LONGEST = 32
_MOST_COLUMNS = 400
#: Messages of these types hold nothing of a flight.
_SKIPPED = ('MarkerArray', 'Image', 'CompressedImage', 'PointCloud2', 'String', 'DiagnosticArray')
#: First bytes of an MCAP file; how much of both its ends is looked at [bytes], for what a log of
#: ours has there.
_MAGIC, _LOOK = b'\x89MCAP0\r\n', 1 << 16
_OURS = (b'fluid_sim_ros ', b'fluid_sim/run.json')
#: (topic, type, time of the log [ns], message)
_Message = tuple[str, str, int, Any]


def read_bag(path: Path) -> RawLog:
    """
    Read an MCAP file, or the folder of a bag.

    Parameters
    ----------
    path
        Of the file or the folder.

    Returns
    -------
    RawLog
        One stream per topic; its columns are the fields, such as ``pose.pose.position.x``,
        ``data[0]`` or ``velocity[m1]`` (of a JointState). Time: of the header where it has one,
        else of the log. ``about`` holds the type of each topic as ``type of TOPIC``.

    Raises
    ------
    FlightError
        If rosbags finds no bag in it.

    """
    with needed_for('a ROS bag'):
        import mcap.reader  # noqa: F401
        import rosbags.highlevel  # noqa: F401  one line where either is missing

    files = sorted(path.glob('*.mcap')) if path.is_dir() else [path]
    bag = path if path.is_dir() else path.parent
    rows: dict[str, list[tuple[float, ...]]] = {}
    names: dict[str, list[str]] = {}
    types: dict[str, str] = {}
    faults: list[str] = []
    count = 0
    in_mcap = bool(files) and files[0].suffix == '.mcap'
    run = run_of(files[0]) if in_mcap else None
    try:
        messages = _mcap(files) if in_mcap else _any(bag)
        for topic, kind, log_ns, message in messages:
            count += 1
            check_limit('flight_messages', count, f'{path}: messages')
            found = dict(_numbers(message, ''))
            if topic not in names:
                types[topic] = kind
                names[topic] = list(found)[:_MOST_COLUMNS]
                rows[topic] = []
            stamp = found.get('header.stamp.sec', 0) + 1e-9 * found.get('header.stamp.nanosec', 0)
            # a simulation begins at 0: a header without a stamp is one that nobody set
            has_stamp = 'header.stamp.sec' in found and (stamp > 0 or log_ns < 1_000_000)
            # a command of ours acts from when it was taken, not from the state that it answers
            taken = run is not None and '/cmd/' in topic
            time = stamp if has_stamp and not taken else log_ns * 1e-9
            rows[topic].append((time, *(found.get(name, np.nan) for name in names[topic])))
    except FluidSimError:
        raise
    except Exception as error:  # noqa: BLE001  what decompresses a damaged chunk raises anything
        reason = printable(' '.join(str(error).split()) or type(error).__name__)
        if not count:
            hint = '' if in_mcap or path.is_dir() else (
                '; a .db3 is read with the metadata.yaml beside it: give the folder of the bag'
            )  # fmt: skip
            raise FlightError(f'{path}: no bag that rosbags reads ({reason}){hint}') from None
        mend = '; fluid_sim repair makes a log of ours whole' if in_mcap else ''
        faults.append(f'damaged: {reason}; what is before is read{mend}')
    streams = {}
    for topic, numbers in rows.items():
        table = np.array(numbers, dtype=np.float64)
        columns = {name: table[:, 1 + i] for i, name in enumerate(names[topic])}
        streams[topic] = Stream(table[:, 0], columns)
    about = {f'type of {topic}': kind for topic, kind in types.items()}
    if run is None:
        return RawLog(path, 'ROS bag', 'ros', streams, about, tuple(faults))
    streams, unrepeated = with_schedule(streams, run)
    faults += unrepeated
    return RawLog(path, 'log of fluid_sim', 'fluid_sim', streams, about, tuple(faults))


def of_others(file: Path) -> bool:
    """
    Return whether an MCAP file is of other software, as far as a damaged one tells.

    Parameters
    ----------
    file
        Of the log.

    """
    with open_data(file) as stream:
        head = stream.read(_LOOK)
        stream.seek(max(0, file.stat().st_size - _LOOK))
        ends = head + stream.read(_LOOK)
    # who wrote it stands at its begin, what is attached at its end
    return head.startswith(_MAGIC) and not any(mark in ends for mark in _OURS)


def _mcap(files: list[Path]) -> Iterator[_Message]:
    from mcap.reader import McapReader, NonSeekingReader, make_reader
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    for file in files:
        store = get_typestore(Stores.EMPTY)
        with open_data(file) as stream:
            reader: McapReader = make_reader(stream)
            whole = True
            try:
                reader.get_summary()
            except Exception:  # noqa: BLE001  cut off: what is before, in the order of the file
                stream.seek(0)
                reader, whole = NonSeekingReader(stream), False
            for schema, channel, message in reader.iter_messages(log_time_order=whole):
                if schema is None or channel.message_encoding != 'cdr':
                    continue
                if schema.name.rpartition('/')[2] in _SKIPPED:
                    continue
                if schema.name not in store.types:
                    new = get_types_from_msg(schema.data.decode(), schema.name)
                    store.register({k: v for k, v in new.items() if k not in store.types})
                content = store.deserialize_cdr(message.data, schema.name)
                yield channel.topic, schema.name, message.log_time, content


def _any(folder: Path) -> Iterator[_Message]:
    from rosbags.highlevel import AnyReader
    from rosbags.typesys import Stores, get_typestore

    with AnyReader([folder], default_typestore=get_typestore(Stores.ROS2_JAZZY)) as reader:
        taken = [c for c in reader.connections if c.msgtype.rpartition('/')[2] not in _SKIPPED]
        for connection, log_ns, data in reader.messages(taken):
            content = reader.deserialize(data, connection.msgtype)
            yield connection.topic, connection.msgtype, log_ns, content


def _numbers(value: Any, name: str) -> Iterator[tuple[str, float]]:
    """Yield the numbers of a message with their names."""
    if isinstance(value, bool | int | float | np.number):
        yield name, float(value)
    elif isinstance(value, np.ndarray | list):
        if len(value) <= _LONGEST:
            for i, each in enumerate(value):
                yield from _numbers(each, f'{name}[{i}]')
    elif hasattr(value, '__dataclass_fields__'):
        joints = list(getattr(value, 'name', ())) if hasattr(value, 'effort') else []
        for key in value.__dataclass_fields__:
            member = getattr(value, key)
            if key in ('name', '__msgtype__'):
                continue
            if joints and isinstance(member, np.ndarray | list) and len(member) == len(joints):
                for joint, number in zip(joints, member, strict=True):
                    yield f'{key}[{joint}]', float(number)
            else:
                yield from _numbers(member, f'{name}.{key}' if name else key)
