"""The topics of a vehicle's sensors: each new reading as one message, when it appears."""

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fluid_sim_ros.messages.templates import Source, StampBytes, Template
from fluid_sim_ros.messages.topic import SENSOR, StateTopic
from fluid_sim_ros.schema.sensors import Channel
from fluid_sim_ros.sensors import SensorSuite
from fluid_sim_ros.sensors.airspeed import Airspeed
from fluid_sim_ros.sensors.beams import Dvl, Rangefinder
from fluid_sim_ros.sensors.gnss import Gnss
from fluid_sim_ros.sensors.pressure import Barometer, WaterPressure
from fluid_sim_ros.sensors.sensor import Sensor
from fluid_sim_ros.simulation import Simulation

Array = NDArray[np.float64] | NDArray[np.float32]

_GEODETIC = ('latitude', 'longitude', 'altitude')
#: Variance of what is not measured, for messages that cannot say so otherwise.
UNKNOWN = 1e6


class SensorTopic(StateTopic):
    """
    A topic that shows a sensor's readings.

    Its stamp is the time at which the reading was true, so with latency it lies in the past. A
    sensor may have several topics, and is sampled only while one of them is asked for.

    Parameters
    ----------
    simulation, sensor
        What is measured, and by what.
    name, message
        Topic name and message type.
    constants
        What stays in the message, as for ``Template.of``.
    sources
        Arrays of the sensor that members of the message follow.
    prepare
        Called before each message is made.

    """

    def __init__(
        self,
        simulation: Simulation,
        sensor: Sensor,
        name: str,
        message: str,
        constants: Mapping[str, Any],
        sources: Mapping[str, Source],
        prepare: Callable[[], None] | None = None,
    ) -> None:
        self._simulation, self._sensor = simulation, sensor
        self._stamp = StampBytes()
        constants = {'header.frame_id': sensor.frame, **constants}
        template = Template.of(message, constants, list(sources))
        copies = [(template.stamps[0], self._stamp.view)]
        copies += template.copies(list(sources.values()))
        super().__init__(
            name, message, template, math.gcd(sensor.period, sensor.latency), copies,
            sensor.needs_forces, prepare, SENSOR, appears_later=sensor.latency > 0,
        )  # fmt: skip

    def data(self) -> bytes:
        """Return the message of a new reading, or nothing if none has appeared."""
        sensor = self._sensor
        sensor.update(self._simulation.tick, self._simulation.time_ns)
        if not sensor.fresh:
            return b''
        self._stamp.set(sensor.time_ns)
        return super().data()


def sensor_topics(simulation: Simulation, suite: SensorSuite, vehicle: str) -> list[SensorTopic]:
    """
    Return the topics of a vehicle's sensors.

    Parameters
    ----------
    simulation
        What is measured.
    suite
        The vehicle's sensors.
    vehicle
        Its name.

    Returns
    -------
    list of SensorTopic
        In the order of the schema.

    """
    topics: list[SensorTopic] = []

    def add(
        sensor: Sensor,
        name: str,
        message: str,
        constants: Mapping[str, Any],
        sources: Mapping[str, Source],
        prepare: Callable[[], None] | None = None,
    ) -> None:
        full = f'{vehicle}/{name}'
        topics.append(SensorTopic(simulation, sensor, full, message, constants, sources, prepare))

    def pressure(sensor: Barometer | WaterPressure | Airspeed, name: str) -> None:
        add(
            sensor, name, 'sensor_msgs/msg/FluidPressure',
            {'variance': _variance(sensor, sensor.config.pressure)},
            {'fluid_pressure': sensor.values},
        )  # fmt: skip

    def distance(sensor: Rangefinder | Dvl, name: str, channel: Channel, value: Array) -> None:
        low, high = channel.range or (0.0, math.inf)
        single = np.zeros(1, dtype=np.float32)
        add(
            sensor, name, 'sensor_msgs/msg/Range',
            {
                'radiation_type': 0 if isinstance(sensor, Dvl) else 1,  # ultrasound, infrared
                'min_range': low, 'max_range': high, 'variance': _variance(sensor, channel),
            },
            {'range': single},
            prepare=lambda: np.copyto(single, value, casting='same_kind'),
        )  # fmt: skip

    def velocity(sensor: Gnss | Dvl, name: str, frame: str, value: Array) -> None:
        add(
            sensor, name, 'geometry_msgs/msg/TwistWithCovarianceStamped',
            {
                'header.frame_id': frame,
                'twist.covariance': _diagonal(
                    *[_variance(sensor, sensor.config.velocity)] * 3, *[UNKNOWN] * 3
                ),
            },
            {'twist.twist.linear': value},
        )  # fmt: skip

    if imu := suite.imu:
        add(
            imu, 'imu/data', 'sensor_msgs/msg/Imu',
            {
                'orientation_covariance': _diagonal(-1.0, 0.0, 0.0),  # there is no orientation
                'angular_velocity_covariance': _diagonal(
                    *[_variance(imu, imu.config.gyroscope)] * 3
                ),
                'linear_acceleration_covariance': _diagonal(
                    *[_variance(imu, imu.config.accelerometer)] * 3
                ),
            },
            {'angular_velocity': imu.angular_velocity, 'linear_acceleration': imu.specific_force},
        )  # fmt: skip
    if compass := suite.magnetometer:
        variance = _variance(compass, compass.config.field)
        add(
            compass, 'imu/mag', 'sensor_msgs/msg/MagneticField',
            {'magnetic_field_covariance': _diagonal(*[variance] * 3)},
            {'magnetic_field': compass.field},
        )  # fmt: skip
    if suite.barometer:
        pressure(suite.barometer, 'pressure')
    if suite.pressure:
        pressure(suite.pressure, 'water/pressure')
    if suite.airspeed:
        pressure(suite.airspeed, 'airspeed/pressure')
    if gnss := suite.gnss:
        horizontal = _variance(gnss, gnss.config.horizontal)
        vertical = _variance(gnss, gnss.config.vertical)
        add(
            gnss, 'gps/fix', 'sensor_msgs/msg/NavSatFix',
            {
                'status': {'status': 0, 'service': 1},  # a fix, by GPS
                'position_covariance': _diagonal(horizontal, horizontal, vertical),
                'position_covariance_type': 2,  # the diagonal is known
            },
            {name: gnss.geodetic[i : i + 1] for i, name in enumerate(_GEODETIC)},
        )  # fmt: skip
        velocity(gnss, 'gps/vel', 'map', gnss.velocity_w)
    if finder := suite.rangefinder:
        distance(finder, 'range', finder.config.distance, finder.values)
    if dvl := suite.dvl:
        velocity(dvl, 'dvl/twist', dvl.frame, dvl.velocity)
        distance(dvl, 'dvl/altitude', dvl.config.altitude, dvl.values[3:])
    return topics


def _variance(sensor: Sensor, channel: Channel) -> float:
    return channel.variance(sensor.config.rate)


def _diagonal(*values: float) -> list[float]:
    """Return a covariance matrix, row by row."""
    numbers: list[float] = np.diag(values).ravel().tolist()
    return numbers
