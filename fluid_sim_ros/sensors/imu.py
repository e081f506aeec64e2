# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The inertial measurement unit: specific force and angular rates at its place."""

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.schema.sensors import ImuFile
from fluid_sim_ros.sensors.mount import Carrier
from fluid_sim_ros.sensors.reading import IMU, Quantity, Reading
from fluid_sim_ros.sensors.sensor import Sensor


class Imu(Sensor, file=ImuFile):
    """
    Accelerometer and gyroscope in one place.

    With the specific force f_o of the base_link origin (acceleration minus gravity), angular
    velocity w and angular acceleration a, an accelerometer at r reads

        f = f_o + a x r + w x (w x r)

    (Titterton and Weston, *Strapdown Inertial Navigation Technology*, 2nd ed. 2004, ch. 4). The
    world is taken for inertial: the Earth's rate, 7.3e-5 rad/s, is left out.

    Parameters
    ----------
    carrier, config
        See ``Sensor``.

    Attributes
    ----------
    specific_force
        [m/s^2], axes of the mount, shape (3,); +9.81 upwards at rest, 0 in free fall.
    angular_velocity
        [rad/s], axes of the mount, shape (3,).

    """

    config: ImuFile
    channels = (('accelerometer', 3), ('gyroscope', 3))
    # below the noise of any, above the rounding of float32
    dither = (1e-3, 1e-4)  # [m/s^2], [rad/s]
    readings = (
        # REP-145: data_raw where there is no orientation
        Reading('imu/data_raw', IMU, (
            Quantity('angular_velocity', 'rad/s', ('gyroscope',)),
            Quantity('specific_force', 'm/s^2', ('accelerometer',)),
        ), former='imu/data'),
    )  # fmt: skip
    needs_forces = True

    def __init__(self, carrier: Carrier, config: ImuFile) -> None:
        super().__init__(carrier, config)
        self.specific_force = self.values[:3]
        self.angular_velocity = self.values[3:]

    def _measure(self, values: Array) -> bool:
        # plain floats: three times as fast as arrays of three
        wx, wy, wz, fx, fy, fz, ax, ay, az = self._state[_RATES_TO_ACCELERATIONS].tolist()
        rx, ry, rz = self._arm
        along = wx * rx + wy * ry + wz * rz
        square = wx * wx + wy * wy + wz * wz
        values[:] = (
            fx + ay * rz - az * ry + wx * along - square * rx,
            fy + az * rx - ax * rz + wy * along - square * ry,
            fz + ax * ry - ay * rx + wz * along - square * rz,
            wx, wy, wz,
        )  # fmt: skip
        if self.mount.rotation_sb is not None:
            numbers = values.tolist()
            values[:] = *self.mount.turned(numbers[:3]), *self.mount.turned(numbers[3:])
        return True


#: Angular velocity, specific force and angular acceleration lie side by side.
_RATES_TO_ACCELERATIONS = slice(nat.ANGULAR_VELOCITY.start, nat.ANGULAR_ACCELERATION.stop)
