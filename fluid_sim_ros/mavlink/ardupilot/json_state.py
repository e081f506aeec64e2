# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What ArduPilot gets to know of its vehicle at the end of each frame."""

import ctypes
import math
from collections.abc import Sequence

from fluid_sim_ros.mavlink.ardupilot.json_packets import JsonState
from fluid_sim_ros.mavlink.battery import Battery
from fluid_sim_ros.mavlink.ned import euler
from fluid_sim_ros.mavlink.sticks import Sticks
from fluid_sim_ros.mavlink.vehicle_truth import Truth, TruthReader
from fluid_sim_ros.physics.environment.atmosphere import DENSITY
from fluid_sim_ros.plugins.exchange import LONGEST_REPLY, ArduPilotState, exchange_library
from fluid_sim_ros.schema.sensors import SensorsFile
from fluid_sim_ros.sensors import SensorSuite
from fluid_sim_ros.sensors.compiled import CompiledSensor, carrier_of
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import exact

#: What a rangefinder without an echo says [m].
_OUT_OF_RANGE = 1000.0


class StateReader:
    """
    Reads the true state, and the sensors that ArduPilot does not make up itself.

    Parameters
    ----------
    simulation, vehicle
        Where the vehicle is, and its name.
    sticks
        Of a radio control.
    battery
        What its monitor measures, or None.

    """

    def __init__(
        self, simulation: Simulation, vehicle: str, sticks: Sticks, battery: Battery | None
    ) -> None:
        self._simulation, self._sticks, self._battery = simulation, sticks, battery
        self._truth = TruthReader(simulation, vehicle)
        self._suite = _sensors(simulation, vehicle)
        self._aerial = simulation.streams == ('wind',)

    def read(self, time_s: float) -> JsonState:
        """
        Return the present state.

        Parameters
        ----------
        time_s
            Time of the state by the autopilot's clock [s].

        Returns
        -------
        JsonState
            NED and FRD axes.

        """
        truth = self._truth.read(forces=True)
        air, vane = (truth.air_ned, _vane(truth)) if self._aerial else (None, None)
        battery = self._battery
        return JsonState(
            time_s, truth.rates, truth.specific_force, truth.position_ned, truth.velocity_ned,
            truth.attitude, air, *self._measure(), vane, self._sticks.pulses(),
            None if battery is None else (battery.voltage, battery.current),
        )  # fmt: skip

    def _measure(self) -> tuple[float | None, float | None]:
        """Return airspeed and distance to the ground where the vehicle has sensors for them."""
        suite, simulation = self._suite, self._simulation
        suite.read(simulation.tick, simulation.time_ns)  # the truth's reader has observed
        airspeed = suite.airspeed.airspeed if suite.airspeed else None
        if suite.rangefinder is None:
            return airspeed, None
        return airspeed, min(max(suite.rangefinder.distance, 0.0), _OUT_OF_RANGE)


class ReplyWriter:
    """
    Writes the replies in the library: the same bytes as ``write_state`` of ``StateReader.read``.

    Parameters
    ----------
    simulation, vehicle, sticks, battery
        See ``StateReader``.

    """

    def __init__(
        self, simulation: Simulation, vehicle: str, sticks: Sticks, battery: Battery | None
    ) -> None:
        self._simulation, self._sticks, self._battery = simulation, sticks, battery
        suite = _sensors(simulation, vehicle)
        self._compiled = [
            None if sensor is None else CompiledSensor(sensor)
            for sensor in (suite.airspeed, suite.rangefinder)
        ]
        self._state = ArduPilotState(
            carrier_of(simulation, vehicle), aerial=simulation.streams == ('wind',),
            sea_density=DENSITY, distance=math.inf, metered=battery is not None,
        )  # fmt: skip
        self._state.instruments[:] = [c.address if c else None for c in self._compiled]
        self._pulses: Sequence[int] = ()
        self._into = ctypes.create_string_buffer(LONGEST_REPLY)
        self._addresses = ctypes.addressof(self._state), ctypes.addressof(self._into)
        self._write = exchange_library().ardupilot_state

    def reply(self, time_s: float) -> bytes:
        """
        Return the reply that says the present state.

        Parameters
        ----------
        time_s
            Time of the state by the autopilot's clock [s].

        Returns
        -------
        bytes
            One line of JSON.

        """
        simulation, state, battery = self._simulation, self._state, self._battery
        simulation.observe(forces=True, wrenches=False)
        self.take_sticks()
        if battery is not None:
            state.voltage, state.current = battery.voltage, battery.current
        (what, into), tick = self._addresses, simulation.tick
        while (size := self._write(what, tick, time_s, into, LONGEST_REPLY)) < 0:
            self.draw(size, tick)
        return ctypes.string_at(into, size)

    @property
    def address(self) -> int:
        """Of what replies are made from."""
        return self._addresses[0]

    def take_sticks(self) -> None:
        """Have the next reply say where the sticks are."""
        if (pulses := self._sticks.pulses()) is not self._pulses:
            self._pulses = pulses
            self._state.channels = len(pulses)
            self._state.pulses[: len(pulses)] = pulses

    def draw(self, found: int, tick: int) -> None:
        """
        Draw the noise that the library asks for, at every 256th reading.

        Parameters
        ----------
        found
            -1 - i for instrument i of ``ArduPilotState``.
        tick
            The present one.

        """
        compiled = self._compiled[-1 - found]
        assert compiled is not None
        compiled.draw(tick)


def _vane(truth: Truth) -> tuple[float, float]:
    """Return where the wind comes from, clockwise from ahead [rad], and its speed [m/s]."""
    north, east, _ = (v - a for v, a in zip(truth.velocity_ned, truth.air_ned, strict=True))
    speed = math.sqrt(north * north + east * east)
    heading = euler(truth.attitude)[2]
    return (math.remainder(math.atan2(east, north) - heading, math.tau) if speed else 0.0), speed


def _sensors(simulation: Simulation, vehicle: str) -> SensorSuite:
    """Return the sensors, read at every frame."""
    config, chosen = simulation.vehicle(vehicle).sensors, {}
    for kind in ('rangefinder', 'airspeed'):
        sensor = getattr(config, kind)
        if sensor is not None:
            rate = 1 / exact(simulation.timestep)
            chosen[kind] = sensor.model_copy(update={'rate': rate, 'latency': 0.0})
    return SensorSuite(simulation, vehicle, SensorsFile().model_copy(update=chosen))
