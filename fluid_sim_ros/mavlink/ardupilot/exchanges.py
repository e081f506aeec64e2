# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The exchanges with an ArduPilot: the state at the end of a frame out, the next packet in.

One that is like the one before is one call of the library (``UsualExchange``); all others, and
what is not usual in such a one, are done here.
"""

import socket
import time
from abc import abstractmethod
from typing import Any

from fluid_sim_ros.loop.autopilot_port import AutopilotOptions, Surroundings
from fluid_sim_ros.mavlink.actuator_map import ActuatorMap
from fluid_sim_ros.mavlink.ardupilot.frames import Frames, frame_us
from fluid_sim_ros.mavlink.ardupilot.json_packets import (
    LONGEST_PACKET,
    RC_CHANNELS,
    ServoPacket,
    read_servo_packet,
)
from fluid_sim_ros.mavlink.ardupilot.json_state import ReplyWriter
from fluid_sim_ros.mavlink.ardupilot.station import second_port
from fluid_sim_ros.mavlink.ardupilot.udp_port import Datagram, UdpPort
from fluid_sim_ros.mavlink.ardupilot.usual import UsualExchange
from fluid_sim_ros.mavlink.battery import Battery
from fluid_sim_ros.mavlink.link import SLICE, AutopilotLink
from fluid_sim_ros.mavlink.mapping import AutopilotFile
from fluid_sim_ros.mavlink.parameter_check import ParameterCheck, cast_value
from fluid_sim_ros.mavlink.program.parameters import needed_parameters
from fluid_sim_ros.mavlink.silence import Silence
from fluid_sim_ros.plugins.exchange import ANSWERED, ASK, BEFORE, HEAR, SILENT
from fluid_sim_ros.simulation import Simulation

#: Port of the first instance, and from one instance to the next.
FIRST_PORT, PORT_STEP = 9002, 10
#: ArduPilot adds the difference of two timestamps to its clock and drops what is less than 1 us.
#: Each timestamp is ahead by so much more [s], or rounding would cost 1 us in many frames.
_AHEAD = 1e-10


class ArduPilotExchanges(AutopilotLink):
    """
    The exchanges of one ArduPilot at one vehicle; ``ArduPilotBridge`` says whose packets count.

    Parameters
    ----------
    simulation, options, surroundings, actuators
        As for ``AutopilotLink``.
    file
        The rest of the mapping.

    Raises
    ------
    ConfigError
        If the port is in use.

    """

    name, protocol = 'ArduPilot', 'ardupilot'
    channels = RC_CHANNELS

    def __init__(
        self,
        simulation: Simulation,
        options: AutopilotOptions,
        surroundings: Surroundings,
        actuators: ActuatorMap,
        file: AutopilotFile,
    ) -> None:
        super().__init__(simulation, options, surroundings, actuators, file)
        limits = simulation.vehicle(options.vehicle).thrust_range[:, 1].tolist()
        self._battery = Battery(file.battery, limits) if file.battery else None
        self._state = ReplyWriter(simulation, options.vehicle, self._sticks, self._battery)
        self._whole = UsualExchange(simulation, self._state, actuators, self._battery)
        self.peer = self._whole.peer
        self._frames = Frames(simulation.timestep, surroundings.log)
        port = options.port or FIRST_PORT + PORT_STEP * options.instance
        self._port = UdpPort(options.address, port, LONGEST_PACKET)
        self.port = self._port.port
        self._peer: Any = None
        second = second_port(options.instance)
        self._check = ParameterCheck(
            self.name, needed_parameters(file, options.parameters), 1,
            lambda: socket.create_connection(second, SLICE), cast_value,
            f'TCP port {second[1]}',
        )  # fmt: skip
        self._heard_at = self._silent_at = 0.0
        self._silence = Silence(self.name, options, surroundings, self.counters)
        self._count = -1
        self._owed = False  # the autopilot waits for the state at the frame's end
        self._later: Datagram | None = None  # came while the repeated ones were looked through
        self._reply: bytes | None = b''  # None: the library has it
        self._sent_ns = 0
        self._told = 0  # frames that this process has been told the end of
        self._offset_ns = 0  # from simulated time to that of the autopilot

    @abstractmethod
    def _begin_next(self, simulation: Simulation) -> bool:
        """Begin the next frame where its packet comes, or where it is not waited for."""

    @abstractmethod
    def _note_silence(self, now: float) -> None:
        """Note that nothing has come by now [s]."""

    def _exchange(self, simulation: Simulation, phases: int) -> bool:
        """Ask, hear or both as in the exchange before; True when the simulation may go on."""
        time_s = 0.0
        if phases & ASK:
            time_s = self._next_time(simulation)
            self._reply = None
        found = self._whole.run(phases, time_s, self._count + 1)
        if found != ANSWERED:
            return self._look_closer(simulation, found, phases)
        if phases & HEAR:
            self._heard_at = time.monotonic()
            self._frames.begin(simulation, self._frames.rate)
            self.counters.answered += 1
            self._report_check()
            self._count += 1
            self._driven()
            self._owed = True
        return True

    def _look_closer(self, simulation: Simulation, found: int, phases: int) -> bool:
        """Go on with an exchange in which something was not usual, as with any other."""
        self._end_usual()
        if found == SILENT:
            self._note_silence(time.monotonic())
            return self._silence.given_up and self._go_on_alone(simulation)
        if found == BEFORE:
            self._sort(self._whole.heard())
            self._drop_repeated()
            self._send_reply()
        else:
            self._later = self._whole.heard()
        return phases & HEAR == 0 or self._begin_next(simulation)

    def _end_usual(self) -> None:
        self._usual = False
        if self._reply is None:
            self._reply = self._whole.reply()

    def _send_reply(self) -> None:
        if self._reply:
            self._port.send(self._reply, self._peer)

    def _next_time(self, simulation: Simulation) -> float:
        """Return the time of the state that is now sent, by the autopilot's clock [s]."""
        self._sent_ns = simulation.time_ns + self._offset_ns
        self._told += 1
        self._owed = False
        self.counters.sent += 1
        return self._sent_ns * 1e-9 + self._told * _AHEAD

    def _answer(self, simulation: Simulation) -> None:
        self._reply = self._state.reply(self._next_time(simulation))
        self._drop_repeated()
        self._send_reply()

    def _start_frame(self, simulation: Simulation, packet: ServoPacket) -> None:
        if self._silence.given_up:  # its clock has stood still meanwhile
            self._offset_ns = self._sent_ns - simulation.time_ns
        if self._silence.reported:
            self._silence.ends(time.monotonic() - self._silent_at)
        self._frames.begin(simulation, packet.rate)
        if self._count >= 0:
            self.counters.answered += 1
        self._report_check()
        self._count = packet.count
        self._drive(packet.pulses)
        seconds = 1e-6 * frame_us(packet.rate)
        if self._battery is not None:
            self._battery.draw(self._actuators.last[0], seconds)
        self._owed = True
        self._usual = self._later is None and self._whole.connect(
            self._port.socket, self._peer, packet.rate, seconds
        )

    def _report_check(self) -> None:
        for key, line in self._check.lines().items():
            self._surroundings.report(key, line)

    def _go_on_alone(self, simulation: Simulation) -> bool:
        """Begin a while at real time (it was waited for as long), with everything at rest."""
        self._commands.set(*self._actuators.rest)
        self._owed = False
        self._frames.go_on(simulation, SLICE)
        return True

    def _drop_repeated(self) -> None:
        """
        Drop the questions that were repeated meanwhile, as after a pause: one answer serves all.

        ArduPilot would take each further answer for that of a later frame.
        """
        while self._later is None and (got := self._port.receive(0.0)) is not None:
            self._sort(got)

    def _sort(self, got: Datagram) -> None:
        """Count a question that is repeated; keep any other."""
        packet = read_servo_packet(got[0])
        same = isinstance(packet, ServoPacket) and packet.count == self._count
        if same and got[1] == self._peer:
            self.counters.repeated += 1
        else:
            self._later = got
