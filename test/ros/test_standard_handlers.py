# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What the services of simulation_interfaces do, with its classes from ROS's generator alone."""

import sys
from importlib import import_module
from types import SimpleNamespace

import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.ros.standard.entities import EntityServices
from fluid_sim_ros.ros.standard.running import FEATURES, SimulationServices
from fluid_sim_ros.ros.standard.services import SERVICES, create_standard_services
from test.support import rosidl_package, standard_types

pytestmark = pytest.mark.ros


class SessionDouble:
    """As much of a session as the services ask for, around a real simulation."""

    def __init__(self):
        self.simulation, self.tap, self.alive = Simulation('fleet_mixed'), None, True
        self.runner = SimpleNamespace(paused=False, stopped=False)
        self.outputs = SimpleNamespace(repeat=lambda _: None)

    def check_alive(self):
        if not self.alive:
            raise FluidSimError('diverged')

    def pause(self, paused):
        self.runner.paused = paused
        return 'time'

    def step(self, steps):
        self.simulation.step(steps)
        return 'time'

    def reset(self):
        self.simulation.reset()
        return 'time'


@pytest.fixture(scope='module')
def package(tmp_path_factory):
    """Return the package's modules msg and srv: Python classes, without any compiled part."""
    folder = tmp_path_factory.mktemp('classes')
    types = standard_types
    rosidl_package.build('simulation_interfaces', types.TEXTS, types.NEEDS, folder, compiled=False)
    sys.path.insert(0, str(folder))
    yield import_module('simulation_interfaces.msg'), import_module('simulation_interfaces.srv')
    sys.path.remove(str(folder))
    for name in [name for name in sys.modules if name.startswith('simulation_interfaces')]:
        del sys.modules[name]


@pytest.fixture
def call(package):
    """Return a function that calls a service; its ``session`` is the one that is served."""
    messages, services = package
    session = SessionDouble()

    def on_session(work):
        if call.session is None:
            raise FluidSimError('the node is not configured')
        return work(call.session)

    ended = []
    sets = [
        kind(messages, services, on_session, lambda: ended.append(True))
        for kind in (SimulationServices, EntityServices)
    ]
    kinds = {name: kind for table in SERVICES.values() for name, kind in table.items()}

    def call(name, **fields):
        kind = getattr(services, kinds[name])
        served = next(each for each in sets if hasattr(each, name))
        return served.answering(getattr(served, name))(kind.Request(**fields), kind.Response())

    call.session, call.ended, call.messages = session, ended, messages
    return call


def test_features_are_those_that_there_are(call):
    known = call.messages.SimulatorFeatures
    features = call('get_simulator_features').features
    assert list(features.features) == [getattr(known, name) for name in FEATURES]
    assert known.SPAWNING not in features.features and known.DELETING not in features.features


def test_the_state_of_the_simulation_is_read_and_set(call):
    states, codes = call.messages.SimulationState, call.messages.Result

    def to(number):
        return call('set_simulation_state', state=states(state=number)).result.result

    def state():
        return call('get_simulation_state').state.state

    assert state() == states.STATE_PLAYING
    assert to(states.STATE_PLAYING) == 101
    call.session.simulation.step(5)
    assert to(states.STATE_PAUSED) == codes.RESULT_OK and state() == states.STATE_PAUSED
    assert to(states.STATE_STOPPED) == codes.RESULT_OK and state() == states.STATE_STOPPED
    assert call.session.simulation.step_count == 0
    assert to(states.STATE_PLAYING) == codes.RESULT_OK and not call.session.runner.paused
    assert to(77) == codes.RESULT_FEATURE_UNSUPPORTED
    call.session = None
    assert state() == states.STATE_INITIALIZING
    assert to(states.STATE_PLAYING) == codes.RESULT_INCORRECT_STATE
    assert to(states.STATE_QUITTING) == codes.RESULT_OK and call.ended


def test_steps_are_taken_while_paused_in_portions(call):
    codes = call.messages.Result
    answer = call('step_simulation', steps=3).result
    assert answer.result == codes.RESULT_INCORRECT_STATE and 'STATE_PAUSED' in answer.error_message
    call.session.runner.paused = True
    assert call('step_simulation', steps=1203).result.result == codes.RESULT_OK
    assert call.session.simulation.step_count == 1203
    assert call('step_simulation', steps=0).result.result == codes.RESULT_OPERATION_FAILED


@pytest.mark.parametrize(
    ('scope', 'result', 'is_reset'),
    [(0, 1, True), (255, 1, True), (3, 1, True), (4, 1, False), (1, 0, False), (2, 0, False)],
)
def test_time_and_state_are_reset_together(call, scope, result, is_reset):
    call.session.simulation.step(3)
    assert call('reset_simulation', scope=scope).result.result == result
    assert (call.session.simulation.step_count == 0) == is_reset


def test_entities_are_chosen_by_name_alone(call):
    messages = call.messages
    codes, filters = messages.Result, messages.EntityFilters
    assert call('get_entities').entities == ['one', 'two', 'rov']
    assert call('get_entities', filters=filters(filter='o$|^r')).entities == ['two', 'rov']
    for wrong in (
        filters(tags=messages.TagsFilter(tags=['a'])),
        filters(categories=[messages.EntityCategory()]),
        filters(bounds=messages.Bounds(points=[import_module('geometry_msgs.msg').Vector3()])),
    ):
        answer = call('get_entities', filters=wrong).result
        assert answer.result == codes.RESULT_FEATURE_UNSUPPORTED
        assert 'by name alone' in answer.error_message
    answer = call('get_entities_states', filters=filters(filter='(')).result
    assert answer.result == codes.RESULT_OPERATION_FAILED
    found = call('get_entities_states', filters=filters(filter='rov'))
    assert found.entities == ['rov'] and found.states[0].pose.position.z == -2.0


def test_an_entity_is_read_and_set_in_the_frame_map(call):
    messages, codes = call.messages, call.messages.Result
    new = messages.EntityState()
    new.pose.position.x, new.twist.angular.z = 5.0, 0.3
    new.pose.orientation.z, new.pose.orientation.w = 1.0, 0.0

    def place(name='rov', **flags):
        return call('set_entity_state', entity=name, state=new, **flags).result

    assert place(set_pose=True).result == codes.RESULT_OK
    state = call('get_entity_state', entity='rov').state
    assert state.header.frame_id == 'map' and state.pose.position.x == 5.0
    assert state.pose.orientation.z == 1.0 and state.twist.angular.z == 0.0
    assert place(set_twist=True).result == codes.RESULT_OK
    assert call('get_entity_state', entity='rov').state.twist.angular.z == pytest.approx(0.3)
    assert place('rob', set_pose=True).result == codes.RESULT_NOT_FOUND
    new.header.frame_id = 'odom'
    assert place(set_pose=True).result == codes.RESULT_FEATURE_UNSUPPORTED
    new.header.frame_id, call.session.alive = 'world', False
    answer = place(set_pose=True)
    assert (answer.result, answer.error_message) == (codes.RESULT_OPERATION_FAILED, 'diverged')


def test_without_the_package_nothing_is_created(monkeypatch):
    monkeypatch.setitem(sys.modules, 'simulation_interfaces.msg', None)
    assert create_standard_services(None, None, None) is False
