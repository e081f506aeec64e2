# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The control laws of the examples, each with a target that can be moved while it holds."""

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple, Protocol

from fluid_sim_ros.control import rotation as rot
from fluid_sim_ros.control.fixed_wing import FixedWingCommand, FixedWingController, FlightTarget
from fluid_sim_ros.control.multirotor import MultirotorController, PoseTarget
from fluid_sim_ros.control.plant import Plant
from fluid_sim_ros.control.state import State
from fluid_sim_ros.control.torpedo import CruiseTarget, TorpedoController
from fluid_sim_ros.control.underwater import DepthTarget, UnderwaterController
from fluid_sim_ros.physics.environment.atmosphere import GRAVITY
from fluid_sim_ros.scene.vehicle import Vehicle

#: Speed at which a torpedo is held that begins slower [m/s].
_CRUISE = 1.5
_FINS = ('rudder', 'planes')
_SURFACES = FixedWingCommand._fields[1:]


class Answer(NamedTuple):
    """Thrusts [N] and joint commands in the order of the vehicle's; no joints: left alone."""

    thrusts: Sequence[float]
    joints: Sequence[float] = ()


class Move(NamedTuple):
    """
    How far a target is to be moved, in the axes of the target's heading.

    Attributes
    ----------
    forward, left, up
        [m]. An aircraft and a torpedo take ``forward`` as a change of speed [m/s], and no
        ``left``.
    turn
        Of the heading, to the left [rad].

    """

    forward: float = 0.0
    left: float = 0.0
    up: float = 0.0
    turn: float = 0.0


class Helm(Protocol):
    """
    A law with the target that it holds.

    Attributes
    ----------
    fastest
        How fast the target is moved at most, as a ``Move`` per second.

    """

    fastest: Move

    def __call__(self, state: State) -> Answer:
        """
        Return the commands that answer a state.

        Parameters
        ----------
        state
            Of the vehicle.

        """

    def move(self, by: Move) -> None:
        """
        Move the target.

        Parameters
        ----------
        by
            How far.

        """


class _Planes:
    """A torpedo: depth, heading and speed."""

    fastest = Move(forward=0.5, up=0.3, turn=0.2)

    def __init__(self, law: TorpedoController, target: CruiseTarget, joints: Sequence[str]):
        self._law, self.target, self._joints = law, target, tuple(joints)

    def __call__(self, state: State) -> Answer:
        thrust, *fins = self._law.step(state, self.target)
        return Answer([thrust], [fins[_FINS.index(name)] for name in self._joints])

    def move(self, by: Move) -> None:
        depth, heading, speed = self.target
        self.target = CruiseTarget(
            depth - by.up, rot.wrap(heading + by.turn), max(speed + by.forward, 0.0)
        )


class _Wings:
    """An aircraft: height, heading and airspeed."""

    fastest = Move(forward=2.0, up=2.0, turn=0.3)

    def __init__(self, law: FixedWingController, target: FlightTarget, joints: Sequence[str]):
        self._law, self.target, self._joints = law, target, tuple(joints)

    def __call__(self, state: State) -> Answer:
        thrust, *surfaces = self._law.step(state, self.target)
        return Answer([thrust], [surfaces[_SURFACES.index(name)] for name in self._joints])

    def move(self, by: Move) -> None:
        height, heading, speed, _ = self.target
        self.target = FlightTarget(
            height + by.up, rot.wrap(heading + by.turn), max(speed + by.forward, 0.0)
        )


class _Dive:
    """An underwater vehicle: depth, place and heading."""

    fastest = Move(forward=0.6, left=0.6, up=0.4, turn=0.6)

    def __init__(self, law: UnderwaterController, target: DepthTarget):
        self._law, self.target = law, target

    def __call__(self, state: State) -> Answer:
        return Answer(self._law.step(state, self.target))

    def move(self, by: Move) -> None:
        old = self.target
        place = _moved(old.place_w or (0.0, 0.0), old.heading, by)
        self.target = DepthTarget(
            old.depth - by.up, rot.wrap(old.heading + by.turn), place_w=place
        )


class _Hover:
    """A multirotor: place, height and heading."""

    fastest = Move(forward=2.0, left=2.0, up=1.0, turn=0.8)

    def __init__(self, law: MultirotorController, target: PoseTarget):
        self._law, self.target = law, target

    def __call__(self, state: State) -> Answer:
        return Answer(self._law.step(state, self.target))

    def move(self, by: Move) -> None:
        place, yaw = self.target
        x, y = _moved(place, yaw, by)
        self.target = PoseTarget((x, y, place[2] + by.up), rot.wrap(yaw + by.turn))


def _moved(place: Sequence[float], heading: float, by: Move) -> tuple[float, float]:
    """Return where a place in the world [m] lies after a move along a heading [rad]."""
    cos, sin = math.cos(heading), math.sin(heading)
    return (
        place[0] + cos * by.forward - sin * by.left,
        place[1] + sin * by.forward + cos * by.left,
    )


#: Something that answers states with commands.
Law = Callable[[State], Answer]


def helm_of(plant: Plant, vehicle: Vehicle, begin: State) -> Helm:
    """
    Return the law that fits a vehicle, holding the place, height and heading of a state.

    Parameters
    ----------
    plant
        Mass and thrusters.
    vehicle
        Its fins or surfaces tell a torpedo and an aircraft; of the others, one that buoyancy
        carries is held as an underwater vehicle, the rest as a multirotor.
    begin
        What to hold; an aircraft and a torpedo go on at its speed.

    Returns
    -------
    Helm
        With its default gains.

    Raises
    ------
    ConfigError
        If the law does not fit the vehicle after all; says why.

    """
    r_wb = rot.from_quaternion(begin.quat_wb_wxyz)
    yaw, height = rot.yaw_of(r_wb), begin.position_w[2]
    joints = vehicle.joints
    if set(joints) == set(_FINS):
        torpedo = TorpedoController(plant, float(abs(vehicle.joint_range).min()))
        return _Planes(
            torpedo, CruiseTarget(-height, yaw, max(begin.velocity_b[0], _CRUISE)), joints
        )
    if set(joints) == set(_SURFACES):
        plane = FixedWingController(plant, float(abs(vehicle.joint_range).min()))
        return _Wings(plane, FlightTarget(height, yaw, begin.velocity_b[0]), joints)
    if plant.weight < 0.5 * plant.mass * GRAVITY:
        rov = UnderwaterController(plant)
        return _Dive(rov, DepthTarget(-height, yaw, place_w=begin.position_w))
    return _Hover(MultirotorController(plant), PoseTarget(begin.position_w, yaw))
