# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""How each type of message holds the numbers of a sensor and their variances."""

import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.sensors import reading

#: Variance of what is not measured, for messages that cannot say so otherwise.
UNKNOWN = 1e6


@dataclass(frozen=True)
class Layout:
    """
    Members of a message type, as for ``Template.of``.

    Attributes
    ----------
    quantities
        Members that hold the numbers of each quantity of a `Reading`.
    variances
        Member for the variances of each quantity: a number, or a covariance matrix; what a matrix
        has beyond the quantity is not measured. Empty: the message has no place for them.
    size
        Rows of such a matrix.
    limits
        Members for the lowest and the highest reading, where there are such.
    constants
        Members that are the same whatever the sensor.

    """

    quantities: tuple[tuple[str, ...], ...]
    variances: tuple[str, ...]
    size: int = 3
    limits: tuple[str, ...] = ()
    constants: Mapping[str, Any] = field(default_factory=dict)


_BIG = sys.byteorder == 'big'
#: Three numbers of single precision for each point; sensor_msgs/PointField.FLOAT32 is 7.
_POINTS: dict[str, Any] = {
    'height': 1, 'point_step': 12,
    'fields': [
        {'name': axis, 'offset': 4 * i, 'datatype': 7, 'count': 1} for i, axis in enumerate('xyz')
    ],
}  # fmt: skip

_LAYOUTS = {
    reading.IMU: Layout(
        (('angular_velocity',), ('linear_acceleration',)),
        ('angular_velocity_covariance', 'linear_acceleration_covariance'),
        constants={'orientation_covariance': [-1.0, *[0.0] * 8]},  # there is no orientation
    ),
    reading.MAGNETIC_FIELD: Layout((('magnetic_field',),), ('magnetic_field_covariance',)),
    reading.FLUID_PRESSURE: Layout((('fluid_pressure',),), ('variance',), size=1),
    reading.NAV_SAT_FIX: Layout(
        (('latitude', 'longitude', 'altitude'),), ('position_covariance',),
        # a fix, by GPS; of the covariance the diagonal is known
        constants={'status': {'status': 0, 'service': 1}, 'position_covariance_type': 2},
    ),
    reading.RANGE: Layout(
        (('range',),), ('variance',), size=1, limits=('min_range', 'max_range')
    ),
    # a scan cannot state variances
    reading.SCAN: Layout((('ranges',),), ('',), limits=('range_min', 'range_max')),
    # neither can clouds of points and pictures, whose bytes are in the order of the machine
    reading.CLOUD: Layout((('data',),), ('',), constants=_POINTS | {'is_bigendian': _BIG}),
    reading.IMAGE: Layout((('data',),), ('',), constants={'is_bigendian': int(_BIG)}),
    reading.CAMERA_INFO: Layout((), ()),
    reading.VELOCITY: Layout((('twist.twist.linear',),), ('twist.covariance',), size=6),
}  # fmt: skip


def layout_of(message: str) -> Layout:
    """
    Return where a message type holds numbers and variances.

    Parameters
    ----------
    message
        ``package/msg/Name``.

    Returns
    -------
    Layout
        Its members.

    Raises
    ------
    ConfigError
        If no sensor has this message.

    """
    try:
        return _LAYOUTS[message]
    except KeyError:
        raise ConfigError(
            f"message type '{message}' has no layout for sensors; there are: {listed(_LAYOUTS)}"
        ) from None
