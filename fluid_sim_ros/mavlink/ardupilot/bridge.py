"""
ArduPilot in lockstep: a servo packet comes in, one frame is simulated, its end is the reply.

The autopilot leads: it says with each packet how long its frame is. The frame is split into equal
steps no longer than the scene's timestep; without packets simulated time stands still.
"""

import time
from fractions import Fraction
from typing import Any

from fluid_sim_ros.loop.autopilot_port import AutopilotOptions, Surroundings
from fluid_sim_ros.mavlink.ardupilot.json_packets import (
    LONGEST_PACKET,
    JsonState,
    ServoPacket,
    read_servo_packet,
    write_state,
)
from fluid_sim_ros.mavlink.link import SLICE, AutopilotLink, Trouble
from fluid_sim_ros.mavlink.mapping import ActuatorMap
from fluid_sim_ros.mavlink.sockets import Datagram, UdpPort
from fluid_sim_ros.mavlink.vehicle_truth import TruthReader
from fluid_sim_ros.schema.sensors import SensorsFile
from fluid_sim_ros.sensors import SensorSuite
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import exact

#: Port of the first instance, and from one instance to the next.
FIRST_PORT, PORT_STEP = 9002, 10
#: What a rangefinder without an echo says [m].
_OUT_OF_RANGE = 1000.0


class ArduPilotBridge(AutopilotLink):
    """
    One ArduPilot at one vehicle.

    Parameters
    ----------
    simulation, options, surroundings, actuators
        As for ``AutopilotLink``.

    Raises
    ------
    ConfigError
        If the port is in use.

    """

    name, protocol = 'ArduPilot', 'ardupilot'

    def __init__(
        self,
        simulation: Simulation,
        options: AutopilotOptions,
        surroundings: Surroundings,
        actuators: ActuatorMap,
    ) -> None:
        super().__init__(simulation, options, surroundings, actuators)
        self._truth = TruthReader(simulation, options.vehicle)
        self._simulation = simulation
        self._suite = _sensors(simulation, options.vehicle)
        self._aerial = simulation.streams == ('wind',)
        self._longest = exact(simulation.timestep)
        port = options.port or FIRST_PORT + PORT_STEP * options.instance
        self._port = UdpPort(options.address, port, LONGEST_PACKET)
        self.port = self._port.port
        self._peer: Any = None
        self._heard_at = 0.0
        self._gone = False
        self._count = -1
        self._rate = 0
        self._steps = 0  # of a frame
        self._frame_end = 0  # step at which the present frame ends
        self._owed = False  # the autopilot waits for the state at the frame's end
        self._later: Datagram | None = None  # came while the repeated ones were looked through
        self._waiting: ServoPacket | None = None  # first packet of a process that has restarted
        self._reply = b''
        self._sent_ns = 0
        self._offset_ns = 0  # from simulated time to that of the autopilot

    # ---- the pacing's side -----------------------------------------------------------------

    def begin(self, simulation: Simulation) -> None:
        """Let the autopilot's time go on where a reset has set the simulation's back."""
        now_ns = simulation.time_ns
        if now_ns + self._offset_ns < self._sent_ns:
            frame_ns = 1_000_000_000 // self._rate if self._owed else 0
            self._offset_ns = self._sent_ns + frame_ns - now_ns
        if simulation.step_count == 0:  # it has the scene's timestep again
            self._rate = self._frame_end = 0

    def steps_left(self, simulation: Simulation) -> int:
        """Return the steps to the end of the frame."""
        return max(1, self._frame_end - simulation.step_count)

    def meet(self, simulation: Simulation) -> bool:
        """Answer at the end of a frame, and begin the next one with the packet that follows."""
        if simulation.step_count < self._frame_end:
            return True
        if self._owed:
            self._answer(simulation)
        packet, self._waiting = self._waiting, None
        if packet is None:
            packet = self._next_packet(simulation)
        if packet is None:
            return False
        self._start_frame(simulation, packet)
        return True

    def _values(self) -> dict[str, Any]:
        return {
            'port': self.port, 'peer': _text(self._peer), 'frame_rate_hz': self._rate,
            'frame_count': self._count,
        }  # fmt: skip

    def _trouble(self) -> Trouble | None:
        if self._peer is None:
            return 'warn', f'waiting for ArduPilot on UDP port {self.port}'
        if self._gone:
            return 'error', 'ArduPilot is silent; waiting for it'
        return None

    def close(self) -> None:
        """Close the socket."""
        self._port.close()

    # ---- one frame -------------------------------------------------------------------------

    def state(self, time_ns: int) -> JsonState:
        """
        Return what the autopilot gets to know of the present state.

        Parameters
        ----------
        time_ns
            Time of the state by the autopilot's clock [ns].

        """
        truth = self._truth.read(forces=True)
        return JsonState(
            time_ns, truth.rates, truth.specific_force, truth.position_ned, truth.velocity_ned,
            truth.attitude, truth.air_ned if self._aerial else None, *self._measure(),
        )  # fmt: skip

    def _measure(self) -> tuple[float | None, float | None]:
        """Return airspeed and distance to the ground where the vehicle has sensors for them."""
        suite, simulation = self._suite, self._simulation
        suite.read(simulation.tick, simulation.time_ns)  # the truth's reader has observed
        airspeed = suite.airspeed.airspeed if suite.airspeed else None
        if suite.rangefinder is None:
            return airspeed, None
        return airspeed, min(max(suite.rangefinder.distance, 0.0), _OUT_OF_RANGE)

    def _answer(self, simulation: Simulation) -> None:
        self._sent_ns = simulation.time_ns + self._offset_ns
        self._reply = write_state(self.state(self._sent_ns))
        self._owed = False
        self.counters.sent += 1
        self._drop_repeated()
        self._port.send(self._reply, self._peer)

    def _start_frame(self, simulation: Simulation, packet: ServoPacket) -> None:
        if packet.rate != self._rate:
            self._rate = packet.rate
            frame = Fraction(1, packet.rate)
            self._steps = -int(-frame // self._longest)  # rounded up
            timestep = frame / self._steps
            simulation.set_timestep(timestep)
            if self._surroundings.log is not None:
                self._surroundings.log.event(timestep=str(timestep))
        self._count = packet.count
        self._drive(packet.pulses)
        self.counters.answered += 1
        self._frame_end = simulation.step_count + self._steps
        self._owed = True

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
        if self._gone:
            self._gone = False
            self._surroundings.report('back', 'ArduPilot answers again')
        if packet.count == self._count:
            self.counters.repeated += 1
            if self._reply:
                self._port.send(self._reply, sender)
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
            packet = read_servo_packet(got[0])
            same = isinstance(packet, ServoPacket) and packet.count == self._count
            if same and got[1] == self._peer:
                self.counters.repeated += 1
            else:
                self._later = got

    def _adopt(self, sender: Any, now: float) -> bool:
        """Take a new sender as the autopilot, unless the present one is still there."""
        if self._peer is not None and now - self._heard_at < self._timeout:
            self.counters.strangers += 1
            return False
        self._peer = sender
        self.counters.connections += 1
        self._surroundings.report('connected', f'ArduPilot at {_text(sender)}')
        return True

    def _restart(self, simulation: Simulation, packet: ServoPacket) -> None:
        """Begin anew with a process whose frames count from the start again."""
        self.counters.restarts += 1
        self._surroundings.report('restarted', 'ArduPilot has restarted: back to the start')
        self._sent_ns = self._offset_ns = 0
        self._count, self._rate, self._reply = -1, 0, b''
        self._owed = False
        self._surroundings.reset()
        self._frame_end = simulation.step_count
        self._waiting = packet

    def _note_silence(self, now: float) -> None:
        if self._peer is not None and not self._gone and now - self._heard_at > self._timeout:
            self._gone = True
            self.counters.gone += 1
            self._surroundings.report(
                'gone', f'ArduPilot: nothing for {self._timeout:g} s; waiting on port {self.port}'
            )


def _sensors(simulation: Simulation, vehicle: str) -> SensorSuite:
    """Return the sensors that ArduPilot does not make up itself, read at every frame."""
    config, chosen = simulation.vehicle(vehicle).sensors, {}
    for kind in ('rangefinder', 'airspeed'):
        sensor = getattr(config, kind)
        if sensor is not None:
            rate = 1 / exact(simulation.timestep)
            chosen[kind] = sensor.model_copy(update={'rate': rate, 'latency': 0.0})
    return SensorSuite(simulation, vehicle, SensorsFile().model_copy(update=chosen))


def _text(sender: Any) -> str:
    return f'{sender[0]}:{sender[1]}' if sender else ''
