# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Commands, limits and efforts of thrusters are newtons, whatever their gear and gain."""

import numpy as np
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.messages.state_topics import DEFAULTS, StateTopics
from fluid_sim_ros.simulation.thrust_matrix import thrust_matrix

MOTOR = '<general name="t" site="s" gear="{}" gainprm="{}" ctrlrange="-1 2"/>'
ACTUATORS = {
    'gear 50': (MOTOR.format('50 0 0 0 0 0', 1), 50.0),
    'gear .5': (MOTOR.format('0 .3 .4 0 0 .02', 1), 0.5),
    'gain': (MOTOR.format('1 0 0 0 0 0', 7), 7.0),
    'both': (MOTOR.format('2 0 0 0 0 0', 7), 14.0),
    'minus': (MOTOR.format('2 0 0 0 0 0', -7), 14.0),
    'unit': (MOTOR.format('.7071 .7071 0 0 0 0', 1), 1.0),
}


@pytest.fixture
def simulation(tmp_path):
    def make(actuator):
        path = tmp_path / 'model.xml'
        path.write_text(
            '<mujoco><compiler autolimits="true"/><option gravity="0 0 0"/><worldbody>'
            '<body name="a"><freejoint/><geom size=".1" mass="2"/><site name="s"/></body>'
            f'</worldbody><actuator>{actuator}</actuator></mujoco>'
        )
        return Simulation(path)

    return make


@pytest.mark.parametrize('kind', ACTUATORS)
def test_a_command_of_1_is_1_newton_whatever_the_gear(simulation, kind):
    actuator, scale = ACTUATORS[kind]
    run = simulation(actuator)
    vehicle = run.vehicles['a']
    np.testing.assert_allclose(vehicle.thrust_range, [[-scale, 2 * scale]])
    wanted = 0.4 * scale
    assert run.set_thrust('a', [wanted]) == 0
    run.step(1)
    force = np.linalg.norm(run.data.qfrc_actuator[:3])
    assert force == pytest.approx(wanted, rel=2e-4)
    matrix = thrust_matrix(run.model, run.data, vehicle)
    assert np.linalg.norm(matrix[:3, 0]) == pytest.approx(1.0, rel=2e-4)
    effort = vehicle.effort_scale * run.data.actuator_force
    assert abs(effort[0]) == pytest.approx(wanted, rel=2e-4)
    # limits too: what is beyond is saturated and counted
    assert run.set_thrust('a', [9 * scale]) == 1
    run.step(1)
    assert np.linalg.norm(run.data.qfrc_actuator[:3]) == pytest.approx(2 * scale, rel=2e-4)


def test_joint_states_tell_the_effort_in_newton(simulation):
    run = simulation(ACTUATORS['gear 50'][0])
    run.set_thrust('a', [1.0])
    run.step(1)
    topics = StateTopics(run, DEFAULTS)
    (topic,) = (each for each in topics.topics if each.name == 'a/joint_states')
    topics.take_state()
    effort = np.frombuffer(topics.data(topic)[-8:], '<f8')
    assert effort[0] == pytest.approx(1.0)
