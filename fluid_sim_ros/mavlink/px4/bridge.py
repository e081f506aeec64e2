"""
PX4 in lockstep: every 4 ms of simulated time it gets its sensors, and answers with its outputs.

The simulation leads: PX4's clock is the time of the message that it got last. So simulated time
stands still while nobody is connected, and an answer is waited for; but PX4 does not answer
before its start is over, nor in some states, and must get its time all the same. Then the loop
free-wheels: without an answer it goes on at real time.
"""

import time
from collections.abc import Sequence
from typing import Any

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.loop.autopilot_port import AutopilotOptions, Surroundings
from fluid_sim_ros.mavlink.link import SLICE, AutopilotLink, Trouble
from fluid_sim_ros.mavlink.mapping import ActuatorMap, AutopilotFile
from fluid_sim_ros.mavlink.px4.hil_answers import Actuators, HilReader
from fluid_sim_ros.mavlink.px4.hil_messages import HilWriter
from fluid_sim_ros.mavlink.px4.hil_state import HilState
from fluid_sim_ros.mavlink.sockets import TcpServer
from fluid_sim_ros.mavlink.sticks import Sticks
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import exact

#: Port of the first instance; the next ones follow.
FIRST_PORT = 4560
#: Between two exchanges [us]: PX4 answers each HIL_SENSOR at this rate.
PERIOD_US = 4000
#: Wall time for one exchange while free-wheeling [s]: real time.
_FREE_WHEEL = PERIOD_US * 1e-6


class Px4Bridge(AutopilotLink):
    """
    One PX4 at one vehicle.

    Parameters
    ----------
    simulation, options, surroundings, actuators
        As for ``AutopilotLink``.
    file
        The rest of the mapping.

    Raises
    ------
    ConfigError
        If 4 ms are not a whole number of timesteps, or the port is in use.

    """

    name, protocol = 'PX4', 'px4'
    takes_sticks = True

    def __init__(
        self,
        simulation: Simulation,
        options: AutopilotOptions,
        surroundings: Surroundings,
        actuators: ActuatorMap,
        file: AutopilotFile,
    ) -> None:
        steps = exact(PERIOD_US * 1e-6) / exact(simulation.timestep)
        if steps.denominator != 1:
            raise ConfigError(
                f'px4: the timestep of {simulation.timestep:g} s does not divide 4 ms, the period '
                'of PX4; choose one that does, such as 0.002 s'
            )
        super().__init__(simulation, options, surroundings, actuators)
        self._period = steps.numerator
        self._sticks = Sticks(file.rc, options.sticks_timeout)
        self._state = HilState(simulation, options.vehicle, file, self._sticks)
        self._writer, self._reader = HilWriter(), HilReader()
        self._server = TcpServer(options.address, options.port or FIRST_PORT + options.instance)
        self.port = self._server.port
        self._locked = False  # it has answered: wait for it
        self._flown = False  # an autopilot was here before
        self._armed = False
        self._sent_us = 0
        self._answered_us = 0
        self._asked_at = 0.0
        self._offset_us = 0  # from simulated time to that of the autopilot

    # ---- the pacing's side -----------------------------------------------------------------

    def begin(self, simulation: Simulation) -> None:
        """Let the autopilot's time go on where a reset has set the simulation's back."""
        if self._now_us(simulation) < self._sent_us:
            self._offset_us += self._sent_us + PERIOD_US - self._now_us(simulation)
        self._asked_at = time.monotonic()

    def steps_left(self, simulation: Simulation) -> int:
        """Return the steps to the next exchange."""
        return self._period - simulation.step_count % self._period

    def meet(self, simulation: Simulation) -> bool:
        """Send the sensors at every exchange and wait, within bounds, for what they lead to."""
        if not self._server.connected and not self._greet():
            return False
        now_us = self._now_us(simulation)
        if simulation.step_count % self._period or not now_us:
            return True  # PX4 takes no message of time 0
        if now_us != self._sent_us:
            if self._server.stuck:  # it has not read for seconds: it is halted
                self._server.send()
                self._receive(SLICE)
                return False
            self._send(simulation, now_us)
        return self._wait()

    def set_sticks(self, axes: Sequence[float], buttons: Sequence[float]) -> None:
        """
        Take the sticks of a radio control, which PX4 gets as RC_CHANNELS; see ``Sticks``.

        Parameters
        ----------
        axes
            Deflections, -1 to 1; saturated.
        buttons
            0 for off, another number for on.

        Raises
        ------
        CommandError
            If they are too many, none, or not finite.

        """
        self._sticks.move(axes, buttons)

    def _values(self) -> dict[str, Any]:
        return {
            'port': self.port, 'peer': self._server.peer,
            'autopilot_time_s': self._sent_us * 1e-6, 'armed': self._armed,
            'sticks_lost': self._sticks.lost,
        }  # fmt: skip

    def _trouble(self) -> Trouble | None:
        server = self._server
        if not server.connected:
            return 'warn', f'waiting for PX4 on TCP port {self.port}'
        if server.stuck:
            return 'error', 'PX4 does not read; waiting for it'
        if not self._locked:
            line = 'PX4 is silent' if self.counters.gone else 'PX4 is connected, no answer yet'
            return 'warn', f'{line}: going on at real time'
        return None

    def close(self) -> None:
        """Close the connection and the port."""
        self._server.close()

    # ---- one exchange ----------------------------------------------------------------------

    def _now_us(self, simulation: Simulation) -> int:
        return simulation.time_ns // 1000 + self._offset_us

    def _greet(self) -> bool:
        """Wait a short while for a connection; True when one is new and time may go on."""
        if not self._server.accept(SLICE):
            return False
        self.counters.connections += 1
        self._writer, self._reader = HilWriter(), HilReader()
        self._locked = False
        self._sent_us = self._answered_us = self._offset_us = 0
        self._surroundings.report('connected', f'PX4 at {self._server.peer}')
        if not self._flown:
            self._flown = True
            return True
        self.counters.restarts += 1
        self._surroundings.reset()
        return False

    def _send(self, simulation: Simulation, now_us: int) -> None:
        self._sent_us = now_us
        self.counters.sent += 1
        self._server.send(self._state.messages(self._writer, now_us))
        self._asked_at = time.monotonic()

    def _wait(self) -> bool:
        """Wait for the answer; True when the simulation may go on, with it or without."""
        patience = self._timeout if self._locked else _FREE_WHEEL
        while True:
            left = self._asked_at + patience - time.monotonic()
            if not self._receive(min(left, SLICE)):
                return False
            if self._answered_us == self._sent_us:
                return True
            if self._locked and patience != self._timeout:
                patience = self._timeout
            elif left <= 0:
                self._note_silence()
                return True
            elif left > SLICE:
                return False  # serve requests, and come back

    def _receive(self, timeout: float) -> bool:
        """Take in what arrives within ``timeout`` [s]; False when the connection has gone."""
        data = self._server.receive(timeout)
        if data is None:
            self._lost()
            return False
        if data:
            received = self._reader.receive(data)
            for fault in received.faults:
                self._malformed(fault)
            for actuators in received.actuators:
                self._take(actuators)
        return True

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
        if not self._locked:
            self._locked = True
            if not actuators.lockstep:
                self._surroundings.report('lockstep', 'this PX4 was built without lockstep')
        self._armed = actuators.armed
        self._drive(actuators.controls)

    # ---- when it does not answer -----------------------------------------------------------

    def _note_silence(self) -> None:
        if not self._locked:
            return
        self.counters.missed += 1
        self.counters.gone += 1
        self._locked = False
        self._surroundings.report(
            'gone', f'PX4: no answer for {self._timeout:g} s; going on at real time'
        )

    def _lost(self) -> None:
        self.counters.disconnections += 1
        self._commands.set(*self._actuators.rest)
        self._armed = False
        self._surroundings.report(
            'gone', f'PX4 has closed the connection; listening on port {self.port}'
        )
