# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The example controllers as processes: answers, waypoints, parameters, bad input."""

import math
import signal

import numpy as np
import pytest
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import DescribeParameters, ListParameters, SetParameters
from sensor_msgs.msg import JointState

from fluid_sim_ros.control.multirotor import MultirotorController, PoseTarget
from fluid_sim_ros.control.state import State
from fluid_sim_ros.simulation.plant import plant_of
from test.support.ros_processes import Peer, controller, error_lines, stamp_ns, wait_until

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]

PERIOD_NS = 10_000_000


def odometry(z=1.5, x=0.0, tick=0):
    message = Odometry()
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(
        tick * PERIOD_NS, 1_000_000_000
    )
    message.pose.pose.position.x, message.pose.pose.position.z = x, z
    message.pose.pose.orientation.w = 1.0
    return message


class Simulator:
    """Stands where the simulator stands: publishes states and waits for their answers."""

    def __init__(self, peer, vehicle='x500'):
        self.answers = peer.collect(JointState, f'{vehicle}/cmd/thrust_stamped')
        self._states = peer.publisher(Odometry, f'{vehicle}/odom', depth=10)
        # the answer's way has to be found too, before the first state
        topic = f'{vehicle}/cmd/thrust_stamped'
        wait_until(lambda: peer.node.count_publishers(topic) > 0, 'the controller')
        self.ask(odometry(z=1.5 if vehicle == 'x500' else -5.0), patience=True)
        self.answers.clear()

    def ask(self, state, patience=False):
        """Publish a state and return the answer to it."""

        def answered():
            return any(stamp_ns(a) == stamp_ns(state) for a in self.answers)

        if patience:  # until both directions are matched

            def again():
                self._states.publish(state)
                return answered()

            wait_until(again, 'a first answer')
        else:
            self._states.publish(state)
            wait_until(answered, f'an answer to the state at {stamp_ns(state)} ns')
        return next(a for a in self.answers if stamp_ns(a) == stamp_ns(state))

    def publish(self, state):
        self._states.publish(state)


def test_each_state_gets_the_answer_of_the_law_with_its_own_stamp():
    law = MultirotorController(plant_of('quadrotor', 'x500')[0])
    with controller('quad') as process, Peer() as peer:
        simulator = Simulator(peer)
        home, rest = PoseTarget((0.0, 0.0, 1.5)), ((1, 0, 0, 0), (0, 0, 0), (0, 0, 0))
        law.step(State(0.0, (0, 0, 1.5), *rest), home)
        for tick in range(1, 20):
            x = 0.01 * tick
            answer = simulator.ask(odometry(x=x, tick=tick))
            expected = law.step(State(tick * PERIOD_NS * 1e-9, (x, 0.0, 1.5), *rest), home)
            assert list(answer.effort) == expected
        assert not answer.name
        process.signal(signal.SIGINT)
        assert process.wait() == 0
    assert error_lines(process.output) == []


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize('kind', ['quad', 'rov', 'auv', 'plane'])
def test_ends_cleanly_on_a_signal_before_any_state(kind, number):
    with controller(kind) as process:
        wait_until(lambda: 'waiting for' in process.output, 'the start')
        process.signal(number)
        assert process.wait() == 0
    assert error_lines(process.output) == []


@pytest.mark.parametrize('kind', ['quad', 'rov'])
def test_an_unsound_state_is_reported_not_answered_and_forgotten(kind):
    vehicle, z = ('x500', 1.5) if kind == 'quad' else ('bluerov2_heavy', -5.0)
    with controller(kind) as process, Peer() as peer:
        simulator = Simulator(peer, vehicle)
        before = list(simulator.ask(odometry(z=z, tick=1)).effort)
        unsound = [odometry(z=z, tick=tick) for tick in (2, 3, 4)]
        unsound[0].pose.pose.position.x = math.nan
        unsound[1].twist.twist.angular.y = math.inf
        unsound[2].pose.pose.orientation.w = 0.0  # no attitude at all
        for state in unsound:
            simulator.publish(state)
        after = list(simulator.ask(odometry(z=z, tick=5)).effort)
        answered = {stamp_ns(a) // PERIOD_NS for a in simulator.answers}
    assert answered.isdisjoint({2, 3, 4})
    assert after == pytest.approx(before, abs=1e-9)
    assert 'not answered' in process.output


def test_time_going_back_starts_anew():
    with controller('quad', waypoints='[0.0, 0.0, 1.5, 0.0, 0.0, 5.0, 0.0, 1.5, 0.0, 0.0]') as p:
        with Peer() as peer:
            simulator = Simulator(peer)  # reaches the first waypoint at once, so goes on
            forward = list(simulator.ask(odometry(tick=50)).effort)
            first = list(simulator.ask(odometry(z=0.5, tick=20)).effort)
        wait_until(lambda: 'time went back' in p.output, 'the note of it')
    # nose down (rear rotors m2, m4 stronger) to go on; level to climb to the first waypoint
    assert forward[1] > forward[0] and forward[3] > forward[2]
    assert np.ptp(first) < 1e-9 and first[0] > forward[0]


def test_a_waypoint_on_the_topic_is_flown_to_and_a_bad_one_rejected():
    with controller('quad') as process, Peer() as peer:
        simulator = Simulator(peer)
        hover = list(simulator.ask(odometry(tick=1)).effort)
        waypoints = peer.publisher(PoseStamped, 'x500/cmd/waypoint')
        wrong = PoseStamped()
        wrong.header.frame_id = 'moon'
        waypoints.publish(wrong)
        wait_until(lambda: "frame 'moon' is not known" in process.output, 'the rejection')
        goal = PoseStamped()
        goal.header.frame_id = 'map'
        goal.pose.position.z, goal.pose.orientation.w = 4.0, 1.0
        waypoints.publish(goal)
        ticks = iter(range(2, 2000))
        wait_until(
            lambda: sum(simulator.ask(odometry(tick=next(ticks))).effort) > sum(hover) + 5,
            'a climb',
        )


@pytest.mark.parametrize(
    ('kind', 'parameters', 'message'),
    [
        ('quad', {'scene': 'nowhere'}, "scene 'nowhere' is not known"),
        ('quad', {'scene': 'sphere'}, '0 vehicles with thrusters'),
        ('quad', {'vehicle': 'x501'}, "vehicle 'x501' is not in scene 'quadrotor'"),
        ('quad', {'waypoints': '[1.0, 2.0]'}, '2 numbers; must be a multiple of 5'),
        ('quad', {'waypoints': 'north'}, "parameter 'waypoints': 'north' is not an array"),
        ('quad', {'gains.position': -1.0}, "'gains.position': -1.0 is out of range"),
        ('quad', {'gains.max_tilt': 2.0}, "gain 'max_tilt': 2.0; must be below pi/2"),
        ('quad', {'gains.postion': 1.0}, "parameter 'gains.postion' is not known"),
        ('rov', {'depth': 'deep'}, "parameter 'depth': 'deep' is not a number"),
        ('auv', {'scene': 'rov'}, 'this controller needs fins'),
        ('auv', {'gains.max_pitch': 2.0}, "gain 'max_pitch': 2.0; must be below pi/2"),
        ('plane', {'scene': 'quadrotor'}, 'controller needs: aileron, elevator, rudder'),
        ('plane', {'gains.balance': 0.0}, "gain 'balance': 0.0; must be above 0"),
    ],
)
def test_bad_input_is_one_line_and_exit_code_2(kind, parameters, message):
    with controller(kind, **parameters) as process:
        assert process.wait() == 2
    lines = [line for line in process.output.splitlines() if '[INFO]' not in line]
    assert len(lines) == 1 and message in lines[0], process.output
    assert lines[0].startswith(f'{kind}_controller: error: ')


def test_every_parameter_says_its_unit():
    with controller('rov'), Peer() as peer:
        names = peer.call(ListParameters, '/rov_controller/list_parameters').result.names
        of_rclpy = ('use_sim_time', 'start_type_description_service', 'qos_overrides.')
        own = [n for n in names if not n.startswith(of_rclpy)]
        answer = peer.call(DescribeParameters, '/rov_controller/describe_parameters', names=own)
        assert {'scene', 'vehicle', 'waypoints', 'depth', 'gains.velocity'} <= set(own)
        for descriptor in answer.descriptors:
            has_unit = descriptor.description.startswith('[') and ']' in descriptor.description
            assert has_unit or descriptor.name in ('scene', 'vehicle'), descriptor.name


def set_number(peer, name, value):
    parameter = Parameter(
        name=name,
        value=ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=value),
    )
    answer = peer.call(SetParameters, '/rov_controller/set_parameters', parameters=[parameter])
    return answer.results[0]


def test_depth_changes_while_it_runs_and_gains_do_not():
    with controller('rov'), Peer() as peer:
        simulator = Simulator(peer, 'bluerov2_heavy')
        still = simulator.ask(odometry(z=-5.0, tick=1)).effort
        assert np.abs(still).max() < 1.0  # no more than its small weight in water
        assert set_number(peer, 'depth', 8.0).successful
        down = simulator.ask(odometry(z=-5.0, tick=2)).effort
        assert min(down[4:]) > 5.0  # t5 to t8 push down when positive
        refused = set_number(peer, 'gains.position', 2.0)
        assert not refused.successful and 'fixed while the controller runs' in refused.reason
        assert not set_number(peer, 'depth', math.inf).successful
