# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Where a sensor sits: on which vehicle, and at which place and turn of its base body."""

from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.scene.vehicle import Vehicle
from fluid_sim_ros.simulation import Simulation


@dataclass(frozen=True)
class Carrier:
    """
    What sensors are mounted on.

    Attributes
    ----------
    simulation, vehicle
        Whose state they measure.
    state
        The vehicle's row of ``Simulation.observe``, which follows each call.
    seed
        Of their random numbers.
    dither
        Whether readings that autopilots watch may never stand still.

    """

    simulation: Simulation
    vehicle: Vehicle
    state: Array
    seed: int
    dither: bool


@dataclass(frozen=True)
class Mount:
    """
    Where a sensor sits on its base body.

    Attributes
    ----------
    position_b
        Place in base_link [m], shape (3,).
    rotation_sb
        Turns vectors of base_link into the sensor's axes, shape (3, 3); None: the same axes.
    quat_bs_wxyz
        The opposite turn, from the sensor's axes to base_link, shape (4,).

    """

    position_b: Array
    rotation_sb: Array | None
    quat_bs_wxyz: Array

    @classmethod
    def of_site(cls, carrier: Carrier, site: str | None, where: str) -> 'Mount':
        """
        Return the mount at a site of the base body.

        Parameters
        ----------
        carrier
            What carries the sensor.
        site
            Its name; None is base_link itself.
        where
            What an error begins with.

        Returns
        -------
        Mount
            Place and axes.

        Raises
        ------
        ConfigError
            If the base body has no such site.

        """
        if site is None:
            return cls(np.zeros(3), None, np.array([1.0, 0.0, 0.0, 0.0]))
        model, body = carrier.simulation.model, carrier.vehicle.body_id
        prefix = carrier.vehicle.prefix
        identity = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SITE, prefix + site)
        if identity < 0 or model.site_bodyid[identity] != body:
            sites = [model.site(i) for i in range(model.nsite) if model.site_bodyid[i] == body]
            has = listed(s.name.removeprefix(prefix) for s in sites if s.name)
            raise ConfigError(f"{where}: site '{site}' is not on the base body; it has: {has}")
        rotation = np.empty(9)
        mujoco.mju_quat2Mat(rotation, model.site_quat[identity])
        rotation_bs = rotation.reshape(3, 3)
        turned = not np.array_equal(rotation_bs, np.eye(3))
        return cls(
            model.site_pos[identity].copy(), rotation_bs.T.copy() if turned else None,
            model.site_quat[identity].copy(),
        )  # fmt: skip

    def to_sensor(self, vectors_b: Array) -> Array:
        """
        Turn vectors into the sensor's axes.

        Parameters
        ----------
        vectors_b
            Of any unit, base_link axes, shape (..., 3).

        Returns
        -------
        Array
            The same vectors, axes of the sensor.

        """
        if self.rotation_sb is None:
            return vectors_b
        turned: Array = vectors_b @ self.rotation_sb.T
        return turned

    def turned(self, vector_b: Sequence[float]) -> Sequence[float]:
        """
        Turn one vector into the sensor's axes, in the order of operations of the compiled twin.

        Parameters
        ----------
        vector_b
            Of any unit, base_link axes, three numbers.

        Returns
        -------
        vector_s
            The same vector, axes of the sensor.

        """
        if self.rotation_sb is None:
            return vector_b
        x, y, z = vector_b
        a, b, c, d, e, f, g, h, i = self.rotation_sb.ravel().tolist()
        return a * x + b * y + c * z, d * x + e * y + f * z, g * x + h * y + i * z

    def to_base(self, vectors_s: Array) -> Array:
        """
        Turn vectors into base_link's axes.

        Parameters
        ----------
        vectors_s
            Of any unit, axes of the sensor, shape (..., 3).

        Returns
        -------
        Array
            The same vectors, base_link axes.

        """
        if self.rotation_sb is None:
            return vectors_s
        turned: Array = vectors_s @ self.rotation_sb
        return turned
