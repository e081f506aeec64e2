# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
ArduPilot in lockstep: a servo packet comes in, one frame is simulated, its end is the reply.

The autopilot leads: it says with each packet how long its frame is, in whole microseconds, since
its clock counts those. The frame is split into equal steps no longer than the scene's timestep;
without packets simulated time stands still.

An exchange that is like the one before is one call of the library (``UsualExchange``); all others,
and what is not usual in such a one, are done here.
"""

import socket
import time
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
from fluid_sim_ros.mavlink.ardupilot.station import Station, second_port
from fluid_sim_ros.mavlink.ardupilot.udp_port import Datagram, UdpPort
from fluid_sim_ros.mavlink.ardupilot.usual import UsualExchange
from fluid_sim_ros.mavlink.battery import Battery
from fluid_sim_ros.mavlink.link import SLICE, AutopilotLink, Trouble
from fluid_sim_ros.mavlink.mapping import AutopilotFile
from fluid_sim_ros.mavlink.parameter_check import ParameterCheck, cast_value
from fluid_sim_ros.mavlink.program.parameters import needed_parameters
from fluid_sim_ros.mavlink.silence import REPORT_AFTER, Silence
from fluid_sim_ros.plugins.exchange import ANSWERED, ASK, BEFORE, HEAR, SILENT
from fluid_sim_ros.simulation import Simulation

#: Port of the first instance, and from one instance to the next.
FIRST_PORT, PORT_STEP = 9002, 10
#: ArduPilot adds the difference of two timestamps to its clock and drops what is less than 1 us.
#: Each timestamp is ahead by so much more [s], or rounding would cost 1 us in many frames.
_AHEAD = 1e-10


class ArduPilotBridge(AutopilotLink):
    """
    One ArduPilot at one vehicle.

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
    leads = True

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
        self._station = Station(options.instance)
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
        self._waiting: ServoPacket | None = None  # first packet of a process that has restarted
        self._reply: bytes | None = b''  # None: the library has it
        self._sent_ns = 0
        self._told = 0  # frames that this process has been told the end of
        self._offset_ns = 0  # from simulated time to that of the autopilot

    # ---- the pacing's side -----------------------------------------------------------------

    def begin(self, simulation: Simulation) -> None:
        """Let the autopilot's time go on where a reset has set the simulation's back."""
        self._end_usual()
        self._heard_at = time.monotonic()
        now_ns = simulation.time_ns
        if now_ns + self._offset_ns < self._sent_ns:
            frame_ns = 1000 * frame_us(self._frames.rate) if self._owed else 0
            self._offset_ns = self._sent_ns + frame_ns - now_ns
        if simulation.step_count == 0:  # it has the scene's timestep again
            self._frames.forget()
            if self._battery is not None:
                self._battery.refill()

    def steps_left(self, simulation: Simulation) -> int:
        """Return the steps to the end of the frame."""
        return self._frames.steps_left(simulation)

    def join(self) -> None:
        """Leave the timestep to whoever put several together."""
        self._frames.shared = True

    def offer(self, simulation: Simulation) -> None:
        """Answer where a frame has ended."""
        if self._owed and self._frames.over(simulation):
            if self._usual:
                self._exchange(simulation, ASK)
            else:
                self._answer(simulation)

    def next_ns(self, simulation: Simulation) -> int:
        """Return the simulated time at which the present frame ends [ns]."""
        return self._frames.end_ns

    def meet(self, simulation: Simulation) -> bool:
        """Answer at the end of a frame, and begin the next one with the packet that follows."""
        if not self._frames.over(simulation):
            return True
        if self._usual:
            return self._exchange(simulation, ASK | HEAR if self._owed else HEAR)
        if self._owed:
            self._answer(simulation)
        return self._begin_next(simulation)

    def _begin_next(self, simulation: Simulation) -> bool:
        """Begin the next frame where its packet comes, or where it is not waited for."""
        packet, self._waiting = self._waiting, None
        if packet is None:
            packet = self._next_packet(simulation)
        if packet is None:
            return self._silence.given_up and self._go_on_alone(simulation)
        self._start_frame(simulation, packet)
        return True

    def _values(self) -> dict[str, Any]:
        return {
            'port': self.port, 'peer': _text(self._peer), 'frame_rate_hz': self._frames.rate,
            'frame_count': self._count,
        }  # fmt: skip

    def _trouble(self) -> Trouble | None:
        if self._peer is None:
            return 'warn', f'waiting for ArduPilot on UDP port {self.port}'
        if self._silence.given_up:
            return 'error', 'ArduPilot is silent: going on at real time'
        if self._silence.reported:
            return 'error', 'ArduPilot is silent; simulated time waits for it'
        return None

    def reasons(self) -> list[str]:
        """Return what may be wrong while it has not answered yet, most likely first."""
        reasons = [
            'ArduPilot is not started, or without --model JSON:127.0.0.1',
            f'it is of another instance: it sends to UDP port {FIRST_PORT} + {PORT_STEP} x '
            f'instance (-I), and here it is {self.port}',
            'it runs on another host or in a container: --model JSON:ADDRESS there, '
            '--address here',
        ]
        return [self._station.line, *reasons] if self._station.waits else reasons

    def close(self) -> None:
        """Close the socket."""
        self._check.stop()
        self._port.close()

    # ---- one frame -------------------------------------------------------------------------

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

    # ---- packets ---------------------------------------------------------------------------

    def _next_packet(self, simulation: Simulation) -> ServoPacket | None:
        """Return the packet that begins the next frame, or None when it is not there yet."""
        got, self._later = self._later, None
        if got is None:
            got = self._port.receive(SLICE)
        now = time.monotonic()
        if got is None:
            self._note_silence(now)
            return None
        data, sender = got
        packet = read_servo_packet(data)
        if isinstance(packet, str):
            self._malformed(packet)
            return None
        if sender != self._peer and not self._adopt(sender, now):
            return None
        self._heard_at = now
        self._port.bind_to(sender)
        if packet.count == self._count:
            self.counters.repeated += 1
            self._send_reply()
            return None
        if packet.count < self._count:
            self._restart(simulation, packet)
            return None
        if self._count >= 0:
            self.counters.missed += packet.count - self._count - 1
        return packet

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

    def _adopt(self, sender: Any, now: float) -> bool:
        """Take a new sender as the autopilot, unless the present one is still there."""
        if self._peer is not None and now - self._heard_at < REPORT_AFTER:
            self.counters.strangers += 1
            return False
        self._peer = sender
        self.counters.connections += 1
        self._surroundings.inform(f'ArduPilot at {_text(sender)}')
        self._check.start()
        return True

    def _restart(self, simulation: Simulation, packet: ServoPacket) -> None:
        """Begin anew with a process whose frames count from the start again."""
        self.counters.restarts += 1
        self._surroundings.inform('ArduPilot has restarted: back to the start')
        self._sent_ns = self._offset_ns = self._told = 0
        self._count, self._reply = -1, b''
        self._owed = False
        self._surroundings.reset()
        self._frames.forget()
        self._frames.end_here(simulation)
        self._waiting = packet

    def _note_silence(self, now: float) -> None:
        if self._peer is None:
            if self._station.look():
                self._surroundings.report('station', self._station.line)
        else:
            if not self._silence.reported:
                self._silent_at = self._heard_at
            if now - self._heard_at >= REPORT_AFTER:
                self._port.bind_to(None)  # another process may be its successor
            self._silence.lasts(now - self._heard_at)


def _text(sender: Any) -> str:
    return f'{sender[0]}:{sender[1]}' if sender else ''
