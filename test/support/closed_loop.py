# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Controllers closed around the simulation of their scene; stamps as over ROS, without it."""

import dataclasses
from collections.abc import Callable, Sequence

import mujoco
import numpy as np

from fluid_sim_ros import Scene, Simulation
from fluid_sim_ros.control import rotation as rot
from fluid_sim_ros.control.fixed_wing import FixedWingController, FlightTarget
from fluid_sim_ros.control.multirotor import MultirotorController, PoseTarget
from fluid_sim_ros.control.state import State
from fluid_sim_ros.control.underwater import DepthTarget, UnderwaterController

Vector = tuple[float, float, float]
STILL: Vector = (0.0, 0.0, 0.0)


class Loop:
    """A scene without its schedule, one vehicle, and the state in the form of odometry."""

    def __init__(self, scene: str, rate: float, medium: str) -> None:
        self.simulation = Simulation(dataclasses.replace(Scene.load(scene), schedule=()))
        self.data = self.simulation.data
        self.steps = round(1 / (rate * self.simulation.timestep))
        (self._vehicle,) = self.simulation.vehicles
        self._medium_w = STILL
        self._set_medium = getattr(self.simulation, f'set_{medium}')  # wind or current

    def state(self) -> State:
        q, v = self.data.qpos.tolist(), self.data.qvel.tolist()
        velocity_b = rot.to_body(rot.from_quaternion(q[3:7]), v[:3])
        return State(self.simulation.time, q[:3], q[3:7], velocity_b, v[3:6])

    def advance(
        self, thrusts: list[float], medium_w: Vector, joints: Sequence[float] = ()
    ) -> None:
        simulation = self.simulation
        simulation.set_thrust(self._vehicle, thrusts)
        if joints:
            simulation.set_joints(self._vehicle, joints)
        if medium_w != self._medium_w:
            self._medium_w = medium_w
            self._set_medium(medium_w)
        simulation.step(self.steps)


def run_closed_loop(
    controller: MultirotorController,
    seconds: float,
    *,
    target: Callable[[float], Vector],
    wind: Callable[[float], Vector] = lambda t: STILL,
    yaw: float = 0.0,
    quat: tuple[float, float, float, float] | None = None,
    rate: float = 100.0,
) -> np.ndarray:
    """Return rows of time, position (3), yaw, thrusts (4)."""
    loop, rows = Loop('quadrotor', rate, 'wind'), []
    if quat is not None:
        loop.data.qpos[3:7] = np.array(quat) / np.linalg.norm(quat)
    for _ in range(round(seconds * rate)):
        state = loop.state()
        thrusts = controller.step(state, PoseTarget(target(state.time), yaw))
        heading = rot.yaw_of(rot.from_quaternion(state[2]))
        rows.append([state[0], *state[1], heading, *thrusts])
        loop.advance(thrusts, wind(state[0]))
    return np.array(rows)


def dive(
    controller: UnderwaterController,
    seconds: float,
    *,
    depth: Callable[[float], float] = lambda t: 5.0,
    heading: Callable[[float], float] = lambda t: 0.0,
    current: Callable[[float], Vector] = lambda t: STILL,
    push: Callable[[mujoco.MjData], None] = lambda data: None,
    rate: float = 50.0,
    **hold: object,
) -> np.ndarray:
    """Return rows of time, position (3), yaw, tilt, velocity (3), thrusts (8)."""
    loop, rows = Loop('rov', rate, 'current'), []
    for _ in range(round(seconds * rate)):
        state = loop.state()
        thrusts = controller.step(
            state, DepthTarget(depth(state.time), heading(state.time), **hold)
        )
        r_wb = rot.from_quaternion(state[2])
        tilt = np.arccos(min(1.0, r_wb[8]))
        rows.append([state[0], *state[1], rot.yaw_of(r_wb), tilt, *loop.data.qvel[:3], *thrusts])
        push(loop.data)
        loop.advance(thrusts, current(state[0]))
    return np.array(rows)


def cruise(
    controller: FixedWingController,
    seconds: float,
    *,
    altitude: float = 100.0,
    heading: float = 0.0,
    airspeed: float = 25.0,
    wind: Callable[[float], Vector] = lambda t: STILL,
    line: Vector | None = None,
    rate: float = 100.0,
) -> np.ndarray:
    """Return rows of time, position (3), yaw, roll, airspeed, thrust, deflections (3)."""
    loop, rows = Loop('aerosonde', rate, 'wind'), []
    air = STILL
    for _ in range(round(seconds * rate)):
        state = loop.state()
        command = controller.step(
            state._replace(medium_w=air), FlightTarget(altitude, heading, airspeed, line)
        )
        r_wb = rot.from_quaternion(state[2])
        speed = np.linalg.norm(np.subtract(loop.data.qvel[:3], air))
        roll = np.arctan2(r_wb[7], r_wb[8])
        rows.append([state[0], *state[1], rot.yaw_of(r_wb), roll, speed, *command])
        # the air of a state is what its step will fly in, as the node's message says
        loop.advance([command.thrust], air, command[1:])
        air = wind(loop.simulation.time)
    return np.array(rows)
