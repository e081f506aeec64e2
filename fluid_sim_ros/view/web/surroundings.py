# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What is around the vehicles: light, ground, water with its waves, sky or depth behind it."""

from typing import Any

import mujoco
import numpy as np
import viser

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import surface
from fluid_sim_ros.view.stage import Stage
from fluid_sim_ros.view.web.shapes import LEFT_OUT, grid_faces

#: Points per side of the water, and how they spread: x = reach sinh(k s)/sinh(k), -1 <= s <= 1.
_POINTS, _SPREAD, _REACH = 41, 3.5, 60.0
#: Waves are drawn in every second picture: they are slower than what swims in them.
_EVERY = 2
_WATER, _WATER_OPACITY = (70, 140, 180), 0.55
#: Top and bottom of the background in air and under water (red, green, blue).
_SKY = ((120, 165, 215), (226, 234, 242))
_DEEP = ((96, 160, 184), (28, 74, 104))


class Surroundings:
    """
    Draws into viser's scene what is around the vehicles.

    Parameters
    ----------
    server
        Whose scene is drawn into.
    stage
        Poses the model.
    extent
        Of the vehicle that is followed [m].

    Attributes
    ----------
    has_surface
        Whether the model has a free surface, which is drawn.

    """

    def __init__(self, server: viser.ViserServer, stage: Stage, extent: float) -> None:
        self._api, self._stage, self._extent = server.scene, stage, extent
        self.has_surface = self._kind_of_surface() != surface.NO_SURFACE
        self._water: Any = None
        self._water_at: tuple[float, ...] = ()
        self._under: bool | None = None
        self._turn = 0
        self._add_lights()
        self._add_ground()

    def _add_lights(self) -> None:
        # viser's own lights bleach the colours of the terms
        api = self._api
        api.configure_default_lights(enabled=False)
        api.add_light_hemisphere(
            '/light/sky', sky_color=(255, 255, 255), ground_color=(150, 150, 150), intensity=1.0
        )
        api.add_light_directional('/light/sun', color=(255, 252, 244), intensity=1.0,
                                  position=(2.0, 3.0, 5.0), cast_shadow=True)  # fmt: skip

    def _add_ground(self) -> None:
        model, data = self._stage.model, self._stage.data
        planes = [g for g in range(model.ngeom) if model.geom_type[g] in LEFT_OUT]
        for number, geom in enumerate(planes):
            quat = np.zeros(4)
            mujoco.mju_mat2Quat(quat, data.geom_xmat[geom])
            self._api.add_grid(
                f'/world/ground_{number}', infinite_grid=True, cell_size=1.0, section_size=5.0,
                cell_color=(190, 186, 174), section_color=(160, 156, 144),
                plane_color=(214, 210, 198), plane_opacity=1.0, fade_distance=80.0,
                position=data.geom_xpos[geom], wxyz=quat,
            )  # fmt: skip
        if not planes and not self.has_surface:  # something to see the motion against
            self._api.add_grid(
                '/world/reference',
                infinite_grid=True,
                cell_size=1.0,
                section_size=5.0,
                cell_color=(205, 210, 216),
                section_color=(170, 176, 184),
                fade_distance=60.0,
            )

    def _kind_of_surface(self) -> int:
        kind, _ = self._stage.water(np.zeros((1, 2)))
        return kind

    def is_under(self, place: Array) -> bool:
        """
        Return whether a place lies in a liquid.

        Parameters
        ----------
        place
            World [m], shape (3,).

        """
        kind, heights = self._stage.water(place[np.newaxis, :2])
        return bool(place[2] < heights[0]) if kind != surface.NO_SURFACE else self._is_liquid()

    def _is_liquid(self) -> bool:
        return float(self._stage.model.opt.density) > 100.0

    def draw(self, place: Array, eye: Array) -> None:
        """
        Draw the water and the background around a place.

        Parameters
        ----------
        place
            Of the vehicle that is followed, world [m], shape (3,); the stage is posed.
        eye
            Of the camera, world [m], shape (3,): above or under the surface.

        """
        self._draw_background(self.is_under(eye))
        if not self.has_surface:
            return
        extent = self._extent
        at = tuple(np.round(place[:2] / extent) * extent)
        moves = self._kind_of_surface() == surface.WAVES
        self._turn = (self._turn + 1) % _EVERY
        if self._water is not None and at == self._water_at and not (moves and self._turn == 0):
            return
        ticks = np.sinh(_SPREAD * np.linspace(-1, 1, _POINTS)) / np.sinh(_SPREAD) * _REACH * extent
        x, y = np.meshgrid(at[0] + ticks, at[1] + ticks)
        points = np.column_stack([x.ravel(), y.ravel()])
        _, heights = self._stage.water(points)
        vertices = np.column_stack([points, heights]).astype(np.float32)
        self._water_at = at
        if self._water is None:
            self._water = self._api.add_mesh_simple(
                '/world/water', vertices, grid_faces(_POINTS, _POINTS), color=_WATER,
                opacity=_WATER_OPACITY, side='double', cast_shadow=False, receive_shadow=False,
            )  # fmt: skip
        else:
            self._water.vertices = vertices

    def _draw_background(self, under: bool) -> None:
        if under == self._under:
            return
        self._under = under
        top, bottom = _DEEP if under else _SKY
        shade = np.linspace(0.0, 1.0, 64)[:, np.newaxis]
        column = (np.array(top) * (1 - shade) + np.array(bottom) * shade).astype(np.uint8)
        self._api.set_background_image(np.repeat(column[:, np.newaxis], 2, axis=1), format='png')
        extent = self._extent
        color = tuple(int(0.5 * (a + b)) for a, b in zip(_DEEP[0], _DEEP[1], strict=True))
        self._api.configure_fog(8 * extent, 70 * extent, color=color, enabled=under)
