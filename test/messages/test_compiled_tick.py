# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The compiled tick makes the same bytes, in the same order, as the topics' Python."""

import numpy as np
import pytest

from fluid_sim_ros import Simulation, scene_names
from fluid_sim_ros.messages.compiled_tick import CompiledTick
from fluid_sim_ros.messages.state_topics import DEFAULTS, StateTopics

STATES = 8
#: 1103 topics.
LARGE = ('fleet_swarm',)


def disturb(simulation, rng):
    """Set a random motion and random commands."""
    model, data = simulation.model, simulation.data
    for vehicle in simulation.vehicles.values():
        if vehicle.thrusters:
            low, high = np.clip(vehicle.thrust_range, -5.0, 5.0).T
            simulation.set_thrust(vehicle.name, rng.uniform(low, high))
        joint = int(model.body_jntadr[vehicle.body_id])
        if joint >= 0 and model.jnt_type[joint] == 0:
            place = model.jnt_qposadr[joint] + 3
            quat_wxyz = data.qpos[place : place + 4] + rng.normal(0.0, 0.2, 4)
            data.qpos[place : place + 4] = quat_wxyz / np.linalg.norm(quat_wxyz)
    data.qvel[:] += rng.normal(0.0, 0.1, model.nv)


def by_python(states, tick):
    """Return name and bytes of each message that is due."""
    states.take_state()
    due = [topic for topic in states.topics if tick % topic.period == 0]
    return [(topic.name, data) for topic in due if (data := states.data(topic))]


def compiled_from(states, compiled):
    assert compiled.take()
    topics = [states.topics[place] for place in compiled.made()]
    return [(topic.name, topic.template.bytes()) for topic in topics]


@pytest.mark.parametrize(
    'scene',
    [pytest.param(s, marks=pytest.mark.full if s in LARGE else ()) for s in scene_names()],
)
def test_every_message_of_every_scene_has_the_same_bytes(scene):
    simulation, rng = Simulation(scene), np.random.default_rng(7)
    first, second = (StateTopics(simulation, DEFAULTS) for _ in range(2))
    compiled = CompiledTick(simulation, second)
    compiled.choose(range(len(second.topics)))
    count = 0
    for i in range(STATES):
        expected = by_python(first, simulation.tick)
        assert compiled_from(second, compiled) == expected
        count += len(expected)
        if i < STATES - 2:
            disturb(simulation, rng)
        simulation.step(max(1, round(0.01 / simulation.timestep)))
    assert count > 2 * len(second.topics)


def test_uneven_rates_and_a_choice_of_topics_are_kept():
    simulation = Simulation('x500')
    settings = {**DEFAULTS, 'odom.rate': 70.0, 'tf.rate': 33.0, 'clock.rate': 500.0}
    first, second = (StateTopics(simulation, settings) for _ in range(2))
    compiled = CompiledTick(simulation, second)
    wanted = ('x500/odom', '/clock', '/tf', 'x500/joint_states', 'x500/imu/data')
    compiled.choose([i for i, t in enumerate(second.topics) if t.name in wanted])
    found = []
    for _ in range(60):
        expected = [each for each in by_python(first, simulation.tick) if each[0] in wanted]
        made = compiled_from(second, compiled)
        assert made == expected
        found += [name for name, _ in made]
        simulation.step(1)
    assert set(found) == set(wanted)
    assert found.count('/clock') > found.count('x500/odom') > found.count('/tf') > 2


def test_nothing_is_observed_where_nothing_is_due():
    simulation = Simulation('rov')
    states = StateTopics(simulation, DEFAULTS)
    compiled = CompiledTick(simulation, states)
    compiled.choose([i for i, t in enumerate(states.topics) if t.name.endswith('/odom')])
    simulation.step(1)
    before = simulation.observe(forces=False).copy()
    simulation.data.qpos[0] += 1.0
    assert compiled.take() and compiled.made() == []
    rows = np.frombuffer(simulation.observe(forces=False))
    assert rows[0] == before[0, 0] + 1.0
