# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A log's messages as tables: one CSV or Parquet file per topic."""

import csv
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from fluid_sim_ros.output.new_file import file_names, new_file
from fluid_sim_ros.recording.log import Log, LogTopic, Series
from fluid_sim_ros.sensors.reading import BULKY

#: Memory for the messages of topics that one pass over the file reads [bytes], and of a message
#: beside its own bytes: the object, its place, step and times.
_TOGETHER, _MESSAGE = 64 << 20, 80
#: A text cell that begins with one of these is calculated by spreadsheets.
_FORMULA = ('=', '+', '-', '@', '\t', '\r')


def export(log: Log, folder: Path, kind: str) -> list[str]:
    """
    Write every topic that has messages of numbers by name; return the files.

    Pictures and clouds of points are none: ``left_out`` names their topics.

    The first columns are ``step``, ``log_time_s`` (simulated) and ``publish_time_ns`` (wall).

    Parameters
    ----------
    log
        The log.
    folder
        Where the files go; topics give their names.
    kind
        ``csv`` (numbers in the fewest digits that give the same bits again) or ``parquet``.

    Returns
    -------
    list
        Paths of the files; no two topics share one.

    Raises
    ------
    LogError, ConfigError
        If messages do not fit their definition, or a file cannot be written.

    """
    files: list[str] = []
    topics = list(log.topics.values())
    stems = dict(zip([t.name for t in topics], file_names(t.name for t in topics), strict=True))
    wanted = {topic.name: topic for topic in topics if topic.type not in BULKY}
    sizes = _sizes(log, wanted)
    for together in _groups(sizes):
        found = log.series(together)
        for name in together:
            table = _table(log, wanted[name], found.pop(name))
            path = folder / f'{stems[name]}.{kind}'
            with new_file(path) as file:
                (_write_csv if kind == 'csv' else _write_parquet)(table, file)
            files.append(str(path))
            log.report('tables', len(files), len(sizes))
    return files


def left_out(log: Log) -> list[str]:
    """
    Return the topics that make no tables: pictures and clouds of points.

    Parameters
    ----------
    log
        The log.

    """
    return sorted(topic.name for topic in log.topics.values() if topic.type in BULKY)


def _sizes(log: Log, topics: Collection[str]) -> dict[str, int]:
    """Return the memory that the messages of each topic take [bytes]; topics without any, none."""
    sizes = dict.fromkeys(topics, 0)
    for message in log.messages(topics):
        sizes[message.topic] += _MESSAGE + len(message.data)
    return {name: size for name, size in sizes.items() if size}


def _groups(sizes: Mapping[str, int]) -> Iterator[list[str]]:
    """Yield topics in their order, as many at a time as may be in memory together."""
    together: list[str] = []
    left = _TOGETHER
    for name, size in sizes.items():
        if together and size > left:
            yield together
            together, left = [], _TOGETHER
        together.append(name)
        left -= size
    if together:
        yield together


def _table(log: Log, topic: LogTopic, series: Series) -> dict[str, NDArray[Any]]:
    table: dict[str, NDArray[Any]] = {
        'step': series.steps,
        'log_time_s': series.log_ns / 1e9,
        'publish_time_ns': series.publish_ns,
    }
    for name, values in log.table(topic, series.data).items():
        # a field may have the name of a column of ours
        table[f'message.{name}' if name in table else name] = values
    return table


def _write_csv(table: Mapping[str, NDArray[Any]], path: Path) -> None:
    with path.open('w', newline='', encoding='utf-8') as stream:
        writer = csv.writer(stream)
        writer.writerow(table)
        # tolist gives Python numbers, whose text is the shortest that reads back the same
        columns = (
            map(_cell, values) if values.dtype == object else values.tolist()
            for values in table.values()
        )  # fmt: skip
        writer.writerows(zip(*columns, strict=True))


def _cell(text: str) -> str:
    """Return a text that a spreadsheet does not take for a formula."""
    return f"'{text}" if text.startswith(_FORMULA) else text


def _write_parquet(table: Mapping[str, NDArray[Any]], path: Path) -> None:
    import pyarrow
    import pyarrow.parquet

    pyarrow.parquet.write_table(pyarrow.table(dict(table)), path)
