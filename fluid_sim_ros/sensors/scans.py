# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Sensors with a fan of beams in one plane: lidar and multi-beam sonar."""

import math
from typing import Any

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.physics.environment.sound_in_water import audible_range
from fluid_sim_ros.schema.sensors import LidarFile, ScanFile, SensorFile, SonarFile
from fluid_sim_ros.sensors.beams import Looking
from fluid_sim_ros.sensors.mount import Carrier
from fluid_sim_ros.sensors.reading import CLOUD, SCAN, Quantity, Reading


def _scan_and_cloud(below: str) -> tuple[Reading, ...]:
    """Return the topics of a fan: its ranges, and the same as points."""
    return (
        Reading(f'{below}scan', SCAN, (Quantity('ranges', 'm', ('distance',)),)),
        Reading(f'{below}points', CLOUD, (Quantity('points', 'm', ()),)),
    )


class _Scan(Looking):
    """
    Distances along a fan of beams; see ``Lidar``.

    All beams of a reading are of one instant. The vehicle's own geoms are looked through, and so
    is what is translucent, such as water.
    """

    config: ScanFile
    infinite_beyond = True

    def __init__(self, carrier: Carrier, config: ScanFile) -> None:
        super().__init__(carrier, config)
        first, last = (math.radians(angle) for angle in config.angles)
        self.angles = np.linspace(first, last, config.beams)
        fan = np.column_stack([
            np.cos(self.angles), np.sin(self.angles), np.zeros(config.beams)
        ])  # fmt: skip
        self._fan = fan
        self._beams_b = self.mount.to_base(fan)
        self._hit = np.zeros(config.beams, dtype=np.int32)
        self._found = np.zeros(config.beams)
        self.ranges = self.values
        self.points = np.zeros((config.beams, 3), dtype=np.float32)

    @classmethod
    def axes(cls, config: SensorFile) -> tuple[tuple[str, int], ...]:
        """
        Return what is measured.

        Parameters
        ----------
        config
            A ``ScanFile``.

        Returns
        -------
        tuple
            Key of the file, and number of beams.

        """
        assert isinstance(config, ScanFile)
        return (('distance', config.beams),)

    def constants(self, reading: Reading) -> dict[str, Any]:
        """
        Return what stays in a message.

        Parameters
        ----------
        reading
            Its topic.

        Returns
        -------
        dict
            Angles of the fan [rad], as sensor_msgs/LaserScan has them, or the size of the cloud.

        """
        if reading.message == CLOUD:
            count = len(self.angles)
            return {'width': count, 'row_step': 12 * count, 'data': bytes(12 * count)}
        step = (self.angles[-1] - self.angles[0]) / (len(self.angles) - 1)
        return {
            'angle_min': self.angles[0], 'angle_max': self.angles[-1], 'angle_increment': step,
            'scan_time': 1.0 / self.config.rate, 'ranges': [0.0] * len(self.angles),
        }  # fmt: skip

    def prepare(self, reading: Reading) -> bool:
        """
        Turn ranges into points for the cloud.

        Parameters
        ----------
        reading
            Its topic.

        Returns
        -------
        bool
            True.

        """
        if reading.message == CLOUD:
            known = np.where(np.isfinite(self.ranges), self.ranges, np.nan)
            self.points[:] = known[:, np.newaxis] * self._fan
        return True

    def _measure(self, values: Array) -> bool:
        model, data = self._simulation.model, self._simulation.observed
        start_w = np.array(self._position_w())
        beams_w = np.ascontiguousarray(self._beams_b @ self._rotation_bw())
        mujoco.mj_multiRay(
            model, data, start_w, beams_w.ravel(), None, 1, self._base, self._hit, self._found,
            None, len(beams_w), mujoco.mjMAXVAL,
        )  # fmt: skip
        values[:] = np.where(self._found < 0, math.inf, self._found)
        for i in np.flatnonzero((self._hit >= 0) & self.passed[self._hit]):
            values[i] = self._distance(start_w, beams_w[i])  # go on behind it
        return True


class Lidar(_Scan, file=LidarFile):
    """
    Distances to the nearest geoms along a fan of beams in the x-y plane of its axes.

    Parameters
    ----------
    carrier, config
        See ``Sensor``.

    Attributes
    ----------
    angles
        Of the beams, from x counter-clockwise about z [rad], shape (n,).
    ranges
        [m], shape (n,); +inf: nothing within the range, -inf: nearer than the range.
    points
        What the cloud was last made of: ends of the beams, axes of the sensor [m], shape (n, 3);
        NaN where the range is infinite.

    """

    config: LidarFile
    readings = _scan_and_cloud('')


class Sonar(_Scan, file=SonarFile):
    """
    Distances by a fan of acoustic beams in the x-y plane of its axes.

    It hears an echo as long as the transmission loss there and back (spherical spreading and
    absorption; see ``physics.environment.sound_in_water``) is below ``loss``: that, or the range
    of ``distance`` where it is shorter, is its maximum range. Beams are straight, without
    side lobes, echoes of the free surface and reverberation.

    Parameters
    ----------
    carrier, config
        See ``Sensor``.

    Attributes
    ----------
    angles, ranges, points
        As of ``Lidar``.
    reach
        Maximum range [m].

    """

    config: SonarFile
    readings = _scan_and_cloud('sonar/')

    def __init__(self, carrier: Carrier, config: SonarFile) -> None:
        self.reach = audible_range(
            config.loss, config.frequency, config.temperature, config.salinity, config.depth
        )
        low, high = config.distance.range or (0.0, math.inf)
        self.reach = min(self.reach, high)
        if not low < self.reach:
            raise ConfigError(
                f'sensors.sonar: a loss of {config.loss:g} dB reaches {self.reach:.3g} m, not the '
                f'lowest range of {low:g} m; raise loss, or lower frequency'
            )
        distance = config.distance.model_copy(update={'range': [low, self.reach]})
        super().__init__(carrier, config.model_copy(update={'distance': distance}))
