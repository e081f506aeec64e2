"""A log's messages as tables: one CSV or Parquet file per topic."""

import csv
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fluid_sim_ros.recording.decode import columns
from fluid_sim_ros.recording.log import Log


def export(log: Log, folder: Path, kind: str) -> list[str]:
    """
    Write every topic that has messages; return the files.

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
        Paths of the files.

    """
    files = []
    for topic in log.topics.values():
        messages = list(log.messages([topic.name]))
        if not messages:
            continue
        table: dict[str, NDArray[Any]] = {
            'step': np.array([m.step for m in messages]),
            'log_time_s': np.array([m.log_ns for m in messages]) / 1e9,
            'publish_time_ns': np.array([m.publish_ns for m in messages]),
            **columns(topic.definition, [m.data for m in messages]),
        }
        path = folder / f'{topic.name.strip("/").replace("/", "_")}.{kind}'
        (_write_csv if kind == 'csv' else _write_parquet)(table, path)
        files.append(str(path))
    return files


def _write_csv(table: Mapping[str, NDArray[Any]], path: Path) -> None:
    with path.open('w', newline='', encoding='utf-8') as stream:
        writer = csv.writer(stream)
        writer.writerow(table)
        # tolist gives Python numbers, whose text is the shortest that reads back the same
        writer.writerows(zip(*(values.tolist() for values in table.values()), strict=True))


def _write_parquet(table: Mapping[str, NDArray[Any]], path: Path) -> None:
    import pyarrow
    import pyarrow.parquet

    pyarrow.parquet.write_table(pyarrow.table(dict(table)), path)
