# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Runner: schedule of sinks, the three pacings, requests of other threads."""

import threading
import time
from fractions import Fraction

import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.loop.pacing import Lockstep, Pacing, RealTime
from fluid_sim_ros.loop.request_queue import RequestQueue
from fluid_sim_ros.loop.runner import NoSource, Runner
from fluid_sim_ros.step_clock import Beat, duration_steps


class Recorder:
    def __init__(self, period):
        self.period = period
        self.steps = []

    def write(self, simulation):
        self.steps.append(simulation.step_count)


class Answers:
    """Answers in lockstep from the second time on that it is asked about a step."""

    def __init__(self):
        self.asked = []

    def poll(self, simulation):
        raise AssertionError('lockstep does not poll')

    def wait(self, simulation, timeout):
        self.asked.append(simulation.step_count)
        if self.asked.count(simulation.step_count) > 1:
            return True
        time.sleep(timeout)
        return False


@pytest.fixture
def sphere():
    return Simulation('sphere', timestep=0.002)


def test_each_sink_sees_every_multiple_of_its_period_once(sphere):
    sinks = [Recorder(5), Recorder(3)]
    Runner(sphere, NoSource(), sinks, Pacing()).run(until=32)
    assert sinks[0].steps == list(range(0, 33, 5))
    assert sinks[1].steps == list(range(0, 33, 3))
    assert sphere.step_count == 32


def test_real_time_keeps_pace(sphere):
    start = time.perf_counter()
    Runner(sphere, NoSource(), [Recorder(5)], RealTime(factor=4.0, tick=5)).run(until=200)
    wall = time.perf_counter() - start
    assert wall >= 0.1  # 0.4 s simulated at 4 times real time: never early


def test_real_time_counts_overruns(sphere):
    class Slow(Recorder):
        def write(self, simulation):
            super().write(simulation)
            if len(self.steps) == 2:
                time.sleep(0.4)

    pacing = RealTime(factor=1.0, tick=5)
    Runner(sphere, NoSource(), [Slow(5)], pacing).run(until=20)
    assert pacing.overruns == 1


def test_lockstep_asks_again_until_answered_and_never_steps_without(sphere):
    source, timeouts = Answers(), []

    def hold(simulation):
        timeouts.append(simulation.step_count)
        return False

    pacing = Lockstep(Beat(Fraction(10)), on_timeout=hold, patience=0.01)
    Runner(sphere, source, [], pacing).run(until=30)
    assert timeouts == [0, 10, 20]
    assert pacing.misses == 3
    assert sorted(set(source.asked)) == [0, 10, 20]


def test_lockstep_may_go_on_without_an_answer(sphere):
    source = Answers()
    Runner(sphere, source, [], Lockstep(Beat(Fraction(10)), lambda s: True, 0.01)).run(until=30)
    assert source.asked == [0, 10, 20]


def test_requests_are_served_between_steps_and_while_paused(sphere):
    requests = RequestQueue()
    runner = Runner(sphere, NoSource(), [], Pacing(), requests)
    runner.paused = True
    thread = threading.Thread(target=runner.run)
    thread.start()
    assert requests.call(lambda: threading.current_thread() is thread, 5.0)
    requests.call(lambda: runner.advance_paused(7), 5.0)
    assert sphere.step_count == 7
    with pytest.raises(ZeroDivisionError):
        requests.call(lambda: 1 / 0, 5.0)
    runner.stop()
    thread.join()
    requests.close()
    with pytest.raises(FluidSimError, match='ended'):
        requests.call(lambda: None, 1.0)


def test_a_loop_that_does_not_answer_is_reported():
    with pytest.raises(FluidSimError, match=r'did not answer within 0\.01 s'):
        RequestQueue().call(lambda: None, 0.01)


def test_durations_are_whole_steps():
    assert duration_steps(1.0, 0.002) == 500
