# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The MAVLink 2 messages of a simulator to PX4: their bytes, their bits and their units.

Body axes are FRD, world axes NED. The codec is pymavlink's ``common`` dialect; see
https://mavlink.io/en/messages/common.html for the fields.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from pymavlink.dialects.v20 import common as dialect

from fluid_sim_ros.mavlink.ned import Quaternion, Vector3
from fluid_sim_ros.mavlink.px4.wire import Frame, triangle

#: Bits of HIL_SENSOR.fields_updated; PX4 takes a group only with all of its bits.
ACCELEROMETER, GYRO, MAGNETOMETER = 0x007, 0x038, 0x1C0
BAROMETER = 0x1A00  # absolute pressure, pressure altitude, temperature
AIRSPEED = 0x400  # differential pressure

#: MAV_ESTIMATOR_TYPE_VISION, MAV_FRAME_LOCAL_NED, MAV_FRAME_BODY_FRD
_VISION, _LOCAL_NED, _BODY_FRD = 2, 1, 12
#: A magnetic or air data value that the message has a field for, but no new reading.
_ABSENT: Vector3 = (0.0, 0.0, 0.0)
_GCS, _NOT_AN_AUTOPILOT = 6, 8  # MAV_TYPE_GCS, MAV_AUTOPILOT_INVALID
#: Of HIL_GPS: a fix in three dimensions, by so many satellites.
_FIX_3D, _SATELLITES = 3, 12
_COURSE_UNKNOWN = 65535  # [cdeg]
_SENSORS = Frame(dialect.MAVLink_hil_sensor_message)
_GPS = Frame(dialect.MAVLink_hil_gps_message)
_TRUTH = Frame(dialect.MAVLink_hil_state_quaternion_message)
_ODOMETRY = Frame(dialect.MAVLink_odometry_message)
_STICKS = Frame(dialect.MAVLink_rc_channels_message)


@dataclass
class SensorReadings:
    """
    What one HIL_SENSOR says; groups without a new reading are None.

    Attributes
    ----------
    specific_force, gyro
        [m/s^2] and [rad/s], FRD.
    magnetic_field
        [G], FRD.
    pressure, pressure_altitude, temperature
        Absolute pressure [hPa], the altitude [m] that the standard atmosphere has it at, and
        temperature [degC].
    differential_pressure
        Dynamic pressure of the air [hPa].

    """

    specific_force: Vector3
    gyro: Vector3
    magnetic_field: Vector3 | None = None
    pressure: float | None = None
    pressure_altitude: float = 0.0
    temperature: float = 0.0
    differential_pressure: float | None = None


class HilWriter:
    """
    Packs the simulator's messages, which it numbers, for one connection.

    Parameters
    ----------
    system, component
        MAVLink ids of the sender.

    """

    def __init__(self, system: int = 1, component: int = 51) -> None:
        self._mav = dialect.MAVLink(None, srcSystem=system, srcComponent=component)

    @property
    def ids(self) -> tuple[int, int]:
        """MAVLink ids of the sender: system and component."""
        return self._mav.srcSystem, self._mav.srcComponent

    def number(self) -> int:
        """Return the number of the next message, which is then taken."""
        number: int = self._mav.seq
        self._mav.seq = (number + 1) % 256
        return number

    def pack(self, message: dialect.MAVLink_message) -> bytes:
        """
        Return the frame of a message of the dialect.

        Parameters
        ----------
        message
            With its fields.

        """
        data: bytes = message.pack(self._mav)
        self._mav.seq = (self._mav.seq + 1) % 256
        return data

    def sensors(self, time_us: int, readings: SensorReadings) -> bytes:
        """
        Return HIL_SENSOR with the bits of the groups that are new.

        Parameters
        ----------
        time_us
            Time of the readings by the autopilot's clock [us].
        readings
            In the units of the message: see ``SensorReadings``.

        Returns
        -------
        bytes
            One MAVLink frame.

        """
        fields = ACCELEROMETER | GYRO
        field_frd, pressure = readings.magnetic_field, readings.pressure
        differential = readings.differential_pressure
        if field_frd is None:
            field_frd = _ABSENT
        else:
            fields |= MAGNETOMETER
        if pressure is not None:
            fields |= BAROMETER
        if differential is not None:
            fields |= AIRSPEED
        return _SENSORS.pack(
            self.number(), *self.ids,
            time_us, *readings.specific_force, *readings.gyro, *field_frd,
            pressure or 0.0, differential or 0.0, readings.pressure_altitude,
            readings.temperature, fields, 0,
        )  # fmt: skip

    def gps(
        self,
        time_us: int,
        latitude: float,
        longitude: float,
        altitude: float,
        velocity_ned: Vector3,
        eph: int = 30,
        epv: int = 40,
    ) -> bytes:
        """
        Return HIL_GPS of a 3D fix.

        Parameters
        ----------
        time_us
            Time of the fix by the autopilot's clock [us].
        latitude, longitude
            WGS 84 [deg].
        altitude
            Above mean sea level [m].
        velocity_ned
            Over ground, NED axes [m/s], three numbers.
        eph, epv
            Error of the horizontal and vertical position [cm], as PX4 reads these fields.

        Returns
        -------
        bytes
            One MAVLink frame.

        """
        north, east, down = (_int16(100 * v) for v in velocity_ned)
        speed = min(round(100 * math.hypot(*velocity_ned[:2])), 65534)
        course = math.degrees(math.atan2(velocity_ned[1], velocity_ned[0])) % 360
        return _GPS.pack(
            self.number(), *self.ids,
            time_us, round(latitude * 1e7), round(longitude * 1e7), round(altitude * 1e3),
            eph, epv, speed, north, east, down,
            round(100 * course) % 36000 if speed else _COURSE_UNKNOWN, _FIX_3D, _SATELLITES, 0, 0,
        )  # fmt: skip

    def truth(
        self,
        time_us: int,
        attitude: Quaternion,
        rates: Vector3,
        geodetic: Vector3,
        velocity_ned: Vector3,
        airspeed: float,
        acceleration_ned: Vector3,
    ) -> bytes:
        """
        Return HIL_STATE_QUATERNION, the true state for the autopilot's log.

        In the message [m/s] become cm/s, and [m/s^2] thousandths of it, saturated at their 16
        bits. (The message's definition says thousandths of g along the body's axes; PX4 reads
        thousandths of m/s^2, and logs them as the derivative of the velocity.)

        Parameters
        ----------
        time_us
            Time of the state by the autopilot's clock [us].
        attitude
            Rotation FRD to NED, scalar first, four numbers.
        rates
            Angular velocity, FRD axes [rad/s], three numbers.
        geodetic
            Latitude [deg], longitude [deg] and altitude above mean sea level [m].
        velocity_ned
            Over ground, NED axes [m/s], three numbers.
        airspeed
            Speed through the medium [m/s].
        acceleration_ned
            Derivative of the velocity, NED axes [m/s^2], three numbers.

        Returns
        -------
        bytes
            One MAVLink frame.

        """
        latitude, longitude, altitude = geodetic
        air = min(max(round(100 * airspeed), 0), 65535)
        return _TRUTH.pack(
            self.number(), *self.ids,
            time_us, *attitude, *rates,
            round(latitude * 1e7), round(longitude * 1e7), round(altitude * 1e3),
            *(_int16(100 * v) for v in velocity_ned), air, air,
            *(_int16(1000 * a) for a in acceleration_ned),
        )  # fmt: skip

    def odometry(
        self,
        time_us: int,
        position_ned: Vector3,
        attitude: Quaternion,
        velocity_frd: Vector3,
        rates: Vector3,
        pose_variance: Sequence[float],
        velocity_variance: Sequence[float],
    ) -> bytes:
        """
        Return ODOMETRY as of a vision system; variances of six numbers each.

        Parameters
        ----------
        time_us
            Time of the state by the autopilot's clock [us].
        position_ned
            From the world's origin, NED axes [m], three numbers.
        attitude
            Rotation FRD to NED, scalar first, four numbers.
        velocity_frd
            Over ground, FRD axes [m/s], three numbers.
        rates
            Angular velocity, FRD axes [rad/s], three numbers.
        pose_variance
            Of position [m^2] and attitude [rad^2], six numbers.
        velocity_variance
            Of velocity [m^2/s^2] and angular velocity [rad^2/s^2], six numbers.

        Returns
        -------
        bytes
            One MAVLink frame.

        """
        return _ODOMETRY.pack(
            self.number(), *self.ids,
            time_us, *position_ned, *attitude, *velocity_frd, *rates,
            *triangle(pose_variance), *triangle(velocity_variance),
            _LOCAL_NED, _BODY_FRD, 0, _VISION, 100,
        )  # fmt: skip

    def heartbeat(self) -> bytes:
        """Return the simulator's HEARTBEAT."""
        return self.pack(dialect.MAVLink_heartbeat_message(_GCS, _NOT_AN_AUTOPILOT, 0, 0, 0, 3))

    def rc_channels(self, time_ms: int, channels: Sequence[int]) -> bytes:
        """
        Return RC_CHANNELS: the sticks of a radio control, pulse widths [us], at most 18.

        Parameters
        ----------
        time_ms
            Time by the autopilot's clock [ms].
        channels
            Pulse widths [us], at most 18.

        Returns
        -------
        bytes
            One MAVLink frame.

        """
        pulses = [*channels, *[65535] * (18 - len(channels))]
        return _STICKS.pack(self.number(), *self.ids, time_ms, *pulses, len(channels), 255)


def _int16(value: float) -> int:
    return min(max(round(value), -32768), 32767)
