# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The usual exchange with PX4, in one call of the library; ``Px4Bridge`` is its twin."""

import ctypes

from fluid_sim_ros.mavlink.actuator_map import ActuatorMap
from fluid_sim_ros.mavlink.battery import Battery
from fluid_sim_ros.mavlink.link import SLICE
from fluid_sim_ros.mavlink.px4.hil_answers import ARMED
from fluid_sim_ros.mavlink.px4.hil_messages import HilWriter
from fluid_sim_ros.mavlink.px4.hil_sensor import CompiledReadings
from fluid_sim_ros.mavlink.px4.hil_state import HilState
from fluid_sim_ros.mavlink.sockets import is_alone
from fluid_sim_ros.plugins.exchange import (
    ASK,
    OBSERVED,
    Observer,
    Peer,
    Px4Exchange,
    exchange_library,
)
from fluid_sim_ros.simulation import Simulation


class UsualExchange:
    """
    Sends the sensors, hears their answer and commands what it says.

    Parameters
    ----------
    simulation
        What is flown.
    state
        What PX4 gets to know; with readings of the library.
    actuators, battery
        What its outputs drive, and what that draws on.
    period
        From one exchange to the next [s].

    Attributes
    ----------
    peer
        The other end of its socket.
    usable
        Whether the readings are the library's.

    """

    def __init__(
        self,
        simulation: Simulation,
        state: HilState,
        actuators: ActuatorMap,
        battery: Battery | None,
        period: float,
    ) -> None:
        self._simulation, self._state = simulation, state
        readings = state.readings
        self.usable = isinstance(readings, CompiledReadings)
        self._all = Px4Exchange(
            observer=Observer(*simulation.observe_addresses), period=period,
            peer=Peer(socket=-1, alone=is_alone()), driven=ctypes.addressof(actuators.driven),
            battery=ctypes.addressof(battery.state) if battery else None,
        )  # fmt: skip
        if isinstance(readings, CompiledReadings):
            self._readings = readings
            self._all.sensors = readings.address
        self._address = ctypes.addressof(self._all)
        self.peer: Peer = self._all.peer
        self._run = exchange_library().px4_exchange
        self._others = b''

    def connect(self, socket: int, writer: HilWriter) -> None:
        """
        Speak to another client.

        Parameters
        ----------
        socket
            File descriptor of its connection, which does not block.
        writer
            Numbers the messages of that connection.

        """
        self.peer.socket = socket
        self.peer.quick = 0
        self._writer = writer
        self._all.system, self._all.component = writer.ids

    def run(self, phases: int, now_us: int) -> int:
        """
        Ask and hear, or one of both.

        Parameters
        ----------
        phases
            ``ASK``, ``HEAR`` or both.
        now_us
            Time by the autopilot's clock [us].

        Returns
        -------
        int
            What was found, within a slice of time: ``ANSWERED`` and so on of plugins/exchange.py.

        """
        tick, number, others = self._simulation.tick, 0, b''
        if phases & ASK:
            state, writer = self._state, self._writer
            others, observed = state.besides(writer, now_us)
            if observed:
                phases |= OBSERVED
            if state.vision:
                self._readings.give(state.pressure)
            self._others, number = others, writer.number()
        size = len(others)
        while (
            found := self._run(self._address, phases, tick, now_us, number, others, size, SLICE)
        ) < 0:
            phases |= OBSERVED
            self._readings.draw(found, tick)
        return found

    @property
    def armed(self) -> bool:
        """Whether the last answer was one of an armed PX4."""
        return bool(self._all.answer.mode & ARMED)

    def heard(self) -> bytes:
        """Return what has come."""
        return ctypes.string_at(self._all.portion, self._all.size)

    def unsent(self) -> bytes:
        """Return what PX4 has not taken of what was last sent."""
        whole = ctypes.string_at(self._all.frame, self._all.frame_size) + self._others
        return whole[self._all.sent :]
