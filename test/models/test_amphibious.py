# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The amphibious quadrotor: in air, in water and through the surface, against SciPy."""

import mujoco
import numpy as np
import pytest

from benchmarks.vehicles import amphibious as bench
from fluid_sim_ros import Scene, Simulation
from fluid_sim_ros.control.multirotor import MultirotorController, PoseTarget
from fluid_sim_ros.plugins.native import native
from fluid_sim_ros.simulation.plant import plant_of
from test.support.closed_loop import Loop

SHARE = 0.005  # of the value, as for the other vehicles


def rotor_states(simulation):
    """Return thrust [N] of rotors and screws as they act."""
    model, data, out = simulation.model, simulation.data, np.zeros(6)
    mujoco.mj_forward(model, data)
    thrusts = []
    for actuator in simulation.vehicles[bench.NAME].thruster_ids:
        native().thruster(model._address, data._address, int(actuator), out.ctypes.data)
        thrusts.append(out[2])
    return np.array(thrusts)


def test_hover_command_is_weight_less_the_air_it_displaces():
    simulation = Simulation(bench.NAME)
    thrust, _ = bench.IN_AIR.level_flight(0.0)
    np.testing.assert_allclose(simulation.data.ctrl[:4], thrust, rtol=1e-8)
    simulation.step(1900)  # before the scene's first event
    assert np.abs(simulation.data.qvel).max() < 1e-6


@pytest.mark.parametrize('tilt_deg', [5, pytest.param(15, marks=pytest.mark.full)])
def test_speed_against_tilt_in_air(tilt_deg):
    _, measured, solved = bench.level_flight(tilt_deg)
    assert measured == pytest.approx(solved, rel=SHARE)


@pytest.mark.parametrize('screw', [-6.0, 0.0, 4.0])
def test_sink_and_rise_under_water(screw):
    measured, solved = bench.vertical_speed(screw)
    assert measured == pytest.approx(solved, rel=1e-9)
    assert np.sign(measured) == (-1 if screw < 0 else 1)


def test_entry_follows_the_slamming_equation_to_first_order():
    errors = []
    for timestep in (0.002, 0.001):
        times, measured = bench.dropped(1.5, 1.0, timestep)
        solved = bench.entry(times, 1.5)
        errors.append(np.abs(measured - solved).max(axis=0) / np.abs(solved).max(axis=0))
    assert (errors[1] < SHARE).all()
    assert errors[1][0] == pytest.approx(errors[0][0] / 2, rel=0.1)


def test_it_floats_with_dry_rotors():
    measured, solved = bench.floating_height()
    assert measured == pytest.approx(solved, abs=1e-4)
    assert solved + 0.08 > 0.127 * np.sin(0.1)  # the discs clear the water, also at 0.1 rad


def test_rotors_work_in_air_and_screws_in_water():
    simulation = Simulation(bench.NAME)
    simulation.set_thrust(bench.NAME, [5.0] * 8)
    simulation.step(500)
    np.testing.assert_allclose(rotor_states(simulation)[:4], 5, rtol=1e-3)
    assert not rotor_states(simulation)[4:].any()
    simulation.data.qpos[2] = -1.0
    np.testing.assert_allclose(rotor_states(simulation)[4:], 5, rtol=1e-3)
    assert not rotor_states(simulation)[:4].any()
    simulation.data.qpos[2] = 0.06  # the screws' middles at the surface
    np.testing.assert_allclose(rotor_states(simulation)[4:], 2.5, rtol=1e-3)


def test_under_water_a_roll_is_righted():
    simulation = Simulation(bench.NAME)
    simulation.data.qpos[2] = -2.0
    simulation.data.qpos[3:7] = (np.cos(0.2), np.sin(0.2), 0, 0)
    force, torque = simulation.wrench(bench.NAME)['buoyancy']
    assert np.linalg.norm(force) == pytest.approx(1000 * bench.VOLUME * bench.G, rel=1e-9)
    assert np.abs(torque).max() < 1e-12  # at the origin; the weight, below it, rights
    simulation.set_thrust(bench.NAME, [0.0] * 8)
    simulation.step(8000)
    assert simulation.data.xmat[1].reshape(3, 3)[2, 2] > 0.999


def test_the_scene_flies_dives_floats_and_flies_again():
    times, heights = bench.demonstration()

    def at(time):
        return heights[np.searchsorted(times, time)]

    assert at(1.9) == pytest.approx(1.5, abs=1e-6)
    assert heights[(times > 7) & (times < 10)].min() < -1.3  # on its screws
    assert at(18.9) == pytest.approx(bench.floating_height()[1], abs=0.02)
    assert at(24.0) > 2.5
    assert abs(at(25.9) - at(24.9)) < 0.05  # hovers


def test_the_quadrotor_controller_flies_it_by_its_rotors(tmp_path):
    """A scene that names the rotors alone; the screws keep the keyframe's zero."""
    scene = tmp_path / 'flight.yaml'
    scene.write_text(
        f'model: {Scene.load(bench.NAME).model_path}\nmedium: air\nkeyframe: hover\n'
        'vehicles: {amphibious: {body: amphibious, thrusters: [m1, m2, m3, m4]}}\n'
    )
    plant, _ = plant_of(str(scene), '')
    controller = MultirotorController(plant)
    loop = Loop(str(scene), 100.0, 'wind')
    for i in range(1500):
        thrusts = controller.step(loop.state(), PoseTarget((0.0, 0.0, 1.5)))
        loop.advance(thrusts, (4.0, 0.0, 0.0) if i >= 200 else (0.0, 0.0, 0.0))
    assert np.linalg.norm(np.subtract(loop.state()[1], (0, 0, 1.5))) < 0.1
