# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Sensors that look along rays: rangefinder and Doppler velocity log."""

import math
from collections.abc import Sequence

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins.translucent import translucent_geoms
from fluid_sim_ros.schema.sensors import DvlFile, RangefinderFile, SensorFile
from fluid_sim_ros.sensors.mount import Carrier
from fluid_sim_ros.sensors.reading import (
    INFRARED,
    RANGE,
    ULTRASOUND,
    VELOCITY,
    Quantity,
    Reading,
)
from fluid_sim_ros.sensors.sensor import Sensor

#: Rays step over the geoms of the vehicle's moving parts and of water, at most this many.
_PASSED = 64
#: How far a ray goes on behind such a geom [m].
_STEP = 1e-6
#: A range's frame has its x along the ray; this turn takes x to z.
_X_TO_Z = np.array([math.sqrt(0.5), 0.0, -math.sqrt(0.5), 0.0])


class Looking(Sensor):
    """
    A sensor with rays; needs the geoms' places at this boundary, which come with the forces.

    Parameters
    ----------
    carrier, config
        See ``Sensor``.

    Attributes
    ----------
    passed
        Whether rays pass each geom of the model.

    """

    needs_forces = True

    def __init__(self, carrier: Carrier, config: SensorFile) -> None:
        super().__init__(carrier, config)
        self._geom = np.zeros(1, dtype=np.int32)
        self._base = carrier.vehicle.body_id
        model = carrier.simulation.model
        own = model.body_rootid[model.geom_bodyid] == model.body_rootid[self._base]
        self.passed = own | translucent_geoms(model)

    def _distance(self, start_w: Array, direction_w: Array) -> float:
        """Return the distance [m] along a unit vector to what no ray passes, or inf."""
        model, data = self._simulation.model, self._simulation.observed
        base = self._base
        start, gone = start_w, 0.0
        for _ in range(_PASSED):
            distance = mujoco.mj_ray(model, data, start, direction_w, None, 1, base, self._geom)
            if distance < 0:
                return math.inf
            gone += float(distance)
            if not self.passed[self._geom[0]]:
                return gone
            gone += _STEP
            start = start_w + gone * direction_w
        return math.inf


class Rangefinder(Looking, file=RangefinderFile):
    """
    Distance to the nearest geom along a ray.

    The vehicle's own geoms are looked through, as is what is translucent: bodies of water.

    Parameters
    ----------
    carrier, config
        See ``Sensor``.

    Attributes
    ----------
    distance
        [m]; +inf: nothing within the range, -inf: nearer than the range.

    """

    config: RangefinderFile
    channels = (('distance', 1),)
    readings = (
        Reading(
            'range', RANGE, (Quantity('values', 'm', ('distance',)),),
            constants={'radiation_type': INFRARED},
        ),
    )  # fmt: skip
    infinite_beyond = True
    distance = math.inf

    def __init__(self, carrier: Carrier, config: RangefinderFile) -> None:
        super().__init__(carrier, config)
        direction = np.array(config.direction)
        length = float(np.linalg.norm(direction))
        if not length > 0:
            raise ConfigError(f'{self.where}: direction {config.direction}: must not be zero')
        self._direction_b = self.mount.to_base(direction / length)
        mujoco.mju_quatZ2Vec(self.frame_quat_bs, self._direction_b)
        mujoco.mju_mulQuat(self.frame_quat_bs, self.frame_quat_bs.copy(), _X_TO_Z)

    def _measure(self, values: Array) -> bool:
        direction_w = self._to_world(self._direction_b.tolist())
        values[0] = self._distance(np.array(self._position_w()), np.array(direction_w))
        return True

    def compiled_constants(self) -> Sequence[float]:
        """Return the direction of the ray, base_link axes."""
        direction_b: list[float] = self._direction_b.tolist()
        return direction_b

    def _convert(self) -> None:
        self.distance = float(self.values[0])


class Dvl(Looking, file=DvlFile):
    """
    Velocity over the bed.

    There is bottom lock, and so a reading, while three of the four beams find a geom whose height
    below the sensor is within the range of ``altitude``.

    Parameters
    ----------
    carrier, config
        See ``Sensor``.

    Attributes
    ----------
    velocity
        [m/s], axes of the mount, shape (3,).
    altitude
        Mean height of the sensor over what the beams meet, along -z of its axes [m].
    height
        The same as an array, shape (1,).

    """

    config: DvlFile
    channels = (('velocity', 3), ('altitude', 1))
    readings = (
        Reading('dvl/twist', VELOCITY, (Quantity('velocity', 'm/s', ('velocity',)),)),
        Reading(
            'dvl/altitude', RANGE, (Quantity('height', 'm', ('altitude',)),),
            constants={'radiation_type': ULTRASOUND},
        ),
    )  # fmt: skip
    altitude = 0.0

    def __init__(self, carrier: Carrier, config: DvlFile) -> None:
        super().__init__(carrier, config)
        self.velocity, self.height = self.values[:3], self.values[3:]
        tilt = math.radians(config.beam_angle)
        self._down = math.cos(tilt)
        out = math.sin(tilt) / math.sqrt(2.0)
        corners = [(sx * out, sy * out, -self._down) for sx in (1, -1) for sy in (1, -1)]
        self._beams_b = self.mount.to_base(np.array(corners))
        self._limits = config.altitude.range or [0.0, math.inf]

    def _measure(self, values: Array) -> bool:
        start_w, (low, high) = np.array(self._position_w()), self._limits
        beams_w = self._beams_b @ self._rotation_bw()
        heights = [self._down * self._distance(start_w, beam) for beam in beams_w]
        locked = [height for height in heights if low <= height <= high and height < math.inf]
        if len(locked) < 3:
            return False
        values[:3] = self.mount.to_sensor(self._velocity_b())
        values[3] = sum(locked) / len(locked)
        return True

    def _convert(self) -> None:
        self.altitude = float(self.values[3])
