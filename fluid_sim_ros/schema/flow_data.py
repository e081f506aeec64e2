# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Winds and currents from data: a time series, or a grid over time and place."""

from typing import Literal, Self

from pydantic import model_validator

from fluid_sim_ros.schema.base import Vector
from fluid_sim_ros.schema.flow_model import FlowModel, Increasing, Sheared, check_rising, words


class Series(FlowModel):
    """
    A time series: a CSV ``file`` with the columns t, x, y, z ([s], [m/s]), or both lists here.

    Cubic Hermite between the rows; before the first and after the last row their values hold.
    """

    model: Literal['series']
    one_of = 'series'
    file: str | None = None
    times: Increasing | None = None
    velocities: list[Vector] | None = None

    @model_validator(mode='after')
    def _rows(self) -> Self:
        if (self.times is None) != (self.velocities is None):
            raise ValueError('times and velocities belong together')
        if self.times is None and self.file is None:
            raise ValueError('needs a file, or times and velocities')
        if self.times is not None and self.velocities is not None:
            check_rising(self.times, 'times')
            if len(self.velocities) != len(self.times):
                raise ValueError(f'{len(self.times)} times need as many velocities')
        return self

    def _keys(self, stream: str) -> dict[str, str]:
        rows = zip(self.times or [], self.velocities or [], strict=True)
        numbers = words(number for time, velocity in rows for number in (time, *velocity))
        return {f'{stream}_series': numbers}


class GridFile(Sheared):
    """
    A flow u(t, x, y, z) on a rectilinear grid: an NPZ or NetCDF ``file`` (grid_files.py).

    Linear between the points; beyond the grid the value at its edge holds. ``data`` is the packed
    content of the file, which a log holds instead of it.
    """

    model: Literal['grid']
    one_of = 'grid'
    file: str = ''
    data: str | None = None

    @model_validator(mode='after')
    def _some_source(self) -> Self:
        if not self.file and self.data is None:
            raise ValueError('needs a file')
        return self

    def _keys(self, stream: str) -> dict[str, str]:
        return super()._keys(stream) | {f'{stream}_grid': f'{stream}_grid'}

    def packed_grid(self) -> str | None:
        """Return the packed content of the file."""
        return self.data
