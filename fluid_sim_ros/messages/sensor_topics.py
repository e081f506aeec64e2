"""The topics of a vehicle's sensors: each new reading as one message, when it appears."""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from fluid_sim_ros.messages import sensor_templates, templates
from fluid_sim_ros.messages.topic import StateTopic
from fluid_sim_ros.schema.sensors import Channel
from fluid_sim_ros.sensors import SensorSuite
from fluid_sim_ros.sensors.airspeed import Airspeed
from fluid_sim_ros.sensors.beams import Dvl, Rangefinder
from fluid_sim_ros.sensors.gnss import Gnss
from fluid_sim_ros.sensors.pressure import Barometer, WaterPressure
from fluid_sim_ros.sensors.sensor import Sensor
from fluid_sim_ros.simulation import Simulation

Samples = NDArray[np.float64] | NDArray[np.float32]

IMU = 'sensor_msgs/msg/Imu'
MAGNETIC_FIELD = 'sensor_msgs/msg/MagneticField'
FLUID_PRESSURE = 'sensor_msgs/msg/FluidPressure'
NAV_SAT_FIX = 'sensor_msgs/msg/NavSatFix'
RANGE = 'sensor_msgs/msg/Range'
VELOCITY = 'geometry_msgs/msg/TwistWithCovarianceStamped'


class SensorTopic(StateTopic):
    """
    A topic that shows a sensor's readings.

    Its stamp is the time at which the reading was true, so with latency it lies in the past. A
    sensor may have several topics, and is sampled only while one of them is asked for.
    """

    reliable = False
    depth = 5

    def __init__(
        self,
        simulation: Simulation,
        sensor: Sensor,
        name: str,
        message: str,
        template: templates.Template,
        sources: list[Samples],
        prepare: Callable[[], None] | None = None,
    ) -> None:
        self._simulation, self._sensor = simulation, sensor
        self._stamp = templates.StampBytes()
        copies = [(template.stamps[0], self._stamp.view)]
        copies += [
            (block, templates.as_bytes(source))
            for block, source in zip(template.blocks, sources, strict=True)
        ]
        super().__init__(
            name, message, template, math.gcd(sensor.period, sensor.latency), copies,
            sensor.needs_forces, prepare, appears_later=sensor.latency > 0,
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
    """Return the topics of a vehicle's sensors."""
    topics: list[SensorTopic] = []

    def add(
        sensor: Sensor,
        name: str,
        message: str,
        template: templates.Template,
        *sources: Samples,
        prepare: Callable[[], None] | None = None,
    ) -> None:
        full = f'{vehicle}/{name}'
        topics.append(
            SensorTopic(simulation, sensor, full, message, template, list(sources), prepare)
        )

    def variance(sensor: Sensor, channel: Channel) -> float:
        return channel.variance(sensor.config.rate)

    def pressure(sensor: Barometer | WaterPressure | Airspeed, name: str) -> None:
        template = sensor_templates.fluid_pressure(
            sensor.frame, variance(sensor, sensor.config.pressure)
        )
        add(sensor, name, FLUID_PRESSURE, template, sensor.values)

    def distance(sensor: Rangefinder | Dvl, name: str, channel: Channel, value: Samples) -> None:
        low, high = channel.range or (0.0, math.inf)
        by_sound = isinstance(sensor, Dvl)
        template = sensor_templates.distance(
            sensor.frame, by_sound, low, high, variance(sensor, channel)
        )
        single = np.zeros(1, dtype=np.float32)
        add(
            sensor, name, RANGE, template, single,
            prepare=lambda: np.copyto(single, value, casting='same_kind'),
        )  # fmt: skip

    def velocity(sensor: Gnss | Dvl, name: str, frame: str, value: Samples) -> None:
        template = sensor_templates.velocity(frame, variance(sensor, sensor.config.velocity))
        add(sensor, name, VELOCITY, template, value)

    if imu := suite.imu:
        file = imu.config
        template = sensor_templates.imu(
            imu.frame, variance(imu, file.gyroscope), variance(imu, file.accelerometer)
        )
        add(imu, 'imu/data', IMU, template, imu.angular_velocity, imu.specific_force)
    if compass := suite.magnetometer:
        template = sensor_templates.magnetic_field(
            compass.frame, variance(compass, compass.config.field)
        )
        add(compass, 'imu/mag', MAGNETIC_FIELD, template, compass.field)
    if suite.barometer:
        pressure(suite.barometer, 'pressure')
    if suite.pressure:
        pressure(suite.pressure, 'water/pressure')
    if suite.airspeed:
        pressure(suite.airspeed, 'airspeed/pressure')
    if gnss := suite.gnss:
        template = sensor_templates.nav_sat_fix(
            gnss.frame, variance(gnss, gnss.config.horizontal),
            variance(gnss, gnss.config.vertical),
        )  # fmt: skip
        add(gnss, 'gps/fix', NAV_SAT_FIX, template, gnss.geodetic)
        velocity(gnss, 'gps/vel', 'map', gnss.velocity_w)
    if finder := suite.rangefinder:
        distance(finder, 'range', finder.config.distance, finder.values)
    if dvl := suite.dvl:
        velocity(dvl, 'dvl/twist', dvl.frame, dvl.velocity)
        distance(dvl, 'dvl/altitude', dvl.config.altitude, dvl.values[3:])
    return topics
