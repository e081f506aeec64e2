"""The example controllers as processes: answers, pacings, waypoints, resets, bad input."""

import math
import signal

import numpy as np
import pytest
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import DescribeParameters, ListParameters, SetParameters
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger

from fluid_sim_ros.control.multirotor import MultirotorController, PoseTarget
from fluid_sim_ros.control.state import State
from fluid_sim_ros.simulation.plant import plant_of
from test.support.ros_processes import Peer, Process, error_lines, node, stamp_ns, wait_until

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]

PERIOD_NS = 10_000_000


def controller(kind, **parameters):
    return Process(f'fluid_sim_ros.ros.controllers.{kind}', **parameters)


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
        ('rov', {'scene': 'quadrotor'}, 'rank 4; this controller needs 6'),
        ('auv', {'scene': 'rov'}, 'this controller needs: rudder, planes'),
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
        own = [n for n in names if n not in ('use_sim_time', 'start_type_description_service')]
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


def numbers(message):
    p, q = message.pose.pose.position, message.pose.pose.orientation
    return np.array([p.x, p.y, p.z, 2 * math.atan2(q.z, q.w)])


def reach(states, seconds):
    """Wait until the states have come this far; return the last one's position and heading."""
    wait_until(lambda: states and stamp_ns(states[-1]) > seconds * 1e9, f'{seconds} s')
    return numbers(states[-1])


@pytest.mark.parametrize('first', ['node', 'controller'])
def test_lockstep_pair_flies_to_a_waypoint_whoever_starts_first(first):
    start = {
        'node': lambda: node(scene='quadrotor', pacing='lockstep', enable_wind=False),
        'controller': lambda: controller('quad', waypoints='[1.0, 0.5, 2.0, 0.5, 0.0]'),
    }
    second = ({*start} - {first}).pop()
    with Peer() as peer:
        states = peer.collect(Odometry, 'x500/odom', depth=5000)
        with start[first]() as one, start[second]() as two:
            there = reach(states, 8.0)
            for process in (one, two):
                process.signal(signal.SIGTERM)
                assert process.wait() == 0
    assert there == pytest.approx([1.0, 0.5, 2.0, 0.5], abs=0.03)


def test_free_pacing_is_answered_in_order():
    with Peer() as peer:
        answers = peer.collect(JointState, 'x500/cmd/thrust_stamped', depth=5000)
        with controller('quad') as pilot:
            with node(scene='quadrotor', pacing='free') as simulator:
                wait_until(lambda: len(answers) > 200, 'two hundred answers')
            assert error_lines(simulator.output + pilot.output) == []
    stamps = np.array([stamp_ns(a) for a in answers])
    assert (np.diff(stamps) > 0).all()
    assert np.isfinite([list(a.effort) for a in answers]).all()


def test_realtime_pair_holds_its_place_through_a_reset():
    plan = '[0.0, 0.0, 1.5, 0.0, 0.0]'
    with Peer() as peer:
        states = peer.collect(Odometry, 'x500/odom')
        with node(scene='quadrotor', realtime__factor=2.0, enable_wind=False) as simulator:
            with controller('quad', waypoints=plan) as pilot:
                before = reach(states, 8.0)
                assert peer.call(Trigger, '/fluid_sim_node/reset').success
                wait_until(lambda: 'time went back' in pilot.output, 'the reset')
                wait_until(lambda: stamp_ns(states[-1]) < 5e9, 'the time after it')
                after = reach(states, 6.0)
            assert error_lines(simulator.output) == []
    assert before == pytest.approx([0.0, 0.0, 1.5, 0.0], abs=0.05)
    assert after == pytest.approx([0.0, 0.0, 1.5, 0.0], abs=0.05)


def test_lockstep_rov_dives_and_turns():
    with Peer() as peer:
        states = peer.collect(Odometry, 'bluerov2_heavy/odom', depth=5000)
        pilot = controller('rov', depth=6.0, heading=1.0)
        with pilot, node(scene='rov', pacing='lockstep', enable_wind=False):
            there = reach(states, 12.0)
    assert there[2:] == pytest.approx([-6.0, 1.0], abs=0.01)


def test_lockstep_auv_dives_and_heads_for_its_waypoints_by_thrust_and_fins():
    plan = '[8.0, 0.0, -5.0, 3.0, 0.0, 150.0, -75.0, -6.0, 0.0, 0.0]'  # passes the first at once
    with Peer() as peer:
        states = peer.collect(Odometry, 'remus100/odom', depth=5000)
        pilot = controller('auv', waypoints=plan, depth=2.0, heading=2.0)  # a plan comes first
        with pilot, node(scene='remus100', pacing='lockstep') as simulator:
            x, y, z, yaw = reach(states, 18.0)
        assert error_lines(simulator.output + pilot.output) == []
    assert math.hypot(x, y) > 20
    assert yaw == pytest.approx(math.atan2(-75 - y, 150 - x), abs=0.03)
    assert z == pytest.approx(-6.0, abs=0.3)  # still settling


def fly_in_wind(seconds, **parameters):
    """Return rows of position and heading in lockstep, 100 Hz, and what both processes printed."""
    with Peer() as peer:
        states = peer.collect(Odometry, 'aerosonde/odom', depth=10000)
        with node(scene='aerosonde', pacing='lockstep', duration=seconds) as simulator:
            wait_until(lambda: states, 'the first state, which waits for its answer')
            with controller('plane', **parameters) as pilot:
                assert simulator.wait() == 0
        output = simulator.output + pilot.output
    by_stamp = {stamp_ns(m): m for m in states}
    rows = [numbers(by_stamp[stamp]) for stamp in sorted(by_stamp)]
    assert len(rows) >= 100 * seconds
    return np.array(rows[: round(100 * seconds)]), output


def test_lockstep_plane_holds_altitude_and_heading_in_wind_and_a_gust():
    rows, output = fly_in_wind(20.0, altitude=102.0, heading=0.2)  # wind at 5 s, gust at 10 s
    assert error_lines(output) == []
    windy, gust, after = rows[900:1000], rows[1000:1300], rows[1950:]
    for calm, turned in ((windy, 0.06), (after, 0.01)):  # 4 s after the wind, 7 s after the gust
        assert calm[:, 2] == pytest.approx(102.0, abs=0.5)
        assert calm[:, 3] == pytest.approx(0.2, abs=turned)
    assert np.abs(rows[500:, 2] - 102.0).max() < 5.0
    assert gust[:, 2].max() > 102.5  # it did lift


def test_lockstep_plane_flies_waypoints_the_same_way_twice():
    plan = '[60.0, 2.0, 100.5, 0.0, 0.0, 120.0, 10.0, 101.0, 0.3, 0.0]'
    first, _ = fly_in_wind(10.0, waypoints=plan)
    second, _ = fly_in_wind(10.0, waypoints=plan)
    np.testing.assert_array_equal(first, second)
    along, left = np.cos(0.3), np.sin(0.3)
    distance = along * (first[:, 1] - 10) - left * (first[:, 0] - 120)
    assert np.abs(distance[-50:]).max() < 5.0
    assert first[-1, 2] == pytest.approx(101.0, abs=0.5)
