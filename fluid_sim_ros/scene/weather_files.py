# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Reads the files that a scene's weather names; a fault is one line with file and row."""

import csv
import math
from collections.abc import Sequence
from io import TextIOWrapper
from itertools import islice
from pathlib import Path
from typing import Any, TypeVar

from fluid_sim_ros.errors import ConfigError, listed, printable
from fluid_sim_ros.scene.grid_files import pack, read_grid
from fluid_sim_ros.schema.data_file import open_data
from fluid_sim_ros.schema.flow_data import GridFile, Series
from fluid_sim_ros.schema.flow_model import FlowModel
from fluid_sim_ros.schema.limits import beyond, check_limit, limit

Model = TypeVar('Model', bound=FlowModel)

COLUMNS = ('t', 'x', 'y', 'z')


def with_files(models: Sequence[Model], folder: Path) -> tuple[Model, ...]:
    """
    Return models with the content of their files.

    Parameters
    ----------
    models
        As a scene's file states them.
    folder
        What their paths are relative to.

    Returns
    -------
    tuple
        The same models; those without a file as they are.

    Raises
    ------
    ConfigError
        For a file that cannot be read; see ``read_csv`` and ``read_grid``.

    """
    return tuple(_with_file(model, folder) for model in models)


def _with_file(model: Model, folder: Path) -> Model:
    content: dict[str, Any] = {}
    if isinstance(model, Series) and model.times is None:
        rows = read_csv(folder / str(model.file))
        content = {'times': [row[0] for row in rows], 'velocities': [row[1:] for row in rows]}
    elif isinstance(model, GridFile) and model.data is None:
        content = {'data': pack(read_grid(folder / model.file))}
    return model.model_copy(update=content) if content else model


def read_csv(path: Path) -> list[list[float]]:
    """
    Return the rows of a time series in a CSV file with a header; other columns are ignored.

    Parameters
    ----------
    path
        The file.

    Returns
    -------
    list
        Rows of time [s] and velocity x, y, z [m/s], world axes.

    Raises
    ------
    ConfigError
        For a file that cannot be read, a missing column, a gap, a number that is not finite, or
        times that do not rise.

    """
    try:
        check_limit('csv_bytes', path.stat().st_size, f'{path}: size')
        with TextIOWrapper(open_data(path), encoding='utf-8', newline='') as file:
            reader = csv.DictReader(file, skipinitialspace=True)
            names = reader.fieldnames or []
            missing = [name for name in COLUMNS if name not in names]
            if missing:
                raise ConfigError(
                    f"{path}: no column '{missing[0]}'; needed: {listed(COLUMNS)}; "
                    f'it has: {listed(names)}'
                )
            most = limit('csv_rows')
            rows = [_row(path, reader.line_num, row) for row in islice(reader, most)]
            if next(reader, None) is not None:
                raise beyond('csv_rows', most, f'{path}: a row more')
    except FileNotFoundError:
        raise ConfigError(f'{path}: no such file') from None
    except OSError as error:
        raise ConfigError(f'{path}: {error.strerror or error}') from None
    except (UnicodeDecodeError, csv.Error) as error:
        raise ConfigError(f'{path}: {printable(str(error))}') from None
    if len(rows) < 2:
        raise ConfigError(f'{path}: {len(rows)} rows; a time series needs two or more')
    for number in range(1, len(rows)):
        if rows[number][0] <= rows[number - 1][0]:
            raise ConfigError(
                f'{path}: t must rise strictly: {rows[number][0]:g} after '
                f'{rows[number - 1][0]:g} s (data row {number + 1})'
            )
    return rows


def _row(path: Path, line: int, row: dict[str, Any]) -> list[float]:
    values = []
    for name in COLUMNS:
        text = row[name]
        try:
            value = float(text)
        except (TypeError, ValueError):
            what = 'a gap' if not text else repr(printable(text, 60))
            raise ConfigError(f"{path}: line {line}, column '{name}': {what}") from None
        if not math.isfinite(value):
            raise ConfigError(
                f"{path}: line {line}, column '{name}': {printable(text, 60)} is not finite"
            )
        values.append(value)
    return values
