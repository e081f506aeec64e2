# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What a sensor shows of its readings: the numbers, units and message of each of its topics."""

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Quantity:
    """
    Some numbers of a reading that belong together.

    Attributes
    ----------
    name
        Attribute of the sensor that holds them: an array that each reading overwrites.
    unit
        One for all of them, or one for each.
    channels
        Keys of the sensor's file with their errors: one for all of them, or one for each; none
        for what the message cannot state errors of.

    """

    name: str
    unit: str | tuple[str, ...]
    channels: tuple[str, ...]


@dataclass(frozen=True)
class Reading:
    """
    One topic of a sensor.

    Attributes
    ----------
    topic
        Its name below that of the vehicle.
    message
        Message type, ``package/msg/Name``.
    quantities
        What the message holds, in the order of its definition.
    frame
        Frame of the numbers; '' is the sensor's own.
    former
        Name that the topic had in the last release, under which it is still there; '' for none.
    constants
        Fields of the message that are the same in all of them, where only the sensor knows them.

    """

    topic: str
    message: str
    quantities: tuple[Quantity, ...]
    frame: str = ''
    former: str = ''
    constants: Mapping[str, int] = field(default_factory=dict)


#: Values of ``sensor_msgs/Range.radiation_type``.
ULTRASOUND, INFRARED = 0, 1

IMU = 'sensor_msgs/msg/Imu'
MAGNETIC_FIELD = 'sensor_msgs/msg/MagneticField'
FLUID_PRESSURE = 'sensor_msgs/msg/FluidPressure'
NAV_SAT_FIX = 'sensor_msgs/msg/NavSatFix'
RANGE = 'sensor_msgs/msg/Range'
SCAN = 'sensor_msgs/msg/LaserScan'
CLOUD = 'sensor_msgs/msg/PointCloud2'
IMAGE = 'sensor_msgs/msg/Image'
CAMERA_INFO = 'sensor_msgs/msg/CameraInfo'
#: Messages that hold other data than a few numbers by name: they make no tables or curves.
BULKY = (CLOUD, IMAGE)
VELOCITY = 'geometry_msgs/msg/TwistWithCovarianceStamped'


def pressure_reading(topic: str) -> Reading:
    """
    Return the topic of a sensor whose only number is a pressure.

    Parameters
    ----------
    topic
        Its name below that of the vehicle.

    Returns
    -------
    Reading
        Of the channel ``pressure`` [Pa], which is all of the sensor's ``values``.

    """
    return Reading(topic, FLUID_PRESSURE, (Quantity('values', 'Pa', ('pressure',)),))
