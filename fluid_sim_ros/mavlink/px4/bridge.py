# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
PX4 in lockstep: every 4 ms of simulated time it gets its sensors, and answers with its outputs.

The simulation leads: PX4's clock is the time of the message that it got last. So simulated time
stands still while nobody is connected, and an answer is waited for; but PX4 does not answer
before its start is over, nor in some states, and must get its time all the same. Then the loop
free-wheels: without an answer it goes on at real time.

A PX4 that has answered and is silent may be halted, or slow: it is waited for. Or it goes on and
sends no outputs, as in flight termination: it still reads what it gets, which shows.
"""

import time
from typing import Any

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.loop.autopilot_port import AutopilotOptions, Surroundings
from fluid_sim_ros.mavlink.actuator_map import ActuatorMap
from fluid_sim_ros.mavlink.link import SLICE, Trouble
from fluid_sim_ros.mavlink.mapping import AutopilotFile
from fluid_sim_ros.mavlink.px4.exchanges import FIRST_PORT, PERIOD_US, Px4Exchanges
from fluid_sim_ros.mavlink.px4.hil_answers import HilReader
from fluid_sim_ros.mavlink.px4.hil_messages import HilWriter
from fluid_sim_ros.plugins.exchange import ASK, HEAR
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import exact

_PERIOD_NS = 1000 * PERIOD_US
#: Wall time for one exchange while free-wheeling [s]: real time.
_FREE_WHEEL = PERIOD_US * 1e-6


class Px4Bridge(Px4Exchanges):
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
        super().__init__(simulation, options, surroundings, actuators, file)
        self._period = steps.numerator
        self._flown = False  # an autopilot was here before

    # ---- the pacing's side -----------------------------------------------------------------

    def begin(self, simulation: Simulation) -> None:
        """Let the autopilot's time go on where a reset has set the simulation's back."""
        self._usual = False
        if self._now_us(simulation) < self._sent_us:
            self._offset_us += self._sent_us + PERIOD_US - self._now_us(simulation)
        self._asked_at = time.monotonic()
        if simulation.step_count == 0:
            self._companion.begin()

    def steps_left(self, simulation: Simulation) -> int:
        """Return the steps to the next exchange."""
        return self._period - simulation.step_count % self._period

    def meet(self, simulation: Simulation) -> bool:
        """Send the sensors at every exchange and wait, within bounds, for what they lead to."""
        if reason := self._server.displaced():
            self._server.disconnect()
            self._lost(f'PX4 at {reason}')
        if not self._server.connected and not self._greet():
            return False
        time_ns = simulation.time_ns
        now_us = time_ns // 1000 + self._offset_us
        if time_ns % _PERIOD_NS or not now_us:
            return True  # PX4 takes no message of time 0
        if now_us != self._sent_us:
            if self._usual:
                return self._exchange(now_us, ASK | HEAR)
            if self._server.stuck and not self._silence.given_up:  # it is halted at its start
                self._server.send()
                self._receive(SLICE)
                return False
            self._send(now_us)
        elif self._usual and self._answered_us != now_us:  # it was offered
            return self._exchange(now_us, HEAR)
        return self._wait()

    def join(self) -> None:
        """Nothing changes: its exchanges come at times, whatever the timestep."""

    def offer(self, simulation: Simulation) -> None:
        """Send the sensors where an exchange is due and PX4 can take them."""
        now_us = self._now_us(simulation)
        due = now_us and now_us != self._sent_us and not simulation.time_ns % _PERIOD_NS
        if due and self._server.connected and not self._server.stuck:
            if self._usual:
                self._exchange(now_us, ASK)
            else:
                self._send(now_us)

    def next_ns(self, simulation: Simulation) -> int:
        """Return the simulated time of the next exchange [ns]."""
        return (simulation.time_ns // _PERIOD_NS + 1) * _PERIOD_NS

    def _values(self) -> dict[str, Any]:
        return {
            'port': self.port, 'peer': self._server.peer,
            'autopilot_time_s': self._sent_us * 1e-6, 'armed': self._armed,
        }  # fmt: skip

    def _trouble(self) -> Trouble | None:
        server = self._server
        if not server.connected:
            return 'warn', f'waiting for PX4 on TCP port {self.port}'
        if self._silence.given_up:
            return 'error', 'PX4 sends no outputs: going on at real time'
        if self._silence.reported:
            state = '' if self._reading.goes_on else ' (it does not read: halted?)'
            return 'error', f'PX4 is silent{state}; simulated time waits for it'
        if server.stuck:
            return 'error', 'PX4 does not read; waiting for it'
        if not self._locked:
            return 'warn', 'PX4 is connected, no answer yet: going on at real time'
        return None

    def reasons(self) -> list[str]:
        """Return what may be wrong while it has not answered yet, most likely first."""
        if self._server.connected:
            return [
                'PX4 is still starting: wait longer',
                'an underwater airframe does not answer before it has a mode and sticks',
            ]
        return [
            'PX4 is not started, or not with an airframe of a simulation '
            '(PX4_SYS_AUTOSTART, as in the mapping)',
            f'it is of another instance: it connects to TCP port {FIRST_PORT} + instance, and '
            f'here it is {self.port}',
            'it runs on another host or in a container: PX4_SIM_HOSTNAME there, --address here',
        ]

    def close(self) -> None:
        """Close the connection and the port."""
        self._companion.close()
        self._server.close()

    # ---- one exchange ----------------------------------------------------------------------

    def _now_us(self, simulation: Simulation) -> int:
        return simulation.time_ns // 1000 + self._offset_us

    def _greet(self) -> bool:
        """Wait a short while for a connection; True when one is new and time may go on."""
        if not self._server.accept(SLICE):
            if self._heard:
                self._silence.absent(time.monotonic() - self._lost_at)
            return False
        self.counters.connections += 1
        self._writer, self._reader = HilWriter(), HilReader()
        self._whole.connect(self._server.socket, self._writer)
        self._locked = self._usual = False
        self._sent_us = self._answered_us = self._offset_us = 0
        self._surroundings.inform(f'PX4 at {self._server.peer}')
        self._companion.open(self._server.host)
        if not self._flown:
            self._flown = True
            return True
        self.counters.restarts += 1
        self._surroundings.inform('PX4 has restarted: back to the start')
        self._surroundings.reset()
        return False

    def _wait(self) -> bool:
        """Wait for the answer; True when the simulation may go on, with it or without."""
        while True:
            left = self._asked_at + _FREE_WHEEL - time.monotonic()
            if not self._receive(SLICE if self._locked else min(left, SLICE)):
                return False
            if self._has_answer():
                return True
            if self._locked:  # else serve requests, and come back
                return self._is_given_up(time.monotonic() - self._asked_at)
            if left <= 0:
                return True
            if left > SLICE:
                return False
