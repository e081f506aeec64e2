# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Each model loads in MuJoCo, runs quietly, and shows the one fact that it is there for."""

from pathlib import Path

import mujoco
import numpy as np
import pytest

from fluid_sim_ros import Scene, Simulation, load_plugins
from fluid_sim_ros.control.gait import JointWave, travelling_wave, wing_beat
from fluid_sim_ros.plugins.native import native
from fluid_sim_ros.schema.settings import RunSettings

MODELS = Path(__file__).parents[2] / 'models'
OWN = (
    'sphere', 'ellipsoid', 'falling_card', 'swimmer', 'fish', 'fly_wing', 'quadrotor', 'rov',
    'bluerov2', 'bluerov2_heavy', 'x500', 'crazyflie', 'crazyflie_37g', 'aerosonde', 'remus100',
)  # fmt: skip


def load(name: str) -> tuple[mujoco.MjModel, mujoco.MjData]:
    load_plugins()
    model = mujoco.MjModel.from_xml_path(str(MODELS / f'{name}.xml'))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    return model, data


def warnings(data: mujoco.MjData) -> dict[str, int]:
    return {
        mujoco.mjtWarning(i).name: int(w.number) for i, w in enumerate(data.warning) if w.number
    }


def kinetic_energy(model: mujoco.MjModel, data: mujoco.MjData) -> np.ndarray:
    """Return the kinetic energy of the bodies and of the flow around them [J]."""
    out, scratch = np.zeros(2), mujoco.MjData(model)
    native().kinetic_energy(model._address, data._address, scratch._address, out.ctypes.data)
    return out


def run(model: mujoco.MjModel, data: mujoco.MjData, seconds: float) -> None:
    mujoco.mj_step(model, data, round(seconds / model.opt.timestep))


def drive(
    model: mujoco.MjModel, data: mujoco.MjData, wave: JointWave, seconds: float
) -> np.ndarray:
    """Run with joint commands; return force and torque of the fluid on the base, per step."""
    fluid = np.empty((round(seconds / model.opt.timestep), 6))
    for row in fluid:
        data.ctrl[:] = wave.angles(data.time)
        mujoco.mj_step(model, data)
        row[:] = data.qfrc_fluid[:6]
    return fluid


@pytest.mark.parametrize('name', OWN)
def test_runs_five_seconds_in_mujoco_without_warnings(name: str) -> None:
    model, data = load(name)
    run(model, data, 5.0)
    assert warnings(data) == {}
    assert data.time == pytest.approx(5.0)
    assert np.isfinite(data.qpos).all()


@pytest.mark.parametrize('name', OWN)
def test_has_what_every_model_has(name: str) -> None:
    model, _ = load(name)
    stock = Scene.load(name).compile(RunSettings(fluid='ellipsoid')).model  # also without plugins
    assert stock.opt.density > 0 and stock.opt.viscosity > 0
    assert model.nkey >= 1
    assert mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_CAMERA, 'track') >= 0
    assert model.nlight >= 1
    text = (MODELS / f'{name}.xml').read_text()
    assert 'Fluid model' in text and 'Integrator:' in text


def test_sphere_reaches_the_terminal_speed_of_its_drag_law() -> None:
    model, data = load('sphere')
    run(model, data, 5.0)
    rho, beta, r = model.opt.density, model.opt.viscosity, model.geom('sphere').size[0]
    volume = 4 / 3 * np.pi * r**3
    blunt = 0.23
    weight = model.body('sphere').mass[0] * 9.81 - rho * volume * 9.81
    quadratic, linear = blunt * rho * np.pi * r**2, 6 * np.pi * beta * r
    speed = (-linear + np.sqrt(linear**2 + 4 * quadratic * weight)) / (2 * quadratic)
    assert -data.qvel[2] == pytest.approx(speed, rel=1e-9)
    # Newton's regime, where Cd = 2 C = 0.46 holds on the standard drag curve
    assert 1e4 < rho * speed * 2 * r / beta < 1e5


def test_ellipsoid_turns_broadside() -> None:
    model, data = load('ellipsoid')
    angles, energies = [], []
    for _ in range(200):
        mujoco.mj_step(model, data, 5)
        long_axis, velocity = data.xmat[1].reshape(3, 3)[:, 0], data.qvel[:3]
        cosine = abs(long_axis @ velocity) / np.linalg.norm(velocity)
        angles.append(np.degrees(np.arccos(cosine)))
        energies.append(kinetic_energy(model, data).sum())
    assert angles[0] < 6 and max(angles) > 80
    # drag only takes; the body alone would gain while the flow gives back
    assert np.diff(energies).max() <= 0


def test_card_falls_and_turns_over() -> None:
    model, data = load('falling_card')
    start, turned = data.qpos[:3].copy(), 0.0
    for _ in range(round(4.0 / model.opt.timestep)):
        mujoco.mj_step(model, data)
        turned += data.qvel[4] * model.opt.timestep
    # as doc/scenes.md states; the way is chaotic late, its mean is not
    assert abs(turned) / (2 * np.pi) == pytest.approx(5.0, abs=1.0)
    assert abs(data.qpos[0] - start[0]) == pytest.approx(1.6, abs=0.3)
    assert (start[2] - data.qpos[2]) / 4.0 == pytest.approx(1.5, abs=0.15)


def test_swimmer_swims_forward_and_the_reversed_wave_backward() -> None:
    ways = {}
    for lag in (1.0, -1.0):
        model, data = load('swimmer')
        wave = travelling_wave(5, amplitude=0.5, frequency=1.0, lag=lag)
        drive(model, data, wave, 5.0)
        start = data.subtree_com[1].copy()
        drive(model, data, wave, 3.0)
        ways[lag] = (data.subtree_com[1] - start) / 3.0
        assert warnings(data) == {}
    assert ways[1.0][0] == pytest.approx(0.20, abs=0.02)  # m/s, as doc/scenes.md states
    assert ways[-1.0][0] < -0.1
    assert abs(ways[1.0][1]) < 0.1 * ways[1.0][0]
    assert abs(ways[1.0][2]) < 1e-6  # neutral: keeps its depth


def test_swimmer_links_are_neutral() -> None:
    model, data = load('swimmer')
    mujoco.mj_forward(model, data)
    assert data.qfrc_passive[2] == pytest.approx(data.qfrc_bias[2], rel=1e-12)


def test_wings_carry_the_weight_and_raise_the_fly() -> None:
    model, data = load('fly_wing')
    frequency = 26.0
    fluid = drive(model, data, wing_beat(stroke=1.15, pitch=0.8, frequency=frequency), 0.6)
    beats = round(5 / frequency / model.opt.timestep)
    weight = model.body_subtreemass[1] * 9.81
    force = fluid[-beats:, :3].mean(axis=0) / weight
    assert force[2] == pytest.approx(1.0, abs=0.1)
    assert np.abs(force[:2]).max() < 0.1
    assert data.qvel[2] > 0.02  # climbs
    assert warnings(data) == {}


def test_wing_drag_and_lift_follow_the_robotic_wing() -> None:
    # Dickinson, Lehmann and Sane (1999), Science 284:1954: CL, CD of the angle of attack [deg]
    model, data = load('fly_wing')
    model.opt.viscosity = 0.0
    model.opt.gravity = 0.0
    geom = model.geom('wing_left')
    area, speed = np.pi * geom.size[0] * geom.size[1], 3.0
    lift, drag, angles = [], [], np.arange(5.0, 91.0, 5.0)
    for angle in np.radians(angles):
        mujoco.mj_resetData(model, data)
        # the air flows backward past wings pitched up by the angle of attack
        data.qpos[model.joint('pitch_left').qposadr] = angle
        model.opt.wind = (-speed, 0.0, 0.0)
        coefficients = model.geom_fluid[geom.id, 1:6].copy()
        force = np.zeros(3)
        for sign, scale in ((1, 1.0), (-1, 0.0)):  # the left wing's share alone
            model.geom_fluid[geom.id, 1:6] = scale * coefficients
            mujoco.mj_forward(model, data)
            force += sign * data.qfrc_fluid[:3]
        model.geom_fluid[geom.id, 1:6] = coefficients
        unit = 0.5 * model.opt.density * area * speed**2
        lift.append(force[2] / unit)
        drag.append(-force[0] / unit)
    cl = 0.225 + 1.58 * np.sin(np.radians(2.13 * angles - 7.2))
    cd = 1.92 - 1.55 * np.cos(np.radians(2.04 * angles - 9.82))
    assert np.sqrt(np.mean((lift - cl) ** 2)) < 0.05
    # the lemma's area keeps drag nearly constant: right on average only
    assert np.mean(drag) == pytest.approx(np.mean(cd), rel=0.05)
    assert np.sqrt(np.mean((drag - cd) ** 2)) > 0.5


def test_quadrotor_hovers_on_its_keyframe_thrust() -> None:
    model, data = load('quadrotor')
    total = data.ctrl.sum()
    assert total == pytest.approx(model.body('x500').mass[0] * 9.81, rel=1e-7)
    run(model, data, 5.0)
    # the centre of mass lies above the origin, thrust passes through it: nothing moves
    assert np.abs(data.qvel).max() < 1e-6
    assert data.qpos[2] == pytest.approx(1.5, abs=1e-5)


def test_quadrotor_inertia_box_is_as_stated() -> None:
    model, _ = load('quadrotor')
    body = model.body('x500')
    mass, (ix, iy, iz) = body.mass[0], body.inertia
    sides = 2 * np.sqrt(1.5 / mass * np.array([iy + iz - ix, iz + ix - iy, ix + iy - iz]))
    assert sides == pytest.approx([0.357, 0.357, 0.105], abs=1e-3)
    assert sides[1] * sides[2] == pytest.approx(0.037, abs=5e-4)  # C_d A = 4 r_j r_k


def test_quadrotor_rotors_turn_against_their_torque() -> None:
    # a yaw command to the left (counter-clockwise) needs more of the clockwise rotors m3, m4
    model, data = load('quadrotor')
    data.ctrl[:] += (-0.5, -0.5, 0.5, 0.5)
    run(model, data, 0.2)
    assert data.qvel[5] > 0.05
    assert np.abs(data.qvel[3:5]).max() < 1e-6


def thruster_matrix(model: mujoco.MjModel, data: mujoco.MjData) -> np.ndarray:
    columns = []
    for i in range(model.nu):
        data.ctrl[:] = np.eye(model.nu)[i]
        mujoco.mj_forward(model, data)
        columns.append(data.qfrc_actuator[:6].copy())
    return np.array(columns).T


def test_rov_thrusters_reach_all_six_directions_and_match_ardusub_signs() -> None:
    model, data = load('rov')
    matrix = thruster_matrix(model, data)
    assert np.linalg.matrix_rank(matrix, tol=1e-3) == 6
    # ArduSub, frame vectored 6DOF: roll, pitch, yaw, throttle, forward, lateral in FRD
    factors = np.array(
        [
            [0, 0, 1, 0, -1, 1], [0, 0, -1, 0, -1, -1], [0, 0, -1, 0, 1, 1], [0, 0, 1, 0, 1, -1],
            [1, -1, 0, -1, 0, 0], [-1, -1, 0, -1, 0, 0], [1, 1, 0, -1, 0, 0], [-1, 1, 0, -1, 0, 0],
        ]
    )  # fmt: skip
    fx, fy, fz, tx, ty, tz = matrix
    # FLU to FRD: y and z change sign; throttle is up
    frd = np.array([tx, -ty, -tz, fz, fx, -fy]).T
    commanded = factors != 0
    assert (np.sign(frd[commanded]) == np.sign(factors[commanded])).all()


def test_rov_sinks_at_its_terminal_speed_and_rights_itself() -> None:
    simulation = Simulation('rov')
    simulation.step(round(60.0 / simulation.timestep))
    # 13.5 kg against 13.4 kg of water, on 33 N s/m and 190 N s^2/m^2: see models/rov.xml
    net = (13.5 - 13.4) * 9.81
    speed = (-33 + np.sqrt(33**2 + 4 * 190 * net)) / (2 * 190)
    state = simulation.snapshot().vehicles['bluerov2_heavy']
    assert state.velocity_b[2] == pytest.approx(-speed, rel=1e-6)

    simulation.reset()
    simulation.data.qpos[3:7] = [np.cos(0.1), np.sin(0.1), 0, 0]  # 0.2 rad of roll
    _, torque = simulation.wrench('bluerov2_heavy')['buoyancy']
    assert torque[0] == pytest.approx(-13.4 * 9.81 * 0.01 * np.sin(0.2), rel=1e-9)


def test_rov_surfaces_and_floats_when_pushed_up() -> None:
    simulation = Simulation('rov')
    simulation.enable_wind(False)  # the scene's current would carry it along
    simulation.set_wrench('bluerov2_heavy', [0, 0, 20], [0, 0, 0], 'map')
    simulation.step(round(30.0 / simulation.timestep))
    state = simulation.snapshot().vehicles['bluerov2_heavy']
    assert -0.2 < state.position_w[2] < 0.1  # out of the water as far as 20 N carry it
    assert np.abs(state.velocity_b).max() < 0.01


def test_stock_rov_has_the_stated_added_mass() -> None:
    model = Scene.load('rov').compile(RunSettings(fluid='ellipsoid')).model
    # geom_fluid: switch, five coefficients, then virtual mass and inertia at unit density
    added = model.opt.density * model.geom_fluid[model.geom('displaced_water').id, 6:9]
    assert added == pytest.approx([5.0, 3.4, 15.0], abs=0.05)  # as models/rov.xml states


def test_stock_rov_drag_is_as_near_to_the_published_as_stated() -> None:
    model = Scene.load('rov').compile(RunSettings(fluid='ellipsoid')).model
    data = mujoco.MjData(model)
    model.opt.viscosity = 0.0
    published = np.array([141.0, 217.0, 190.0, 1.19, 0.47, 1.5])  # quadratic, von Benzon et al.
    found = []
    for axis in range(6):
        data.qvel[:] = np.eye(6)[axis]
        mujoco.mj_forward(model, data)
        found.append(-data.qfrc_fluid[axis])
    # as models/rov.xml states: what three coefficients can do for six numbers
    ratio = np.array(found) / published
    assert ratio == pytest.approx([1.0, 0.59, 1.0, 0.99, 1.67, 0.55], abs=0.01)
