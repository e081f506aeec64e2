# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Steps that leave stages out are whole steps to the bit: worlds in which bodies meet."""

import numpy as np
import pytest

from test.support.lean_worlds import Beside, world

INTEGRATORS = ('RK4', 'implicitfast', 'implicit', 'Euler')


def throw(rng, simulation, beside, speed):
    """Put both bodies anywhere in the room, with any velocity."""
    quaternions = rng.normal(size=(2, 4))
    places = rng.uniform([-2, -2, 0.2], [2.5, 2, 2.8], size=(2, 3))
    velocity = rng.normal(size=simulation.model.nv) * speed
    arm = rng.uniform(-0.5, 0.6)

    def write(data):
        data.qpos[:] = np.concatenate(
            [places[0], quaternions[0], [arm], places[1], quaternions[1]]
        )
        data.qvel[:] = velocity

    beside.both(write)


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_random_drops(tmp_path, integrator):
    simulation = world(tmp_path, integrator)
    beside, rng = Beside(simulation), np.random.default_rng(1)
    for _ in range(12):
        throw(rng, simulation, beside, 2)
        for _ in range(20):
            beside.step(int(rng.integers(1, 12)))
    assert beside.touched
    assert beside.apart


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_large_steps_and_speeds_that_jump_into_a_contact(tmp_path, integrator):
    """A step of 20 ms goes .2 m and more: stages of RK4 meet what its first one does not."""
    simulation = world(tmp_path, integrator, timestep=0.02)
    beside, rng = Beside(simulation), np.random.default_rng(2)
    for _ in range(200):
        throw(rng, simulation, beside, 10)
        for n in (1, 1, 2, 1):
            if not np.isfinite(beside.data.qpos).all() or abs(beside.data.qvel).max() > 1e3:
                break
            beside.step(n)
    assert beside.touched > 20
    assert beside.apart > 20


@pytest.mark.parametrize('share', np.linspace(0.1, 1.2, 12))
def test_a_middle_stage_that_dips_into_the_floor(tmp_path, share):
    """A ball that is pushed up hard: RK4's second stage is lower than its first and its last."""
    changes = {
        'type="ellipsoid" size=".1 .08 .06"': 'type="sphere" size=".1"',
        '<geom friction': '<geom solref="-100000 -100" friction',  # hard: it pushes harder still
    }

    def edit(text):
        for old, new in changes.items():
            text = text.replace(old, new, 1)
        return text

    simulation = world(tmp_path, 'RK4', timestep=0.02, edit=edit)
    simulation.model.opt.gravity[:] = 0
    beside, down, push = Beside(simulation), 0.55, 60.0  # [m/s], [m/s^2]

    def write(data):
        data.qpos[8:15] = [0, 2, 0.1 + share * down * 0.01, 1, 0, 0, 0]
        data.qvel[7:13] = [0, 0, -down, 0, 0, 0]
        data.qfrc_applied[9] = push * simulation.model.body('two').mass[0]

    beside.both(write)
    for _ in range(3):
        beside.step(1)


@pytest.mark.parametrize('integrator', ('RK4', 'implicitfast'))
@pytest.mark.parametrize('gap', (-1e-3, -1e-9, 0.0, 1e-9, 1e-6, 1e-3, 0.05))
def test_grazing(tmp_path, integrator, gap):
    """The ellipsoid flies along the floor, its semi-axis and a gap above it."""
    simulation = world(tmp_path, integrator)
    beside = Beside(simulation)

    def write(data):
        data.qpos[8:15] = [-1, 0.5, 0.06 + gap, 1, 0, 0, 0]
        data.qvel[7:13] = [3, 0, 0, 0, 0, 0]

    simulation.model.opt.gravity[:] = 0
    beside.both(write)
    for _ in range(20):
        beside.step(10)


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_resting_then_taking_off(tmp_path, integrator):
    simulation = world(tmp_path, integrator)
    beside = Beside(simulation)
    for _ in range(60):
        beside.step(10)
    assert beside.touched > 20
    beside.both(lambda data: data.ctrl.fill(14.0))
    for _ in range(30):
        beside.step(10)


@pytest.mark.parametrize('integrator', ('RK4', 'implicitfast'))
def test_ceiling(tmp_path, integrator):
    simulation = world(tmp_path, integrator)
    beside = Beside(simulation)
    beside.both(lambda data: data.ctrl.fill(30.0))
    near = beside.data.qpos[2]
    for _ in range(40):
        beside.step(10)
        near = max(near, beside.data.qpos[2])
    assert near > 2.6  # it reached the ceiling at 2.9
    assert beside.touched


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_joints_at_limits_in_free_flight(tmp_path, integrator):
    simulation = world(tmp_path, integrator)
    simulation.model.opt.gravity[:] = 0
    beside = Beside(simulation)
    beside.both(lambda data: data.qvel.__setitem__(6, 25.0))
    limited = 0
    for _ in range(30):
        beside.step(3)
        limited += beside.data.nefc > 0
    assert limited
    assert simulation.stages().constraints
    assert beside.apart > 20


def test_two_that_collide_in_the_air(tmp_path):
    simulation = world(tmp_path, 'implicitfast')
    simulation.model.opt.gravity[:] = 0
    beside = Beside(simulation)
    beside.both(lambda data: data.qvel.__setitem__(slice(7, 10), [-3.0, -0.5, -1.0]))
    for _ in range(60):
        beside.step(5)
    assert beside.touched
    assert beside.apart


def test_a_plate_that_only_touches_what_its_bits_allow(tmp_path):
    simulation = world(
        tmp_path, 'RK4', edit=lambda x: x.replace('type="plane"', 'type="plane" contype="2"')
    )
    beside = Beside(simulation)
    for _ in range(60):
        beside.step(7)
