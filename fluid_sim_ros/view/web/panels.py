# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The panels of the page: time bar, camera, commands, flow, fluid model."""

import time
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import viser

from fluid_sim_ros.view import orders
from fluid_sim_ros.view.frame import Frame
from fluid_sim_ros.view.source import Source
from fluid_sim_ros.view.web.events import boxed, checked, html, on_user, one_of
from fluid_sim_ros.view.web.forces_panel import ForcesPanel
from fluid_sim_ros.view.web.looks import CAMERAS, Looks

#: Choices of the speed; 0: as fast as it goes.
PACES = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 0.0)
_FREE = 'as fast as it goes'
#: Reach of the sliders of wind and current [m/s], and of a thruster without limits [N].
_MOST_FLOW, _MOST_THRUST = {'wind': 20.0, 'current': 2.0}, 100.0
#: A slider that a user has moved is left alone so long [s].
_LEFT_ALONE = 1.0
KEYS = (
    '**Arrow keys** forward, back, turn; with **Shift** sideways; **Page Up/Down** up and down; '
    'or a gamepad. On release it holds where it is.'
)


class Panels:
    """
    Builds the panels for one vehicle, turns events into orders, and shows numbers.

    Parameters
    ----------
    server
        Of the page.
    source
        Takes the orders.
    looks
        What is drawn; changed by the panels.
    choose
        Called with the name of another vehicle to follow.
    say
        Takes a line for the user: what was refused, and why.

    """

    def __init__(
        self,
        server: viser.ViserServer,
        source: Source,
        looks: Looks,
        choose: Callable[[str], None],
        say: Callable[[str], None],
    ) -> None:
        self._gui, self._source, self._looks = server.gui, source, looks
        self._say = say
        self._touched = 0.0
        self._held: Any = None
        self._sliders: dict[str, Any] = {}
        self._flows: dict[str, list[Any]] = {}
        self._status = self._gui.add_html('')
        self._add_time_bar()
        self._add_camera(choose)
        self.tabs = self._gui.add_tab_group()
        if orders.Thrust in source.takes or orders.Flow in source.takes:
            with self.tabs.add_tab('Steer'):
                self._add_steering()
        with self.tabs.add_tab('Forces'):
            self._forces = ForcesPanel(server, source, looks, say)

    def show(self, frame: Frame, speed: float, remark: str) -> None:
        """
        Show the numbers of a frame.

        Parameters
        ----------
        frame
            The newest.
        speed
            Simulated seconds per second, as measured.
        remark
            The last thing that was said, or empty.

        """
        state = 'paused' if frame.paused else f'{speed:.2g} x'
        lines = [f'<b>t = {frame.time:.2f} s</b> &nbsp; {state}']
        lines += [
            f'<span style="color:#b00020">{html(line)}</span>'
            for line in (frame.note, remark)
            if line
        ]
        self._status.content = boxed('<br>'.join(lines))
        self._play.label = 'Play' if frame.paused else 'Pause'
        if self._seek is not None and abs(self._seek.value - frame.time) > 1e-3:
            self._seek.value = frame.time
        self._forces.show(frame)
        if self._held is not None:
            self._held.value = self._looks.vehicle in frame.steered
        if time.monotonic() - self._touched > _LEFT_ALONE:
            self._show_commands(frame)

    # ---- what is built ---------------------------------------------------------------------

    def _on(self, handle: Any, act: Callable[[Any], None], click: bool = False) -> Any:
        return on_user(handle, act, self._say, click)

    def _add_time_bar(self) -> None:
        takes, source = self._source.takes, self._source
        self._play = self._gui.add_button('Pause', hint='Space')
        self._on(self._play, lambda _: self.toggle(), click=True)
        self._seek: Any = None
        if orders.Step in takes:
            self._on(
                self._gui.add_button('Step', hint='. (20 ms of simulated time)'),
                lambda _: source.take(orders.Step()), click=True,
            )  # fmt: skip
        if orders.Reset in takes:
            self._on(
                self._gui.add_button('Reset', hint='back to the beginning'),
                lambda _: source.take(orders.Reset()), click=True,
            )  # fmt: skip
        if orders.Seek in takes:
            begin, end = source.span
            self._seek = self._gui.add_slider(
                'time [s]', begin, max(end, begin + 1e-3), 0.01, begin
            )
            self._on(self._seek, lambda value: source.take(orders.Seek(checked(value))))
        if orders.Pace in takes:
            names = {_pace_name(pace): pace for pace in PACES}
            first = _pace_name(source.pace)
            if first not in names:
                names = {first: source.pace, **names}
            self._on(
                self._gui.add_dropdown('speed', tuple(names), initial_value=first),
                lambda name: source.take(orders.Pace(_known(names, name))),
            )

    def toggle(self) -> None:
        """Pause or go on."""
        frame = self._source.frame()
        self._source.take(orders.Pause(not (frame is not None and frame.paused)))

    def _add_camera(self, choose: Callable[[str], None]) -> None:
        vehicles = tuple(self._source.vehicles)
        if len(vehicles) > 1:
            self._on(
                self._gui.add_dropdown('vehicle', vehicles, initial_value=self._looks.vehicle),
                lambda name: choose(one_of(vehicles, name)),
            )

        def set_camera(name: Any) -> None:
            self._looks.camera = one_of(CAMERAS, name)

        self._on(
            self._gui.add_dropdown(
                'camera', CAMERAS, initial_value=self._looks.camera, hint='drag to orbit'
            ),
            set_camera,
        )

    def _add_steering(self) -> None:
        source, name = self._source, self._looks.vehicle
        vehicle = source.vehicles[name]
        if orders.Hold in source.takes and vehicle.thrusters:
            self._held = self._gui.add_checkbox('hold and steer', False)
            self._on(self._held, lambda value: self._touch(orders.Hold(name, bool(value))))
        if orders.Steer in source.takes and vehicle.thrusters:
            self._gui.add_markdown(KEYS)
        if orders.Thrust in source.takes and vehicle.thrusters:
            with self._gui.add_folder('thrusters [N]'):
                for i, thruster in enumerate(vehicle.thrusters):
                    low, high = (float(x) for x in vehicle.thrust_range[i])
                    self._add_slider(thruster, low, high, lambda _: self._command_thrust())
        if orders.Joint in source.takes and vehicle.joints:
            with self._gui.add_folder('joints'):
                for i, joint in enumerate(vehicle.joints):
                    low, high = (float(x) for x in vehicle.joint_range[i])
                    self._add_slider(joint, low, high, partial(self._command_joint, joint))
        if orders.Flow in source.takes:
            for stream in source.streams:
                self._add_flow(stream)
        if orders.Rung in source.takes:
            rungs = tuple(source.rungs)
            self._on(
                self._gui.add_dropdown(
                    'fluid', rungs, initial_value=rungs[0],
                    hint='what the vehicle feels; a change begins the flight anew',
                ),
                lambda value: source.take(orders.Rung(one_of(rungs, value))),
            )  # fmt: skip

    def _add_slider(self, name: str, low: float, high: float, act: Callable[[Any], None]) -> None:
        low, high = max(low, -_MOST_THRUST), min(high, _MOST_THRUST)
        step = (high - low) / 400.0
        start = min(max(0.0, low), high)
        slider = self._gui.add_slider(name, low, high, step, start)
        self._sliders[name] = self._on(slider, act)

    def _add_flow(self, stream: str) -> None:
        most = _MOST_FLOW[stream]
        with self._gui.add_folder(f'{stream} [m/s], toward'):
            self._flows[stream] = [
                self._on(
                    self._gui.add_slider(axis, -most, most, most / 100.0, 0.0),
                    lambda _: self._touch(orders.Flow(
                        stream, [checked(slider.value) for slider in self._flows[stream]]
                    )),
                )
                for axis in ('east', 'north', 'up')
            ]  # fmt: skip

    def _command_thrust(self) -> None:
        name = self._looks.vehicle
        thrusters = self._source.vehicles[name].thrusters
        values = [checked(self._sliders[thruster].value) for thruster in thrusters]
        self._touch(orders.Thrust(name, values))

    def _command_joint(self, joint: str, value: Any) -> None:
        self._touch(orders.Joint(self._looks.vehicle, joint, checked(value)))

    def _touch(self, order: orders.Order) -> None:
        self._touched = time.monotonic()
        self._source.take(order)

    # ---- what is shown ---------------------------------------------------------------------

    def _show_commands(self, frame: Frame) -> None:
        vehicle = self._source.vehicles[self._looks.vehicle]
        shown = zip(
            (*vehicle.thrusters, *vehicle.joints), (*vehicle.thruster_ids, *vehicle.joint_ids),
            (*vehicle.thrust_scale, *np.ones(len(vehicle.joints))), strict=True,
        )  # fmt: skip
        for name, actuator, scale in shown:
            value = float(frame.control[actuator]) * float(scale)
            if name in self._sliders and np.isfinite(value):
                slider = self._sliders[name]
                slider.value = min(max(value, slider.min), slider.max)
        for stream, sliders in self._flows.items():
            for slider, value in zip(sliders, frame.flows.get(stream, ()), strict=False):
                slider.value = min(max(float(value), slider.min), slider.max)


def _pace_name(pace: float) -> str:
    return f'{pace:g} x' if pace else _FREE


def _known(names: dict[str, float], name: Any) -> float:
    return names[one_of(tuple(names), name)]
