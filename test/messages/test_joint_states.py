# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``joint_states`` has every joint below the base of a vehicle, then its thrusters."""

import numpy as np
import pytest

from fluid_sim_ros import Simulation, scene_names
from fluid_sim_ros.messages.cdr import read_joint_state
from fluid_sim_ros.messages.state_topics import DEFAULTS, StateTopics
from test.support.volumes import quick

JOINTS = {
    'remus100': ['rudder', 'planes'],
    'aerosonde': ['aileron_left', 'tail_right'],
}


def joint_states(simulation, vehicle):
    topics = StateTopics(simulation, DEFAULTS)
    topics.take_state()
    found = [t for t in topics.topics if t.name == f'{vehicle}/joint_states']
    return read_joint_state(topics.data(found[0])) if found else None


@pytest.mark.parametrize('scene', JOINTS)
def test_joint_states_hold_position_velocity_and_torque_of_the_joints(scene):
    """They once held no joint at all, in silence."""
    simulation = Simulation(scene)
    (vehicle,) = simulation.vehicles
    commands = {name: 0.1 * (i + 1) for i, name in enumerate(simulation.vehicles[vehicle].joints)}
    simulation.set_joints(vehicle, commands)
    simulation.step(20)
    message = joint_states(simulation, vehicle)
    model, data = simulation.model, simulation.observed
    joints = [model.joint(j).name for j in range(model.njnt) if model.jnt_type[j] != 0]
    assert set(JOINTS[scene]) <= set(joints)
    assert message.names == [*joints, *simulation.vehicles[vehicle].thrusters]
    for i, name in enumerate(joints):
        joint = data.joint(name)
        assert message.position[i] == joint.qpos[0]
        assert message.velocity[i] == joint.qvel[0]
        assert message.effort[i] == joint.qfrc_actuator[0]
    assert np.abs(message.position[: len(joints)]).max() > 1e-3


@pytest.mark.parametrize('scene', quick(scene_names(), *set(scene_names()) - {'fleet_swarm'}))
def test_every_joint_of_a_vehicle_is_named(scene):
    simulation = Simulation(scene)
    model = simulation.model
    for name, vehicle in list(simulation.vehicles.items())[:4]:  # the others are alike
        below = [
            model.joint(j).name.removeprefix(vehicle.prefix)
            for j in range(model.njnt)
            if int(model.jnt_type[j]) in (2, 3)  # slide, hinge
            and model.body_rootid[model.jnt_bodyid[j]] == model.body_rootid[vehicle.body_id]
        ]
        message = joint_states(simulation, name)
        names = [] if message is None else message.names
        assert [n for n in names if n not in vehicle.thrusters] == below
