"""Vehicle geoms and force arrows as visualization markers, in the map frame."""

from typing import Any

import mujoco
import numpy as np
from geometry_msgs.msg import Point
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.vehicle import Vehicle, weight_in_air

_LATCHED = QoSProfile(
    depth=1, reliability=ReliabilityPolicy.RELIABLE, durability=DurabilityPolicy.TRANSIENT_LOCAL
)
_GEOM = mujoco.mjtGeom
#: Geom type -> marker type and the factors that turn geom_size into the marker's full extents.
_SHAPES = {
    _GEOM.mjGEOM_SPHERE: (Marker.SPHERE, ((2, 0, 0), (2, 0, 0), (2, 0, 0))),
    _GEOM.mjGEOM_ELLIPSOID: (Marker.SPHERE, ((2, 0, 0), (0, 2, 0), (0, 0, 2))),
    _GEOM.mjGEOM_BOX: (Marker.CUBE, ((2, 0, 0), (0, 2, 0), (0, 0, 2))),
    _GEOM.mjGEOM_MESH: (Marker.CUBE, ((2, 0, 0), (0, 2, 0), (0, 0, 2))),
    _GEOM.mjGEOM_CYLINDER: (Marker.CYLINDER, ((2, 0, 0), (2, 0, 0), (0, 2, 0))),
    _GEOM.mjGEOM_CAPSULE: (Marker.CYLINDER, ((2, 0, 0), (2, 0, 0), (2, 2, 0))),
}
#: Arrow per observed wrench: columns and colour (red, green, blue).
_ARROWS = {'fluid': (nat.TOTAL, (0.1, 0.5, 0.9)), 'thrust': (nat.THRUST, (0.9, 0.5, 0.1))}
_ARROW_SIZE = (0.02, 0.04, 0.06)  # shaft, head diameter, head length [m]


class VehicleMarkers:
    """
    The marker topic of one vehicle.

    Force arrows start at the base_link origin; a force equal to the vehicle's weight in air is
    drawn 1 m long.
    """

    def __init__(self, node: Node, simulation: Simulation, vehicle: Vehicle, row: int) -> None:
        self._simulation = simulation
        self._row = row
        self._body = vehicle.body_id
        model = simulation.model
        self._metres_per_newton = 1.0 / weight_in_air(model, vehicle.body_id)
        self._publisher = node.create_publisher(MarkerArray, f'{vehicle.name}/markers', _LATCHED)
        self._geoms = [g for g in range(model.ngeom) if self._is_drawn(g)]
        self._message = MarkerArray(
            markers=[_geom_marker(model, g, vehicle.name) for g in self._geoms]
            + [_arrow_marker(name, colour) for name, (_, colour) in _ARROWS.items()]
        )

    def _is_drawn(self, geom: int) -> bool:
        model = self._simulation.model
        if int(model.geom_type[geom]) not in _SHAPES:
            return False
        body = model.geom_bodyid[geom]
        while body > self._body:
            body = model.body_parentid[body]
        return bool(body == self._body)

    def publish_if_wanted(self) -> None:
        """Publish the present poses and forces if anybody listens."""
        if not self._publisher.get_subscription_count():
            return
        simulation = self._simulation
        row = simulation.observe(forces=True)[self._row]
        stamp = divmod(simulation.time_ns, 1_000_000_000)
        data = simulation.observed
        quat = np.empty(4)
        for marker, geom in zip(self._message.markers, self._geoms, strict=False):
            mujoco.mju_mat2Quat(quat, data.geom_xmat[geom])
            _place(marker.pose, data.geom_xpos[geom], quat)
        arrows = self._message.markers[len(self._geoms) :]
        for marker, (columns, _) in zip(arrows, _ARROWS.values(), strict=True):
            force_w = np.empty(3)
            mujoco.mju_rotVecQuat(force_w, row[columns][:3], row[nat.QUATERNION])
            start = row[nat.POSITION]
            end = start + force_w * self._metres_per_newton
            marker.points = [_point(start), _point(end)]
        for marker in self._message.markers:
            marker.header.stamp.sec, marker.header.stamp.nanosec = stamp
        self._publisher.publish(self._message)

    def destroy(self, node: Node) -> None:
        """Remove the publisher from the node."""
        node.destroy_publisher(self._publisher)


def _geom_marker(model: Any, geom: int, vehicle: str) -> Marker:
    kind, factors = _SHAPES[int(model.geom_type[geom])]
    marker = Marker(ns=f'{vehicle}/geoms', id=geom, type=kind, action=Marker.ADD)
    marker.header.frame_id = 'map'
    extents = np.array(factors, dtype=float) @ model.geom_size[geom]
    marker.scale.x, marker.scale.y, marker.scale.z = extents.tolist()
    material = model.geom_matid[geom]
    rgba = model.geom_rgba[geom] if material < 0 else model.mat_rgba[material]
    marker.color = ColorRGBA(**dict(zip('rgba', map(float, rgba), strict=True)))
    return marker


def _arrow_marker(name: str, colour: tuple[float, float, float]) -> Marker:
    marker = Marker(ns='forces', id=list(_ARROWS).index(name), type=Marker.ARROW)
    marker.header.frame_id = 'map'
    marker.pose.orientation.w = 1.0
    marker.scale.x, marker.scale.y, marker.scale.z = _ARROW_SIZE
    marker.color = ColorRGBA(r=colour[0], g=colour[1], b=colour[2], a=1.0)
    marker.text = name
    return marker


def _place(pose: Any, position: Any, quat_wxyz: Any) -> None:
    pose.position.x, pose.position.y, pose.position.z = position.tolist()
    w, x, y, z = quat_wxyz.tolist()
    pose.orientation.x, pose.orientation.y, pose.orientation.z, pose.orientation.w = x, y, z, w


def _point(position: Any) -> Point:
    x, y, z = position.tolist()
    return Point(x=x, y=y, z=z)
