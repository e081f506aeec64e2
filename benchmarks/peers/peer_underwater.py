# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The underwater task of the peers: a BlueROV2 Heavy answers a step of thrust in a current.

At rest 5 m deep in a current of 0.36 m/s, then constant thrust ahead, down and in yaw. Reference:
``physics.kirchhoff.kirchhoff_motion`` (DOP853 at 1e-12) with Fossen's damping and restoring
forces. Numbers of the vehicle from vehicle_equations.py.

Stock MuJoCo has no inertia of added mass. The common remedy is an external force -A dnu/dt with
the acceleration of the last step (so Gazebo's hydrodynamics plugin): an iteration whose error
grows by m_A/m each step, 1.38 in heave here, whatever the timestep. The second variant leaves the
heave's added mass out, the only one beyond the vehicle's own.
"""

from collections.abc import Callable, Iterable

import mujoco
import numpy as np
from scipy.integrate import odeint

from benchmarks.peers.peer_mujoco import simulation_runs
from benchmarks.peers.peer_tasks import (
    SAMPLE,
    TIMES,
    Array,
    G,
    Run,
    matrix,
    milliseconds,
    quaternion_rate,
    scipy_runs,
)
from fluid_sim_ros.errors import DivergedError
from fluid_sim_ros.lab.problems.closed_forms import keyframe, scene_of
from fluid_sim_ros.lab.problems.mjcf import body_plugin, free_body, text, world
from fluid_sim_ros.physics.fossen import damping_wrench
from fluid_sim_ros.physics.kirchhoff import kirchhoff_motion, rigid_body_matrix, rotation_wb
from test.support.vehicle_equations import HEAVY

CURRENT = np.array([0.3, -0.2, 0.0])  # [m/s]
#: Of T1 to T8 [N]: ahead, a yaw moment, down.
THRUST = np.array([-4.0, -2.0, 4.0, 2.0, 5.0, 5.0, 5.0, 5.0])
DEPTH = 5.0  # [m]
_WATER = 1000.0  # [kg/m^3]
_START = np.r_[0, 0, -DEPTH, 1, 0, 0, 0, np.zeros(6)]
_FASTEST = 100.0  # no vehicle goes so fast: a run that does has diverged [m/s], [rad/s]


def thrust_wrench() -> Array:
    """Return force [N] and torque [N m] of the thrusters, body axes."""
    forces = THRUST[:, np.newaxis] * HEAVY.rotors.axis
    return np.r_[forces.sum(axis=0), np.cross(HEAVY.rotors.position, forces).sum(axis=0)]


def reference() -> Array:
    """Return the positions at ``TIMES`` [m]."""
    masses = rigid_body_matrix(HEAVY.mass, HEAVY.inertia, np.zeros(3)) + np.diag(HEAVY.added)
    linear, quadratic, thrust = np.diag(HEAVY.linear), np.diag(HEAVY.quadratic), thrust_wrench()

    def wrench(_time: float, state: Array) -> Array:
        to_body = rotation_wb(state[3:7]).T
        nu = np.r_[state[7:10] - to_body @ CURRENT, state[10:13]]
        up = to_body[:, 2]
        lift = HEAVY.buoyancy * up
        restoring = np.r_[lift - HEAVY.mass * G * up, np.cross(HEAVY.center_of_buoyancy, lift)]
        total: Array = damping_wrench(linear, quadratic, nu) + restoring + thrust
        return total

    states = kirchhoff_motion(_START, np.r_[0, TIMES], masses, CURRENT, wrench)
    return states[1:, :3]


def own_model() -> str:
    """Return MJCF with fluid_sim.body, fluid_sim.medium and eight motors."""
    rotors = HEAVY.rotors
    inside = _inertial() + body_plugin(
        added_mass=HEAVY.added, linear_damping=HEAVY.linear, quadratic_damping=HEAVY.quadratic,
        volume=HEAVY.buoyancy / (_WATER * G), center_of_buoyancy=HEAVY.center_of_buoyancy,
        drag='none',
    )  # fmt: skip
    actuators = ''
    for i, (place, axis) in enumerate(zip(rotors.position, rotors.axis, strict=True)):
        inside += f'<site name="t{i}" pos="{text(place)}"/>'
        actuators += f'<motor site="t{i}" gear="{text(axis)} 0 0 0"/>'
    return world(
        free_body(inside), gravity=(0, 0, -G), medium={'density': _WATER, 'current': CURRENT},
        extra=keyframe(_START[:7], _START[7:], f'ctrl="{text(THRUST)}"')
        + f'<actuator>{actuators}</actuator>',
    )  # fmt: skip


def _inertial() -> str:
    return f'<inertial pos="0 0 0" mass="{HEAVY.mass}" diaginertia="{text(HEAVY.inertia)}"/>'


def fossen_rates() -> Callable[[float, Array], Array]:
    """Return y' of a plain Fossen model: position, quaternion, velocity, body rates."""
    masses = np.r_[[HEAVY.mass] * 3, HEAVY.inertia] + HEAVY.added
    thrust, height = thrust_wrench(), HEAVY.center_of_buoyancy[2]
    out = np.empty(13)

    def rates(_time: float, y: Array) -> Array:
        rotation = matrix(y[3:7])
        w = y[10:13]
        flow = CURRENT @ rotation
        nu = np.concatenate([y[7:10] - flow, w])
        load = thrust - (HEAVY.linear + HEAVY.quadratic * np.abs(nu)) * nu
        up = rotation[2]
        load[:3] += (HEAVY.buoyancy - HEAVY.mass * G) * up
        load[3] -= height * HEAVY.buoyancy * up[1]
        load[4] += height * HEAVY.buoyancy * up[0]
        momentum = masses * nu
        load[:3] += cross(momentum[:3], w)
        load[3:] += cross(momentum[:3], nu[:3]) + cross(momentum[3:], w)
        nu_dot = load / masses
        out[:3] = rotation @ y[7:10]
        out[3:7] = quaternion_rate(y[3:7], w)
        out[7:10] = nu_dot[:3] - cross(w, flow)
        out[10:] = nu_dot[3:]
        return out.copy()

    return rates


def cross(a: Array, b: Array) -> Array:
    """Return a x b, without the checks of ``numpy.cross``."""
    (p, q, r), (x, y, z) = a.tolist(), b.tolist()
    return np.array([q * z - r * y, r * x - p * z, p * y - q * x])


def plain_runs(timesteps: Iterable[float], tolerances: Iterable[float], exact: Array) -> list[Run]:
    """Return runs of the plain model: ``solve_ivp`` over all, ``odeint`` for each timestep."""
    rates = fossen_rates()

    def prepare(timestep: float) -> Callable[[], Callable[[], Array]]:
        span = np.array([0, timestep])

        def simulate() -> Array:
            state, out = _START, np.empty((len(TIMES), 3))
            for row in out:
                for _ in range(round(SAMPLE / timestep)):
                    state = odeint(rates, state, span, tfirst=True)[1]
                row[:] = state[:3]
            return out

        return lambda: simulate

    return [
        *scipy_runs(_START, rates, exact, tolerances),
        *(
            Run('SciPy odeint per step', milliseconds(h), prepare(h), exact)
            for h in timesteps
        ),
    ]  # fmt: skip


def lagged_runs(timesteps: Iterable[float], exact: Array) -> list[Run]:
    """Return runs of stock MuJoCo with the fluid as external force, added mass by lag."""
    heave = np.arange(6) == 2
    variants = {'MuJoCo lagged': HEAVY.added, 'MuJoCo lagged, no heave': HEAVY.added * ~heave}

    def prepare(added: Array, timestep: float) -> Callable[[], Callable[[], Array]]:
        model = mujoco.MjModel.from_xml_string(
            f"""<mujoco><option timestep="{timestep:.17g}" gravity="0 0 {-G}"/>
            <worldbody>{free_body(_inertial())}</worldbody></mujoco>"""
        )
        data = mujoco.MjData(model)

        def start() -> Callable[[], Array]:
            mujoco.mj_resetData(model, data)
            data.qpos[:] = _START[:7]
            return lambda: _lagged(model, data, added, round(SAMPLE / timestep))

        return start

    return [
        Run(name, milliseconds(h), prepare(added, h), exact)
        for name, added in variants.items()
        for h in timesteps
    ]


def _lagged(model: mujoco.MjModel, data: mujoco.MjData, added: Array, steps: int) -> Array:
    """Run on, the fluid's force written before each step, its inertia by the last ``qacc``."""
    thrust, height = thrust_wrench(), HEAVY.center_of_buoyancy[2]
    out = np.empty((len(TIMES), 3))
    qvel, qacc, force = data.qvel, data.qacc, data.qfrc_applied
    for row in out:
        for _ in range(steps):
            rotation = matrix(data.qpos[3:7])
            w = qvel[3:]
            nu = np.concatenate([(qvel[:3] - CURRENT) @ rotation, w])
            nu_dot = np.concatenate([qacc[:3] @ rotation - cross(w, nu[:3]), qacc[3:]])
            load = thrust - (HEAVY.linear + HEAVY.quadratic * np.abs(nu)) * nu - added * nu_dot
            momentum = added * nu
            load[:3] += cross(momentum[:3], w) + HEAVY.buoyancy * rotation[2]
            load[3:] += cross(momentum[:3], nu[:3]) + cross(momentum[3:], w)
            load[3] -= height * HEAVY.buoyancy * rotation[2, 1]
            load[4] += height * HEAVY.buoyancy * rotation[2, 0]
            force[:3], force[3:] = rotation @ load[:3], load[3:]
            mujoco.mj_step(model, data)
            if not np.abs(qvel).max() < _FASTEST:
                raise DivergedError('faster than any', time=data.time, body='hull')
        row[:] = data.qpos[:3]
    return out


def underwater_runs(timesteps: Iterable[float], tolerances: Iterable[float]) -> list[Run]:
    """Return all runs of the task."""
    steps, exact = list(timesteps), reference()
    return [
        *simulation_runs(scene_of('underwater', own_model()), steps, exact),
        *plain_runs([h for h in steps if h >= 0.002], tolerances, exact),
        *lagged_runs([h for h in steps if h >= 0.001], exact),
    ]
