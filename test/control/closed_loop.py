"""Controllers closed around plain MuJoCo models; times and stamps as over ROS, without it."""

from collections.abc import Callable

import mujoco
import numpy as np

from fluid_sim_ros.control import rotation as rot
from fluid_sim_ros.control.multirotor import MultirotorController
from fluid_sim_ros.control.underwater import UnderwaterController
from fluid_sim_ros.scene import Scene

Vector = tuple[float, float, float]


class Loop:
    """A stock model of one free body and the state in the form that odometry has it."""

    def __init__(self, scene: str, rate: float) -> None:
        compiled = Scene.load(scene).compile()
        self.model, self.data = compiled.model, mujoco.MjData(compiled.model)
        mujoco.mj_resetDataKeyframe(self.model, self.data, compiled.keyframe_id)
        self.steps = round(1 / (rate * self.model.opt.timestep))

    def state(self) -> tuple[float, list[float], list[float], rot.Vector3, list[float]]:
        q, v = self.data.qpos.tolist(), self.data.qvel.tolist()
        velocity_b = rot.to_body(rot.from_quaternion(q[3:7]), v[:3])
        return self.data.time, q[:3], q[3:7], velocity_b, v[3:6]

    def advance(self, thrusts: list[float], medium_w: Vector) -> None:
        self.data.ctrl[:] = thrusts
        self.model.opt.wind = medium_w
        mujoco.mj_step(self.model, self.data, self.steps)


def fly(
    controller: MultirotorController,
    seconds: float,
    *,
    target: Callable[[float], Vector],
    wind: Callable[[float], Vector] = lambda t: (0.0, 0.0, 0.0),
    yaw: float = 0.0,
    quat: tuple[float, float, float, float] | None = None,
    rate: float = 100.0,
) -> np.ndarray:
    """Return rows of time, position (3), yaw, thrusts (4)."""
    loop, rows = Loop('quadrotor', rate), []
    if quat is not None:
        loop.data.qpos[3:7] = np.array(quat) / np.linalg.norm(quat)
    for _ in range(round(seconds * rate)):
        state = loop.state()
        thrusts = controller.step(*state, target(state[0]), yaw)
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
    current: Callable[[float], Vector] = lambda t: (0.0, 0.0, 0.0),
    push: Callable[[mujoco.MjData], None] = lambda data: None,
    rate: float = 50.0,
    **hold: object,
) -> np.ndarray:
    """Return rows of time, position (3), yaw, tilt, velocity (3), thrusts (8)."""
    loop, rows = Loop('rov', rate), []
    for _ in range(round(seconds * rate)):
        state = loop.state()
        thrusts = controller.step(*state, depth(state[0]), heading(state[0]), **hold)
        r_wb = rot.from_quaternion(state[2])
        tilt = np.arccos(min(1.0, r_wb[8]))
        rows.append([state[0], *state[1], rot.yaw_of(r_wb), tilt, *loop.data.qvel[:3], *thrusts])
        push(loop.data)
        loop.advance(thrusts, current(state[0]))
    return np.array(rows)
