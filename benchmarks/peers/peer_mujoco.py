# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""fluid_sim_ros and stock MuJoCo at the tasks in air."""

from collections.abc import Callable, Iterable

import mujoco
import numpy as np

from benchmarks.peers.peer_tasks import (
    INERTIA,
    MASS,
    SAMPLE,
    TIMES,
    AirTask,
    Array,
    G,
    Run,
    air_start,
    milliseconds,
)
from fluid_sim_ros import Scene, Simulation
from fluid_sim_ros.lab.problems.closed_forms import keyframe, scene_of
from fluid_sim_ros.lab.problems.mjcf import body_plugin, config, free_body, text, world

INTEGRATORS = ('RK4', 'implicitfast')
_ARM = 0.174  # of the x500 [m]
_K = 8.54858e-6  # its rotors' thrust coefficient [N/(rad/s)^2]
_ROTORS = ((1, -1), (-1, 1), (1, 1), (-1, -1))


def own_model(task: AirTask) -> str:
    """Return MJCF with fluid_sim.body for the drag and four fluid_sim.thruster for the thrust."""
    inside = _inertial(INERTIA)
    if task.drag:
        inside += body_plugin(quadratic_damping=[MASS * task.drag] * 3 + [0] * 3, drag='none')
    if not task.thrust:
        return world(free_body(inside), gravity=(0, 0, -G), extra=_start(task))
    inside += ''.join(
        f'<site name="r{i}" pos="{_ARM * x} {_ARM * y} 0"/>' for i, (x, y) in enumerate(_ROTORS)
    )
    each = MASS * task.thrust / 4
    speed = np.sqrt(each / _K)
    instances, actuators = '', ''
    for i in range(4):
        values = {
            'curve': 'quadratic', 'thrust_coefficient': _K, 'rad_s_max': 2 * speed,
            'torque_ratio': 0.016, 'spin': 'ccw' if i < 2 else 'cw',
            'rotor_drag': MASS * task.rotor_drag / (4 * speed),
        }  # fmt: skip
        instances += f'<instance name="r{i}">{config(values)}</instance>'
        names = f'plugin="fluid_sim.thruster" instance="r{i}" site="r{i}"'
        actuators += f'<plugin {names} gear="0 0 1 0 0 0"/><plugin {names} gear="0 0 0 0 0 1"/>'
    mjcf = world(
        free_body(inside), gravity=(0, 0, -G),
        extra=_start(task, [each, 0] * 4) + f'<actuator>{actuators}</actuator>',
    )  # fmt: skip
    thrusters = f'<plugin plugin="fluid_sim.thruster">{instances}</plugin>'
    return mjcf.replace('</extension>', f'{thrusters}</extension>')


def stock_model(task: AirTask, integrator: str, timestep: float) -> str:
    """Return MJCF of stock MuJoCo: drag by a cubic inertia box, thrust by one motor."""
    # half side r of the box: I = 2 m r^2/3; its drag is 2 rho r^2 |v| v = k m |v| v
    inertia = INERTIA[0]
    density = MASS * task.drag / (3 * inertia / MASS)
    motor = '<actuator><motor site="base" gear="0 0 1 0 0 0"/></actuator>' if task.thrust else ''
    start = _start(task, [MASS * task.thrust] if task.thrust else ())
    return f"""<mujoco>
    <option timestep="{timestep:.17g}" integrator="{integrator}" gravity="0 0 {-G}"
     density="{density:.17g}"><flag contact="disable"/></option>
    <worldbody>
      <body><freejoint/>{_inertial([inertia] * 3)}<site name="base"/></body>
    </worldbody>{motor}{start}</mujoco>"""


def _inertial(inertia: Iterable[float]) -> str:
    return f'<inertial pos="0 0 0" mass="{MASS}" diaginertia="{text(list(inertia))}"/>'


def _start(task: AirTask, ctrl: Iterable[float] = ()) -> str:
    state, values = air_start(task), list(ctrl)
    return keyframe(state[:7], state[7:], f'ctrl="{text(values)}"' if values else '')


def own_runs(task: AirTask, timesteps: Iterable[float]) -> list[Run]:
    """Return runs of a task in air by this package."""
    scene = scene_of(task.name, own_model(task))
    return simulation_runs(scene, timesteps, task.reference(TIMES))


def simulation_runs(scene: Scene, timesteps: Iterable[float], reference: Array) -> list[Run]:
    """Return runs of a scene by ``Simulation.step``, several steps a call."""

    def prepare(integrator: str, timestep: float) -> Callable[[], Callable[[], Array]]:
        simulation = Simulation(scene, integrator=integrator, timestep=timestep)

        def start() -> Callable[[], Array]:
            simulation.reset()
            return lambda: _sampled(simulation, round(SAMPLE / timestep))

        return start

    return [
        Run(f'fluid_sim {name}', milliseconds(h), prepare(name, h), reference)
        for name in INTEGRATORS
        for h in timesteps
    ]


def _sampled(simulation: Simulation, steps: int) -> Array:
    """Run on; return the positions of the free joint at ``TIMES``."""
    out = np.empty((len(TIMES), 3))
    for row in out:
        simulation.step(steps)
        row[:] = simulation.data.qpos[:3]
    return out


def stock_runs(task: AirTask, timesteps: Iterable[float]) -> list[Run]:
    """Return runs by ``mj_step``, several steps a call; none where stock has no such force."""
    if task.rotor_drag:
        return []
    reference = task.reference(TIMES)

    def prepare(integrator: str, timestep: float) -> Callable[[], Callable[[], Array]]:
        model = mujoco.MjModel.from_xml_string(stock_model(task, integrator, timestep))
        data, steps = mujoco.MjData(model), round(SAMPLE / timestep)

        def simulate() -> Array:
            out = np.empty((len(TIMES), 3))
            for row in out:
                mujoco.mj_step(model, data, steps)
                row[:] = data.qpos[:3]
            return out

        def start() -> Callable[[], Array]:
            mujoco.mj_resetDataKeyframe(model, data, 0)
            return simulate

        return start

    return [
        Run(f'MuJoCo {name}', milliseconds(h), prepare(name, h), reference)
        for name in INTEGRATORS
        for h in timesteps
    ]
