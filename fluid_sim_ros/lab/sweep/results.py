"""The rows of a sweep on disk: Parquet parts as they come, one table at the end."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.lab.sweep.flight import Row
from fluid_sim_ros.lab.sweep.sweep_file import SweepFile, as_plain


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

    Raises
    ------
    ConfigError
        If the folder holds another sweep, or cannot be written.

    """

    def __init__(self, folder: Path, sweep: SweepFile) -> None:
        self._parts = folder / 'parts'
        self.table_path = folder / 'results.parquet'
        text = json.dumps(as_plain(sweep), indent=2) + '\n'
        stated = folder / 'sweep.json'
        try:
            self._parts.mkdir(parents=True, exist_ok=True)
            if stated.exists() and stated.read_text(encoding='utf-8') != text:
                raise ConfigError(
                    f'{folder}: holds the results of another sweep; choose another --out, or '
                    'delete it'
                )
            stated.write_text(text, encoding='utf-8')
        except OSError as error:
            raise ConfigError(f'--out {folder}: {error.strerror}') from None

    def has(self, begin: int, end: int) -> bool:
        """Return whether a portion is there, whole."""
        path = self._path(begin)
        if not path.exists():
            return False
        try:
            return bool(pq.read_metadata(path).num_rows == end - begin)
        except (pa.ArrowInvalid, OSError):
            return False

    def add(self, begin: int, rows: Sequence[Row]) -> None:
        """Keep a portion."""
        self._write(pa.Table.from_pylist(list(rows)), self._path(begin))

    def finish(self, begins: Sequence[int]) -> pa.Table:
        """Write the table of all portions and return it."""
        tables = [pq.read_table(self._path(begin)) for begin in begins]
        # a run that failed has no state: the columns are those of all portions together
        table = pa.concat_tables(tables, promote_options='permissive')
        self._write(table, self.table_path)
        return table

    def _path(self, begin: int) -> Path:
        return self._parts / f'{begin:09d}.parquet'

    @staticmethod
    def _write(table: pa.Table, path: Path) -> None:
        unfinished = path.with_suffix('.unfinished')
        pq.write_table(table, unfinished)
        unfinished.replace(path)


def statistics(table: pa.Table) -> dict[str, Any]:
    """Return how the runs ended, and minimum, median and maximum of what came out."""
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
    return {'status': {entry['values']: entry['counts'] for entry in ends}, 'columns': numbers}
