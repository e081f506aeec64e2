"""Time and ticks where the timestep changes on the way, and a simulation that steps so."""

from fractions import Fraction

import mujoco
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluid_sim_ros import Simulation
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.loop.pacing import Pacing
from fluid_sim_ros.loop.runner import NoSource, Runner
from fluid_sim_ros.step_clock import StepClock

RATES = st.integers(500, 8000)


@given(st.lists(st.tuples(RATES, st.integers(0, 50)), max_size=20))
def test_time_is_exact_and_ticks_follow_it(paces):
    clock, step, exact_s = StepClock(0.002), 0, Fraction(0)
    for rate, steps in paces:
        clock.retime(step, Fraction(1, rate))
        step += steps
        exact_s += Fraction(steps, rate)
    assert clock.time_ns(step) == int(exact_s * 10**9 + Fraction(1, 2))
    assert clock.time(step) == pytest.approx(float(exact_s), rel=1e-15)
    assert clock.tick(step) == exact_s // Fraction(1, 500)


def test_the_first_tick_at_or_after_a_time():
    clock = StepClock(0.002)
    assert [clock.tick_at(ns) for ns in (0, 1, 2_000_000, 2_000_001)] == [0, 1, 1, 2]


def test_a_retimed_simulation_steps_as_mujoco_does():
    simulation = Simulation('sphere', timestep=0.002)
    simulation.step(10)
    model, data = simulation.model, mujoco.MjData(simulation.model)
    mujoco.mj_copyData(data, model, simulation.data)
    simulation.set_timestep(Fraction(1, 1199))
    simulation.step(100)
    mujoco.mj_step(model, data, 100)
    assert model.opt.timestep == 1 / 1199
    assert np.array_equal(simulation.data.qpos, data.qpos)
    assert simulation.time_ns == round(Fraction(20 * 10**6) + Fraction(100 * 10**9, 1199))
    assert (simulation.step_count, simulation.tick) == (110, 51)
    simulation.reset()
    assert (model.opt.timestep, simulation.tick, simulation.time) == (0.002, 0, 0.0)


def test_a_retimed_state_goes_on_bit_by_bit():
    first, second = Simulation('x500'), Simulation('x500')
    first.set_timestep(Fraction(1, 1111))
    first.step(7)
    saved = first.save_state()
    first.step(9)
    second.load_state(saved)
    second.step(9)
    assert np.array_equal(first.data.qpos, second.data.qpos)
    assert first.time_ns == second.time_ns == round(Fraction(16 * 10**9, 1111))


def test_events_of_the_scene_keep_their_time():
    simulation = Simulation('x500')  # a gust at 10 s
    simulation.set_timestep(Fraction(1, 1200))
    simulation.step(11999)
    assert not simulation.model.opt.wind.any()
    simulation.step(2)
    assert simulation.model.opt.wind.tolist() == [6, 0, 0]


class Times:
    def __init__(self, period):
        self.period = period
        self.times = []

    def write(self, simulation):
        self.times.append(simulation.time)


def test_sinks_are_written_once_at_the_first_boundary_of_their_tick():
    simulation, sink = Simulation('x500'), Times(5)
    simulation.set_timestep(Fraction(1, 800))
    Runner(simulation, NoSource(), [sink], Pacing()).run(until=500)
    due = np.arange(0, 1.0001, 0.01)
    assert len(sink.times) == len(due)
    late = np.array(sink.times) - due
    assert late.min() > -1e-12
    assert late.max() < 1 / 800


@pytest.mark.parametrize('timestep', [Fraction(0), Fraction(-1, 500), Fraction(1, 499)])
def test_a_timestep_must_be_within_the_scenes(timestep):
    with pytest.raises(ConfigError, match=r'must be above 0, and not longer than the scene'):
        Simulation('x500').set_timestep(timestep)


def test_a_gait_keeps_its_timestep():
    with pytest.raises(ConfigError, match='gait keeps'):
        Simulation('swimmer').set_timestep(Fraction(1, 2000))
