# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Moments of actuators at sites, made along one tree, are those that MuJoCo makes of all."""

from concurrent.futures import ThreadPoolExecutor

import mujoco
import numpy as np
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.simulation.engine import Engine
from test.support.lean_worlds import Beside

WORLD = """
<mujoco>
  <option timestep="0.002" integrator="{integrator}" density="1.2" viscosity="1.8e-5"/>
  <worldbody>
    <body name="one" pos="0 0 2"><freejoint/>
      <geom size=".1" mass="1" contype="0" conaffinity="0"/>
      <site name="top" pos=".1 .2 .3" euler="20 30 40"/><site name="zero"/>
      <body pos=".3 0 0" name="plate"><geom size=".05" mass=".1" contype="0" conaffinity="0"/>
        <site name="welded" pos="0 0 .1" euler="10 0 0"/></body>
      <body pos="-.3 0 0"><joint name="arm" axis="0 1 0" damping=".01"/>
        <geom size=".05" mass=".2" contype="0" conaffinity="0"/><site name="hand" pos="-.1 0 0"/>
        <body pos="-.2 0 0"><joint name="wrist" type="ball" damping=".01"/>
          <geom size=".03" mass=".1" contype="0" conaffinity="0"/>
          <site name="tip" pos="0 .1 0" euler="0 50 0"/></body></body>
    </body>
    <body name="two" pos="2 0 1"><joint name="rail" type="slide" axis="1 0 0"/>
      <geom size=".1" mass="1" contype="0" conaffinity="0"/><site name="cart" pos="0 0 .1"/></body>
    <site name="still" pos="0 0 1"/>
  </worldbody>
  <actuator>
    <motor site="top" gear="1 2 3 .1 .2 .3"/><motor site="zero" gear="0 0 1 0 0 0"/>
    <motor site="welded" gear="0 0 0 0 0 1"/><motor joint="arm" gear=".3"/>
    <motor site="hand" gear="0 0 1 0 .1 0"/><motor site="tip" gear="1 0 0 0 .1 0"/>
    <motor site="cart" gear="1 0 .5 0 0 0"/><motor site="still" gear="0 0 1 0 0 0"/>
    <position joint="rail" kp="3" kv=".1"/><velocity site="top" gear="0 0 1" kv=".2"/>
    {actuators}
  </actuator>
  {more}
</mujoco>
"""
#: What a model has beyond the world's -> whether MuJoCo makes the moments nevertheless.
KINDS = {
    'plain': {},
    'a site that refers to another': {
        'actuators': '<motor site="tip" refsite="top" gear="0 0 1 0 0 0"/>'
    },
    'a tendon': {
        'more': '<tendon><fixed name="t"><joint joint="arm" coef="2"/></fixed></tendon>',
        'actuators': '<motor tendon="t"/>',
    },
    'a sensor': {'more': '<sensor><actuatorvel actuator="watched"/></sensor>',
                 'actuators': '<motor name="watched" site="tip" gear="0 1 0 0 0 0"/>'},
    'damping': {'actuators': '<motor joint="arm" damping=".3"/>'},
    'a joint of six': {'actuators': '<motor joint="wrist" gear="1 0 0"/>'},
    'actuation off': {'more': '<option><flag actuation="disable"/></option>'},
}  # fmt: skip


def made(integrator='RK4', **more):
    text = WORLD.format(integrator=integrator, **({'actuators': '', 'more': ''} | more))
    return Engine(mujoco.MjModel.from_xml_string(text), [])


def fly(beside, rng, calls=15):
    nu = beside.model.nu
    for _ in range(calls):
        controls = rng.uniform(-1, 1, nu)
        beside.both(lambda data, controls=controls: data.ctrl.__setitem__(slice(None), controls))
        beside.step(int(rng.integers(1, 9)))


@pytest.mark.parametrize('integrator', ['RK4', 'implicitfast', 'implicit', 'Euler'])
@pytest.mark.parametrize('kind', KINDS)
def test_same_bits(kind, integrator):
    simulation = made(integrator, **KINDS[kind])
    beside = Beside(simulation)
    fly(beside, np.random.default_rng(1))
    assert simulation.stages().moments_by_tree == (kind == 'plain')
    assert np.abs(beside.data.qpos[:3] - [0, 0, 2]).max() > 1e-4


def test_changes_of_the_model_between_calls():
    simulation = made()
    beside, rng = Beside(simulation), np.random.default_rng(2)
    fly(beside, rng, 3)
    simulation.model.actuator_gear[:] *= 1.5
    fly(beside, rng, 3)
    simulation.model.actuator_damping[3] = 0.2
    fly(beside, rng, 3)
    simulation.model.actuator_damping[3] = 0.0
    simulation.model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_ACTUATION
    fly(beside, rng, 3)
    simulation.model.opt.disableflags = 0
    simulation.model.actuator_trnid[4] = simulation.model.site('cart').id, -1
    fly(beside, rng, 3)


def test_a_control_callback_of_a_user():
    simulation = made()
    beside, rng = Beside(simulation), np.random.default_rng(3)
    fly(beside, rng, 3)
    calls = []
    mujoco.set_mjcb_control(lambda model, data: calls.append(data.time))
    try:
        fly(beside, rng, 2)
        assert calls
        assert 'callback' in simulation.stages().whole
    finally:
        mujoco.set_mjcb_control(None)
    fly(beside, rng, 3)
    assert not simulation.stages().whole


def test_threads_do_not_meet():
    """Two simulations and MuJoCo's own steps of the first one's model, all at once."""
    first, second = made(), Simulation('fleet_x500')
    whole = Beside(first)

    def steps(simulation):
        simulation.data.ctrl[:] = 0.3
        for _ in range(60):
            simulation.step(10)
        return simulation.data.qpos.tobytes()

    def bare():
        whole.data.ctrl[:] = 0.3
        mujoco.mj_step(first.model, whole.data, 600)
        return whole.data.qpos.tobytes()

    with ThreadPoolExecutor(3) as pool:
        results = [pool.submit(steps, first), pool.submit(steps, second), pool.submit(bare)]
        found = [result.result() for result in results]
    assert found[0] == found[2]
    assert found[1] == steps(Simulation('fleet_x500'))
