# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Pending events: in order, each once, pruned when past, and quick however many there are."""

import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluid_sim_ros import Simulation
from fluid_sim_ros.errors import CommandError, LimitError
from fluid_sim_ros.scene.schedule import Event, Schedule
from fluid_sim_ros.schema.limits import VARIABLE
from fluid_sim_ros.schema.scene import ScheduledEvent
from fluid_sim_ros.step_clock import NEVER

#: A long flight through a recorded wind.
MANY = 20_000


def change(value):
    return ScheduledEvent.model_validate({'at': value * 0.5, 'wind': [value, 0, 0]})


@given(
    scene=st.lists(st.integers(0, 9), max_size=6),
    moves=st.lists(st.tuples(st.booleans(), st.integers(0, 9)), max_size=30),
)
def test_events_come_in_the_order_of_a_sorted_list(scene, moves):
    """Events at one step keep the order in which they were stated: the scene's first."""
    schedule = Schedule([change(at) for at in scene], 0.5)
    waiting = sorted((Event(at, change(at)) for at in scene), key=lambda e: e.step)
    now = 0
    for add, number in moves:
        if add:
            event = Event(now + number, change(number))
            schedule.add(event)
            waiting = sorted([*waiting, event], key=lambda e: e.step)
        else:
            now += number
            due = [e.change for e in waiting if e.step <= now]
            waiting = [e for e in waiting if e.step > now]
            assert schedule.take_due(now) == due
        assert schedule.next_step == (waiting[0].step if waiting else NEVER)


def test_what_is_past_is_not_kept():
    schedule = Schedule([change(1)], 0.5)
    events = [Event(step, change(step)) for step in (3, 2, 9)]
    for event in events:
        schedule.add(event)
    assert schedule.added() == tuple(events)
    schedule.take_due(3)
    assert schedule.added() == (events[2],)
    schedule.rewind(0, (events[0], events[2]))
    assert [c.at for c in schedule.take_due(99)] == [0.5, 1.5, 4.5]
    assert schedule.added() == ()


def test_a_saved_state_holds_what_is_pending():
    simulation = Simulation('quadrotor')
    for ms in (40, 10, 30):
        simulation.schedule(ms * 1_000_000, change(ms))
    simulation.step(10)  # 20 ms
    saved = simulation.save_state()
    assert [event.step for event in saved.added_events] == [20, 15]

    def flown():
        simulation.step(20)
        return simulation.save_state().streams.wind_w.tolist(), simulation.data.qpos.tolist()

    first = flown()
    assert first[0] == [40, 0, 0]
    simulation.load_state(saved)
    assert flown() == first


def test_many_pending_winds_are_quick():
    simulation, event = Simulation('quadrotor'), change(1)
    begin = time.process_time()
    for i in range(MANY):  # the worst order for a list: each before all others
        simulation.schedule(2_000_000 * (2 * MANY - i), event)
    assert time.process_time() - begin < 1.0
    assert len(simulation.save_state().added_events) == MANY


def start_seconds(tmp_path, events):
    """Return the best processor time of three starts with so many events [s]."""
    scene = tmp_path / f'windy_{events}.yaml'
    rows = (f'- {{at: {i / 100:.2f}, wind: [{i % 7}.5, 1.0, 0.25]}}\n' for i in range(events))
    scene.write_text('model: quadrotor\nschedule:\n' + ''.join(rows))
    seconds = []
    for _ in range(3):
        begin = time.process_time()
        simulation = Simulation(scene)
        seconds.append(time.process_time() - begin)
    assert len(simulation.scene.schedule) == events
    return min(seconds)


def test_starting_with_many_events_takes_time_in_proportion(tmp_path):
    # in proportion: below 5, as a start has other work, too; with the square: 25
    assert start_seconds(tmp_path, MANY // 2) < 10 * start_seconds(tmp_path, MANY // 10)


@pytest.mark.full
def test_a_scene_with_many_events_starts_within_a_second(tmp_path):
    assert start_seconds(tmp_path, MANY) < 1.0


def test_more_than_the_limit_is_refused_and_says_how_to_raise_it(monkeypatch, tmp_path):
    monkeypatch.setenv(VARIABLE, 'scene_events=3')
    simulation = Simulation('quadrotor')
    for i in range(3):
        simulation.schedule(10_000_000 + i, change(1))
    with pytest.raises(CommandError, match=f'scene_events = 3 .*{VARIABLE}=scene_events=NUMBER'):
        simulation.schedule(10_000_000, change(1))
    simulation.step(10)  # they are past: there is room again
    simulation.schedule(30_000_000, change(2))
    scene = tmp_path / 'windy.yaml'
    event = '{at: 1.0, wind: [1, 0, 0]}'
    scene.write_text(f'model: quadrotor\nschedule: [{", ".join([event] * 4)}]\n')
    with pytest.raises(LimitError, match='windy: events of the schedule: 4 is beyond'):
        Simulation(scene)
