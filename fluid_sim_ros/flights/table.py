# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Flights as tables: CSV with a line of names first, or Parquet."""

import csv
import io
import itertools
import math
import re
from array import array
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from fluid_sim_ros.errors import FluidSimError, listed, needed_for, printable
from fluid_sim_ros.flights.flight import FlightError, RawLog, Stream
from fluid_sim_ros.flights.units import UNITS
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.schema.data_file import open_data
from fluid_sim_ros.schema.limits import beyond, check_limit, expanded_size, limit

STREAM = 'table'
#: What separates cells; where it is no comma, that may be the sign of decimals.
_MARKS = (',', ';', '\t')
#: How a line of numbers begins.
_NUMBER = re.compile(r'\s*[-+.]?[0-9]')
#: Names of the column of time, and their units.
_TIMES = {'time': 's', 't': 's', 'time_s': 's', 'time_ms': 'ms', 'time_us': 'us', 'time_ns': 'ns'}


def read_table(path: Path, time: str, unit: str) -> RawLog:
    """
    Read a table.

    Parameters
    ----------
    path
        A file whose name ends with ``.csv`` or ``.parquet``.
    time
        Column of time; '' for one of the usual names.
    unit
        Of it: s, ms, us or ns; '' for that of its name.

    Returns
    -------
    RawLog
        One stream, ``table``; an empty cell is a sample that is not there.

    Raises
    ------
    FlightError
        If it holds no table of numbers, or no time.

    """
    parquet = path.suffix == '.parquet'
    columns = _parquet(path) if parquet else _csv(path)
    time = time or next((name for name in columns if name in _TIMES), '')
    if time not in columns:
        raise FlightError(
            f'{path}: has no column of time ({time or listed(_TIMES)}); name it in the mapping, '
            f'time: {{column: NAME, unit: s}}; columns: {listed(columns)}'
        )
    times = columns.pop(time) * UNITS['s'][unit or _TIMES.get(time, 's')]
    kind = 'Parquet table' if parquet else 'CSV table'
    return RawLog(path, kind, 'table', {STREAM: Stream(times, columns)})


def _csv(path: Path) -> dict[str, Array]:
    check_limit('csv_bytes', path.stat().st_size, f'{path}: size')
    try:
        with open_data(path) as file, io.TextIOWrapper(file, 'utf-8-sig', newline='') as lines:
            head, mark = _head(lines)
            rows = csv.reader(itertools.chain(head, lines), delimiter=mark)
            return _columns(rows, path, mark)
    except UnicodeDecodeError as error:
        raise FlightError(f'{path}: not UTF-8: byte {error.start}') from None
    except csv.Error as error:
        raise FlightError(f'{path}: no CSV: {error}') from None


def _head(lines: Iterator[str]) -> tuple[list[str], str]:
    """
    Return the first lines of a table, the one of names first, and what separates cells.

    Remarks (``#``) before it are passed over, but the last one names the columns where numbers
    follow it, as numpy writes a table.
    """
    remark, line = '', next(lines, '')
    while line.startswith('#'):
        remark, line = line.lstrip('# '), next(lines, '')
    first = [remark, line] if remark and _NUMBER.match(line) else [line]
    return first, max(_MARKS, key=first[0].count)


def _columns(rows: Iterator[list[str]], path: Path, mark: str) -> dict[str, Array]:
    """Return the columns of a table, row by row: texts of numbers take much memory."""
    names = [name.strip() for name in next(rows, [])]
    if not names:
        raise FlightError(f'{path}: the first line must name the columns')
    check_limit('log_columns', len(names), f'{path}: columns')
    if len(set(names)) != len(names) or not names:
        raise FlightError(f'{path}: the first line must name each column once')
    numbers, most, count = array('d'), limit('csv_rows'), 0
    for row in rows:
        if not row:
            continue
        count += 1
        if count > most:
            raise beyond('csv_rows', most, f'{path}: more rows')
        if len(row) != len(names):
            raise FlightError(
                f'{path}: row {count + 1} has {len(row)} cells, the first line names {len(names)}'
            )
        cells: Iterable[tuple[str, str]] = zip(row, names, strict=True)
        if mark != ',':
            cells = ((cell.replace(',', '.'), name) for cell, name in cells)
        numbers.extend(_number(cell, path, count + 1, name) for cell, name in cells)
    table = np.frombuffer(numbers, dtype=np.float64).reshape(count, len(names))
    return {name: table[:, i].copy() for i, name in enumerate(names)}


def _number(cell: str, path: Path, row: int, name: str) -> float:
    try:
        return float(cell) if cell.strip() else math.nan
    except ValueError:
        raise FlightError(
            f'{path}: row {row}, column {printable(name, 60)!r}: {printable(cell, 60)!r} is no '
            'number'
        ) from None


def _parquet(path: Path) -> dict[str, Array]:
    with needed_for('a Parquet table'):
        import pyarrow as pa
        import pyarrow.parquet as pq

    try:
        about = pq.read_metadata(path)
        rows, count = about.num_rows, about.num_columns
        check_limit('log_columns', count, f'{path}: columns')
        check_limit('flight_samples', rows, f'{path}: rows')
        if 8 * rows * count > expanded_size(path.stat().st_size):
            raise beyond(
                'expansion', limit('expansion'), f'{path}: {rows} rows of {count} columns'
            )
        table: Any = pq.read_table(path)
    except FluidSimError:
        raise
    except (pa.ArrowException, OSError, ValueError, TypeError) as error:
        reason = printable(' '.join(str(error).split()))
        raise FlightError(f'{path}: no Parquet file ({reason})') from None
    columns = {}
    for name in table.column_names:
        kind = table.schema.field(name).type
        if pa.types.is_integer(kind) or pa.types.is_floating(kind):
            column = table.column(name).to_numpy()
            columns[name] = np.asarray(column, dtype=np.float64)
    return columns
