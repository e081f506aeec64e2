# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What PX4 gets to know of its vehicle at every exchange: its sensors and, for its log, truth."""

import math
import random
from collections.abc import Callable
from fractions import Fraction

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.mavlink.mapping import AutopilotFile
from fluid_sim_ros.mavlink.ned import Vector3, enu_to_ned
from fluid_sim_ros.mavlink.px4.hil_aids import OpticalFlow, distance_sensor
from fluid_sim_ros.mavlink.px4.hil_messages import HilWriter
from fluid_sim_ros.mavlink.px4.hil_sensor import (
    KINDS,
    CompiledReadings,
    Readings,
)
from fluid_sim_ros.mavlink.px4.sphere import SphereFrame
from fluid_sim_ros.mavlink.sticks import Sticks
from fluid_sim_ros.mavlink.vehicle_truth import TruthReader
from fluid_sim_ros.physics.environment.atmosphere import (
    pressure_altitude,
    standard_pressure,
    standard_temperature,
)
from fluid_sim_ros.schema.sensors import RangefinderFile, SensorsFile
from fluid_sim_ros.sensors import SensorSuite
from fluid_sim_ros.sensors.geodesy import LocalFrame
from fluid_sim_ros.sensors.gnss import Gnss
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import exact

#: Exchanges per second.
RATE = 250
#: Every so many exchanges: magnetic field (83 Hz), pressures, vision, distance and flow (50 Hz),
#: truth and GNSS (10 Hz), radio control (10 Hz), heartbeat (1 Hz).
_FIELD, _PRESSURE, _TRUTH, _STICKS, _HEARTBEAT = 3, 5, 25, 25, 250
#: Range of a rangefinder that states none [m].
_FARTHEST = 100.0
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
    earth
        As of ``AutopilotOptions``.
    readings
        What makes HIL_SENSOR: ``CompiledReadings``, or ``PlainReadings`` with the same bytes.

    Attributes
    ----------
    readings
        As made.
    vision
        Whether the vehicle gets its true pose.
    pressure
        What the last ``besides`` has sent instead of the barometer's: see ``Readings.frame``.

    Raises
    ------
    ConfigError
        If the vehicle lacks a sensor that PX4 needs.

    """

    def __init__(
        self,
        simulation: Simulation,
        vehicle: str,
        file: AutopilotFile,
        sticks: Sticks,
        earth: str = 'wgs84',
        readings: Callable[[Simulation, str, SensorsFile], Readings] = CompiledReadings,
    ) -> None:
        self._simulation = simulation
        self.vision, self._sticks = file.vision, sticks
        self._truth = TruthReader(simulation, vehicle)
        home = simulation.scene.home
        self._frame = SphereFrame(home) if earth == 'sphere' else LocalFrame(home)
        self._altitude = home.altitude
        latency = Fraction(math.ceil(exact(file.gnss_delay) * RATE), RATE)
        self._moved = float(latency) - file.gnss_delay  # [s] between two exchanges
        config = _for_px4(simulation.vehicle(vehicle).sensors, file.vision, latency)
        needed = ['imu', 'magnetometer', *([] if file.vision else ['barometer', 'gnss'])]
        _check(config, [*needed, *(['rangefinder'] if file.optical_flow else [])], vehicle)
        slow = dict.fromkeys(KINDS)
        quick = {kind: getattr(config, kind) for kind in KINDS}
        self.readings = readings(
            simulation, vehicle, SensorsFile(dither=True).model_copy(update=quick)
        )
        self._suite = suite = SensorSuite(simulation, vehicle, config.model_copy(update=slow))
        self._gnss, self._range = suite.gnss, config.rangefinder
        self._range_period = self.readings.sensors['rangefinder'].period if self._range else 0
        self.pressure: Vector3 | None = None
        self._flow = OpticalFlow() if file.optical_flow else None
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
            MAVLink frames. HIL_SENSOR is the first: PX4's clock is its time, and stamps the rest.

        """
        self._simulation.observe(forces=True, wrenches=False)
        others, _ = self.besides(writer, now_us)
        return self.readings.frame(writer, now_us, self.pressure) + others

    def besides(self, writer: HilWriter, now_us: int) -> tuple[bytes, bool]:
        """
        Return the messages that follow HIL_SENSOR: none at four exchanges out of five.

        Parameters
        ----------
        writer, now_us
            See ``messages``.

        Returns
        -------
        others, observed
            MAVLink frames, and whether the vehicles were observed for them, with their forces.

        """
        simulation, gnss, tick = self._simulation, self._gnss, self._simulation.tick
        count, self._count = self._count, self._count + 1
        vision = self.vision and count % _PRESSURE == 0
        truth = count % _TRUTH == 0
        ground = self._range is not None and (
            self._flow is not None or tick % self._range_period == 0
        )
        looks = (
            gnss is not None
            and tick % self._suite.period == 0
            and (gnss.beat.due(tick) or gnss.appears(tick))
        )
        self.pressure, others = None, b''
        observed = vision or truth or ground or looks
        if observed:
            simulation.observe(forces=True, wrenches=False)
        if vision:
            others += self._pose(writer, now_us)
        if looks and gnss is not None:
            gnss.update(tick, simulation.time_ns)
            if gnss.fresh:
                others += self._fix(writer, now_us, gnss)
        if truth:
            others += self._true_state(writer, now_us)
        if ground and self._range is not None:
            others += self._ground(writer, now_us, self._range)
        if count % _STICKS == 0 and (pulses := self._sticks.pulses()):
            others += writer.rc_channels(now_us // 1000, pulses)
        if count % _HEARTBEAT == 0:
            others += writer.heartbeat()
        return others, observed

    def _pose(self, writer: HilWriter, now_us: int) -> bytes:
        """Return ODOMETRY, and note the pressure that goes with it."""
        truth = self._truth.read(forces=False)
        self.pressure = self._pressure_at(-truth.position_ned[2])
        return writer.odometry(
            now_us, truth.position_ned, truth.attitude, truth.velocity_frd, truth.rates,
            _POSE_VARIANCE, _TWIST_VARIANCE,
        )  # fmt: skip

    def _fix(self, writer: HilWriter, now_us: int, gnss: Gnss) -> bytes:
        """Return HIL_GPS of a fix that is as old as PX4 takes it for."""
        velocity_w = gnss.velocity_w.tolist()
        place = [
            p + self._moved * v for p, v in zip(gnss.position_w.tolist(), velocity_w, strict=True)
        ]
        return writer.gps(now_us, *self._frame.geodetic(*place), enu_to_ned(velocity_w))

    def _ground(self, writer: HilWriter, now_us: int, sensor: RangefinderFile) -> bytes:
        """Return DISTANCE_SENSOR and, where it is wanted, HIL_OPTICAL_FLOW, of a new reading."""
        distance, fresh = self.readings.ground()
        if self._flow is not None and math.isfinite(distance):
            truth = self._truth.read(forces=False)
            self._flow.add(truth.rates, truth.velocity_frd, distance, 1 / RATE)
        if not fresh:
            return b''
        nearest, farthest = sensor.distance.range or (0.0, _FARTHEST)
        data = distance_sensor(writer, now_us // 1000, distance, nearest, farthest)
        if self._flow is not None:
            data += writer.pack(self._flow.message(now_us, distance))
        return data

    def _pressure_at(self, height: float) -> Vector3:
        """Return what the standard atmosphere has at a height [m]: [Pa], altitude [m], [K]."""
        pressure = standard_pressure(self._altitude + height)
        pressure += self._noise.uniform(-_DITHER, _DITHER)
        altitude = pressure_altitude(pressure)
        return pressure, altitude, standard_temperature(altitude)

    def _true_state(self, writer: HilWriter, now_us: int) -> bytes:
        truth = self._truth.read(forces=True)
        north, east, down = truth.position_ned
        return writer.truth(
            now_us, truth.attitude, truth.rates, self._frame.geodetic(east, north, -down),
            truth.velocity_ned, truth.airspeed, truth.acceleration_ned,
        )  # fmt: skip


def _check(config: SensorsFile, needed: list[str], vehicle: str) -> None:
    """Raise ConfigError where a sensor is missing that PX4 cannot do without."""
    for kind in needed:
        if getattr(config, kind) is None:
            raise ConfigError(
                f"px4: vehicle '{vehicle}' has no {kind}; add one under 'sensors' of its file in "
                'config/vehicles'
            )


def _for_px4(sensors: SensorsFile, vision: bool, gnss_latency: Fraction) -> SensorsFile:
    """Return the sensors that PX4 takes: at its rates, and as late as it takes them for [s]."""
    periods = {'imu': 1, 'magnetometer': _FIELD, 'airspeed': _PRESSURE, 'rangefinder': _PRESSURE}
    if not vision:
        periods |= {'barometer': _PRESSURE, 'gnss': _TRUTH}
    chosen = {
        # a fraction, because 83.3 Hz has no decimal number
        kind: getattr(sensors, kind).model_copy(
            update={
                'rate': Fraction(RATE, period),
                'latency': gnss_latency if kind == 'gnss' else 0.0,
            }
        )
        for kind, period in periods.items()
        if getattr(sensors, kind) is not None
    }
    return SensorsFile(dither=True).model_copy(update=chosen)
