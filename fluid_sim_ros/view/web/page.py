# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The page: draws the newest frame of a source for every browser that looks."""

import threading
import time
from collections.abc import Callable

from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.output.throttled_log import ThrottledLog
from fluid_sim_ros.view import orders
from fluid_sim_ros.view.frame import Frame
from fluid_sim_ros.view.source import Source
from fluid_sim_ros.view.stage import Stage
from fluid_sim_ros.view.web.front import Server
from fluid_sim_ros.view.web.looks import Looks
from fluid_sim_ros.view.web.panels import Panels
from fluid_sim_ros.view.web.plots import Plots
from fluid_sim_ros.view.web.scene import Scene
from fluid_sim_ros.view.web.steering import Steering, script

#: Pictures a second that are sent, and updates a second of numbers and of plots.
RATE, _NUMBERS_RATE, _PLOTS_RATE = 24.0, 4.0, 2.0
#: Of a simulation that goes as fast as it can: every picture takes time from it.
_FREE_RATE = 6.0
#: Without a browser nothing is drawn; so often it is looked for one [s].
_IDLE = 0.1
#: What was said stays on the page so long [s].
_SAID = 8.0


class Page:
    """
    Draws a source's frames in a thread of its own, while browsers look.

    Parameters
    ----------
    source
        What is shown.
    host, port
        Where the page is served; see ``web.front``.
    say
        Takes the lines that are worth a word on the console too.

    Attributes
    ----------
    url
        Of the page.
    drawn
        Pictures that were sent so far.

    Raises
    ------
    ConfigError
        If the port is in use.

    """

    def __init__(
        self,
        source: Source,
        host: str,
        port: int,
        say: Callable[[str], None] = lambda line: None,
    ) -> None:
        self._source, self._say_aloud = source, say
        self._looks = Looks(next(iter(source.vehicles)))
        title = f'fluid_sim: {source.title}'
        self._report = report = ThrottledLog(say)
        if orders.Steer in source.takes:
            keys = Steering(source, lambda: self._looks.vehicle, self._say)
            self.server = Server(host, port, title, keys.serve, script(), report)
        else:
            self.server = Server(host, port, title, report=report)
        self.url, self.drawn = self.server.url, 0
        self._generation = -1
        self._remark, self._remark_at = '', 0.0
        self._ended = threading.Event()
        self._build_anew = threading.Event()
        self._pace: tuple[float, float] | None = None
        self._speed = 0.0
        self._build()
        self._thread = threading.Thread(target=self._work, name='page')

    def start(self) -> None:
        """Begin to draw."""
        self._thread.start()

    def close(self) -> None:
        """End drawing, and close every connection."""
        self._ended.set()
        if self._thread.is_alive():
            self._thread.join()
        self.server.close()

    # ---- building --------------------------------------------------------------------------

    def _build(self) -> None:
        """Build scene and panels for the source's present model."""
        source, viser = self._source, self.server.viser
        self._generation = source.generation
        self._stage = Stage(source.model, source.vehicles)
        frame = source.frame()
        if frame is not None:
            self._stage.pose(frame)
        viser.gui.reset()
        self._add_hotkeys()
        self._scene = Scene(viser, self._stage, self._looks)
        self._panels = Panels(viser, source, self._looks, self._choose, self._say)
        name = self._looks.vehicle
        with self._panels.tabs.add_tab('Plots'):
            self._plots = Plots(viser, source.vehicles, name, source.terms[name])

    def _choose(self, vehicle: str) -> None:
        self._looks.vehicle = vehicle
        self._build_anew.set()

    def _say(self, line: str) -> None:
        self._remark, self._remark_at = line, time.monotonic()
        self._say_aloud(line)

    def _add_hotkeys(self) -> None:
        commands = self.server.viser.gui

        def add(label: str, key: str, act: Callable[[], None]) -> None:
            def react(_: object) -> None:
                try:
                    act()
                except FluidSimError as error:
                    self._say(str(error))

            commands.add_command(label, hotkey=key).on_trigger(react)

        add('Play or pause', 'space', lambda: self._panels.toggle())
        if orders.Step in self._source.takes:
            add('Step', 'enter', lambda: self._source.take(orders.Step()))

    # ---- drawing ---------------------------------------------------------------------------

    def _work(self) -> None:
        next_numbers = next_plots = 0.0
        last: Frame | None = None
        while not self._ended.is_set():
            begin = time.monotonic()
            self._report.flush()
            if not self.server.viser.get_clients():
                self._pace = None
                self._ended.wait(_IDLE)
                continue
            if self._build_anew.is_set() or self._generation != self._source.generation:
                self._build_anew.clear()
                self._build()
                last = None
            frame = self._source.frame()
            if frame is not None and frame is not last and len(frame.qpos) == self._stage.model.nq:
                last = frame
                self._draw(frame)
            if last is not None and begin >= next_numbers:
                next_numbers = begin + 1.0 / _NUMBERS_RATE
                self._measure(last.time, begin)
                remark = self._remark if begin - self._remark_at < _SAID else ''
                self._panels.show(last, self._speed, remark)
            if begin >= next_plots:
                next_plots = begin + 1.0 / _PLOTS_RATE
                self._plots.show()
            rate = RATE if self._source.pace else _FREE_RATE
            self._ended.wait(max(0.0, begin + 1.0 / rate - time.monotonic()))

    def _draw(self, frame: Frame) -> None:
        self._stage.pose(frame)
        self._scene.draw(frame)
        self._plots.add(frame)
        self.drawn += 1

    def _measure(self, simulated: float, now: float) -> None:
        """Measure how fast simulated time passes."""
        if self._pace is not None and simulated >= self._pace[0]:
            self._speed = (simulated - self._pace[0]) / max(now - self._pace[1], 1e-6)
        self._pace = (simulated, now)
