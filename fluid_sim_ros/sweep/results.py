# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The rows of a sweep on disk: Parquet parts as they come, one table at the end."""

import hashlib
import json
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.schema.limits import check_limit
from fluid_sim_ros.sweep.compiled_run import Row
from fluid_sim_ros.sweep.sweep_file import SweepFile, as_plain

#: Runs from the first up to the second.
Portion = tuple[int, int]


class Results:
    """
    The folder of a sweep.

    ``sweep.json`` says what is run, ``parts/`` holds finished portions (a portion is there whole
    or not at all), ``results.parquet`` all rows by run once every one is there.

    Parameters
    ----------
    folder
        Made when it is not there.
    sweep
        What is run.
    device
        On what device, if not on the processor.

    Raises
    ------
    ConfigError
        If the folder holds another sweep, or cannot be written.

    """

    def __init__(self, folder: Path, sweep: SweepFile, device: str = '') -> None:
        self._parts = folder / 'parts'
        self.table_path = folder / 'results.parquet'
        self._tables: dict[int, pa.Table] = {}
        plain = as_plain(sweep) | ({'device': device} if device else {})
        text = json.dumps(plain, indent=2) + '\n'
        stated = folder / 'sweep.json'
        try:
            self._parts.mkdir(parents=True, exist_ok=True)
            if stated.exists() and stated.read_text(encoding='utf-8') != text:
                raise ConfigError(
                    f'{folder}: holds the results of another sweep or device; choose another '
                    '--out, or delete it'
                )
            stated.write_text(text, encoding='utf-8')
        except OSError as error:
            raise ConfigError(f'--out {folder}: {error.strerror}') from None

    def kept(self) -> list[Portion]:
        """
        Take up what an earlier try left, and return its portions, in order.

        A part that is not whole, or overlaps another one, is deleted.

        Returns
        -------
        list
            Portions, in order.

        """
        kept: list[Portion] = []
        for path in self._parts.glob('*.unfinished'):
            path.unlink()
        for path in sorted(self._parts.glob('*.parquet')):
            table = _read(path)
            if table is None or (kept and table['run'][0].as_py() < kept[-1][1]):
                path.unlink()
                continue
            begin = int(table['run'][0].as_py())
            self._tables[begin] = table
            kept.append((begin, begin + len(table)))
        return kept

    def add(self, rows: Sequence[Row]) -> None:
        """
        Keep a portion, its rows in the order of their runs.

        Parameters
        ----------
        rows
            Consecutive runs.

        """
        begin = int(rows[0]['run'])
        table = as_table(rows)
        _write(table, self._parts / f'{begin:09d}.parquet', with_digest=True)
        self._tables[begin] = table

    def finish(self) -> pa.Table:
        """
        Write the table of all portions and return it.

        Returns
        -------
        pyarrow.Table
            All rows by run.

        """
        tables = [self._tables[begin] for begin in sorted(self._tables)]
        # a run that failed has no state: the columns are those of all portions together
        table = pa.concat_tables(tables, promote_options='permissive')
        _write(table, self.table_path)
        return table


def as_table(rows: Sequence[Row]) -> pa.Table:
    """
    Return rows as a table with the columns of all of them.

    Parameters
    ----------
    rows
        Any rows; what one lacks is null.

    Returns
    -------
    pyarrow.Table
        The table.

    """
    names = dict.fromkeys(name for row in rows for name in row)
    return pa.table({name: [row.get(name) for row in rows] for name in names})


def gaps(kept: Iterable[Portion], total: int) -> list[Portion]:
    """
    Return what of a sweep's runs is not there yet.

    Parameters
    ----------
    kept
        Portions that are there, in order.
    total
        Number of runs.

    Returns
    -------
    list
        Portions, in order.

    """
    found, at = [], 0
    for begin, end in (*kept, (total, total)):
        if begin > at:
            found.append((at, begin))
        at = end
    return found


def _read(path: Path) -> pa.Table | None:
    """Return a part, or None where it is not whole."""
    try:
        begin, _, digest = path.stem.partition('-')
        if _digest(path) != digest:  # pages have checksums, names of columns do not
            return None
        count = pq.read_metadata(path).num_rows
        check_limit('sweep_runs', count, f'{path}: rows')
        table = pq.read_table(path, page_checksum_verification=True)
        runs = pa.array(range(int(begin), int(begin) + count), table['run'].type)
        return table if count and table['run'].combine_chunks().equals(runs) else None
    except (pa.ArrowException, OSError, KeyError, ValueError, TypeError):
        return None


def _digest(path: Path) -> str:
    with path.open('rb') as file:
        return hashlib.file_digest(file, 'sha256').hexdigest()[:16]


def _write(table: pa.Table, path: Path, with_digest: bool = False) -> None:
    unfinished = path.with_suffix('.unfinished')
    pq.write_table(table, unfinished, write_page_checksum=True)
    if with_digest:  # in the name, so that file and checksum are there together or not at all
        path = path.with_stem(f'{path.stem}-{_digest(unfinished)}')
    unfinished.replace(path)


def statistics(table: pa.Table) -> dict[str, Any]:
    """
    Return how the runs ended, and minimum, median and maximum of what came out.

    Parameters
    ----------
    table
        Of a sweep.

    Returns
    -------
    dict
        ``status``: how many runs by their end; ``runs_with_warnings``, and the first of them as
        ``first_warning``; ``columns``: ``min``, ``median`` and ``max`` by name.

    """
    ends = table.column('status').value_counts().to_pylist()
    numbers = {}
    for name in table.column_names:
        column = table.column(name)
        if name == 'run' or not pa.types.is_floating(column.type):
            continue
        values = column.drop_null().to_numpy()
        values = values[np.isfinite(values)]
        if len(values):
            low, middle, high = np.quantile(values, (0.0, 0.5, 1.0)).tolist()
            numbers[name] = {'min': low, 'median': middle, 'max': high}
    said = []
    if 'warnings' in table.column_names:
        rows = zip(table['run'].to_pylist(), table['warnings'].to_pylist(), strict=True)
        said = [f'run {run}: {line}' for run, line in rows if line]
    return {
        'status': {entry['values']: entry['counts'] for entry in ends},
        'runs_with_warnings': len(said),
        'first_warning': said[0] if said else '',
        'columns': numbers,
    }
