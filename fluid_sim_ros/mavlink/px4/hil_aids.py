# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Messages to PX4 that not every vehicle has: distance to the ground, and optical flow.

https://mavlink.io/en/messages/common.html has the fields.
"""

import math

from pymavlink.dialects.v20 import common as dialect

from fluid_sim_ros.mavlink.ned import Vector3
from fluid_sim_ros.mavlink.px4.hil_messages import HilWriter
from fluid_sim_ros.mavlink.px4.wire import Frame

_LASER, _DOWNWARD = 0, 25  # MAV_DISTANCE_SENSOR_LASER, MAV_SENSOR_ROTATION_PITCH_270
#: Signal quality of DISTANCE_SENSOR [%]: 1 is the worst, 0 would be unknown.
_NO_SIGNAL, _BEST = 1, 100
_UNKNOWN = 255  # covariance
_DISTANCE = Frame(dialect.MAVLink_distance_sensor_message)


def distance_sensor(
    writer: HilWriter, time_ms: int, distance: float, nearest: float, farthest: float
) -> bytes:
    """
    Return DISTANCE_SENSOR of a laser that looks down.

    Parameters
    ----------
    writer
        Numbers the message.
    time_ms
        Time by the autopilot's clock [ms].
    distance
        Measured [m]; infinite where there is no echo.
    nearest, farthest
        Range of the sensor [m].

    Returns
    -------
    bytes
        One MAVLink frame.

    """
    low, high = round(100 * nearest), round(100 * farthest)
    if math.isfinite(distance):
        measured, quality = round(100 * distance), _BEST
    else:
        measured, quality = (high + 1 if distance > 0 else 0), _NO_SIGNAL
    angles = (0.0,) * 6  # neither a field of view nor an attitude
    return _DISTANCE.pack(
        writer.number(), *writer.ids, time_ms, low, high, measured, _LASER, 0, _DOWNWARD,
        _UNKNOWN, *angles, quality,
    )  # fmt: skip


class OpticalFlow:
    """
    Integrates the flow that a downward camera sees, without noise.

    The image turns with the camera, and moves by the velocity over the ground by the distance:
    about x by p - v_y / d, about y by q + v_x / d [rad/s], axes forward and right.
    """

    def __init__(self) -> None:
        self._begin()

    def _begin(self) -> None:
        self._flow = [0.0, 0.0]
        self._turn = [0.0, 0.0, 0.0]
        self._duration = 0.0

    def add(self, rates: Vector3, velocity_frd: Vector3, distance: float, seconds: float) -> None:
        """
        Go on for a while.

        Parameters
        ----------
        rates
            Angular velocity [rad/s], FRD axes.
        velocity_frd
            Over ground [m/s], FRD axes.
        distance
            To the ground along the camera's axis [m].
        seconds
            How long.

        """
        p, q, _ = rates
        forward, right, _ = velocity_frd
        self._flow[0] += seconds * (p - right / distance)
        self._flow[1] += seconds * (q + forward / distance)
        self._turn = [turn + seconds * rate for turn, rate in zip(self._turn, rates, strict=True)]
        self._duration += seconds

    def message(self, time_us: int, distance: float) -> dialect.MAVLink_hil_optical_flow_message:
        """
        Return HIL_OPTICAL_FLOW of all since the last one, and begin anew.

        Parameters
        ----------
        time_us
            Time by the autopilot's clock [us].
        distance
            To the ground [m]; infinite: too far, the flow then has no quality.

        Returns
        -------
        message
            Of the dialect.

        """
        seen = math.isfinite(distance) and self._duration > 0
        message = dialect.MAVLink_hil_optical_flow_message(
            time_us, 0, round(1e6 * self._duration), *self._flow, *self._turn, 0,
            255 if seen else 0, 0, distance if seen else -1.0,
        )  # fmt: skip
        self._begin()
        return message
