# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Says once where a body leaves what the fluid forces on it are good for."""

import mujoco
import numpy as np

from fluid_sim_ros.plugins.native import native

#: A body whose extent passes the surface in fewer than four steps gets a warning: what slamming
#: takes from its speed is off by 6 % with a first-order integrator, and by 0.5 % with RK4.
CROSSING_SHARE = 0.25
#: Share at which it is off by about 1 %: the warning names the timestep that gives it.
GOOD_CROSSING_SHARE = 0.1
#: Where the drag curve of Brown and Lawler ends: beyond lies the drag crisis of smooth spheres.
DRAG_CRISIS = 2e5


class LimitWatch:
    """
    Looks at the bodies of one data, each time that it is asked.

    The library keeps the largest values since the data was made, of every evaluation, so that
    nothing between two looks is missed.

    Parameters
    ----------
    model, data
        What is stepped.

    Attributes
    ----------
    lines
        One line per body and limit that it went beyond, in the order in which it was seen.

    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        self.lines: list[str] = []
        self._model = model
        self._values = np.zeros(4)
        self._addresses = (model._address, data._address)
        self._said: set[tuple[int, str]] = set()

    def look(self) -> list[str]:
        """Return the lines that are new since the last look."""
        known, number = len(self.lines), 0
        look, out = native().limits, self._values.ctypes.data
        while (body := look(*self._addresses, number, out)) >= 0:
            for limit, line in limit_lines(self._model, body, *self._values.tolist()).items():
                if (body, limit) not in self._said:
                    self._said.add((body, limit))
                    self.lines.append(line)
            number += 1
        return self.lines[known:]


def limited_bodies(model: mujoco.MjModel, data: mujoco.MjData) -> tuple[int, ...]:
    """
    Return the bodies whose limits the library watches.

    Parameters
    ----------
    model, data
        What is stepped.

    Returns
    -------
    tuple
        Body ids, in the order of the library.

    """
    found: list[int] = []
    values = np.zeros(4)
    look, addresses = native().limits, (model._address, data._address)
    while (body := look(*addresses, len(found), values.ctypes.data)) >= 0:
        found.append(body)
    return tuple(found)


def limit_lines(
    model: mujoco.MjModel, body: int, share: float, speed: float, extent: float, reynolds: float
) -> dict[str, str]:
    """
    Return one line for each limit that a body went beyond.

    Parameters
    ----------
    model
        The compiled model.
    body
        Id of the body.
    share, speed, extent
        Largest share of the body's extent that passed the surface in one step [-], at which speed
        [m/s], and the extent [m].
    reynolds
        Largest Reynolds number of a drag that goes by it [-].

    Returns
    -------
    dict
        Line by limit; empty within all of them.

    """
    name = model.body(body).name
    title, lines = f"body '{name}'" if name else f'body {body}', {}
    if share > CROSSING_SHARE:
        enough = GOOD_CROSSING_SHARE * extent / speed
        lines['crossing'] = (
            f'{title} crossed the surface at {speed:.3g} m/s, {share:.2g} of its {extent:.3g} m '
            f'in one step: slamming and buoyancy are not resolved; use a timestep below '
            f'{enough:.2g} s'
        )
    if reynolds > DRAG_CRISIS:
        lines['drag crisis'] = (
            f'{title} reached Re = {reynolds:.2g}; the drag curve of '
            f'drag_reynolds="brown_lawler" ends at {DRAG_CRISIS:.0e}: beyond the drag crisis a '
            'smooth sphere has down to a fifth of this drag'
        )
    return lines
