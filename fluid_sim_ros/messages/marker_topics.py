"""A vehicle's geoms and force arrows as visualization markers, in the map frame."""

from dataclasses import dataclass

import mujoco
import numpy as np

from fluid_sim_ros.messages import templates
from fluid_sim_ros.messages.templates import Template
from fluid_sim_ros.messages.topic import StateTopic
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.scene.vehicle import Vehicle, weight_in_air
from fluid_sim_ros.simulation import Simulation

MARKERS = 'visualization_msgs/msg/MarkerArray'
_ARROW, _CUBE, _SPHERE, _CYLINDER = range(4)  # of visualization_msgs/Marker
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


@dataclass(frozen=True)
class Marker:
    """
    What stays of one marker.

    ``corners`` is the number of points that change; a marker without any changes its pose.
    """

    namespace: str
    id: int
    type: int
    extents: tuple[float, ...]
    colour: tuple[float, ...]
    text: str = ''
    corners: int = 0


def marker_array(markers: list[Marker]) -> Template:
    """
    Return visualization_msgs/MarkerArray in the frame ``map``, with one block for each marker.

    The block is its pose (position, orientation xyzw: 7), or its points (3 each).
    """
    template = Template(stamped=False).uint32(len(markers))
    for marker in markers:
        template.stamp().string('map').string(marker.namespace)
        template.uint32(marker.id).uint32(marker.type).uint32(0)  # 0: add or modify
        if marker.corners:
            template.constants([0.0] * 6 + [1.0])
        else:
            template.doubles(7)
        template.constants(marker.extents)
        for value in marker.colour:
            template.number('f', value)
        template.uint32(0).uint32(0).number('B', 0)  # lives on; not locked to its frame
        template.uint32(marker.corners)
        if marker.corners:  # an empty sequence aligns nothing behind it
            template.doubles(3 * marker.corners)
        template.uint32(0).string('')  # no colours of points, no texture ...
        template.uint32(0).uint32(0).string('').string('').uint32(0).uint32(0)
        template.string(marker.text)
        template.string('').string('').uint32(0).number('B', 0)  # ... and no mesh
    return template.finish()


class MarkerTopic(StateTopic):
    """
    The markers of one vehicle.

    Force arrows start at the base_link origin; a force equal to the vehicle's weight in air is
    drawn 1 m long. Made for display: the node publishes them at their rate of wall time at most,
    and the numbers are rounded to single precision, which halves their share of a log.
    """

    depth = 1
    transient_local = True
    for_display = True

    def __init__(
        self, simulation: Simulation, vehicle: Vehicle, row: Array, stamp: memoryview, period: int
    ) -> None:
        self._model, self._data = simulation.model, simulation.observed
        self._row = row
        self._metres_per_newton = 1.0 / weight_in_air(self._model, vehicle.body_id)
        self._geoms = [g for g in range(self._model.ngeom) if self._is_drawn(g, vehicle.body_id)]
        self._bodies = self._model.geom_bodyid[self._geoms]
        self._quats_bg_wxyz = self._model.geom_quat[self._geoms]
        self._poses = np.zeros((len(self._geoms), 7))
        self._arrows = np.zeros((len(_ARROWS), 6))
        template = marker_array(
            [self._geom_marker(geom, vehicle.name) for geom in self._geoms]
            + [
                Marker('forces', i, _ARROW, _ARROW_SIZE, (*colour, 1.0), name, corners=2)
                for i, (name, (_, colour)) in enumerate(_ARROWS.items())
            ]
        )
        copies = [(place, stamp) for place in template.stamps]
        copies += [
            (block, templates.as_bytes(numbers))
            for block, numbers in zip(template.blocks, [*self._poses, *self._arrows], strict=True)
        ]
        super().__init__(
            f'{vehicle.name}/markers', MARKERS, template, period, copies,
            needs_forces=True, prepare=self._look,
        )  # fmt: skip

    def _is_drawn(self, geom: int, base: int) -> bool:
        model = self._model
        if int(model.geom_type[geom]) not in _SHAPES:
            return False
        body = model.geom_bodyid[geom]
        while body > base:
            body = model.body_parentid[body]
        return bool(body == base)

    def _geom_marker(self, geom: int, vehicle: str) -> Marker:
        model = self._model
        kind, factors = _SHAPES[int(model.geom_type[geom])]
        extents = np.array(factors, dtype=float) @ model.geom_size[geom]
        material = model.geom_matid[geom]
        rgba = model.geom_rgba[geom] if material < 0 else model.mat_rgba[material]
        return Marker(
            f'{vehicle}/geoms', geom, kind, tuple(extents.tolist()), tuple(rgba.tolist())
        )

    def _look(self) -> None:
        """Take poses and forces from the present state."""
        data, row, poses = self._data, self._row, self._poses
        poses[:, :3] = data.geom_xpos[self._geoms]
        poses[:, 3:] = _product_xyzw(data.xquat[self._bodies], self._quats_bg_wxyz)
        force_w = np.empty(3)
        for ends, (columns, _) in zip(self._arrows, _ARROWS.values(), strict=True):
            mujoco.mju_rotVecQuat(force_w, row[columns][:3], row[nat.QUATERNION])
            ends[:3] = row[nat.POSITION]
            ends[3:] = ends[:3] + force_w * self._metres_per_newton
        for numbers in (poses, self._arrows):
            numbers[:] = numbers.astype(np.float32)


def _product_xyzw(first_wxyz: Array, second_wxyz: Array) -> Array:
    """Return the products of two rows of quaternions, shape (n, 4); their order changes."""
    a, b = first_wxyz[:, :1], second_wxyz[:, :1]
    u, v = first_wxyz[:, 1:], second_wxyz[:, 1:]
    vector = a * v + b * u + np.cross(u, v)
    return np.hstack((vector, a * b - (u * v).sum(axis=1, keepdims=True)))
