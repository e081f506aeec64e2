# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The wrench of each thruster, and thrusts for a wrench, on every layout; controllers on lag."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros import Scene, Simulation
from fluid_sim_ros.control import rotation as rot
from fluid_sim_ros.control.multirotor import MultirotorController, PoseTarget
from fluid_sim_ros.control.underwater import DepthTarget, UnderwaterController
from fluid_sim_ros.errors import CommandError, ConfigError
from fluid_sim_ros.plugins.native import native
from fluid_sim_ros.simulation.plant import plant_of
from fluid_sim_ros.simulation.thrust_matrix import WrenchAllocation, thrust_matrix
from test.support.closed_loop import Loop
from test.support.thruster_models import AEROSONDE, X500, rotor_world

DRIVEN = ('rov', 'quadrotor', 'bluerov2_heavy', 'bluerov2', 'x500', 'crazyflie', 'aerosonde')


def only(simulation):
    (vehicle,) = simulation.vehicles.values()
    return vehicle


def measured_matrix(simulation):
    """Return the wrench at 1 N of each thruster as MuJoCo applies it, with the lag run out."""
    model, data, vehicle = simulation.model, simulation.data, only(simulation)
    data.qpos[3:7] = (1, 0, 0, 0)
    data.qvel[:] = 0
    data.qpos[2] += 500 if data.qpos[2] > 0 else 0  # away from the ground
    columns, out = [], np.zeros(6)
    for actuator in vehicle.thruster_ids:
        data.ctrl[:] = 0
        data.act[:] = 0
        data.ctrl[actuator] = 1e-2
        mujoco.mj_forward(model, data)
        place = model.actuator_actadr[actuator]
        thruster = native().thruster
        if place >= 0 and thruster(model._address, data._address, int(actuator), out.ctypes.data):
            data.act[place] = out[1]
        mujoco.mj_forward(model, data)
        columns.append(data.qfrc_actuator[:6] / 1e-2)
    return np.array(columns).T


@pytest.mark.parametrize('scene', DRIVEN)
def test_the_matrix_is_what_mujoco_applies(scene):
    simulation = Simulation(scene)
    expected = measured_matrix(simulation)
    matrix = thrust_matrix(simulation.model, simulation.data, only(simulation))
    np.testing.assert_allclose(matrix, expected, atol=1e-9)


def test_a_propeller_by_coefficients_has_its_torque_at_rest(tmp_path):
    path = tmp_path / 'propeller.xml'
    path.write_text(rotor_world({**AEROSONDE, 'command': 'newton'}))
    simulation = Simulation(path)
    mujoco.mj_forward(simulation.model, simulation.data)
    matrix = thrust_matrix(simulation.model, simulation.data, only(simulation))
    np.testing.assert_allclose(matrix[2:, 0], [1, 0, 0, -0.508 * 0.00523 / 0.09357], rtol=1e-12)


def test_bluerov2_signs_are_those_of_ardusub_vectored():
    simulation = Simulation('bluerov2')
    mujoco.mj_forward(simulation.model, simulation.data)
    fx, fy, fz, tx, ty, tz = thrust_matrix(simulation.model, simulation.data, only(simulation))
    # ArduSub, frame vectored: roll, pitch, yaw, throttle, forward, lateral in FRD
    factors = np.array([
        [0, 0, 1, 0, -1, 1], [0, 0, -1, 0, -1, -1], [0, 0, -1, 0, 1, 1], [0, 0, 1, 0, 1, -1],
        [1, 0, 0, -1, 0, 0], [-1, 0, 0, -1, 0, 0],
    ])  # fmt: skip
    frd = np.array([tx, -ty, -tz, fz, fx, -fy]).T  # throttle is up
    commanded = factors != 0
    assert (np.sign(frd[commanded]) == factors[commanded]).all()


def allocation(scene):
    compiled = Scene.load(scene).compile()
    (vehicle,) = compiled.vehicles.values()
    return WrenchAllocation(compiled.model, vehicle), vehicle


@pytest.mark.parametrize(
    ('scene', 'force', 'torque'),
    [
        ('bluerov2_heavy', [10, -5, 8], [0.5, -0.4, 1]),
        ('bluerov2', [10, -5, 8], [0.5, 0, 1]),
        ('x500', [0, 0, 20], [0.2, -0.1, 0.02]),
        ('crazyflie', [0, 0, 0.27], [1e-4, -2e-4, 3e-5]),
    ],
)
def test_a_reachable_wrench_is_what_comes_out(scene, force, torque):
    allocate, _ = allocation(scene)
    if scene == 'bluerov2':  # no thruster of its own for pitch: it comes with surge
        torque = [torque[0], -0.011 * force[0], torque[2]]
    thrusts, shortfall = allocate.thrusts(force, torque)
    assert shortfall == ''
    simulation = Simulation(scene)
    np.testing.assert_allclose(
        measured_matrix(simulation) @ thrusts, [*force, *torque], rtol=1e-7, atol=1e-9
    )


def test_beyond_the_limits_the_wrench_keeps_its_direction_and_is_reported():
    allocate, vehicle = allocation('bluerov2_heavy')
    thrusts, shortfall = allocate.thrusts([400, 0, 0], [0, 0, 0])
    assert (vehicle.thrust_range[:, 0] <= thrusts).all()
    assert (thrusts <= vehicle.thrust_range[:, 1]).all()
    # by least norm each vectored one gives its share: the weaker direction limits
    assert shortfall == (
        "wrench_allocated of 'bluerov2_heavy': (113, 0, 0, 0, 0, 0) of (400, 0, 0, 0, 0, 0) "
        '[N, N m], because of the limits of the thrusters'
    )


def test_what_a_layout_cannot_do_is_reported():
    allocate, _ = allocation('x500')
    thrusts, shortfall = allocate.thrusts([1, 0, 8], [0, 0, 0])
    assert thrusts == pytest.approx([2, 2, 2, 2])
    assert shortfall.endswith('because of their layout')


def test_bad_input_is_one_line(tmp_path):
    allocate, _ = allocation('x500')
    with pytest.raises(CommandError, match="wrench of 'x500' holds a value that is not finite"):
        allocate.thrusts([np.nan, 0, 0], [0, 0, 0])
    path = tmp_path / 'rotor.xml'
    path.write_text(rotor_world(X500))  # in rad/s
    with pytest.raises(ConfigError, match=r"'thrust' is commanded in rad_s; allowed .*: newton"):
        allocation(path)


def test_the_quadrotor_controller_holds_an_x500_with_lag_in_a_gust():
    plant, _ = plant_of('x500', '')
    controller = MultirotorController(plant)
    loop = Loop('x500', 100.0, 'wind')
    errors = []
    for i in range(2000):
        state = loop.state()
        thrusts = controller.step(state, PoseTarget((0.0, 0.0, 1.5)))
        loop.advance(thrusts, (6.0, 0.0, 0.0) if i >= 300 else (0.0, 0.0, 0.0))
        errors.append(np.linalg.norm(np.subtract(state.position_w, (0, 0, 1.5))))
    assert max(errors) < 1.5  # m, in the gust
    assert max(errors[-300:]) < 0.05
    assert abs(rot.yaw_of(rot.from_quaternion(loop.state().quat_wb_wxyz))) < 0.02


def test_the_rov_controller_holds_a_bluerov2_heavy_with_lag_in_a_current():
    plant, _ = plant_of('bluerov2_heavy', '')
    controller = UnderwaterController(plant)
    loop = Loop('bluerov2_heavy', 50.0, 'current')
    for i in range(2000):
        target = DepthTarget(5.0, 0.5, place_w=(0.0, 0.0))
        thrusts = controller.step(loop.state(), target)
        loop.advance(thrusts, (0.3, 0.0, 0.0) if i >= 500 else (0.0, 0.0, 0.0))
    state = loop.state()
    assert state.position_w == pytest.approx([0, 0, -5], abs=0.05)
    assert rot.yaw_of(rot.from_quaternion(state.quat_wb_wxyz)) == pytest.approx(0.5, abs=0.02)
