# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The YAML file of a sweep: what is varied, and the numbers of each run."""

import math
import re
from collections.abc import Mapping
from itertools import product
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field, model_validator

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.schema.base import (
    NotNegative,
    Number,
    Positive,
    Strict,
    Vector,
    parse,
)
from fluid_sim_ros.schema.limits import beyond, limit
from fluid_sim_ros.schema.settings import Fluid, Integrator, RunSettings
from fluid_sim_ros.schema.yaml_file import read_yaml

#: A setting that a run takes: a number, or a name (of an integrator or fluid rung).
Value = float | int | str

_SETTINGS = ('seed', 'timestep', 'integrator', 'fluid')
_PATTERN = re.compile(
    rf'^({"|".join(_SETTINGS)}|(wind|current)\.[xyz]|mass\.[^.]+|(thrust|gain)\.[A-Za-z0-9_]+)$'
)
_ALLOWED = (
    f'{", ".join(_SETTINGS)}, wind.x|y|z, current.x|y|z [m/s], mass.<body> (factor), '
    'thrust.<vehicle> (factor of its limit), gain.<name>'
)


class Variation(Strict):
    """
    How one setting varies: exactly one of the keys.

    ``values`` and ``linspace`` (first, last, count) span a grid; ``uniform`` (low, high),
    ``loguniform`` (low, high) and ``normal`` (mean, standard deviation) are drawn for each run.
    """

    values: Annotated[list[Number | str], Field(min_length=1)] | None = None
    linspace: tuple[Number, Number, Annotated[int, Field(ge=1)]] | None = None
    uniform: tuple[Number, Number] | None = None
    loguniform: tuple[Positive, Positive] | None = None
    normal: tuple[Number, NotNegative] | None = None

    @model_validator(mode='after')
    def _is_one(self) -> 'Variation':
        stated = [name for name in type(self).model_fields if getattr(self, name) is not None]
        if len(stated) != 1:
            names = ', '.join(type(self).model_fields)
            raise ValueError(f'needs one of: {names}')
        if len({isinstance(value, str) for value in self.values or ()}) > 1:
            raise ValueError('values are either all numbers or all names')
        for name in ('uniform', 'loguniform'):
            limits = getattr(self, name)
            if limits is not None and limits[0] > limits[1]:
                raise ValueError(f'{name}: {limits[0]:g} is above {limits[1]:g}')
            if limits is not None and not math.isfinite(limits[1] - limits[0]):
                raise ValueError(f'{name}: {limits[0]:g} and {limits[1]:g} are too far apart')
        return self

    @property
    def is_grid(self) -> bool:
        """Whether it spans the grid, and is not drawn."""
        return self.values is not None or self.linspace is not None

    @property
    def count(self) -> int:
        """Points along the grid; 1 for what is drawn."""
        if self.linspace is not None:
            return self.linspace[2]
        return len(self.values or (0,))

    @property
    def grid(self) -> list[Value]:
        """The values that span the grid; empty for what is drawn."""
        if self.values is not None:
            return list(self.values)
        if self.linspace is not None:
            return [float(value) for value in np.linspace(*self.linspace)]
        return []

    def draw(self, random: np.random.Generator) -> float:
        """
        Return a drawn value.

        Parameters
        ----------
        random
            Source of the draws.

        Returns
        -------
        float
            The value.

        """
        if self.uniform is not None:
            return float(random.uniform(*self.uniform))
        if self.loguniform is not None:
            low, high = map(math.log, self.loguniform)
            return math.exp(random.uniform(low, high))
        assert self.normal is not None
        return float(random.normal(*self.normal))


class Hold(Strict):
    """A controller in the loop that holds a place: its errors are part of each row."""

    law: Literal['multirotor', 'underwater']
    target: Vector
    vehicle: str = ''
    yaw: Number = 0.0
    rate: Positive = 100.0
    gains: dict[str, Number] = Field(default_factory=dict)


class SweepFile(Strict):
    """
    One sweep.

    ``scene`` is a name, or a path relative to the file. Each combination of the grid is run
    ``runs`` times, each time with new draws. ``sample_rate`` [Hz] is how often the largest values
    of a row are looked at.
    """

    scene: str
    duration: Positive | None = None
    timestep: Positive | None = None
    integrator: Integrator | None = None
    fluid: Fluid | None = None
    sample_rate: Positive = 10.0
    seed: Annotated[int, Field(ge=0, lt=2**63)] = 0
    runs: Annotated[int, Field(ge=1)] = 1
    hold: Hold | None = None
    vary: Annotated[dict[str, Variation], Field(min_length=1)]

    @model_validator(mode='after')
    def _keys_are_known(self) -> 'SweepFile':
        for key, variation in self.vary.items():
            if not _PATTERN.match(key):
                raise ValueError(f"vary: unknown key '{key}'; allowed: {_ALLOWED}")
            if key.startswith('gain.') and self.hold is None:
                raise ValueError(f"vary: '{key}' needs a controller: key 'hold'")
            if key in _SETTINGS and not variation.is_grid:
                raise ValueError(f"vary: '{key}' cannot be drawn; use values or linspace")
        if self.hold is not None and any(key.startswith('thrust.') for key in self.vary):
            raise ValueError("vary: thrust cannot vary where a controller holds ('hold')")
        total = self.runs * math.prod(variation.count for variation in self.vary.values())
        if total > (most := limit('sweep_runs')):
            raise ValueError(str(beyond('sweep_runs', most, f'runs: {total}')))
        for key, variation in self.vary.items():
            _check_values(key, variation.grid)
        return self

    def settings(self, values: Mapping[str, Value]) -> RunSettings:
        """
        Return the settings of a run.

        Parameters
        ----------
        values
            The numbers of its case, which count before what the file says of all runs.

        Returns
        -------
        RunSettings
            Seed 0 where it does not vary.

        """
        stated = {key: getattr(self, key) for key in _SETTINGS if key != 'seed'}
        return RunSettings(**stated | {k: v for k, v in values.items() if k in _SETTINGS})


def _check_values(key: str, values: list[Value]) -> None:
    """Raise ValueError for a grid that a setting cannot take."""
    if key in _SETTINGS:
        for value in values:
            try:
                RunSettings.checked("vary: '{}'", **{key: value})
            except ConfigError as error:
                raise ValueError(str(error)) from None
    elif values and isinstance(values[0], str):
        raise ValueError(f"vary: '{key}' takes numbers, not '{values[0]}'")


class Cases:
    """
    The numbers of every run, by its index: the same ones whoever asks, in whatever order.

    Parameters
    ----------
    sweep
        What is varied.

    """

    def __init__(self, sweep: SweepFile) -> None:
        self._sweep = sweep
        self._grid_keys = [key for key, variation in sweep.vary.items() if variation.is_grid]
        self._drawn = {k: v for k, v in sweep.vary.items() if not v.is_grid}
        self._points = list(product(*(sweep.vary[key].grid for key in self._grid_keys)))
        self.keys = tuple(sweep.vary)

    def __len__(self) -> int:
        return len(self._points) * self._sweep.runs

    def __getitem__(self, index: int) -> dict[str, Value]:
        values: dict[str, Value] = dict(
            zip(self._grid_keys, self._points[index // self._sweep.runs], strict=True)
        )
        if self._drawn:
            random = np.random.default_rng((self._sweep.seed, index))
            values |= {key: variation.draw(random) for key, variation in self._drawn.items()}
        return values


def read_sweep(path: Path) -> SweepFile:
    """
    Read a sweep's file; a scene path in it becomes absolute.

    Parameters
    ----------
    path
        YAML file.

    Returns
    -------
    SweepFile
        The sweep.

    Raises
    ------
    ConfigError
        With the file, the key and what is allowed.

    """
    sweep = parse(SweepFile, read_yaml(path), path)
    if Path(sweep.scene).suffix:
        scene = (path.parent / sweep.scene).resolve()
        if not scene.is_file():
            raise ConfigError(f"{path}: key 'scene': {scene}: no such file")
        sweep = sweep.model_copy(update={'scene': str(scene)})
    return sweep


def as_plain(sweep: SweepFile) -> dict[str, Any]:
    """
    Return a sweep as JSON can hold it.

    Parameters
    ----------
    sweep
        The sweep.

    Returns
    -------
    dict
        Its keys, without those that are not given.

    """
    return sweep.model_dump(mode='json', exclude_none=True)
