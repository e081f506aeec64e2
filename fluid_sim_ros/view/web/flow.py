# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Wind and current on the page: a field of arrows around the vehicle that is followed."""

from collections.abc import Collection, Sequence
from typing import Any

import numpy as np
import viser

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.view.frame import Frame
from fluid_sim_ros.view.stage import Stage
from fluid_sim_ros.view.web.looks import Looks

#: A flow of this speed [m/s] is drawn one extent of the vehicle long: wind, current.
LENGTH = {'wind': 5.0, 'current': 0.5}
_COLORS = {'wind': (110, 130, 160), 'current': (0, 120, 140)}
#: The field has this many arrows along each axis, this far apart [extents].
_ACROSS, _UP, _APART = 5, 3, 1.6
#: Slower than this share of the speeds above is drawn as nothing.
_LEAST = 0.01
#: The field is drawn anew in every fourth picture: it changes slower than what moves in it.
_EVERY = 4


class FlowField:
    """
    Draws the flow into viser's scene.

    The arrows stand on a grid that stays where it is in the world while the vehicle passes.

    Parameters
    ----------
    server
        Whose scene is drawn into.
    stage
        Knows the flow.
    looks
        What is wanted.

    """

    def __init__(self, server: viser.ViserServer, stage: Stage, looks: Looks) -> None:
        self._stage, self._looks, self._api = stage, looks, server.scene
        extent = self._extent = stage.extents[looks.vehicle]
        self._arrows = self._api.add_arrows(
            '/world/flow', np.zeros((1, 2, 3)), (0, 0, 0), shaft_radius=0.012 * extent,
            head_radius=0.04 * extent, head_length=0.11 * extent, visible=False,
        )  # fmt: skip
        ticks = [np.arange(n) - n // 2 for n in (_ACROSS, _ACROSS, _UP)]
        grid = np.stack(np.meshgrid(*ticks, indexing='ij'), axis=-1).reshape(-1, 3)
        self._grid = grid * _APART * extent
        self._label: Any = None
        self._turn = 0
        self._shown: Array = np.zeros(0)

    def draw(self, frame: Frame, place: Array) -> None:
        """
        Draw the flow of a frame, which the stage was posed to.

        Parameters
        ----------
        frame
            To draw.
        place
            Of the vehicle, world [m], shape (3,).

        """
        self._turn = (self._turn + 1) % _EVERY
        looks, stage = self._looks, self._stage
        if not looks.flow:
            self._hide()
            return
        if self._turn:
            return
        apart = _APART * self._extent
        points = np.round(place / apart) * apart + self._grid
        velocities, liquid = stage.flow(frame, looks.vehicle, np.vstack([place, points]))
        streams = ['current' if wet else 'wind' for wet in liquid]
        full = np.array([LENGTH[stream] for stream in streams])
        speeds = np.linalg.norm(velocities, axis=1)
        shown = np.flatnonzero(speeds[1:] > _LEAST * full[1:]) + 1
        along = velocities * (self._extent * looks.flow_scale / full)[:, np.newaxis]
        ends = [np.stack([points[i - 1], points[i - 1] + along[i]]) for i in shown]
        if not ends:
            self._hide()
            return
        drawn = np.array(ends)
        if drawn.shape != self._shown.shape or np.abs(drawn - self._shown).max() > (
            1e-3 * self._extent
        ):  # a steady flow is sent once
            self._shown = drawn
            show_arrows(self._arrows, ends, [_COLORS[streams[i]] for i in shown])
        self._name(streams[0], float(speeds[0]), place)

    def _name(self, stream: str, speed: float, place: Array) -> None:
        """Write the speed at the vehicle beside it."""
        if self._label is None:
            self._label = self._api.add_label(
                '/world/label_flow', '', anchor='bottom-center', font_screen_scale=0.9
            )
        self._label.visible = self._looks.labels
        text = f'{stream} {speed:.3g} m/s here'
        if self._label.text != text:
            self._label.text = text
        self._label.position = place + np.array([0.0, 0.0, -1.2 * self._extent])

    def _hide(self) -> None:
        if len(self._shown):
            self._shown = np.zeros(0)
            self._arrows.visible = False
            if self._label is not None:
                self._label.visible = False


def show_arrows(
    handle: Any, points: Sequence[Array], shades: Collection[tuple[int, int, int]]
) -> None:
    """
    Show arrows, or none.

    Parameters
    ----------
    handle
        Of viser's arrows.
    points
        Begin and end of each, shape (2, 3).
    shades
        Red, green and blue of each, 0 to 255.

    """
    handle.visible = bool(points)
    if points:
        handle.points = np.asarray(points, dtype=np.float32)
        handle.colors = np.array(shades, dtype=np.uint8)
