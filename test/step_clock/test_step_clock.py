# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Time and ticks where the timestep changes on the way, and a simulation that steps so."""

import math
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
from fluid_sim_ros.step_clock import Beat, StepClock, rounded_steps

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


INTERVALS = st.fractions(1, 50, max_denominator=60)


@given(INTERVALS)
def test_a_beat_is_at_the_step_nearest_to_each_multiple_of_its_interval(interval):
    beat = Beat(interval)
    wanted = [math.floor(k * interval + Fraction(1, 2)) for k in range(60)]
    steps = range(wanted[-1] + 1)
    assert [step for step in steps if beat.due(step)] == wanted
    assert [beat.index(step) for step in wanted] == list(range(60))
    following = [min(w for w in wanted if w > step) - step for step in steps[:-1]]
    assert [beat.until_next(step) for step in steps[:-1]] == following
    assert max(map(int.__sub__, wanted[1:], wanted)) <= beat.longest
    assert all(step % beat.period == 0 for step in wanted)


@pytest.mark.parametrize(
    ('timestep', 'steps'),
    [(0.002, [0, 5, 10]), (0.004, [0, 3, 5, 8]), (0.003, [0, 3, 7, 10]), (1 / 240, [0, 2, 5, 7])],
)
def test_a_rate_that_does_not_divide_the_step_rate_is_met_on_average(timestep, steps):
    beat = Beat.at_rate(100, timestep, 'odom')
    assert [step for step in range(steps[-1] + 1) if beat.due(step)] == steps


@pytest.mark.parametrize(
    ('rate', 'line'),
    [
        (0, 'odom: rate 0 Hz must be above 0'),
        (600, 'odom: rate 600 Hz is above the step rate; allowed is at most 500 Hz, or a timestep '
              'of at most 0.001667 s'),
    ],
)  # fmt: skip
def test_a_rate_that_no_timestep_meets_is_refused(rate, line):
    with pytest.raises(ConfigError) as error:
        Beat.at_rate(rate, 0.002, 'odom')
    assert str(error.value) == line


def test_a_rounded_time_is_told():
    assert rounded_steps(0.01, 0.002, 'latency') == (5, '')
    steps, line = rounded_steps(0.01, 0.003, 'latency')
    assert steps == 3
    assert line == (
        'latency: 0.01 s is not a whole number of timesteps of 0.003 s; '
        'rounded to 3 steps, 0.009 s'
    )
