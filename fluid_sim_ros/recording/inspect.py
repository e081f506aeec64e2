# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What is in a log, whether it is sound, and a clean copy of one that is not."""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, BinaryIO

from mcap.writer import CompressionType, Writer

from fluid_sim_ros.errors import MachineError, of_machine, printable
from fluid_sim_ros.interruption import owns
from fluid_sim_ros.output.progress import Report, silent
from fluid_sim_ros.recording.damage import LogError
from fluid_sim_ros.recording.log import Log
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.recording.writing import rosbag2
from fluid_sim_ros.recording.writing.writer import CHUNK_SIZE


@dataclass
class Count:
    """Messages of one topic, with their first and last simulated time [ns]."""

    messages: int = 0
    bytes: int = 0
    first_ns: int = 0
    last_ns: int = 0


@dataclass
class Contents:
    """Messages per topic, and of the whole log."""

    topics: dict[str, Count] = field(default_factory=dict)
    total: Count = field(default_factory=Count)


def count(log: Log) -> Contents:
    """
    Go through a log once and count.

    Parameters
    ----------
    log
        The log.

    Returns
    -------
    Contents
        The counts.

    """
    contents = Contents({topic.name: Count() for topic in log.topics.values()})
    total = contents.total
    for message in log.messages(lost=log.faults):
        for entry in (contents.topics[message.topic], total):
            if not entry.messages:
                entry.first_ns = entry.last_ns = message.log_ns
            entry.first_ns = min(entry.first_ns, message.log_ns)
            entry.last_ns = max(entry.last_ns, message.log_ns)
            entry.messages += 1
            entry.bytes += len(message.data)
    return contents


def info(path: str | Path, report: Report = silent) -> dict[str, Any]:
    """
    Return what ``fluid_sim info`` shows.

    Parameters
    ----------
    path
        Log file, or the folder of one.
    report
        Is told how far it is.

    Returns
    -------
    dict
        Size, faults, topics with their rates [Hz], and the run (None, with ``run_fault``, where
        the log has none).

    Raises
    ------
    LogError
        If it is no log at all.

    """
    log = open_log(path, report)
    contents = count(log)
    total = contents.total
    result: dict[str, Any] = {
        'path': str(log.path),
        'bytes': log.size,
        'complete': log.complete,
        'faults': log.faults,
        'written_by': log.library,
        'messages': total.messages,
        'begin_s': total.first_ns / 1e9,
        'end_s': total.last_ns / 1e9,
        'topics': {
            topic.name: {
                'type': topic.type,
                'messages': contents.topics[topic.name].messages,
                'rate_hz': _rate(contents.topics[topic.name]),
            }
            for topic in log.topics.values()
        },
    }
    try:
        run = log.description().run
    except LogError as error:
        return result | {'run': None, 'run_fault': str(error)}
    named = ('seed', 'timestep', 'integrator', 'fluid', 'namespace', 'versions')
    return result | {'run': {'scene': run['scene']['name'], **{k: run[k] for k in named}}}


def about(log: Log) -> list[tuple[str, str]]:
    """
    Return what a reader of pictures must know of a log, as (key, text).

    Parameters
    ----------
    log
        The log.

    Returns
    -------
    list
        (key, text) rows.

    """
    rows = [('log', log.path.name)]
    try:
        run = log.description().run
    except LogError as error:
        rows.append(('run', str(error)))
    else:
        versions = run['versions']
        rows += [
            ('scene', printable(run['scene']['name'])),
            ('seed', str(run['seed'])),
            ('timestep', f'{run["timestep"]:g} s, {printable(run["integrator"])}'),
            (
                'recorded by',
                f'fluid_sim_ros {versions["fluid_sim_ros"]}, MuJoCo {versions["mujoco"]}',
            ),
        ]
    return rows + [('damaged', fault) for fault in log.faults]


def _rate(entry: Count) -> float | None:
    seconds = (entry.last_ns - entry.first_ns) / 1e9
    return round((entry.messages - 1) / seconds, 3) if seconds > 0 else None


@contextmanager
def _made(target: Path) -> Iterator[BinaryIO]:
    """Make a new file; where the block fails, nothing is left of it and of folders made for it."""
    owns()
    new = [each for each in target.parents if not each.exists()]
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        stream = target.open('xb')
    except OSError as error:
        raise LogError(f'{target}: {error.strerror}') from None
    try:
        with stream:
            yield stream
    except BaseException as error:
        target.unlink(missing_ok=True)
        for folder in new:  # the innermost first
            shutil.rmtree(folder, ignore_errors=True)
        if isinstance(error, OSError) and of_machine(error):
            raise MachineError(f'{target}: cannot be written ({error.strerror})') from None
        raise


def repair(
    path: str | Path, out: Path, chunk_size: int = CHUNK_SIZE, report: Report = silent
) -> dict[str, Any]:
    """
    Write all that is sound in a log to a new file.

    ``out`` without ``.mcap`` becomes a folder that rosbag2 takes.

    Parameters
    ----------
    path
        Log file, or the folder of one.
    out
        ``.mcap`` file, or a folder that becomes a bag for rosbag2.
    chunk_size
        Size at which a chunk is closed [bytes].
    report
        Is told how far it is.

    Returns
    -------
    dict
        ``path``, ``bytes`` and ``messages`` of the new file, and ``lost``: a line per fault.

    Raises
    ------
    LogError
        If there is nothing to read, or ``out`` exists already.
    MachineError
        If it cannot be written; nothing is left of it then.

    """
    log = open_log(path, report)
    target = out if out.suffix == '.mcap' else out / f'{out.name}_0.mcap'
    with _made(target) as stream:
        writer = Writer(
            stream, chunk_size, CompressionType.ZSTD, enable_crcs=True, enable_data_crcs=True
        )
        writer.start(profile='ros2', library=log.library)
        for name, data in log.attachments.items():
            kind = 'application/json' if name.endswith('.json') else 'application/octet-stream'
            writer.add_attachment(0, 0, name, kind, data)
        ids: dict[str, int] = {}
        schemas: dict[tuple[str, str], int] = {}
        for topic in log.topics.values():
            key = (topic.type, topic.definition)
            if key not in schemas:
                text = topic.definition.encode()
                schemas[key] = writer.register_schema(topic.type, 'ros2msg', text)
            schema = schemas[key]
            ids[topic.name] = writer.register_channel(topic.name, 'cdr', schema, topic.metadata)
        contents = Contents({name: Count() for name in ids})
        for message in log.messages(lost=log.faults):
            writer.add_message(
                ids[message.topic], message.log_ns, message.data, message.publish_ns, message.step
            )
            contents.topics[message.topic].messages += 1
            if not contents.total.messages:
                contents.total.first_ns = message.log_ns
            contents.total.messages += 1
            contents.total.last_ns = message.log_ns
        writer.finish()
        stream.flush()
        if out != target:
            topics = list(log.topics.values())
            rosbag2.write_metadata(
                target,
                [{'topic': t.name, 'type': t.type, 'metadata': t.metadata} for t in topics],
                [contents.topics[t.name].messages for t in topics],
                contents.total.first_ns,
                contents.total.last_ns,
            )
    return {
        'path': str(target), 'bytes': target.stat().st_size,
        'messages': contents.total.messages, 'lost': log.faults,
    }  # fmt: skip
