# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Live plots beside the scene: position, attitude, speed, forces, commands."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import viser
from scipy.spatial.transform import Rotation

from fluid_sim_ros.output.term_colors import COLORS, term_color
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.scene.vehicle import Vehicle
from fluid_sim_ros.view.frame import Frame

#: So much simulated time is kept in the plots [s], in so many points.
_WINDOW, _MOST = 20.0, 400
#: No axis is shorter than this: what is smaller is rounding, no motion and no force.
_LEAST_SPAN = {
    'position': 1e-2,
    'attitude': 1.0,
    'velocity': 1e-2,
    'forces': 1e-3,
    'commands': 1e-3,
}
#: So many commands have a line.
_MOST_COMMANDS = 8


class Plots:
    """
    Draws what frames say of one vehicle over time.

    Parameters
    ----------
    server
        In whose present panel the plots are put.
    vehicles, vehicle
        All, and the one that is drawn.
    terms
        Fluid terms that can act on it.

    """

    def __init__(
        self,
        server: viser.ViserServer,
        vehicles: Mapping[str, Vehicle],
        vehicle: str,
        terms: Sequence[str],
    ) -> None:
        self._row = list(vehicles).index(vehicle)
        self._terms = terms
        target = vehicles[vehicle]
        self._actuators = [*target.thruster_ids, *target.joint_ids][:_MOST_COMMANDS]
        commands = [*target.thrusters, *target.joints][:_MOST_COMMANDS]
        forces = {term: term_color(term) for term in (*terms, 'total', 'thrust')}
        self._blocks = {
            'position': (3, self._plot(server, 'position [m]', ('x', 'y', 'z'))),
            'attitude': (3, self._plot(server, 'attitude [deg]', ('roll', 'pitch', 'yaw'))),
            'velocity': (3, self._plot(server, 'velocity, body axes [m/s]', ('u', 'v', 'w'))),
            'forces': (
                len(forces),
                self._plot(server, 'forces [N]', tuple(forces), tuple(forces.values())),
            ),
        }
        if commands:
            self._blocks['commands'] = (
                len(commands), self._plot(server, 'commands', tuple(commands)),
            )  # fmt: skip
        self._points: list[Array] = []

    @staticmethod
    def _plot(
        server: viser.ViserServer, title: str, names: Sequence[str], shades: Sequence[str] = ()
    ) -> Any:
        shades = shades or [COLORS[i % len(COLORS)] for i in range(len(names))]
        series: list[Any] = [{'label': 't [s]'}]
        series += [
            {'label': name, 'stroke': shade, 'width': 1.5}
            for name, shade in zip(names, shades, strict=True)
        ]
        empty = np.array([0.0, 1.0])
        return server.gui.add_uplot(
            (empty, *(np.zeros(2) for _ in names)), tuple(series), title=title, height=150,
            scales={'x': {'time': False, 'auto': True}, 'y': {'auto': True}},
        )  # fmt: skip

    def clear(self) -> None:
        """Forget all points: the flight begins anew."""
        self._points = []

    def add(self, frame: Frame) -> None:
        """
        Keep a frame, unless it is not newer than the last.

        Parameters
        ----------
        frame
            To keep.

        """
        if self._points:
            last = self._points[-1][0]
            if frame.time < last:
                self._points = []
            elif frame.time - last < _WINDOW / _MOST:
                return
        row = frame.rows[self._row]
        quat = row[nat.QUATERNION]
        euler = np.full(3, np.nan)
        if np.linalg.norm(quat) > 0:
            euler = Rotation.from_quat(quat, scalar_first=True).as_euler('ZYX', degrees=True)[::-1]
        forces = frame.forces(self._row, self._terms)
        sizes = [
            float(np.linalg.norm(forces[term])) if term in forces else np.nan
            for term in (*self._terms, 'total', 'thrust')
        ]
        self._points.append(np.concatenate([
            [frame.time], row[nat.POSITION], euler, row[nat.LINEAR_VELOCITY], sizes,
            frame.control[self._actuators],
        ]))  # fmt: skip
        oldest = frame.time - _WINDOW
        while self._points[0][0] < oldest:
            del self._points[0]

    def show(self) -> None:
        """Send the points to the browsers."""
        if len(self._points) < 2:
            return
        table = np.array(self._points)
        column = 1
        for name, (count, handle) in self._blocks.items():
            values = table[:, column : column + count]
            column += count
            if not np.isfinite(values).any():
                continue
            low, high = float(np.nanmin(values)), float(np.nanmax(values))
            missing = max(_LEAST_SPAN[name] - (high - low), 0.1 * (high - low))
            handle.scales = {
                'x': {'time': False, 'auto': True},
                'y': {'range': (low - missing / 2, high + missing / 2)},
            }
            handle.data = (table[:, 0], *np.ascontiguousarray(values.T))
