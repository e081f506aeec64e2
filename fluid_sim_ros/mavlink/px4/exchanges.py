# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The exchanges with a PX4: sensors out, outputs in.

One that is like the one before is one call of the library (``UsualExchange``); all others, and
what is not usual in such a one, are done here.
"""

import time
from abc import abstractmethod

from fluid_sim_ros.loop.autopilot_port import AutopilotOptions, Surroundings
from fluid_sim_ros.mavlink.actuator_map import ActuatorMap
from fluid_sim_ros.mavlink.link import AutopilotLink
from fluid_sim_ros.mavlink.mapping import AutopilotFile
from fluid_sim_ros.mavlink.px4.companion import Companion
from fluid_sim_ros.mavlink.px4.hil_answers import Actuators, HilReader
from fluid_sim_ros.mavlink.px4.hil_messages import HilWriter
from fluid_sim_ros.mavlink.px4.hil_state import HilState
from fluid_sim_ros.mavlink.px4.reading import Reading
from fluid_sim_ros.mavlink.px4.tcp_server import TcpServer
from fluid_sim_ros.mavlink.px4.usual import UsualExchange
from fluid_sim_ros.mavlink.silence import Silence
from fluid_sim_ros.plugins.exchange import ANSWERED, ASK, GONE, HEAR, HELD, OTHER
from fluid_sim_ros.simulation import Simulation

#: Port of the first instance; the next ones follow.
FIRST_PORT = 4560
#: Between two exchanges [us]: PX4 answers each HIL_SENSOR at this rate.
PERIOD_US = 4000


class Px4Exchanges(AutopilotLink):
    """
    The exchanges of one PX4 at one vehicle; ``Px4Bridge`` says when they are.

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

    name, protocol = 'PX4', 'px4'

    def __init__(
        self,
        simulation: Simulation,
        options: AutopilotOptions,
        surroundings: Surroundings,
        actuators: ActuatorMap,
        file: AutopilotFile,
    ) -> None:
        super().__init__(simulation, options, surroundings, actuators, file)
        self._state = HilState(simulation, options.vehicle, file, self._sticks, options.earth)
        self._writer, self._reader = HilWriter(), HilReader()
        limits = simulation.vehicle(options.vehicle).thrust_range[:, 1].tolist()
        self._companion = Companion(options, file, limits)
        self._whole = UsualExchange(
            simulation, self._state, actuators, self._companion.battery, PERIOD_US * 1e-6
        )
        self.peer = self._whole.peer
        self._server = TcpServer(options.address, options.port or FIRST_PORT + options.instance)
        self.port = self._server.port
        self._locked = False  # it has answered: wait for it
        self._heard = False  # one of them has spoken
        self._armed = False
        self._sent_us = 0
        self._answered_us = 0
        self._asked_at = self._silent_at = self._lost_at = 0.0
        self._silence = Silence(self.name, options, surroundings, self.counters)
        self._reading = Reading(self._server)
        self._offset_us = 0  # from simulated time to that of the autopilot

    @abstractmethod
    def _wait(self) -> bool:
        """Wait for the answer; True when the simulation may go on, with it or without."""

    def _exchange(self, now_us: int, phases: int) -> bool:
        """Ask, hear or both as in the exchange before; True when the simulation may go on."""
        if phases & ASK:
            self._sent_us = now_us
            self._asked_at = time.monotonic()
            self.counters.sent += 1
        found = self._whole.run(phases, now_us)
        if phases & ASK:
            self._companion.tell()
        if found != ANSWERED:
            return self._look_closer(found, phases)
        if phases == ASK:
            self._server.asked(self._asked_at)
            return True
        if phases == HEAR:
            self._server.heard()
        self.counters.answered += 1
        self._answered_us = now_us
        self._report_companion()
        self._armed = self._whole.armed
        self._driven()
        return True

    def _look_closer(self, found: int, phases: int) -> bool:
        """Go on with an exchange in which something was not usual, as with any other."""
        self._usual = False
        self._server.asked(self._asked_at)
        if found == GONE:
            self._server.disconnect()
            self._lost()
            return False
        if found == HELD:
            self._server.keep(self._whole.unsent())
            return phases & HEAR == 0 or self._wait()
        if found == OTHER:
            self._server.heard()
            self._read(self._whole.heard())
            return self._has_answer() or self._wait()
        return self._is_given_up(time.monotonic() - self._asked_at)

    def _has_answer(self) -> bool:
        """Return whether the state just sent is answered; the next may be a usual exchange."""
        if self._answered_us != self._sent_us:
            return False
        self._usual = (
            self._locked
            and self._whole.usable
            and self._reader.idle
            and not (self._server.held or self._silence.reported)
        )
        return True

    def _send(self, now_us: int) -> None:
        self._sent_us = now_us
        self._asked_at = time.monotonic()
        if self._server.stuck:  # it was given up, and may come back
            self._server.send()
            return
        self._companion.draw(self._actuators.last[0], PERIOD_US * 1e-6)
        self.counters.sent += 1
        self._server.send(self._state.messages(self._writer, now_us))

    def _receive(self, timeout: float) -> bool:
        """Take in what arrives within ``timeout`` [s]; False when the connection has gone."""
        data = self._server.receive(timeout)
        if data is None:
            self._lost()
            return False
        if data:
            self._read(data)
        return True

    def _read(self, data: bytes) -> None:
        self._heard = True
        received = self._reader.receive(data)
        for fault in received.faults:
            self._malformed(fault)
        for actuators in received.actuators:
            self._take(actuators)

    def _take(self, actuators: Actuators) -> None:
        counters = self.counters
        if actuators.time_us > self._sent_us:
            counters.fault(
                f'outputs of {actuators.time_us} us, but the time is {self._sent_us} us'
            )
            return
        if actuators.time_us <= self._answered_us:
            counters.repeated += 1
            return
        self._answered_us = actuators.time_us
        if actuators.time_us == self._sent_us:
            counters.answered += 1
        else:
            counters.late += 1
        if not self._locked and not actuators.lockstep:
            self._surroundings.report('lockstep', 'this PX4 was built without lockstep')
        self._locked = True
        self._report_companion()
        if self._silence.reported:
            self._silence.ends(time.monotonic() - self._silent_at)
            self._reading.forget()
        self._armed = actuators.armed
        self._drive(actuators.controls)

    def _report_companion(self) -> None:
        for key, line in self._companion.lines().items():
            self._surroundings.report(key, line)

    def _is_given_up(self, seconds: float) -> bool:
        """Note how long the answer is waited for; True when time goes on without."""
        if not self._silence.reported:
            self._silent_at = self._asked_at
        given_up = self._silence.lasts(seconds)
        if not given_up and self._reading.look(seconds, self._writer.heartbeat):
            self._silence.give_up(
                'takes its sensors, but sends no outputs (flight termination?): thrust to rest, '
                'going on at real time'
            )
            given_up = True
        if given_up:
            self.counters.missed += 1
            self._locked = False
            self._commands.set(*self._actuators.rest)
        return given_up

    def _lost(self, how: str = 'PX4 has closed the connection') -> None:
        self._usual = False
        self.counters.disconnections += 1
        self._lost_at = time.monotonic()
        self._silence.forget()
        self._reading.forget()
        self._commands.set(*self._actuators.rest)
        self._armed = False
        self._surroundings.report('gone', f'{how}; listening on port {self.port}')
