# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Commands: thrust, wrenches, wind, events of the scene."""

import numpy as np
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.errors import CommandError
from test.support.small_models import TWO_PARTS


def test_thrust_saturates_and_counts(boat):
    assert boat.set_thrust('boat', [9.0]) == 1
    assert boat.data.ctrl[0] == 3
    assert boat.set_thrust('boat', [-1.5]) == 0


@pytest.mark.parametrize(
    ('call', 'line'),
    [
        (lambda s: s.set_thrust('ship', [1]), "vehicle 'ship' is not in the scene; it has: boat"),
        (lambda s: s.set_thrust('boat', [1, 2]), r'got 2 values, needs 1 \(push\)'),
        (lambda s: s.set_thrust('boat', [np.nan]), 'not finite'),
        (lambda s: s.set_thrust('boat', [np.inf]), 'not finite'),
        (lambda s: s.set_thrust('boat', ['x']), 'are not numbers'),
        (lambda s: s.set_joints('boat', {'rudder': 1}), "'rudder' is not one of them: turn"),
        (lambda s: s.set_wind([1, 0, 0]), 'is in water only; command the current'),
        (lambda s: s.set_current([1, 0]), 'got 2 values, needs 3'),
        (lambda s: s.set_wrench('boat', [1, 0, 0], [0, 0, 0], 'odom'), 'allowed: base_link, map'),
        (lambda s: s.reset('up'), "keyframe 'up' is not in the model"),
        (lambda s: s.wrench('ship'), "vehicle 'ship'"),
    ],
)
def test_a_wrong_command_is_refused_and_leaves_the_state_alone(boat, call, line):
    control, wind = boat.data.ctrl.copy(), boat.model.opt.wind.copy()
    with pytest.raises(CommandError, match=line):
        call(boat)
    np.testing.assert_array_equal(boat.data.ctrl, control)
    np.testing.assert_array_equal(boat.model.opt.wind, wind)


@pytest.mark.parametrize('frame', ['base_link', 'map'])
def test_a_commanded_wrench_acts_at_the_base_origin_in_its_frame(tmp_path, frame):
    path = tmp_path / 'free.xml'
    path.write_text(
        '<mujoco><option gravity="0 0 0" timestep="1e-4"/><worldbody><body name="b"><freejoint/>'
        '<geom type="box" size=".3 .2 .1"/></body></worldbody></mujoco>'
    )
    simulation = Simulation(path)
    simulation.data.qpos[3:7] = [np.sqrt(0.5), 0, 0, np.sqrt(0.5)]  # body x is world y
    simulation.set_wrench('b', [10, 0, 0], [0, 0, 0], frame)
    simulation.step()
    mass = simulation.model.body('b').mass[0]
    expected = [0, 10, 0] if frame == 'base_link' else [10, 0, 0]
    np.testing.assert_allclose(simulation.data.qvel[:3] / 1e-4 * mass, expected, atol=1e-9)
    simulation.set_wrench('b', [0, 0, 0], [0, 0, 0])
    before = simulation.data.qvel.copy()
    simulation.step()
    np.testing.assert_allclose(simulation.data.qvel, before, atol=1e-12)


def test_wind_can_be_switched_off_and_on():
    simulation = Simulation('quadrotor')
    simulation.set_wind([4, 0, 0])
    simulation.enable_wind(False)
    assert not simulation.model.opt.wind.any()
    simulation.enable_wind(True)
    np.testing.assert_array_equal(simulation.model.opt.wind, [4, 0, 0])


def test_scheduled_events_act_at_their_step_however_steps_are_batched(tmp_path):
    (tmp_path / 'boat.xml').write_text(TWO_PARTS)
    scene = tmp_path / 'scene.yaml'
    scene.write_text(
        'model: boat.xml\nschedule:\n- {at: 0.1, current: [1, 0, 0]}\n'
        '- {at: 0.05, thrust: {boat: [2]}}\n'
    )
    ends = []
    for batch in (1, 7, 200):
        simulation = Simulation(scene)
        while simulation.step_count < 200:
            simulation.step(min(batch, 200 - simulation.step_count))
        ends.append(simulation.data.qpos.copy())
        assert simulation.model.opt.wind[0] == 1
    np.testing.assert_array_equal(ends[0], ends[1])
    np.testing.assert_array_equal(ends[0], ends[2])
    simulation.reset()
    assert simulation.model.opt.wind[0] == 0.3  # the model's own, before the event


def test_time_is_exact_from_the_step_count():
    simulation = Simulation('sphere', timestep=0.001)
    simulation.step(1000)
    assert simulation.time_ns == 1_000_000_000
    assert simulation.time == 1.0
