# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What a user writes into data and model between calls holds at the next step."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros.errors import DivergedError
from fluid_sim_ros.plugins.native import native
from test.support.lean_worlds import Beside, world


@pytest.fixture(params=['RK4', 'implicitfast'])
def flying(request, tmp_path):
    simulation = world(tmp_path, request.param)
    beside = Beside(simulation)
    beside.step(5)
    assert simulation.stages().without_contacts
    return simulation, beside


def put(position):
    return lambda data: data.qpos.__setitem__(slice(0, 3), position)


WRITES = {
    'position into the floor': put([0, 0, 0.04]),
    'position into the other': put([0.6, 0.1, 1.2]),
    'position behind the floor': put([0, 0, -2.0]),
    'velocity': lambda data: data.qvel.__setitem__(slice(0, 3), [0, 0, -200.0]),
    'force': lambda data: data.xfrc_applied.__setitem__((2, slice(0, 3)), [0, 0, -3000.0]),
    'generalized force': lambda data: data.qfrc_applied.__setitem__(2, -3000.0),
    'control': lambda data: data.ctrl.fill(40.0),
    'time': lambda data: setattr(data, 'time', 5.0),
}


@pytest.mark.parametrize('name', WRITES)
def test_writes_into_data(flying, name):
    _, beside = flying
    beside.both(WRITES[name])
    for n in (1, 1, 2, 5, 10):
        beside.step(n)


def set_number(array, index, value):
    return lambda model: getattr(model, array).__setitem__(index, value)


CHANGES = {
    'floor raised': set_number('geom_pos', (0, 2), 0.98),
    'post moved': set_number('body_pos', (1, slice(0, 3)), [0, 0, 0.9]),
    'post turned': set_number('body_quat', (1, slice(0, 4)), [0.7, 0.7, 0, 0]),
    'ceiling thicker': set_number('geom_size', (1, 2), 2.0),
    'hull larger': set_number('geom_rbound', 4, 2.0),
    'margin': set_number('geom_margin', 0, 1.2),
    'gap': set_number('geom_gap', 0, 1.2),
    'floor touches nothing': set_number('geom_contype', 0, 0),
    'arm touches': set_number('geom_contype', 7, 1),
    'fluid of a geom that is drawn only': set_number('geom_fluid', (5, 0), 1.0),
    'friction loss': set_number('dof_frictionloss', 6, 0.01),
    'no limit': set_number('jnt_limited', 1, 0),
    'gravity': lambda model: model.opt.gravity.fill(3.0),
    'wind': lambda model: model.opt.wind.fill(30.0),
    'timestep': lambda model: setattr(model.opt, 'timestep', 0.01),
    'integrator': lambda model: setattr(model.opt, 'integrator', 0),
    'contacts off': lambda model: setattr(model.opt, 'disableflags', 1 << 4),
    'constraints off': lambda model: setattr(model.opt, 'disableflags', 1),
    'parents touch': lambda model: setattr(model.opt, 'disableflags', 1 << 10),
    'energy': lambda model: setattr(model.opt, 'enableflags', 1 << 1),
    'override': lambda model: (
        setattr(model.opt, 'enableflags', 1),
        setattr(model.opt, 'o_margin', 2.0),
    ),
}


@pytest.mark.parametrize('name', CHANGES)
def test_changes_of_the_model(flying, name):
    simulation, beside = flying
    CHANGES[name](simulation.model)
    for n in (1, 1, 10, 3, 10, 10, 10, 10):
        beside.step(n)


def test_saved_states_and_resets(flying):
    simulation, beside = flying
    high = simulation.save_state()
    for _ in range(60):
        beside.step(10)
    assert beside.touched
    low = simulation.save_state()
    for state in (high, low, high, low):
        simulation.load_state(state)
        beside.follow()
        for n in (1, 2, 10):
            beside.step(n)
    simulation.reset()
    beside.follow()
    beside.step(3)


@pytest.mark.parametrize('index', [1, 5, 9])
@pytest.mark.parametrize('array', ['qpos', 'qvel', 'qfrc_applied'])
def test_a_bad_number_is_reset_as_by_whole_steps(flying, array, index):
    simulation, beside = flying
    beside.both(lambda data: getattr(data, array).__setitem__(index, np.nan))
    report = np.zeros(2)
    addresses = simulation.model._address, beside.data._address
    assert native().step(*addresses, 3, report.ctypes.data) == 0
    with pytest.raises(DivergedError):
        simulation.step(3)
    beside.compare()
    warnings = [[w.number for w in data.warning] for data in (simulation.data, beside.data)]
    assert warnings[0] == warnings[1]


def test_callbacks_get_whole_steps(flying):
    simulation, _ = flying
    seen = []
    mujoco.set_mjcb_passive(lambda model, data: seen.append((model is not None, data.ncon)))
    try:
        simulation.step(2)
        assert 'callback' in simulation.stages().whole
    finally:
        mujoco.set_mjcb_passive(None)
    assert seen
    simulation.step(2)
    assert simulation.stages().whole == ''


def test_sensors_see_every_geom(tmp_path):
    sensors = """<sensor><framepos objtype="geom" objname="drawn"/><rangefinder site="push"/>
      <distance geom1="drawn" geom2="floor" cutoff="3"/></sensor></mujoco>"""
    simulation = world(
        tmp_path,
        'RK4',
        edit=lambda text: text.replace('</mujoco>', sensors).replace(
            '<geom type="sphere"', '<geom name="drawn" type="sphere"', 1
        ),
    )
    beside = Beside(simulation)
    for n in (1, 7, 10, 10):
        beside.step(n)
    assert np.count_nonzero(beside.data.sensordata) >= 4


LAST = 'contype="0" conaffinity="0"/></body>\n    </body>'
HAND = '<geom type="sphere" size=".05" pos="-.2 0 0" mass=".01"/></body>'
UNTOUCHED = '<default><geom contype="0" conaffinity="0"'
PAIR = '<contact><pair geom1="floor" geom2="ceiling"/></contact><actuator>'
EDITS = {
    'as it is': ('', '', 'watched'),
    'slide': ('<freejoint/>', '<joint type="slide"/>', 'always'),
    'moving world': ('name="post"', 'name="post" mocap="true"', 'always'),
    'slide without a geom that touches': ('name="arm"', 'name="arm" type="slide"', 'watched'),
    'arm and its parent': (LAST, '/></body></body>', 'watched'),
    'hand and body': (
        LAST, f'/><body pos="-.1 0 0"><joint axis="0 1 0"/>{HAND}</body></body>', 'always',
    ),
    'nothing touches': ('<default><geom', UNTOUCHED, 'never'),
    'pair': ('<actuator>', PAIR, 'always'),
}  # fmt: skip


@pytest.mark.parametrize('name', EDITS)
def test_bodies_that_nothing_bounds_are_looked_at_always(tmp_path, name):
    old, new, contacts = EDITS[name]
    simulation = world(tmp_path, 'RK4', edit=lambda text: text.replace(old, new, 1))
    assert simulation.stages().contacts == contacts
    beside, rng = Beside(simulation), np.random.default_rng(4)
    beside.both(lambda data: data.mocap_pos.fill(0.8))
    for _ in range(40):
        beside.step(int(rng.integers(1, 12)))


def test_mujoco_keeps_its_clock_outside_of_the_simulation(flying):
    simulation, beside = flying
    before = [timer.duration for timer in simulation.data.timer]
    simulation.step(10)
    assert [timer.duration for timer in simulation.data.timer] == before
    mujoco.mj_step(beside.model, beside.data, 10)
    assert beside.data.timer[0].duration > 0
