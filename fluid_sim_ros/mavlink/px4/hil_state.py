"""What PX4 gets to know of its vehicle at every exchange: its sensors and, for its log, truth."""

import random
from fractions import Fraction
from typing import TypeVar

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.mavlink.mapping import AutopilotFile
from fluid_sim_ros.mavlink.ned import enu_to_ned, flu_to_frd
from fluid_sim_ros.mavlink.px4.hil_messages import HilWriter, SensorReadings
from fluid_sim_ros.mavlink.sticks import Sticks
from fluid_sim_ros.mavlink.vehicle_truth import TruthReader
from fluid_sim_ros.physics.environment.atmosphere import (
    pressure_altitude,
    standard_pressure,
    standard_temperature,
)
from fluid_sim_ros.schema.sensors import SensorsFile
from fluid_sim_ros.sensors import SensorSuite
from fluid_sim_ros.sensors.geodesy import LocalFrame
from fluid_sim_ros.sensors.sensor import Sensor
from fluid_sim_ros.simulation import Simulation

Present = TypeVar('Present', bound=Sensor)

#: Exchanges per second.
RATE = 250
#: Every so many exchanges: magnetic field (83 Hz), pressures and vision (50 Hz), truth and GNSS
#: (10 Hz), radio control (10 Hz), heartbeat (1 Hz).
_FIELD, _PRESSURE, _TRUTH, _STICKS, _HEARTBEAT = 3, 5, 25, 25, 250
_GAUSS, _HECTOPASCAL, _CELSIUS = 1e4, 1e-2, -273.15
#: Of the pressure that is sent with vision [Pa], either way.
_DITHER = 1.0
#: Variances that go with the true pose and velocity: [m^2] and [rad^2], [m^2/s^2] and [rad^2/s^2].
_POSE_VARIANCE = (1e-4,) * 3 + (1e-5,) * 3
_TWIST_VARIANCE = (1e-4,) * 3 + (1e-5,) * 3


class HilState:
    """
    Builds the messages of one exchange.

    The vehicle's own sensors measure, at the rates that PX4 wants, and always with dither: PX4
    takes a reading that never changes for a dead sensor. A vehicle with ``vision`` (under water)
    gets its true pose as ODOMETRY instead of HIL_GPS, and of its barometer the pressure that the
    standard atmosphere has at its height, negative heights included: PX4 knows no other medium.

    Parameters
    ----------
    simulation, vehicle
        Who is measured.
    file
        The mapping.
    sticks
        Of a radio control.

    Raises
    ------
    ConfigError
        If the vehicle lacks a sensor that PX4 needs.

    """

    def __init__(
        self, simulation: Simulation, vehicle: str, file: AutopilotFile, sticks: Sticks
    ) -> None:
        self._vision, self._sticks = file.vision, sticks
        self._truth = TruthReader(simulation, vehicle)
        home = simulation.scene.home
        self._frame, self._altitude = LocalFrame(home), home.altitude
        config = _for_px4(simulation.vehicle(vehicle).sensors, file.vision)
        self._suite = suite = SensorSuite(simulation, vehicle, config)
        self._imu = _there(suite.imu, 'imu', vehicle)
        self._magnetometer = _there(suite.magnetometer, 'magnetometer', vehicle)
        self._barometer, self._gnss, self._airspeed = suite.barometer, suite.gnss, suite.airspeed
        if not file.vision:
            _there(suite.barometer, 'barometer', vehicle)
            _there(suite.gnss, 'gnss', vehicle)
        self._noise = random.Random(simulation.seed)
        self._count = 0

    def messages(self, writer: HilWriter, now_us: int) -> bytes:
        """
        Return the messages of the exchange at ``now_us``, the autopilot's time [us].

        Parameters
        ----------
        writer
            Of the connection, which numbers the messages.
        now_us
            Time by the autopilot's clock [us].

        Returns
        -------
        bytes
            MAVLink frames, HIL_SENSOR last.

        """
        self._suite.update()
        count, self._count = self._count, self._count + 1
        readings = self._readings()
        data = b'' if count % _HEARTBEAT else writer.heartbeat()
        if self._vision and count % _PRESSURE == 0:
            truth = self._truth.read(forces=False)
            data += writer.odometry(
                now_us, truth.position_ned, truth.attitude, truth.velocity_frd, truth.rates,
                _POSE_VARIANCE, _TWIST_VARIANCE,
            )  # fmt: skip
            self._read_pressure(readings, -truth.position_ned[2])
        if self._gnss is not None and self._gnss.fresh:
            gnss = self._gnss
            velocity = enu_to_ned(gnss.velocity_w.tolist())
            data += writer.gps(now_us, gnss.latitude, gnss.longitude, gnss.altitude, velocity)
        if count % _TRUTH == 0:
            data += self._true_state(writer, now_us)
        if count % _STICKS == 0 and (pulses := self._sticks.pulses()):
            data += writer.rc_channels(now_us // 1000, pulses)
        # last, because it is what PX4 answers to
        return data + writer.sensors(now_us, readings)

    def _readings(self) -> SensorReadings:
        imu, barometer, airspeed = self._imu, self._barometer, self._airspeed
        readings = SensorReadings(
            flu_to_frd(imu.specific_force.tolist()), flu_to_frd(imu.angular_velocity.tolist())
        )
        if self._magnetometer.fresh:
            x, y, z = self._magnetometer.field.tolist()
            readings.magnetic_field = (_GAUSS * x, -_GAUSS * y, -_GAUSS * z)
        if barometer is not None and barometer.fresh:
            readings.pressure = _HECTOPASCAL * barometer.pressure
            readings.pressure_altitude = barometer.altitude
            readings.temperature = barometer.temperature + _CELSIUS
        if airspeed is not None and airspeed.fresh:
            readings.differential_pressure = _HECTOPASCAL * airspeed.differential_pressure
        return readings

    def _read_pressure(self, readings: SensorReadings, height: float) -> None:
        """Fill in the pressure that the standard atmosphere has at a height [m]."""
        pressure = standard_pressure(self._altitude + height)
        pressure += self._noise.uniform(-_DITHER, _DITHER)
        readings.pressure = _HECTOPASCAL * pressure
        readings.pressure_altitude = pressure_altitude(pressure)
        readings.temperature = standard_temperature(readings.pressure_altitude) + _CELSIUS

    def _true_state(self, writer: HilWriter, now_us: int) -> bytes:
        truth = self._truth.read(forces=True)
        north, east, down = truth.position_ned
        return writer.truth(
            now_us, truth.attitude, truth.rates, self._frame.geodetic(east, north, -down),
            truth.velocity_ned, truth.airspeed, truth.specific_force,
        )  # fmt: skip


def _there(sensor: Present | None, kind: str, vehicle: str) -> Present:
    """Return a sensor that PX4 cannot do without, or raise ConfigError."""
    if sensor is None:
        raise ConfigError(
            f"px4: vehicle '{vehicle}' has no {kind}; add one under 'sensors' of its file in "
            'config/vehicles'
        )
    return sensor


def _for_px4(sensors: SensorsFile, vision: bool) -> SensorsFile:
    """Return the sensors that PX4 takes: at its rates, without latency, as its SITL expects."""
    periods = {'imu': 1, 'magnetometer': _FIELD, 'airspeed': _PRESSURE}
    if not vision:
        periods |= {'barometer': _PRESSURE, 'gnss': _TRUTH}
    chosen = {
        # a fraction, because 83.3 Hz has no decimal number
        kind: getattr(sensors, kind).model_copy(
            update={'rate': Fraction(RATE, period), 'latency': 0.0}
        )
        for kind, period in periods.items()
        if getattr(sensors, kind) is not None
    }
    return SensorsFile(dither=True).model_copy(update=chosen)
