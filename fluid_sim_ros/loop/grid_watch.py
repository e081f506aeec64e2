# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Says once where a vehicle, or the time, leaves the grid of its wind or current."""

import numpy as np

from fluid_sim_ros.physics.environment.grid import AXES
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.plugins.config import medium_of
from fluid_sim_ros.simulation import Simulation

_STREAMS = ('current', 'wind')
_UNITS = dict(zip(AXES, ('s', 'm', 'm', 'm'), strict=True))


class GridWatch:
    """
    Looks at the vehicles of a simulation, each time that it is asked.

    Parameters
    ----------
    simulation
        What is looked at.

    Attributes
    ----------
    lines
        One line per vehicle, stream and axis that was beyond its grid, in the order in which it
        happened; each once.

    """

    def __init__(self, simulation: Simulation) -> None:
        self.lines: list[str] = []
        self._simulation = simulation
        self._idle = not has_grid(simulation)
        self._seen: set[tuple[str, str, str]] = set()
        self._point, self._beyond = np.zeros(3), np.zeros((len(_STREAMS), len(AXES)))
        self._addresses = (
            simulation.model._address, simulation.data._address,
            self._point.ctypes.data, self._beyond.ctypes.data,
        )  # fmt: skip

    def new_lines(self) -> list[str]:
        """Return the lines that are new at this step boundary."""
        if self._idle:
            return []
        known = len(self.lines)
        rows = self._simulation.observe(forces=False)
        for name, row in zip(self._simulation.vehicles, rows, strict=True):
            self._point[:] = row[nat.POSITION]
            if nat.native().beyond_grids(*self._addresses):
                self._note(name)
        return self.lines[known:]

    def _note(self, vehicle: str) -> None:
        values = dict(zip(AXES, (self._simulation.time, *self._point), strict=True))
        for stream, axis in np.argwhere(self._beyond):
            key = (vehicle, _STREAMS[stream], AXES[axis])
            if key in self._seen:
                continue
            self._seen.add(key)
            value, unit, beyond = (
                values[AXES[axis]],
                _UNITS[AXES[axis]],
                self._beyond[stream, axis],
            )
            self.lines.append(
                f"{_STREAMS[stream]} grid: '{vehicle}' at {AXES[axis]} = {value:.6g} {unit} is "
                f'beyond its end at {value - beyond:.6g} {unit}: the edge value holds '
                f'(t = {self._simulation.time:g} s)'
            )


def has_grid(simulation: Simulation) -> bool:
    """
    Return whether the wind or current of a simulation comes from a grid.

    Parameters
    ----------
    simulation
        What is asked about.

    Returns
    -------
    bool
        False without a ``fluid_sim.medium``.

    """
    medium = medium_of(simulation.model)
    return medium is not None and any(medium.text(f'{stream}_grid') for stream in _STREAMS)
