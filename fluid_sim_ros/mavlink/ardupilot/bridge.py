# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
ArduPilot in lockstep: a servo packet comes in, one frame is simulated, its end is the reply.

The autopilot leads: it says with each packet how long its frame is, in whole microseconds, since
its clock counts those. The frame is split into equal steps no longer than the scene's timestep;
without packets simulated time stands still.
"""

import time
from typing import Any

from fluid_sim_ros.loop.autopilot_port import AutopilotOptions, Surroundings
from fluid_sim_ros.mavlink.actuator_map import ActuatorMap
from fluid_sim_ros.mavlink.ardupilot.exchanges import FIRST_PORT, PORT_STEP, ArduPilotExchanges
from fluid_sim_ros.mavlink.ardupilot.frames import frame_us
from fluid_sim_ros.mavlink.ardupilot.json_packets import ServoPacket, read_servo_packet
from fluid_sim_ros.mavlink.ardupilot.station import Station
from fluid_sim_ros.mavlink.link import SLICE, Trouble
from fluid_sim_ros.mavlink.mapping import AutopilotFile
from fluid_sim_ros.mavlink.silence import REPORT_AFTER
from fluid_sim_ros.plugins.exchange import ASK, HEAR
from fluid_sim_ros.simulation import Simulation


class ArduPilotBridge(ArduPilotExchanges):
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
        self._station = Station(options.instance)
        self._waiting: ServoPacket | None = None  # first packet of a process that has restarted

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
