# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What a scene sees of a fluid_sim.thruster: one command per rotor, its speed, its rungs."""

import numpy as np
import pytest

from fluid_sim_ros import Scene, Simulation
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.messages import state_topics
from fluid_sim_ros.messages.cdr import read_joint_state
from test.support.thruster_models import X500, read, rotor_world

HOVER = 500.0  # rad/s
ROTOR = {**X500, 'rotor_drag': 1e-4}
LEVEL = 'timestep=".002" integrator="implicitfast" density="1.2" viscosity="1.8e-5"'


@pytest.fixture
def model(tmp_path):
    path = tmp_path / 'rotor.xml'
    path.write_text(rotor_world(ROTOR, option=LEVEL))
    return path


def test_the_reaction_torque_of_a_rotor_is_no_command(model):
    vehicle = Scene.load(model).compile().vehicles['hull']
    assert vehicle.thrusters == ('thrust',)
    assert vehicle.thruster_ids.tolist() == [0]


def test_a_torque_motor_is_still_a_command(tmp_path):
    path = tmp_path / 'wheel.xml'
    path.write_text(
        '<mujoco><worldbody><body name="b"><freejoint/><geom size=".1"/><site name="s"/></body>'
        '</worldbody><actuator><motor name="wheel" site="s" gear="0 0 0 0 0 1"/></actuator>'
        '</mujoco>'
    )
    assert Scene.load(path).compile().vehicles['b'].thrusters == ('wheel',)


def test_naming_a_reaction_torque_as_thruster_is_refused(model):
    torque = 'gear="0 0 0 0 0 1"'
    model.write_text(model.read_text().replace(torque, f'name="twin" {torque}'))
    scene = model.with_name('scene.yaml')
    scene.write_text('model: rotor.xml\nvehicles: {b: {body: hull, thrusters: [thrust, twin]}}')
    with pytest.raises(ConfigError, match="'twin' is the reaction torque of a fluid_sim"):
        Scene.load(scene).compile()


def test_joint_states_carry_the_rotor_speed(model):
    simulation = Simulation(model)
    simulation.set_thrust('hull', [HOVER])
    topics = state_topics.StateTopics(simulation, state_topics.DEFAULTS)
    joint_states = next(t for t in topics.topics if t.name == 'hull/joint_states')
    simulation.step(10)  # 20 ms, one and a half time constants
    topics.take_state()
    message = read_joint_state(topics.data(joint_states))
    speed = HOVER * (1 - np.exp(-0.02 / 0.0125))
    assert message.names == ['thrust']
    assert message.velocity == pytest.approx([speed], rel=1e-12)
    assert message.effort == pytest.approx([8.54858e-6 * speed**2], rel=1e-12)
    assert read(simulation.model, simulation.data)['rad_s'] == pytest.approx(speed, rel=1e-12)


@pytest.mark.parametrize('fluid', ['none', 'inertia'])
def test_a_fluid_rung_leaves_the_drive_alone(model, fluid):
    simulation = Simulation(model, fluid=fluid)
    simulation.set_thrust('hull', [HOVER])
    simulation.step(200)
    assert read(simulation.model, simulation.data)['rad_s'] == pytest.approx(HOVER, rel=1e-6)
