# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A model posed as a frame has it: bodies, force arrows, water; without drawing anything."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.plugins import surface
from fluid_sim_ros.plugins.drawn_arrow import extent
from fluid_sim_ros.scene.vehicle import Vehicle, weight_in_air
from fluid_sim_ros.view.frame import Frame

#: A force equal to the weight is drawn this long, in extents of the vehicle.
LENGTH = 2.0
#: Forces below this share of the weight are not drawn.
_LEAST = 1e-3
#: A fluid without a surface is a liquid above this density [kg/m^3].
_LIQUID = 100.0
#: Without a weight to compare with [N].
_NO_WEIGHT = 1.0


@dataclass(frozen=True)
class Arrow:
    """
    A force to draw.

    Attributes
    ----------
    term
        Fluid term, ``total``, ``thrust`` or ``weight``.
    start, along
        World axes [m], shape (3,): where it acts, and its drawn length.
    newtons
        Its size [N].

    """

    term: str
    start: Array
    along: Array
    newtons: float


class Stage:
    """
    Poses a model.

    Parameters
    ----------
    model
        Only read; the data is the stage's own.
    vehicles
        By name, in the order of a frame's rows.

    Attributes
    ----------
    data
        As the last ``pose`` left it.
    ghost
        The same for the frame's ghost.
    extents
        How far each vehicle reaches from its origin [m].

    """

    def __init__(self, model: mujoco.MjModel, vehicles: Mapping[str, Vehicle]) -> None:
        self.model, self.vehicles = model, vehicles
        self.data, self.ghost = mujoco.MjData(model), mujoco.MjData(model)
        self.extents = {v.name: extent(model, v.body_id) for v in vehicles.values()}
        self._weights = {
            v.name: weight_in_air(model, v.body_id) or _NO_WEIGHT for v in vehicles.values()
        }

    def pose(self, frame: Frame) -> None:
        """
        Pose the model.

        Parameters
        ----------
        frame
            Its ``qpos`` and ``time`` are taken.

        """
        self.data.qpos[:] = frame.qpos
        self.data.time = frame.time
        if frame.weather is not None:
            self.data.plugin_state[:] = frame.weather
        mujoco.mj_kinematics(self.model, self.data)
        if frame.ghost is not None:
            self.ghost.qpos[:] = frame.ghost
            mujoco.mj_kinematics(self.model, self.ghost)

    def arrows(self, frame: Frame, name: str, terms: Iterable[str], scale: float) -> list[Arrow]:
        """
        Return the forces on a vehicle as arrows, of the last posed frame.

        Parameters
        ----------
        frame
            With its forces.
        name
            Of the vehicle.
        terms
            That are wanted.
        scale
            Times the length of ``LENGTH`` extents for the vehicle's weight.

        Returns
        -------
        list
            From its base_link origin (``weight`` from its centre of mass); none for forces below a
            thousandth of the weight.

        """
        vehicle = self.vehicles[name]
        body, weight = vehicle.body_id, self._weights[name]
        rotation = self.data.xmat[body].reshape(3, 3)
        per_newton = LENGTH * self.extents[name] * scale / weight
        forces = frame.forces(list(self.vehicles).index(name), self._terms(terms))
        arrows = []
        for term in terms:
            start = self.data.xpos[body].copy()
            if term == 'weight':
                force_w = np.array([0.0, 0.0, -weight])
            elif term in forces:
                force_w = rotation @ forces[term]
            else:
                continue
            newtons = float(np.linalg.norm(force_w))
            if newtons > _LEAST * weight:
                arrows.append(Arrow(term, start, force_w * per_newton, newtons))
        return arrows

    @staticmethod
    def _terms(terms: Iterable[str]) -> list[str]:
        return [term for term in terms if term not in ('total', 'thrust', 'weight')]

    def thrusters(self, frame: Frame, name: str, scale: float) -> list[Arrow]:
        """
        Return the force of each thruster of a vehicle, where it acts.

        Parameters
        ----------
        frame
            With the forces of the actuators.
        name
            Of the vehicle.
        scale
            As of ``arrows``.

        Returns
        -------
        list
            None for thrusters that do not act at a site.

        """
        model, vehicle, weight = self.model, self.vehicles[name], self._weights[name]
        per_newton = LENGTH * self.extents[name] * scale / weight
        found = []
        for actuator, effort in zip(vehicle.thruster_ids, vehicle.effort_scale, strict=True):
            if model.actuator_trntype[actuator] != mujoco.mjtTrn.mjTRN_SITE:
                continue
            site = int(model.actuator_trnid[actuator, 0])
            gear = model.actuator_gear[actuator, :3]
            size = float(np.linalg.norm(gear))
            body = int(model.site_bodyid[site])
            force = float(frame.force[actuator]) * float(effort)
            if size == 0.0 or not np.isfinite(force) or abs(force) < _LEAST * weight:
                continue
            rotation = np.zeros(9)
            mujoco.mju_quat2Mat(rotation, model.site_quat[site])
            axis_b = rotation.reshape(3, 3) @ (gear / size)
            r_wb = self.data.xmat[body].reshape(3, 3)
            start = self.data.xpos[body] + r_wb @ model.site_pos[site]
            found.append(Arrow('thrust', start, r_wb @ axis_b * force * per_newton, abs(force)))
        return found

    def water(self, points: Array) -> tuple[int, Array]:
        """
        Return the free surface over points, at the time of the last posed frame.

        Parameters
        ----------
        points
            x and y in the world [m], shape (n, 2).

        Returns
        -------
        kind, heights
            See ``plugins.surface.surface_heights``.

        """
        return surface.surface_heights(self.model, self.data, points)

    def flow(self, frame: Frame, name: str, points: Array) -> tuple[Array, NDArray[np.bool_]]:
        """
        Return the velocity of the fluids at points, at the time of the last posed frame.

        It is what the vehicle would meet there: means, profiles, grids, gusts, its own turbulence
        and the orbital velocity of waves. Where the source knows the flow at the vehicle alone
        (a log, a node), that is taken, and how the scene's own flow differs from there.

        Parameters
        ----------
        frame
            That was posed.
        name
            Of the vehicle.
        points
            World [m], shape (n, 3).

        Returns
        -------
        velocities
            World axes [m/s], shape (n, 3); zeros where nothing is known.
        liquid
            Which points lie in the liquid, shape (n,).

        """
        body, row = self.vehicles[name].body_id, frame.rows[list(self.vehicles).index(name)]
        place = self.data.xpos[body]
        velocities = np.array([self._flow_at(body, point) for point in points])
        liquid = self._in_liquid(points)
        known = row[nat.MEDIUM_VELOCITY]
        if frame.weather is None and np.isfinite(known).all():
            alike = liquid == self._in_liquid(place[np.newaxis])[0]
            velocities[alike] += known - self._flow_at(body, place)
        return velocities, liquid

    def _flow_at(self, body: int, point: Array) -> Array:
        out, at = np.zeros(9), np.ascontiguousarray(point)
        nat.native().flow(
            self.model._address, self.data._address, body, at.ctypes.data, out.ctypes.data
        )
        return out[:3]

    def _in_liquid(self, points: Array) -> NDArray[np.bool_]:
        kind, heights = self.water(points[:, :2])
        if kind == surface.NO_SURFACE:
            return np.full(len(points), float(self.model.opt.density) > _LIQUID)
        below: NDArray[np.bool_] = points[:, 2] < heights
        return below
