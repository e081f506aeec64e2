# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A vehicle's geoms, what is tied to it and force arrows as markers, in the map frame."""

from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np

from fluid_sim_ros.messages.templates import Source, Template
from fluid_sim_ros.messages.tied import cords, tied_bodies
from fluid_sim_ros.messages.topic import LATCHED, StateTopic
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.scene.vehicle import Vehicle, weight_in_air
from fluid_sim_ros.simulation import Simulation

MARKERS = 'visualization_msgs/msg/MarkerArray'
_ARROW, _CUBE, _SPHERE, _CYLINDER, _LINE_STRIP = range(5)  # of visualization_msgs/Marker
_GEOM = mujoco.mjtGeom
#: Geom type -> marker type and the factors that turn geom_size into the marker's full extents.
_SHAPES = {
    _GEOM.mjGEOM_SPHERE: (_SPHERE, ((2, 0, 0), (2, 0, 0), (2, 0, 0))),
    _GEOM.mjGEOM_ELLIPSOID: (_SPHERE, ((2, 0, 0), (0, 2, 0), (0, 0, 2))),
    _GEOM.mjGEOM_BOX: (_CUBE, ((2, 0, 0), (0, 2, 0), (0, 0, 2))),
    _GEOM.mjGEOM_MESH: (_CUBE, ((2, 0, 0), (0, 2, 0), (0, 0, 2))),
    _GEOM.mjGEOM_CYLINDER: (_CYLINDER, ((2, 0, 0), (2, 0, 0), (0, 2, 0))),
    _GEOM.mjGEOM_CAPSULE: (_CYLINDER, ((2, 0, 0), (2, 0, 0), (2, 2, 0))),
}
#: Arrow per observed wrench: columns and colour (red, green, blue).
_ARROWS = {'fluid': (nat.TOTAL, (0.1, 0.5, 0.9)), 'thrust': (nat.THRUST, (0.9, 0.5, 0.1))}
_ARROW_SIZE = (0.02, 0.04, 0.06)  # shaft, head diameter, head length [m]
_THINNEST = 0.005  # line of a cord that can be seen [m]


def marker(
    namespace: str, number: int, kind: int, extents: Sequence[float], colour: Sequence[float]
) -> dict[str, Any]:
    """
    Return what stays of a visualization_msgs/Marker in the frame ``map``.

    Parameters
    ----------
    namespace, number
        Together its identity.
    kind
        Marker type.
    extents
        Its scale along x, y, z [m], shape (3,).
    colour
        Red, green, blue and opacity, 0 to 1, shape (4,).

    Returns
    -------
    dict
        Values by member, as for ``Template.of``.

    """
    return {
        'header.frame_id': 'map', 'ns': namespace, 'id': number, 'type': kind,
        'scale': dict(zip('xyz', extents, strict=True)),
        'color': dict(zip('rgba', colour, strict=True)),
        'texture.header.stamp': {},  # there is no texture: its stamp stays 0
    }  # fmt: skip


class MarkerTopic(StateTopic):
    """
    The markers of one vehicle, and of a tether or a load that is tied to it.

    Force arrows start at the base_link origin; a force equal to the vehicle's weight in air is
    drawn 1 m long. Made for display: the node publishes them at their rate of wall time at most,
    and the numbers are rounded to single precision, which halves their share of a log.

    Parameters
    ----------
    simulation, vehicle
        What is drawn.
    row
        The vehicle's row of ``Simulation.observe``.
    stamp
        View of the present stamp.
    period
        Steps between two messages.

    """

    for_display = True

    def __init__(
        self, simulation: Simulation, vehicle: Vehicle, row: Array, stamp: memoryview, period: int
    ) -> None:
        self._model, self._data = simulation.model, simulation.observed
        self._row = row
        self._metres_per_newton = 1.0 / weight_in_air(self._model, vehicle.body_id)
        others = [v.body_id for v in simulation.vehicles.values() if v.name != vehicle.name]
        tied = tied_bodies(self._model, vehicle.body_id, others)
        own = [b for b in range(self._model.nbody) if self._is_part(b, vehicle.body_id)]
        self._geoms = self._drawn([*own, *tied])
        self._cords = cords(self._model, {*own, *tied})
        self._bodies = self._model.geom_bodyid[self._geoms]
        self._quats_bg_wxyz = self._model.geom_quat[self._geoms]
        self._poses = np.zeros((len(self._geoms), 7))
        self._arrows = np.zeros((len(_ARROWS), 6))
        self._lines = [np.zeros(3 * len(sites)) for sites in self._cords.values()]
        markers = [self._geom_marker(geom, vehicle.name) for geom in self._geoms]
        sources: dict[str, Source] = {
            f'markers[{i}].pose': pose for i, pose in enumerate(self._poses)
        }
        for i, (name, (_, colour)) in enumerate(_ARROWS.items()):
            sources[f'markers[{len(markers)}].points'] = self._arrows[i]
            arrow = marker('forces', i, _ARROW, _ARROW_SIZE, (*colour, 1.0))
            markers.append({**arrow, 'text': name, 'points': [{}, {}]})
        for line, (tendon, sites) in zip(self._lines, self._cords.items(), strict=True):
            sources[f'markers[{len(markers)}].points'] = line
            markers.append(self._cord_marker(tendon, len(sites), vehicle.name))
        template = Template.of(MARKERS, {'markers': markers}, list(sources))
        copies = [(place, stamp) for place in template.stamps]
        copies += template.copies(list(sources.values()))
        super().__init__(
            f'{vehicle.name}/markers', MARKERS, template, period, copies,
            needs_forces=True, prepare=self._take_state, quality=LATCHED,
        )  # fmt: skip

    def _is_part(self, body: int, base: int) -> bool:
        while body > base:
            body = int(self._model.body_parentid[body])
        return body == base

    def _drawn(self, bodies: Sequence[int]) -> list[int]:
        model, chosen = self._model, set(bodies)
        return [
            geom for geom in range(model.ngeom)
            if int(model.geom_type[geom]) in _SHAPES and int(model.geom_bodyid[geom]) in chosen
        ]  # fmt: skip

    def _cord_marker(self, tendon: int, count: int, vehicle: str) -> dict[str, Any]:
        model = self._model
        material = model.tendon_matid[tendon]
        rgba = model.tendon_rgba[tendon] if material < 0 else model.mat_rgba[material]
        width = max(2 * float(model.tendon_width[tendon]), _THINNEST)
        line = marker(f'{vehicle}/cords', tendon, _LINE_STRIP, (width, 0, 0), rgba.tolist())
        return {**line, 'pose.orientation.w': 1.0, 'points': [{}] * count}

    def _geom_marker(self, geom: int, vehicle: str) -> dict[str, Any]:
        model = self._model
        kind, factors = _SHAPES[int(model.geom_type[geom])]
        extents = np.array(factors, dtype=float) @ model.geom_size[geom]
        material = model.geom_matid[geom]
        rgba = model.geom_rgba[geom] if material < 0 else model.mat_rgba[material]
        return marker(f'{vehicle}/geoms', geom, kind, extents.tolist(), rgba.tolist())

    def _take_state(self) -> None:
        """Take poses and forces from the present state."""
        data, row, poses = self._data, self._row, self._poses
        poses[:, :3] = data.geom_xpos[self._geoms]
        poses[:, 3:] = _product_xyzw(data.xquat[self._bodies], self._quats_bg_wxyz)
        force_w = np.empty(3)
        for ends, (columns, _) in zip(self._arrows, _ARROWS.values(), strict=True):
            mujoco.mju_rotVecQuat(force_w, row[columns][:3], row[nat.QUATERNION])
            ends[:3] = row[nat.POSITION]
            ends[3:] = ends[:3] + force_w * self._metres_per_newton
        for line, sites in zip(self._lines, self._cords.values(), strict=True):
            line[:] = data.site_xpos[sites].reshape(-1)
        for numbers in (poses, self._arrows, *self._lines):
            numbers[:] = numbers.astype(np.float32)


def _product_xyzw(first_wxyz: Array, second_wxyz: Array) -> Array:
    """Return the products of two rows of quaternions, shape (n, 4); their order changes."""
    a, b = first_wxyz[:, :1], second_wxyz[:, :1]
    u, v = first_wxyz[:, 1:], second_wxyz[:, 1:]
    vector = a * v + b * u + np.cross(u, v)
    return np.hstack((vector, a * b - (u * v).sum(axis=1, keepdims=True)))
