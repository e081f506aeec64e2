# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""How the vehicles of a run ended: on the ground, upside down, or beyond the scene."""

import math
from dataclasses import dataclass

import mujoco
import numpy as np

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.scene.vehicle import Vehicle
from fluid_sim_ros.simulation import Simulation

#: A vehicle farther from its start than this many extents of the model is beyond the scene.
_FAR = 100.0
#: A tilt beyond this is upside down [rad].
_OVER = 0.5 * math.pi


@dataclass(frozen=True)
class _Stance:
    """How a vehicle stands: place [m], tilt of its z axis [rad], what of the world it touches."""

    position_w: Array
    tilt: float
    touches: str


class Outcome:
    """
    Compares the end of a run with its begin.

    Only what has changed is worth a word: a vehicle that begins on the ground may end there.

    Parameters
    ----------
    simulation
        At its begin.

    """

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self._begin = {name: self._stance(name) for name in simulation.vehicles}

    def remarks(self) -> list[str]:
        """Return one line for each vehicle whose end is worth a word."""
        lines = []
        for name, begin in self._begin.items():
            end = self._stance(name)
            told = [self._fallen(name, begin, end), self._beyond(begin, end)]
            words = [word for word in told if word]
            if words:
                lines.append(f"vehicle '{name}' ended {' and '.join(words)}")
        return lines

    def _stance(self, name: str) -> _Stance:
        simulation = self._simulation
        vehicle = simulation.vehicles[name]
        row = simulation.observe(forces=True)[list(simulation.vehicles).index(name)]
        matrix = np.empty(9)
        mujoco.mju_quat2Mat(matrix, row[nat.QUATERNION])
        tilt = math.acos(min(max(float(matrix[8]), -1.0), 1.0))
        return _Stance(row[nat.POSITION].copy(), tilt, _touched(simulation, vehicle))

    def _fallen(self, name: str, begin: _Stance, end: _Stance) -> str:
        vehicle = self._simulation.vehicles[name]
        words = []
        if end.touches and not begin.touches:
            words.append(f"on '{end.touches}'")
        driven = vehicle.thrusters or vehicle.joints  # others have no right way up
        if driven and end.tilt > _OVER >= begin.tilt:
            words.append(f'upside down (tilt {math.degrees(end.tilt):.0f} deg)')
        return ', '.join(words)

    def _beyond(self, begin: _Stance, end: _Stance) -> str:
        model = self._simulation.model
        below = _plane_above(model, end.position_w)
        if below and not _plane_above(model, begin.position_w):
            return f"below '{below}', through which it fell"
        way = end.position_w - begin.position_w
        far = float(np.linalg.norm(way))
        if far > _FAR * float(model.stat.extent):
            return f'{far:.0f} m from its start, beyond the scene'
        return ''


def _touched(simulation: Simulation, vehicle: Vehicle) -> str:
    """Return the name of a fixed geom that a vehicle touches, or ''."""
    model, data = simulation.model, simulation.observed
    root = model.body_rootid[vehicle.body_id]
    for pair in data.contact.geom[: data.ncon]:
        bodies = model.geom_bodyid[pair]
        roots = model.body_rootid[bodies]
        for mine, other in ((0, 1), (1, 0)):
            fixed = model.body_weldid[bodies[other]] == 0
            if roots[mine] == root and model.body_weldid[bodies[mine]] and fixed:
                return model.geom(int(pair[other])).name or 'the ground'
    return ''


def _plane_above(model: mujoco.MjModel, position_w: Array) -> str:
    """Return the name of a fixed plane whose back a place is at, or ''."""
    for geom in np.flatnonzero(model.geom_type == mujoco.mjtGeom.mjGEOM_PLANE):
        if model.body_weldid[model.geom_bodyid[geom]]:
            continue
        normal = np.empty(3)
        mujoco.mju_rotVecQuat(normal, np.array([0.0, 0.0, 1.0]), model.geom_quat[geom])
        level = normal[2] > 0.5 and (model.geom_contype[geom] or model.geom_conaffinity[geom])
        if level and float(normal @ (position_w - model.geom_pos[geom])) < 0:
            return model.geom(int(geom)).name or 'the ground'
    return ''
