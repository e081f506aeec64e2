# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A tether in a current against the equations of a line, and a slung load against the pendulum."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.loop.hold import Hold
from fluid_sim_ros.loop.pacing import Pacing
from fluid_sim_ros.loop.runner import NoSource, Runner
from test.support.slung_runs import exact_period, pendulum
from test.support.tether_equations import Cable, shape
from test.support.tether_runs import ANCHOR, LENGTH, SEGMENTS, settled

FULL = pytest.mark.full
WHOLE = SEGMENTS * LENGTH  # [m]


@pytest.mark.parametrize(
    ('end', 'current', 'roll', 'pull_error'),
    [
        pytest.param((8.0, 0.0, -4.95), (0.0, 1.0, 0.0), 0.0, 0.01, marks=FULL),  # slack, across
        pytest.param((8.0, 0.0, -4.95), (0.6, 0.8, 0.0), 0.0, 0.015, marks=FULL),  # aslant
        ((14.5, 0.0, -4.95), (0.0, 1.0, 0.0), 0.0, 0.01),  # nearly taut
        ((8.0, 0.0, -4.95), (0.6, 0.8, 0.0), np.pi / 8, 0.06),  # between the axes of every segment
    ],
)
def test_the_tether_hangs_in_a_current_as_the_equations_say(end, current, roll, pull_error):
    places, pull, speed = settled(end, np.array(current), 20.0, roll)
    expected, forces = shape(Cable(), ANCHOR, end, current, SEGMENTS + 1)
    assert speed < 5e-3
    assert np.linalg.norm(places - expected, axis=1).max() < 0.003 * WHOLE
    assert np.linalg.norm(pull - forces[1]) < pull_error * np.linalg.norm(forces[1])


def test_the_equations_know_the_force_on_the_whole():
    end, current = (8.0, 0.0, -4.95), np.array([0.6, 0.8, 0.0])
    places, forces = shape(Cable(), ANCHOR, end, current, 2001)
    tangents = np.gradient(places, WHOLE / 2000, axis=0)
    loads = np.array([Cable().load(t / np.linalg.norm(t), current) for t in tangents])
    whole = np.trapezoid(loads, dx=WHOLE / 2000, axis=0)
    np.testing.assert_allclose(forces.sum(axis=0), whole, rtol=1e-4, atol=1e-4)
    np.testing.assert_allclose(np.linalg.norm(tangents, axis=1), 1.0, atol=1e-4)


def test_a_slack_tether_leaves_the_vehicle_alone_in_still_water():
    tethered, alone = Simulation('bluerov2_tether'), Simulation('bluerov2')
    tethered.enable_wind(False)
    start = tethered.snapshot().vehicles['bluerov2'].position_w
    alone.data.qpos[:3] = start
    for simulation in (tethered, alone):
        simulation.step(1500)
    places = [s.snapshot().vehicles['bluerov2'].position_w for s in (tethered, alone)]
    assert abs(places[1] - start).max() > 0.05  # it rises
    np.testing.assert_allclose(*places, atol=0.02)


def test_a_taut_tether_holds_the_vehicle_under_full_thrust():
    simulation = Simulation('bluerov2_tether')
    simulation.reset('taut')
    simulation.set_thrust('bluerov2', [-40.0, -40.0, 40.0, 40.0, 0.0, 0.0])  # ahead
    reach = []
    for _ in range(40):
        simulation.step(100)
        site = simulation.data.site('tether').xpos
        reach.append(np.linalg.norm(site - ANCHOR))
    assert max(reach) < WHOLE + 0.05
    simulation.set_thrust('bluerov2', [0.0] * 6)


@pytest.mark.parametrize(('angle', 'error'), [(0.05, 1e-4), (0.5, 4e-3)])  # drag takes amplitude
def test_the_load_swings_as_a_pendulum(angle, error):
    assert pendulum(angle) == pytest.approx(exact_period(angle), rel=error)


def test_the_cord_pulls_and_never_pushes():
    simulation = Simulation('x500_slung_load')
    model, data = simulation.model, simulation.data
    speed = 3.0
    data.qvel[model.jnt_dofadr[model.joint('load').id] + 2] = speed  # upward: the cord goes slack
    height = float(data.qpos[9])
    for _ in range(round(speed / 9.81 / simulation.timestep)):
        simulation.step()
    assert not data.nefc  # nothing is taut, nothing touches
    rise = data.qpos[9] - height
    assert rise == pytest.approx(speed**2 / (2 * 9.81), rel=0.03)  # its drag takes some


def test_the_controller_carries_the_load():
    simulation = Simulation('x500_slung_load')
    Runner(simulation, NoSource(), [Hold(simulation)], Pacing()).run(until=2400)
    mujoco.mj_forward(simulation.model, simulation.data)
    vehicle = simulation.snapshot().vehicles['x500']
    assert vehicle.position_w == pytest.approx([0.0, 0.0, 3.0], abs=0.02)
    load = simulation.data.qfrc_constraint[:3]
    assert load == pytest.approx([0.0, 0.0, -0.3 * 9.81], abs=0.05)


def test_what_hangs_on_a_vehicle_comes_along_into_a_fleet(tmp_path):
    path = tmp_path / 'fleet.yaml'
    path.write_text(
        'vehicles: {a: {model: bluerov2_tether, position: [0, 0, -3], keyframe: slack}, '
        'b: {model: bluerov2_tether, position: [0, 20, -3], yaw: 90, keyframe: slack}}'
    )
    fleet, alone = Simulation(path), Simulation('bluerov2_tether')
    moved = fleet.snapshot().vehicles['b'].position_w
    own = alone.snapshot().vehicles['bluerov2'].position_w - ANCHOR
    mujoco.mj_forward(fleet.model, fleet.data)
    anchor = fleet.data.body('b/tether_1').xpos
    np.testing.assert_allclose(moved - anchor, [-own[1], own[0], own[2]], atol=1e-9)
    assert abs(fleet.data.efc_pos).max() < 1e-6  # both tethers end at their vehicles
    path.write_text(
        'vehicles: {a: {model: x500_slung_load, position: [0, 0, 5], keyframe: hover}, '
        'b: {model: x500_slung_load, position: [4, 0, 5], yaw: 45, keyframe: hover}}'
    )
    fleet = Simulation(path)
    np.testing.assert_allclose(fleet.data.body('b/load').xpos, [0, 0, 0])  # before a pass
    mujoco.mj_forward(fleet.model, fleet.data)
    np.testing.assert_allclose(fleet.data.body('b/load').xpos, [4, 0, 3.45], atol=1e-12)
    assert list(fleet.vehicles) == ['a', 'b']
