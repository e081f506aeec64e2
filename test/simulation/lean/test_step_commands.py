# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Gaits and wrenches in the compiled step are those of their twins in Python, to the bit."""

from dataclasses import replace
from fractions import Fraction

import mujoco
import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from fluid_sim_ros import Scene, Simulation
from fluid_sim_ros.schema.scene import Gait, ScheduledEvent
from fluid_sim_ros.step_clock import NEVER
from test.support.lean_worlds import STATE, Beside
from test.support.strategies import floats
from test.support.volumes import quick


class InPython(Beside):
    """A copy that takes every step whole, with gaits and wrenches written by Python."""

    def __init__(self, simulation, wrenches=None):
        super().__init__(simulation)
        self.wrenches = wrenches or {}
        self.cycles = simulation._in_steps.gaits.cycles

    def step(self, n):
        self._simulation.step(n)
        for tick in range(self._simulation.step_count - n, self._simulation.step_count):
            for cycle in self.cycles():
                cycle.write(tick, self.data.ctrl)
            for vehicle, wrench in self.wrenches.items():
                self.apply(self._simulation.vehicles[vehicle], *wrench)
            mujoco.mj_step(self.model, self.data)
        self.compare()
        assert self._simulation.data.ctrl.tobytes() == self.data.ctrl.tobytes()

    def apply(self, vehicle, force, torque, frame):
        quat_wb = self.data.qpos[vehicle.qpos_address + 3 : vehicle.qpos_address + 7].copy()
        target = self.data.qfrc_applied[vehicle.dof_address : vehicle.dof_address + 6]
        turned, quat_bw = np.empty(3), np.empty(4)
        mujoco.mju_negQuat(quat_bw, quat_wb)
        in_body = frame == 'base_link'
        vector, quat = (force, quat_wb) if in_body else (torque, quat_bw)
        mujoco.mju_rotVecQuat(turned, np.array(vector, float), quat)
        target[:3], target[3:] = (turned, torque) if in_body else (force, turned)


@pytest.mark.parametrize('integrator', ['RK4', 'implicitfast'])
@pytest.mark.parametrize('scene', quick(['fish', 'fly_wing', 'swimmer'], 'fish', 'fly_wing'))
def test_scenes_with_gaits(scene, integrator):
    simulation = Simulation(scene, integrator=integrator)
    beside, rng = InPython(simulation), np.random.default_rng(3)
    for _ in range(12):
        beside.step(int(rng.integers(1, 40)))
    simulation.set_joints(scene if scene != 'fly_wing' else 'fly', [0.1] * simulation.model.nu)
    beside.data.ctrl[:] = 0.1
    beside.step(20)


SWIMMER = Scene.load('swimmer')
#: Some divide the step rate of 500 Hz, some do not, one no 64-bit fraction can hold.
RATES = (500.0, 250.0, 100.0, 499.9, 333.25, 173.0, 7.0, 0.3, 333.3333333333333, 12.3456789012345)


@settings(max_examples=25)
@given(
    rate=st.sampled_from(RATES),
    frequency=floats(0.01, 20),
    ramp=st.sampled_from([0.0, 0.05, 0.3]),
    numbers=st.lists(floats(-7, 7), min_size=15, max_size=15),
    offsets=st.booleans(),
    blocks=st.lists(st.integers(1, 60), min_size=1, max_size=4),
)
@example(499.9, 1.0, 0.05, [0.3] * 15, True, [7, 300])
def test_any_gait(rate, frequency, ramp, numbers, offsets, blocks):
    gait = Gait(
        frequency=frequency, amplitudes=numbers[:5], phases=numbers[5:10],
        offsets=numbers[10:] if offsets else [], ramp=ramp, rate=rate,
    )  # fmt: skip
    simulation = Simulation(replace(SWIMMER, gait={'swimmer': gait}), timestep=0.002)
    control = np.zeros(simulation.model.nu)
    (cycle,) = simulation._in_steps.gaits.cycles()
    tick = 0
    for block in blocks:
        simulation.step(block)
        for at in range(tick, tick + block):
            assert cycle.beat.due(at) == (cycle.next_due(at) == at)
            cycle.write(at, control)
        tick += block
        assert simulation.data.ctrl.tobytes() == control.tobytes()
        assert simulation.next_change == cycle.next_due(tick)


def test_a_rate_beyond_64_bits_is_counted_in_python():
    gait = SWIMMER.gait['swimmer'].model_copy(update={'rate': 33.333333333333336})
    scene = replace(SWIMMER, gait={'swimmer': gait})
    simulation = Simulation(scene, timestep=0.0033333333333333335)
    assert simulation._in_steps.next_here(0) < NEVER
    beside = InPython(simulation)
    for block in (1, 10, 50, 33):
        beside.step(block)


def test_late_ticks():
    simulation = Simulation(replace(SWIMMER, gait={'swimmer': Gait(
        frequency=1.0, amplitudes=[0.5] * 5, phases=[0.0] * 5, rate=173.0
    )}))  # fmt: skip
    (cycle,) = simulation._in_steps.gaits.cycles()
    control = np.zeros(simulation.model.nu)
    for tick in (10**6, 10**9 + 7, 10**15):
        simulation.load_state(replace(simulation.save_state(), step=tick))
        simulation.step(10)
        for at in range(tick, tick + 10):
            cycle.write(at, control)
        assert simulation.data.ctrl.tobytes() == control.tobytes()


@pytest.mark.parametrize('frame', ['base_link', 'map'])
def test_wrenches_turn_with_their_vehicles(frame):
    simulation = Simulation('fleet_mixed')
    first, *others = simulation.vehicles
    wrench = ([3.0, -1.0, 2.0], [0.2, 0.3, -0.1], frame)
    simulation.set_wrench(first, *wrench)
    beside = InPython(simulation, {first: wrench})
    simulation.set_wrench(others[0], [0, 0, 1.0], [0.1, 0, 0], 'map')
    beside.wrenches[others[0]] = ([0, 0, 1.0], [0.1, 0, 0], 'map')
    for block in (1, 9, 40):
        beside.step(block)
    state = simulation.save_state()
    simulation.set_wrench(first, [0, 0, 0], [0, 0, 0])
    del beside.wrenches[first]
    address = simulation.vehicles[first].dof_address
    beside.data.qfrc_applied[address : address + 6] = 0
    beside.step(20)
    simulation.load_state(state)
    beside.wrenches[first] = wrench
    beside.follow()
    beside.step(20)
    simulation.reset()
    simulation.step(5)
    assert not simulation.data.qfrc_applied.any()


def test_a_wrench_in_blocks_is_that_in_single_steps_also_retimed():
    ends = []
    for blocks in ((1,) * 60, (7, 53), (60,)):
        simulation = Simulation('x500')
        simulation.schedule(30_000_000, ScheduledEvent(
            at=0, wrench={'x500': {'force': [1, 0, 2], 'torque': [0.1, 0, 0.05]}}
        ))  # fmt: skip
        simulation.schedule(40_000_001, ScheduledEvent(at=0, wind=[1, 2, 0]))
        simulation.set_timestep(Fraction(1, 811))
        for block in blocks:
            simulation.step(block)
        state = np.empty(mujoco.mj_stateSize(simulation.model, STATE))
        mujoco.mj_getState(simulation.model, simulation.data, state, STATE)
        ends.append(state.tobytes())
        assert simulation.data.qfrc_applied.any()
        assert simulation.model.opt.wind.tolist() == [1, 2, 0]
    assert len(set(ends)) == 1


@pytest.mark.parametrize('integrator', ['RK4', 'implicitfast'])
def test_a_beating_fly_that_falls_to_the_ground_and_grazes_it(integrator):
    simulation = Simulation('fly_wing', integrator=integrator)
    simulation.data.qpos[2], simulation.data.qvel[:3] = 0.1, (0.3, 0, -2.0)
    beside, rng, contacts = InPython(simulation), np.random.default_rng(6), []
    for _ in range(30):
        beside.step(int(rng.integers(1, 60)))
        contacts.append(beside.data.ncon > 0)
    assert any(contacts)
    assert not all(contacts)
