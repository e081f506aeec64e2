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
            share, speed, extent, reynolds = self._values.tolist()
            if share > CROSSING_SHARE and self._is_new(body, 'crossing'):
                self.lines.append(self._crossing(body, share, speed, extent))
            if reynolds > DRAG_CRISIS and self._is_new(body, 'drag crisis'):
                self.lines.append(self._drag_crisis(body, reynolds))
            number += 1
        return self.lines[known:]

    def _is_new(self, body: int, limit: str) -> bool:
        new = (body, limit) not in self._said
        self._said.add((body, limit))
        return new

    def _title(self, body: int) -> str:
        name = self._model.body(body).name
        return f"body '{name}'" if name else f'body {body}'

    def _crossing(self, body: int, share: float, speed: float, extent: float) -> str:
        enough = GOOD_CROSSING_SHARE * extent / speed
        return (
            f'{self._title(body)} crossed the surface at {speed:.3g} m/s, {share:.2g} of its '
            f'{extent:.3g} m in one step: slamming and buoyancy are not resolved; use a timestep '
            f'below {enough:.2g} s'
        )

    def _drag_crisis(self, body: int, reynolds: float) -> str:
        return (
            f'{self._title(body)} reached Re = {reynolds:.2g}; the drag curve of '
            f'drag_reynolds="brown_lawler" ends at {DRAG_CRISIS:.0e}: beyond the drag crisis a '
            'smooth sphere has down to a fifth of this drag'
        )
