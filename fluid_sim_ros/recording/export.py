# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A log's messages as tables: one CSV or Parquet file per topic."""

import csv
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from fluid_sim_ros.output.new_file import file_names, new_file
from fluid_sim_ros.recording.log import Log
from fluid_sim_ros.sensors.reading import BULKY

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
    files = []
    topics = list(log.topics.values())
    for topic, stem in zip(topics, file_names(t.name for t in topics), strict=True):
        if topic.type in BULKY:
            continue
        series = log.series(topic)
        if not series.data:
            continue
        table: dict[str, NDArray[Any]] = {
            'step': series.steps,
            'log_time_s': series.log_ns / 1e9,
            'publish_time_ns': series.publish_ns,
        }
        for name, values in log.table(topic, series.data).items():
            # a field may have the name of a column of ours
            table[f'message.{name}' if name in table else name] = values
        path = folder / f'{stem}.{kind}'
        with new_file(path) as file:
            (_write_csv if kind == 'csv' else _write_parquet)(table, file)
        files.append(str(path))
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
