# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Pictures of a pinhole camera, drawn without a display: by MuJoCo's renderer through EGL."""

import atexit
import copy
import weakref
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins.renderer import bound_buffers, by_egl
from fluid_sim_ros.plugins.translucent import translucent_geoms

#: Nothing nearer is drawn [m], nor farther, in sizes of the model and at least so far [m].
_NEAR, _FAR, _LEAST_FAR = 0.01, 50.0, 1000.0
#: Most samples per pixel of a colour picture, and the largest side of maps of shadows [pixels].
_SAMPLES, _SHADOWS = 4, 1024
#: Geoms of a picture that are not the model's: the triangles of waves.
_MORE_GEOMS = 6000
#: Group of the geoms that are not drawn.
_HIDDEN = 5
#: Flags without which distances are of less accuracy far away, as in MuJoCo's own renderer.
_SEGMENT = mujoco.mjtRndFlag.mjRND_SEGMENT.value, mujoco.mjtRndFlag.mjRND_IDCOLOR.value


@dataclass(frozen=True)
class Pinhole:
    """
    The geometry of a picture.

    Attributes
    ----------
    width, height
        [pixels].
    focal
        Focal length [pixels], the same across and down; the axis goes through the middle.

    """

    width: int
    height: int
    focal: float


class Offscreen:
    """
    Draws pictures of one kind; made and used in one thread, or in several one after another.

    The model is copied, since sizes of pictures are part of it.

    Parameters
    ----------
    model
        What is drawn.
    pinhole
        The camera.
    distances
        Whether pictures hold distances along the axis [m] instead of colours. What is translucent
        has none: light that measures goes through water.

    Raises
    ------
    ConfigError
        If nothing can be drawn here; in one line.

    """

    def __init__(self, model: mujoco.MjModel, pinhole: Pinhole, distances: bool) -> None:
        self._model = model = copy.copy(model)
        self._pinhole, self._distances = pinhole, distances
        width, height = pinhole.width, pinhole.height
        # a mean of several samples of a distance would be a distance of nothing
        samples = 0 if distances else _SAMPLES
        bound_buffers(model, width, height, shadows=_SHADOWS, samples=samples)
        with by_egl(f'no picture of {width} x {height} pixels can be drawn here: '):
            from mujoco.egl import GLContext

            self._gl: Any = GLContext(width, height)
            with self._gl.as_current():
                self._context = mujoco.MjrContext(model, mujoco.mjtFontScale.mjFONTSCALE_100.value)
                mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN.value, self._context)
                self._context.readDepthMap = mujoco.mjtDepthMap.mjDEPTH_ZEROFAR
        _keep(self)
        self._scene = mujoco.MjvScene(model, model.ngeom + _MORE_GEOMS)
        self._option = mujoco.MjvOption()
        self._option.sitegroup[:] = 0  # marks for people, which no camera sees
        if distances:
            for flag in _SEGMENT:
                self._scene.flags[flag] = 1
            model.geom_group[translucent_geoms(model)] = _HIDDEN
            self._option.geomgroup[_HIDDEN] = 0
        self._rect = mujoco.MjrRect(0, 0, width, height)
        self._far = max(_LEAST_FAR, _FAR * float(model.stat.extent))
        self._buffer = (
            np.zeros((height, width), np.float32)
            if distances
            else np.zeros((height, width, 3), np.uint8)
        )

    def look(self, data: mujoco.MjData, place_w: Array, axes_w: Array) -> mujoco.MjvScene:
        """
        Take the scene as it is seen now; more may be added to what is returned.

        Parameters
        ----------
        data
            Of the model, with the places of its geoms.
        place_w
            Of the camera, world [m], shape (3,).
        axes_w
            Its axis and what is up in the picture, world, shape (2, 3).

        Returns
        -------
        mujoco.MjvScene
            What ``picture`` draws.

        """
        scene, pinhole = self._scene, self._pinhole
        mujoco.mjv_updateScene(
            self._model, data, self._option, None, mujoco.MjvCamera(),
            mujoco.mjtCatBit.mjCAT_ALL.value, scene,
        )  # fmt: skip
        across, down = (
            _NEAR * side / 2 / pinhole.focal for side in (pinhole.width, pinhole.height)
        )
        for eye in scene.camera:
            eye.pos[:], (eye.forward[:], eye.up[:]) = place_w, axes_w
            eye.frustum_near, eye.frustum_far = _NEAR, self._far
            eye.frustum_top, eye.frustum_bottom = down, -down
            eye.frustum_center, eye.frustum_width, eye.orthographic = 0.0, across, 0
        for light in (scene.lights[i] for i in range(scene.nlight)):
            if light.headlight:
                light.pos[:], light.dir[:] = place_w, axes_w[0]
        return scene

    def picture(self) -> NDArray[Any]:
        """
        Return what was looked at last.

        Returns
        -------
        NDArray
            Red, green and blue (uint8, shape (height, width, 3)), or distances along the axis [m]
            (float32, shape (height, width)), inf where there is nothing; from the top left, and
            overwritten by the next picture.

        """
        buffer = self._buffer
        colours, depths = (None, buffer) if self._distances else (buffer, None)
        with self._gl.as_current():
            mujoco.mjr_render(self._rect, self._scene, self._context)
            mujoco.mjr_readPixels(colours, depths, self._rect, self._context)
        if not self._distances:
            return buffer[::-1]
        # the reversed map is near (far - z) / (z (far - near)) of the distance z, 0 at the far end
        near, far = _NEAR, self._far
        with np.errstate(divide='ignore'):
            distances = near * far / (buffer[::-1].astype(np.float64) * (far - near) + near)
        distances[buffer[::-1] == 0.0] = np.inf
        result: NDArray[Any] = distances.astype(np.float32)
        return result

    def close(self) -> None:
        """Give back what the graphics driver holds."""
        if self._gl is not None:
            with self._gl.as_current():
                self._context.free()
            self._gl.free()
            self._gl = None

    def __del__(self) -> None:
        if getattr(self, '_gl', None) is not None:
            self.close()


#: What must be given back before EGL ends, which it does at the interpreter's exit.
_open: 'weakref.WeakSet[Offscreen]' = weakref.WeakSet()


def _keep(made: Offscreen) -> None:
    if not _open:
        atexit.unregister(_close_all)
        atexit.register(_close_all)  # behind EGL's own, and so before it
    _open.add(made)


def _close_all() -> None:
    for each in list(_open):
        each.close()
