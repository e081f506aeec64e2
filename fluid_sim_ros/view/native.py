# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""MuJoCo's desktop viewer on a source: the same forces as arrows, drawn by MuJoCo."""

import threading
import time
from typing import Any

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError, FluidSimError
from fluid_sim_ros.output.term_colors import rgb, term_color
from fluid_sim_ros.plugins.drawn_arrow import add_arrow
from fluid_sim_ros.plugins.drawn_waves import add_waves
from fluid_sim_ros.view import orders
from fluid_sim_ros.view.frame import Frame
from fluid_sim_ros.view.source import Source
from fluid_sim_ros.view.stage import Arrow, Stage

#: Pictures a second.
_RATE = 60.0
#: Width of an arrow [extents of the vehicle]; seen from so many of them away.
_WIDTH, _DISTANCE = 0.04, 6.0
#: The window gets so long to close [s].
_LONGEST_END = 5.0
_SPACE, _RIGHT, _BACKSPACE = 32, 262, 259  # key codes of GLFW


class NativeView:
    """
    Shows a source in a window, in a thread of its own.

    Space pauses, the right arrow steps, Backspace resets. MuJoCo's own panels work on what is
    drawn: they change nothing in the simulation.

    Parameters
    ----------
    source
        What is shown.

    Attributes
    ----------
    drawn
        Pictures so far.
    arrows
        How many arrows the last picture had.

    Raises
    ------
    ConfigError
        If no window can be opened here.

    """

    def __init__(self, source: Source) -> None:
        self._source, self.drawn, self.arrows = source, 0, 0
        self._stage = Stage(source.model, source.vehicles)
        self._ended = threading.Event()
        self._open()
        self._thread = threading.Thread(target=self._work, name='native view')

    def start(self) -> None:
        """Begin to draw; the source ends when the window is closed."""
        self._thread.start()

    def close(self) -> None:
        """Close the window."""
        self._ended.set()
        if self._thread.is_alive():
            self._thread.join()
        self._viewer.close()
        for thread in self._windows:
            thread.join(_LONGEST_END)

    def _open(self) -> None:
        import mujoco.viewer

        if not _can_open():
            raise ConfigError(
                '--native: no window can be opened here (no display, or no OpenGL); '
                'without --native the view is a page for a browser'
            )
        before = set(threading.enumerate())
        self._viewer: Any = mujoco.viewer.launch_passive(
            self._stage.model,
            self._stage.data,
            key_callback=self._on_key,
            show_left_ui=False,
            show_right_ui=False,
        )
        # the window's own thread: it must have ended before the process does
        self._windows = [t for t in threading.enumerate() if t not in before]
        name = next(iter(self._source.vehicles))
        with self._viewer.lock():
            camera = self._viewer.cam
            camera.type = mujoco.mjtCamera.mjCAMERA_TRACKING
            camera.trackbodyid = self._source.vehicles[name].body_id
            camera.distance = _DISTANCE * self._stage.extents[name]
            camera.azimuth, camera.elevation = 130.0, -20.0

    def _on_key(self, key: int) -> None:
        frame = self._source.frame()
        paused = frame is not None and frame.paused
        order = {
            _SPACE: orders.Pause(not paused), _RIGHT: orders.Step(), _BACKSPACE: orders.Reset()
        }.get(key)  # fmt: skip
        if order is None or type(order) not in self._source.takes:
            return
        # not in the window's thread, which an answer may take long to reach
        threading.Thread(target=self._do, args=(order,)).start()

    def _do(self, order: orders.Order) -> None:
        try:
            self._source.take(order)
        except FluidSimError:
            return  # such as a divergence, which the source has said

    def _work(self) -> None:
        while not self._ended.is_set():
            begin = time.monotonic()
            if not self._viewer.is_running():
                self._source.stop()
                return
            frame = self._source.frame()
            if frame is not None:
                with self._viewer.lock():
                    self._stage.pose(frame)
                    self._draw(frame)
                self._viewer.sync()
                self.drawn += 1
            self._ended.wait(max(0.0, begin + 1.0 / _RATE - time.monotonic()))

    def _draw(self, frame: Frame) -> None:
        stage, scene = self._stage, self._viewer.user_scn
        mujoco.mj_comPos(stage.model, stage.data)
        mujoco.mj_camlight(stage.model, stage.data)
        scene.ngeom, self.arrows = 0, 0
        for name in stage.vehicles:
            extent = stage.extents[name]
            terms = (*self._source.terms[name], 'thrust', 'weight')
            for arrow in stage.arrows(frame, name, terms, 1.0):
                self._add(scene, arrow, _WIDTH * extent)
        first = next(iter(stage.vehicles.values()))
        add_waves(
            scene, stage.model, stage.data, stage.data.xpos[first.body_id],
            stage.extents[first.name],
        )  # fmt: skip

    def _add(self, scene: Any, arrow: Arrow, width: float) -> None:
        color = np.array([*(part / 255 for part in rgb(term_color(arrow.term))), 1.0])
        label = f'{arrow.term} {arrow.newtons:.3g} N'
        self.arrows += add_arrow(scene, arrow.start, arrow.along, width, color, label)


def _can_open() -> bool:
    """Return whether a window can be opened: a failure of the viewer would end the process."""
    import glfw

    if not glfw.init():
        return False
    glfw.window_hint(glfw.VISIBLE, glfw.FALSE)
    window = glfw.create_window(8, 8, 'fluid_sim', None, None)
    if window is None:
        return False
    glfw.destroy_window(window)
    return True
