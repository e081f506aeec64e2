# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Entities: bodies that move freely, read and set in world axes."""

import numpy as np
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.errors import CommandError
from fluid_sim_ros.simulation.entities import Entities, UnknownEntityError


def test_vehicles_and_other_bodies_that_move_freely_are_entities():
    assert Entities(Simulation('x500_slung_load')).names == ('x500', 'load')
    assert Entities(Simulation('fleet_mixed')).names == ('one', 'two', 'rov')


def test_what_is_set_is_read():
    entities = Entities(Simulation('fleet_mixed'))
    quat = np.array([0.5, -0.5, 0.5, 0.5])
    entities.place('rov', [1, 2, -3, *(2 * quat)], [0.1, 0.2, 0.3, 0.4, 0.5, 0.6])
    state = entities.state('rov')
    assert state.position_w == pytest.approx([1, 2, -3])
    assert state.quat_wb_wxyz == pytest.approx(quat)
    assert state.velocity_w == pytest.approx([0.1, 0.2, 0.3])
    assert state.omega_w == pytest.approx([0.4, 0.5, 0.6])
    # the pose alone: the twist stays in the world's axes
    entities.place('rov', [0, 0, -2, 1, 0, 0, 0])
    state = entities.state('rov')
    assert state.velocity_w == pytest.approx([0.1, 0.2, 0.3])
    assert state.omega_w == pytest.approx([0.4, 0.5, 0.6])
    entities.place('rov', None, [0.0] * 6)
    assert entities.state('rov').position_w == pytest.approx([0, 0, -2])
    assert np.abs(entities.state('rov').omega_w).max() == 0.0


def test_a_state_is_that_of_odometry():
    simulation = Simulation('x500')
    simulation.set_thrust('x500', [5.0, 5.2, 5.1, 5.0])
    simulation.step(200)
    state, seen = Entities(simulation).state('x500'), simulation.snapshot().vehicles['x500']
    assert state.position_w == pytest.approx(seen.position_w)
    assert np.linalg.norm(state.velocity_w) == pytest.approx(np.linalg.norm(seen.velocity_b))


def test_it_goes_on_from_where_it_was_placed():
    simulation = Simulation('sphere')
    Entities(simulation).place('sphere', [3, 0, 5, 1, 0, 0, 0], [0.0] * 6)
    simulation.step(10)
    assert simulation.snapshot().vehicles['sphere'].position_w[0] == pytest.approx(3.0)
    assert simulation.snapshot().vehicles['sphere'].position_w[2] == pytest.approx(5.0, abs=0.01)


@pytest.mark.parametrize(
    ('name', 'pose', 'twist', 'words'),
    [
        ('sphere', [0, 0, 0, 0, 0, 0, 0], None, 'the quaternion must not be zero'),
        ('sphere', [0, 0, float('nan'), 1, 0, 0, 0], None, 'every number must be finite'),
        ('sphere', None, [float('inf')] + [0.0] * 5, 'every number must be finite'),
    ],
)
def test_wrong_numbers_change_nothing(name, pose, twist, words):
    simulation = Simulation('sphere')
    before = simulation.save_state().engine.tobytes()
    with pytest.raises(CommandError, match=words):
        Entities(simulation).place(name, pose, twist)
    assert simulation.save_state().engine.tobytes() == before


def test_unknown_and_fixed_ones_are_named():
    with pytest.raises(UnknownEntityError, match=r"entity 'spheer' is not known.*sphere"):
        Entities(Simulation('sphere')).state('spheer')
    with pytest.raises(CommandError, match="'bob' cannot be placed: it has no free joint"):
        Entities(Simulation('water_pendulum')).place('bob', [0, 0, 0, 1, 0, 0, 0])
