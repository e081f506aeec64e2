# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""HIL_SENSOR, the message of every exchange: made in the library, or here with the same bytes."""

import ctypes
import math
from collections.abc import Mapping
from typing import Protocol

from fluid_sim_ros.mavlink.ned import Vector3, flu_to_frd
from fluid_sim_ros.mavlink.px4.hil_messages import HilWriter, SensorReadings
from fluid_sim_ros.plugins.exchange import LONGEST_FRAME, Px4Sensors, exchange_library
from fluid_sim_ros.schema.sensors import SensorsFile
from fluid_sim_ros.sensors import SensorSuite
from fluid_sim_ros.sensors.compiled import CompiledSensor, carrier_of
from fluid_sim_ros.sensors.sensor import Sensor
from fluid_sim_ros.simulation import Simulation

#: Sensors that HIL_SENSOR tells of, in the order of ``Px4Sensors`` of plugins/exchange.py.
_KINDS = ('imu', 'magnetometer', 'barometer', 'airspeed')
#: Sensors that are read here.
KINDS = (*_KINDS, 'rangefinder')
_GAUSS, _HECTOPASCAL, _CELSIUS = 1e4, 1e-2, -273.15


class Readings(Protocol):
    """
    Makes HIL_SENSOR of a vehicle.

    Attributes
    ----------
    sensors
        By kind.

    """

    sensors: Mapping[str, Sensor]

    def frame(self, writer: HilWriter, now_us: int, pressure: Vector3 | None) -> bytes:
        """
        Return the message of the present boundary, at which all was observed with its forces.

        Parameters
        ----------
        writer
            Of the connection, which numbers the messages.
        now_us
            Time by the autopilot's clock [us].
        pressure
            To be sent instead of the barometer's: [Pa], the altitude that has it [m], [K].

        Returns
        -------
        bytes
            One MAVLink frame.

        """

    def ground(self) -> tuple[float, bool]:
        """Return what the rangefinder reads [m], and whether it is new; see ``frame``."""


class PlainReadings:
    """
    The twin in Python.

    Parameters
    ----------
    simulation, vehicle
        Who is measured.
    config
        The sensors of ``KINDS``, at the rates of the exchange.

    Attributes
    ----------
    sensors
        By kind.

    """

    def __init__(self, simulation: Simulation, vehicle: str, config: SensorsFile) -> None:
        self._simulation = simulation
        self._suite = suite = SensorSuite(simulation, vehicle, config)
        self.sensors: Mapping[str, Sensor] = _by_kind(suite)
        self._imu, self._magnetometer = suite.imu, suite.magnetometer
        self._barometer, self._airspeed = suite.barometer, suite.airspeed
        self._range = suite.rangefinder

    def frame(self, writer: HilWriter, now_us: int, pressure: Vector3 | None) -> bytes:
        """
        Return HIL_SENSOR; see ``Readings``.

        Parameters
        ----------
        writer, now_us, pressure
            See there.

        """
        self._suite.read(self._simulation.tick, self._simulation.time_ns)
        imu, barometer, airspeed = self._imu, self._barometer, self._airspeed
        assert imu is not None
        readings = SensorReadings(
            flu_to_frd(imu.specific_force.tolist()), flu_to_frd(imu.angular_velocity.tolist())
        )
        if self._magnetometer is not None and self._magnetometer.fresh:
            x, y, z = self._magnetometer.field.tolist()
            readings.magnetic_field = (_GAUSS * x, -_GAUSS * y, -_GAUSS * z)
        if pressure is None and barometer is not None and barometer.fresh:
            pressure = (barometer.pressure, barometer.altitude, barometer.temperature)
        if pressure is not None:
            readings.pressure = _HECTOPASCAL * pressure[0]
            readings.pressure_altitude = pressure[1]
            readings.temperature = pressure[2] + _CELSIUS
        if airspeed is not None and airspeed.fresh:
            readings.differential_pressure = _HECTOPASCAL * airspeed.differential_pressure
        return writer.sensors(now_us, readings)

    def ground(self) -> tuple[float, bool]:
        """Return what the rangefinder reads; see ``Readings``."""
        assert self._range is not None
        self._suite.read(self._simulation.tick, self._simulation.time_ns)
        return self._range.distance, self._range.fresh


class CompiledReadings:
    """
    The message as the library makes it.

    Parameters
    ----------
    simulation, vehicle, config
        See ``PlainReadings``.

    Attributes
    ----------
    sensors
        By kind; they give places and errors, and are not read themselves.

    """

    def __init__(self, simulation: Simulation, vehicle: str, config: SensorsFile) -> None:
        self._simulation = simulation
        self.sensors: Mapping[str, Sensor] = _by_kind(SensorSuite(simulation, vehicle, config))
        self._compiled = [
            CompiledSensor(self.sensors[kind]) if kind in self.sensors else None for kind in _KINDS
        ]
        self._all = Px4Sensors(carrier=carrier_of(simulation, vehicle))
        self._all.instruments[:] = [c.address if c else None for c in self._compiled]
        self._into = ctypes.create_string_buffer(LONGEST_FRAME)
        self._addresses = ctypes.addressof(self._all), ctypes.addressof(self._into)
        self._sensors = exchange_library().px4_sensors
        beam = self.sensors.get('rangefinder')
        self._range = None if beam is None else CompiledSensor(beam)
        self._distance = math.inf

    def frame(self, writer: HilWriter, now_us: int, pressure: Vector3 | None) -> bytes:
        """
        Return HIL_SENSOR; see ``Readings``.

        Parameters
        ----------
        writer, now_us, pressure
            See there.

        """
        self.give(pressure)
        (what, into), tick = self._addresses, self._simulation.tick
        number, ids = writer.number(), writer.ids
        while (size := self._sensors(what, tick, now_us, number, *ids, into)) < 0:
            self.draw(size, tick)
        return ctypes.string_at(into, size)

    @property
    def address(self) -> int:
        """Of what HIL_SENSOR is made from."""
        return self._addresses[0]

    def give(self, pressure: Vector3 | None) -> None:
        """
        Set what is sent instead of the barometer's reading; see ``frame``.

        Parameters
        ----------
        pressure
            See there.

        """
        self._all.given = pressure is not None
        if pressure is not None:
            self._all.pressure[:] = pressure

    def draw(self, found: int, tick: int) -> None:
        """
        Draw the noise that the library asks for, at every 256th reading.

        Parameters
        ----------
        found
            -1 - i for instrument i of ``Px4Sensors``.
        tick
            The present one.

        """
        compiled = self._compiled[-1 - found]
        assert compiled is not None
        compiled.draw(tick)

    def saturated(self) -> dict[str, int]:
        """Return how many values of each of its sensors were beyond the range so far."""
        found = zip(_KINDS, self._compiled, strict=True)
        return {kind: compiled.saturated for kind, compiled in found if compiled is not None}

    def ground(self) -> tuple[float, bool]:
        """Return what the rangefinder reads; see ``Readings``."""
        assert self._range is not None
        fresh = self._range.look(self._addresses[0], self._simulation.tick)
        if fresh:
            (self._distance,) = self._range.values()
        return self._distance, fresh


def _by_kind(suite: SensorSuite) -> dict[str, Sensor]:
    return {sensor.config.kind: sensor for sensor in suite.sensors}
