# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""MuJoCo's own fluid forces and their slopes, made along chains, are MuJoCo's to the bit."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.simulation.engine import Engine
from test.support.fluid_trees import world
from test.support.lean_worlds import Beside
from test.support.volumes import quick

INTEGRATORS = ('RK4', 'implicitfast', 'implicit', 'Euler')
FEATHER = 'density="1.2" viscosity="1.8e-5"'
PLANK = f"""
<mujoco><option timestep=".001" integrator="{{integrator}}" {FEATHER} {{option}}>{{flag}}</option>
  <worldbody>
    <body name="plank" pos="0 0 1" {{gravcomp}}><freejoint/>
      <geom type="box" size=".2 .1 .01" mass=".1" fluidshape="ellipsoid" contype="0"
            conaffinity="0"/>
      <site name="a"/>
      <body pos=".2 0 0"><joint name="flap" axis="0 1 0" damping=".001" stiffness=".01"/>
        <geom type="capsule" size=".02 .1" mass=".05" contype="0" conaffinity="0"/>
        <site name="b" pos="0 0 .1"/></body>
    </body>
  </worldbody>
  {{more}}
</mujoco>"""
#: What a model has beyond the plank's -> whether MuJoCo makes the forces nevertheless.
KINDS = {
    'plain': {},
    'a tendon with a spring': {
        'more': '<tendon><spatial stiffness="3" damping=".2"><site site="a"/><site site="b"/>'
        '</spatial></tendon>'
    },
    'a sensor of a geom': {'more': '<sensor><framepos objtype="body" objname="plank"/></sensor>'},
    'a servo': {'more': '<actuator><position joint="flap" kp=".2" kv=".01"/></actuator>'},
    'a damped servo': {
        'more': '<actuator><position joint="flap" kp=".2" damping=".1"/></actuator>'
    },
    'a lagging motor': {
        'more': '<actuator><general joint="flap" dyntype="filter" dynprm=".1"/></actuator>'
    },
    'a lagging servo': {
        'more': '<actuator><general joint="flap" dyntype="filter" dynprm=".1" biastype="affine" '
        'biasprm="0 -.2 -.01"/></actuator>'
    },
    'motors': {
        'more': '<actuator><motor joint="flap" damping=".1"/><motor site="b" gear="0 0 1"/>'
        '</actuator>'
    },
    'dampers off': {'flag': '<flag damper="disable"/>'},
    'passive forces off': {'flag': '<flag spring="disable" damper="disable"/>'},
    'actuation off': {'flag': '<flag actuation="disable"/>'},
    'weightless': {'gravcomp': 'gravcomp="1"'},
}  # fmt: skip


def plank(integrator='implicitfast', **more):
    empty = {'option': '', 'flag': '', 'gravcomp': '', 'more': ''}
    text = PLANK.format(integrator=integrator, **(empty | more))
    return Engine(mujoco.MjModel.from_xml_string(text), [])


def tumble(engine, beside, rng, calls=8, speed=3.0):
    """Throw the bodies again and again; ends where an explicit integrator blows up, in both."""
    for _ in range(calls):
        velocity = rng.normal(size=beside.model.nv) * speed * rng.choice([0, 0.1, 1])
        beside.both(lambda data, v=velocity: data.qvel.__setitem__(slice(None), v))
        n = int(rng.integers(1, 6))
        taken = engine.step(n)
        assert beside.take(n) == taken
        if taken < n:
            return
        beside.compare()


@pytest.mark.parametrize('integrator', INTEGRATORS)
@pytest.mark.parametrize('seed', quick(range(140), *range(28)))
def test_random_trees(seed, integrator):
    engine = Engine(mujoco.MjModel.from_xml_string(world(seed, integrator)), [])
    tumble(engine, Beside(engine), np.random.default_rng(seed), 4, speed=0.5)
    assert engine.stages().fluid_by_chain


@pytest.mark.parametrize('seed', range(7))
def test_slopes(seed):
    """All of qDeriv after the last step of a call, which others may read."""
    engine = Engine(mujoco.MjModel.from_xml_string(world(seed, 'implicitfast')), [])
    beside, rng = Beside(engine), np.random.default_rng(seed)
    for _ in range(5):
        tumble(engine, beside, rng, 1, speed=0.5)
        assert (engine.data.qDeriv == beside.data.qDeriv).all()
    assert np.count_nonzero(engine.data.qDeriv)


@pytest.mark.parametrize('integrator', INTEGRATORS)
@pytest.mark.parametrize('kind', KINDS)
def test_kinds(kind, integrator):
    engine = plank(integrator, **KINDS[kind])
    tumble(engine, Beside(engine), np.random.default_rng(1))
    assert engine.stages().fluid_by_chain == (kind not in ('passive forces off', 'weightless'))


CHANGES = {
    'density': lambda model: setattr(model.opt, 'density', 900.0),
    'viscosity': lambda model: setattr(model.opt, 'viscosity', 2.0),
    'negative density': lambda model: setattr(model.opt, 'density', -1.0),
    'wind': lambda model: model.opt.wind.__setitem__(slice(None), [1, -3, 2]),
    'size': lambda model: model.geom_size.__imul__(1.3),
    'coefficients': lambda model: model.geom_fluid.__imul__(0.7),
    'ellipsoid to box': lambda model: model.geom_fluid.fill(0),
    'mass': lambda model: model.body_mass.__imul__(1.1),
    'inertia': lambda model: model.body_inertia.__imul__(1.1),
    'place': lambda model: model.geom_pos.__iadd__(0.02),
    'turn': lambda model: model.geom_quat.__setitem__((0, slice(None)), [0.6, 0.8, 0, 0]),
    'servo to motor': lambda model: model.actuator_biastype.fill(0),
    'weightless': lambda model: model.body_gravcomp.fill(0.5),
}  # fmt: skip


@pytest.mark.parametrize('integrator', ('RK4', 'implicitfast'))
@pytest.mark.parametrize('name', CHANGES)
def test_changes_of_the_model_between_calls(name, integrator):
    engine = plank(integrator, **KINDS['a servo'])
    beside, rng = Beside(engine), np.random.default_rng(2)
    tumble(engine, beside, rng, 2)
    CHANGES[name](engine.model)
    tumble(engine, beside, rng, 3)


def test_no_fluid_at_all_places_no_geoms():
    engine = plank()
    engine.model.opt.density = engine.model.opt.viscosity = 0
    stages = engine.stages()
    assert not stages.fluid_by_chain
    assert stages.moved_geoms == 0
    tumble(engine, Beside(engine), np.random.default_rng(3))


def test_a_passive_callback_of_a_user():
    engine = plank()
    beside, rng = Beside(engine), np.random.default_rng(4)
    tumble(engine, beside, rng, 2)
    calls = []
    mujoco.set_mjcb_passive(lambda model, data: calls.append(data.time))
    try:
        tumble(engine, beside, rng, 2)
        assert calls
        assert 'callback' in engine.stages().whole
    finally:
        mujoco.set_mjcb_passive(None)
    tumble(engine, beside, rng, 2)
    assert engine.stages().fluid_by_chain


@pytest.mark.parametrize('index', [1, 6])
@pytest.mark.parametrize('array', ['qpos', 'qvel', 'qfrc_applied'])
def test_a_bad_number_ends_the_same_step(array, index):
    engine = plank()
    beside = Beside(engine)
    beside.both(lambda data: getattr(data, array).__setitem__(index, np.nan))
    taken = [engine.step(3), beside.take(3)]
    assert taken == [0, 0]
    beside.compare()


@pytest.mark.parametrize('scene', ['swimmer', 'fly_wing'])
def test_shipped_scenes_are_served(scene):
    stages = Simulation(scene, integrator='implicitfast').stages()
    assert stages.fluid_by_chain
    assert stages.moved_geoms == 0
    assert "MuJoCo's fluid forces by chain" in stages.words()
