# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What makes films look like a place: ground to the horizon, sky, and water."""

import mujoco
import numpy as np

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import surface
from fluid_sim_ros.plugins.drawn_waves import WATER, add_waves
from fluid_sim_ros.plugins.translucent import translucent_geoms

#: Under water things fade between these distances [extents of the vehicle], to this colour.
_CLEAR, _LOST, _DEEP = 4.0, 70.0, np.array([0.05, 0.26, 0.34])
#: Sky over the horizon and overhead; the deep below what the horizon is.
_HORIZON, _ZENITH, _ABYSS = (np.array(c) for c in ((0.76, 0.85, 0.93), (0.35, 0.52, 0.75),
                                                   (0.02, 0.1, 0.15)))  # fmt: skip
#: Both meet within this sine of the elevation.
_BLEND = 0.01
#: Faces of a sky that show what is overhead, and what is below.
_UP, _DOWN = 2, 3
#: A level surface reaches to this share of what is drawn farthest, and is so thin [extents].
_REACH, _THIN = 0.7, 1e-3
_HIDDEN = 5
#: A fluid without a surface is a liquid above this density [kg/m^3].
_LIQUID = 100.0


class Scenery:
    """
    Dresses the pictures of a model.

    Parameters
    ----------
    model
        Its looks are changed: planes of the world reach the horizon, bodies of water that stand
        still give way to the surface as it moves, the sky ends at the water.
    data
        Of the model.
    extent
        Of the vehicle that is followed [m].

    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, extent: float) -> None:
        self._model, self._data, self._extent = model, data, extent
        self._kind, _ = surface.surface_heights(model, data, np.zeros((1, 2)))
        still = model.body_weldid[model.geom_bodyid] == 0
        model.geom_size[still & (model.geom_type == mujoco.mjtGeom.mjGEOM_PLANE), :2] = 0.0
        if self._kind != surface.NO_SURFACE:
            model.geom_group[still & translucent_geoms(model)] = _HIDDEN
        _end_the_sky(model, self._kind != surface.NO_SURFACE)
        size = float(model.stat.extent)
        model.vis.map.fogstart, model.vis.map.fogend = (
            _CLEAR * extent / size, _LOST * extent / size
        )  # fmt: skip
        model.vis.rgba.fog[:3] = _DEEP

    def dress(self, scene: mujoco.MjvScene, center: Array) -> None:
        """
        Add the water around a point, and let the view end in it where the eye is under.

        Parameters
        ----------
        scene
            With its cameras set.
        center
            Middle of the picture, world [m], shape (3,).

        """
        eye = np.mean([camera.pos for camera in scene.camera], axis=0)
        _, (height,) = surface.surface_heights(self._model, self._data, eye[np.newaxis, :2])
        under = eye[2] < height
        if self._kind == surface.NO_SURFACE:
            under = float(self._model.opt.density) > _LIQUID
        elif self._kind == surface.LEVEL:
            self._add_level(scene, center, float(height))
        else:
            add_waves(scene, self._model, self._data, center, self._extent)
        scene.flags[mujoco.mjtRndFlag.mjRND_FOG] = int(under)

    def _add_level(self, scene: mujoco.MjvScene, center: Array, height: float) -> None:
        if scene.ngeom >= scene.maxgeom:
            return
        reach = _REACH * float(self._model.vis.map.zfar) * float(self._model.stat.extent)
        mujoco.mjv_initGeom(
            scene.geoms[scene.ngeom], mujoco.mjtGeom.mjGEOM_BOX,
            np.array([reach, reach, _THIN * self._extent]),
            np.array([center[0], center[1], height]), np.eye(3).ravel(), WATER,
        )  # fmt: skip
        scene.ngeom += 1


def _end_the_sky(model: mujoco.MjModel, at_the_water: bool) -> None:
    """
    Have the ground fade into the sky, or the sky end at the water.

    Of a gradient between two colours, which most models have for a sky.
    """
    for texture in range(model.ntex):
        width, channels = int(model.tex_width[texture]), int(model.tex_nchannel[texture])
        whole = int(model.tex_height[texture]) == 6 * width  # right, left, up, down, front, back
        if model.tex_type[texture] != mujoco.mjtTexture.mjTEXTURE_SKYBOX or not whole:
            continue
        begin, size = int(model.tex_adr[texture]), 6 * width * width * channels
        faces = model.tex_data[begin : begin + size].reshape(6, width, width, channels)
        top, bottom = (faces[i, ..., :3].mean(axis=(0, 1)) for i in (_UP, _DOWN))
        model.vis.rgba.haze[:3] = _DEEP if at_the_water else 0.5 * (top + bottom) / 255
        if at_the_water:
            for face, rise in enumerate(_rises(width)):
                faces[face, ..., :3] = np.round(255 * _sky_over_water(rise))


def _rises(width: int) -> list[Array]:
    """Return the sine of the elevation of each pixel of the six faces."""
    across = (2 * np.arange(width) + 1) / width - 1
    u, v = np.meshgrid(across, across)
    length = np.sqrt(1 + u * u + v * v)
    side = -v / length
    return [side, side, 1 / length, -1 / length, side, side]


def _sky_over_water(rise: Array) -> Array:
    """Return the colour at a sine of elevation, shape (..., 3), 0 to 1."""
    up, down = np.clip(rise, 0, 1)[..., np.newaxis], np.clip(-rise, 0, 1)[..., np.newaxis]
    sky = _HORIZON + up**0.6 * (_ZENITH - _HORIZON)
    deep = _DEEP + down**0.5 * (_ABYSS - _DEEP)
    share = np.clip(0.5 + rise / (2 * _BLEND), 0, 1)[..., np.newaxis]
    colour: Array = deep + share * (sky - deep)
    return colour
