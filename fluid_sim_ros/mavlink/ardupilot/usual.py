# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The usual exchange with ArduPilot as one call of the library; the bridge is its twin."""

import ctypes
import socket
import struct
from typing import Any

from fluid_sim_ros.mavlink.actuator_map import ActuatorMap
from fluid_sim_ros.mavlink.ardupilot.json_state import ReplyWriter
from fluid_sim_ros.mavlink.ardupilot.udp_port import Datagram
from fluid_sim_ros.mavlink.battery import Battery
from fluid_sim_ros.mavlink.link import SLICE
from fluid_sim_ros.mavlink.sockets import is_alone
from fluid_sim_ros.plugins.exchange import (
    ASK,
    OBSERVED,
    ArduPilotExchange,
    Observer,
    Peer,
    Sender,
    exchange_library,
)
from fluid_sim_ros.simulation import Simulation

#: Behind the family in a ``sockaddr``: port, and the address; of IPv6 flow before and scope behind
#: it. https://man7.org/linux/man-pages/man7/ipv6.7.html
_IPV4, _IPV6 = struct.Struct('!2xH4s'), struct.Struct('!2xHI16s')
_SCOPE = struct.Struct('=24xI')


class UsualExchange:
    """
    Sends the state at the end of a frame, hears the next packet and commands what it says.

    Parameters
    ----------
    simulation
        What is flown.
    state
        What ArduPilot gets to know.
    actuators, battery
        What its outputs drive, and what that draws on.

    Attributes
    ----------
    peer
        The other end of its socket.

    """

    def __init__(
        self,
        simulation: Simulation,
        state: ReplyWriter,
        actuators: ActuatorMap,
        battery: Battery | None,
    ) -> None:
        self._simulation, self._state = simulation, state
        self._all = ArduPilotExchange(
            observer=Observer(*simulation.observe_addresses), state=state.address,
            driven=ctypes.addressof(actuators.driven), peer=Peer(socket=-1, alone=is_alone()),
            battery=ctypes.addressof(battery.state) if battery else None,
        )  # fmt: skip
        self._address = ctypes.addressof(self._all)
        self.peer: Peer = self._all.peer
        self._run = exchange_library().ardupilot_exchange
        self._connected = exchange_library().ardupilot_connected

    def connect(self, socket: int, peer: Any, rate: int, seconds: float) -> bool:
        """
        Speak on a socket, at a rate of frames.

        Parameters
        ----------
        socket
            File descriptor, which does not block.
        peer
            Address that Python's sockets gave.
        rate, seconds
            Frames per second [Hz], and how long one lasts [s].

        Returns
        -------
        bool
            Whether the socket hears this peer alone.

        """
        self.peer.socket = socket
        self._all.rate, self._all.seconds = rate, seconds
        return bool(self._connected(self._address)) and _place(self._all.autopilot) == peer

    def run(self, phases: int, time_s: float, count: int) -> int:
        """
        Ask and hear, or one of both.

        Parameters
        ----------
        phases
            ``ASK``, ``HEAR`` or both.
        time_s
            Time of the state by the autopilot's clock [s].
        count
            Number of the packet that is to come.

        Returns
        -------
        int
            What was found, within a slice of time: ``ANSWERED`` and so on of plugins/exchange.py.

        """
        tick = self._simulation.tick
        if phases & ASK:
            self._state.take_sticks()
        while (found := self._run(self._address, phases, tick, time_s, count, SLICE)) < 0:
            phases |= OBSERVED
            self._state.draw(found, tick)
        return found

    def reply(self) -> bytes:
        """Return the last reply."""
        return ctypes.string_at(self._all.reply, self._all.reply_size)

    def heard(self) -> Datagram:
        """Return what has come, and its sender as Python's sockets have it."""
        whole, sender = self._all, self._all.sender
        return ctypes.string_at(whole.packet, whole.size), _place(sender)


def _place(sender: Sender) -> Any:
    """Return host and port of an address, and of IPv6 flow and scope."""
    address = bytes(sender.address)[: sender.size]
    (family,) = struct.unpack_from('=H', address)
    if family == socket.AF_INET:
        port, host = _IPV4.unpack_from(address)
        return socket.inet_ntop(family, host), port
    port, flow, host = _IPV6.unpack_from(address)
    return socket.inet_ntop(family, host), port, flow, *_SCOPE.unpack_from(address)
