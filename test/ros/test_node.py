"""The node as its users meet it: a process of its own, real topics, services and signals."""

import signal

import numpy as np
import pytest
from geometry_msgs.msg import TwistStamped, WrenchStamped
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState, GetState
from nav_msgs.msg import Odometry
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray
from std_srvs.srv import SetBool, Trigger
from visualization_msgs.msg import MarkerArray

from fluid_sim_ros import Scene, Simulation, scene_names
from test.support.ros_processes import NODE, Peer, Process, error_lines, node, stamp_ns, wait_until

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]

SELF = '/fluid_sim_node'


def set_parameter(peer, name, **value):
    parameter = Parameter(name=name, value=ParameterValue(**value))
    response = peer.call(SetParameters, f'{SELF}/set_parameters', parameters=[parameter])
    return response.results[0]


def string(value):
    return {'type': ParameterType.PARAMETER_STRING, 'string_value': value}


@pytest.mark.parametrize('scene', scene_names())
def test_every_scene_publishes_at_its_rates_to_another_process(scene):
    vehicle = next(iter(Scene.load(scene).compile().vehicles))
    rates = {'odom__rate': 50.0, 'wrench__rate': 25.0, 'clock__rate': 50.0}
    timestep = Simulation(scene).timestep
    if (0.02 / timestep) % 1 > 1e-9:  # a model whose timestep does not divide 20 ms
        rates = dict.fromkeys(rates, 1 / (10 * timestep))
    with Peer() as peer:
        odometry = peer.collect(Odometry, f'{vehicle}/odom')
        wrenches = peer.collect(WrenchStamped, f'{vehicle}/wrench/total')
        clocks = peer.collect(Clock, '/clock')
        with node(scene=scene, pacing='realtime', realtime__factor=4.0, **rates):
            wait_until(lambda: len(odometry) > 25 and len(wrenches) > 12, f'{scene} on its topics')
        for messages, rate in ((odometry, 'odom__rate'), (wrenches, 'wrench__rate')):
            gaps = np.diff([stamp_ns(m) for m in messages])
            np.testing.assert_allclose(gaps, 1e9 / rates[rate], atol=1.0)
        assert clocks
        assert odometry[0].header.frame_id == f'{vehicle}/odom'
        assert odometry[0].child_frame_id == f'{vehicle}/base_link'
        assert wrenches[0].header.frame_id == f'{vehicle}/base_link'


def test_odometry_and_wrench_are_those_of_the_simulation():
    with Peer() as peer:
        odometry = peer.collect(Odometry, 'sphere/odom')
        total = peer.collect(WrenchStamped, 'sphere/wrench/total')
        drag = peer.collect(WrenchStamped, 'sphere/wrench/drag')
        viscous = peer.collect(WrenchStamped, 'sphere/wrench/viscous')
        lists = (odometry, total, drag, viscous)
        with node(scene='sphere', realtime__factor=5.0):
            wait_until(lambda: min(map(len, lists)) > 100, 'odometry and wrenches')
        last = odometry[-1]
        simulation = Simulation('sphere')
        simulation.step(round(stamp_ns(last) * 1e-9 / simulation.timestep))
        state = simulation.snapshot().vehicles['sphere']
        pose, twist = last.pose.pose, last.twist.twist
        assert [pose.position.x, pose.position.y, pose.position.z] == state.position_w.tolist()
        o = pose.orientation
        assert [o.w, o.x, o.y, o.z] == state.quat_wb_wxyz.tolist()
        assert [twist.linear.x, twist.linear.y, twist.linear.z] == state.velocity_b.tolist()
        forces = {stamp_ns(m): m.wrench.force.z for m in viscous}
        drags = {stamp_ns(m): m.wrench.force.z for m in drag}
        totals = {stamp_ns(m): m.wrench.force.z for m in total}
        shared = forces.keys() & drags.keys() & totals.keys()
        assert len(shared) > 50
        terms = simulation.wrench('sphere')
        for name in set(terms) - {'drag', 'viscous'}:
            assert not terms[name][0].any()  # a sphere that falls straight in stock fluid
        for time in shared:
            assert totals[time] == pytest.approx(forces[time] + drags[time], rel=1e-12)


def test_commands_are_applied_and_bad_ones_counted_and_survived():
    with Peer() as peer:
        peer.watch_diagnostics()
        joints = peer.collect(JointState, 'x500/joint_states')
        with node(scene='quadrotor', command_timeout=0.0) as process:
            thrust = peer.publisher(Float64MultiArray, 'x500/cmd/thrust')
            stamped = peer.publisher(JointState, 'x500/cmd/thrust_stamped')
            wrench = peer.publisher(WrenchStamped, 'x500/cmd/wrench')
            wind = peer.publisher(TwistStamped, 'wind')
            current = peer.publisher(TwistStamped, 'current')

            def errors(topic):
                values = peer.diagnostics.get('commands', (0, '', {}))[2]
                return values.get(f'{topic} last error', '')

            def refused(publisher, message, topic, words):
                publisher.publish(message)
                wait_until(lambda: words in errors(topic), f"'{words}' on {topic}")

            refused(thrust, Float64MultiArray(data=[1.0]), 'x500/cmd/thrust', 'needs 4')
            nan = Float64MultiArray(data=[1.0, float('nan'), 1.0, 1.0])
            refused(thrust, nan, 'x500/cmd/thrust', 'not finite')
            inf = Float64MultiArray(data=[1.0, float('inf'), 1.0, 1.0])
            refused(thrust, inf, 'x500/cmd/thrust', 'inf')
            names = JointState(name=['a', 'b', 'c', 'd'], effort=[1.0] * 4)
            refused(stamped, names, 'x500/cmd/thrust_stamped', 'names must be the thrusters m1')
            message = WrenchStamped()
            message.header.frame_id = 'moon'
            refused(wrench, message, 'x500/cmd/wrench', 'allowed: x500/base_link, map')
            refused(current, TwistStamped(), 'current', 'command the wind')
            message = TwistStamped()
            message.twist.linear.x = float('nan')
            refused(wind, message, 'wind', 'not finite')

            thrust.publish(Float64MultiArray(data=[1.0, 2.0, 3.0, 99.0]))
            limit = Scene.load('quadrotor').compile().vehicles['x500'].thrust_range[3, 1]
            expected = [1.0, 2.0, 3.0, limit]
            wait_until(lambda: joints and joints[-1].effort.tolist() == expected, 'the thrust')
            wait_until(
                lambda: peer.diagnostics['commands'][2]['saturated values'] == '1', 'saturation'
            )
            assert process.alive


def test_a_stale_command_becomes_zero_thrust_and_is_reported():
    with Peer() as peer:
        peer.watch_diagnostics()
        joints = peer.collect(JointState, 'x500/joint_states')
        with node(scene='quadrotor', command_timeout=0.2):
            thrust = peer.publisher(Float64MultiArray, 'x500/cmd/thrust')
            thrust.publish(Float64MultiArray(data=[2.0] * 4))
            wait_until(lambda: joints and joints[-1].effort[0] == 2.0, 'the thrust')
            wait_until(lambda: joints[-1].effort[0] == 0.0, 'zero thrust')
            wait_until(
                lambda: 'stale: x500' in peer.diagnostics.get('commands', (0, ''))[1], 'stale'
            )


def test_services_reset_step_pause_and_wind():
    with Peer() as peer:
        odometry = peer.collect(Odometry, 'x500/odom')
        medium = peer.collect(TwistStamped, 'x500/medium/wind')
        with node(scene='quadrotor', step_count=5):
            wait_until(lambda: odometry, 'odometry')  # a paused node publishes each step once
            refusal = peer.call(Trigger, f'{SELF}/step')
            assert not refusal.success
            assert 'not paused' in refusal.message
            paused = peer.call(SetBool, f'{SELF}/pause', data=True)
            assert paused.success
            step = int(paused.message.rsplit(' ', 1)[1])
            stepped = peer.call(Trigger, f'{SELF}/step')
            assert int(stepped.message.rsplit(' ', 1)[1]) == step + 5
            reset = peer.call(Trigger, f'{SELF}/reset')
            assert reset.success
            assert reset.message.endswith('step 0')
            wait_until(lambda: odometry and stamp_ns(odometry[-1]) == 0, 'odometry at time 0')

            wind = peer.publisher(TwistStamped, 'wind')
            message = TwistStamped()
            message.header.frame_id = 'map'
            message.twist.linear.x = 3.0
            message.header.stamp.nanosec = 200_000_000  # in the future: acts at 0.2 s
            wind.publish(message)
            peer.call(SetBool, f'{SELF}/pause', data=False)
            wait_until(lambda: medium and medium[-1].twist.linear.x == 3.0, 'the wind')
            before = [m.twist.linear.x for m in medium if 0 < stamp_ns(m) <= 200_000_000]
            assert not any(before[-5:])
            peer.call(SetBool, f'{SELF}/enable_wind', data=False)
            wait_until(lambda: medium[-1].twist.linear.x == 0.0, 'wind off')


def test_a_diverging_run_is_an_error_that_reset_ends(tmp_path):
    (tmp_path / 'light.xml').write_text(
        '<mujoco><option density="1000" timestep=".02" integrator="Euler"/><worldbody>'
        '<body name="ball"><freejoint/><geom size=".1" density="50"/></body></worldbody>'
        '<keyframe><key name="fast" qvel="50 0 0 0 0 0"/><key name="rest"/></keyframe></mujoco>'
    )
    scene = tmp_path / 'light.yaml'
    scene.write_text('model: light.xml\nkeyframe: fast\n')
    with Peer() as peer:
        peer.watch_diagnostics()
        rates = dict.fromkeys(
            ('odom__rate', 'wrench__rate', 'medium__rate', 'joint_states__rate', 'clock__rate'),
            50.0,
        )
        with node(scene=scene, **rates) as process:
            wait_until(
                lambda: 'diverged at t =' in peer.diagnostics.get('loop', (0, ''))[1],
                'a report of the divergence',
            )
            assert "body 'ball'" in peer.diagnostics['loop'][1]
            assert not peer.call(SetBool, f'{SELF}/pause', data=False).success
            keyframe = set_parameter(peer, 'reset.keyframe', **string('rest'))
            assert keyframe.successful
            assert peer.call(Trigger, f'{SELF}/reset').success
            wait_until(lambda: peer.diagnostics['loop'][1] == 'running', 'a running loop')
            assert process.alive


def test_parameters_fixed_and_live():
    with Peer() as peer, node(scene='sphere', realtime__factor=2) as process:
        refused = set_parameter(peer, 'scene', **string('rov'))
        assert not refused.successful
        assert 'fixed while the node is configured' in refused.reason
        refused = set_parameter(
            peer, 'use_sim_time', type=ParameterType.PARAMETER_BOOL, bool_value=True
        )
        assert 'publishes /clock' in refused.reason
        factor = set_parameter(
            peer, 'realtime.factor', type=ParameterType.PARAMETER_DOUBLE, double_value=-1.0
        )
        assert not factor.successful
        assert set_parameter(peer, 'pacing', **string('free')).successful
        assert set_parameter(peer, 'pacing', **string('realtime')).successful
        assert process.alive


def test_a_second_publisher_of_clock_and_a_namesake_are_reported():
    with Peer('rival') as rival, Peer() as peer:
        peer.watch_diagnostics()
        rival.node.create_publisher(Clock, '/clock', 1)
        with node(scene='sphere'):
            wait_until(
                lambda: (
                    '2 publishers of /clock: /fluid_sim_node, /rival'
                    in peer.diagnostics.get('graph', (0, ''))[1]
                ),
                'the second clock',
            )
            with node(scene='sphere'):
                wait_until(
                    lambda: f'another node is called {SELF}' in peer.diagnostics['graph'][1],
                    'the namesake',
                )


def test_lifecycle_by_hand():
    with Peer() as peer, node(scene='sphere', autostart=False) as process:

        def change(transition):
            request = Transition(id=transition)
            return peer.call(ChangeState, f'{SELF}/change_state', transition=request).success

        def state():
            return peer.call(GetState, f'{SELF}/get_state').current_state.label

        odometry = peer.collect(Odometry, 'sphere/odom')
        assert state() == 'unconfigured'
        assert not peer.call(Trigger, f'{SELF}/reset').success
        assert change(Transition.TRANSITION_CONFIGURE)
        assert state() == 'inactive'
        assert change(Transition.TRANSITION_ACTIVATE)
        wait_until(lambda: len(odometry) > 3, 'odometry')
        assert change(Transition.TRANSITION_DEACTIVATE)
        assert change(Transition.TRANSITION_CLEANUP)
        assert set_parameter(peer, 'scene', **string('nowhere')).successful
        assert not change(Transition.TRANSITION_CONFIGURE)
        assert state() == 'unconfigured'
        assert set_parameter(peer, 'scene', **string('ellipsoid')).successful
        assert change(Transition.TRANSITION_CONFIGURE)
        assert change(Transition.TRANSITION_INACTIVE_SHUTDOWN)
        assert process.wait() == 0


def test_markers_show_the_vehicle_without_tf():
    with Peer() as peer:
        markers = peer.collect(MarkerArray, 'x500/markers', latched=True)
        with node(scene='quadrotor'):
            wait_until(lambda: len(markers) > 2, 'markers')
        names = {marker.ns for marker in markers[-1].markers}
        assert names == {'x500/geoms', 'forces'}
        assert {marker.header.frame_id for marker in markers[-1].markers} == {'map'}


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize('pacing', ['realtime', 'free', 'lockstep'])
def test_a_signal_ends_the_node_with_exit_code_0(number, pacing):
    with Peer() as peer:
        odometry = peer.collect(Odometry, 'x500/odom')
        with node(scene='quadrotor', pacing=pacing) as process:
            wait_until(lambda: odometry, 'odometry')
            process.signal(number)
            assert process.wait(10) == 0
            assert not error_lines(process.output)


def test_two_instances_in_namespaces_do_not_meet():
    arguments = ('--ros-args', '-r', '__ns:=/one')
    with Peer() as peer:
        one = peer.collect(Odometry, '/one/sphere/odom')
        two = peer.collect(Odometry, '/sphere/odom')
        with Process(NODE, *arguments, scene='sphere'), node(scene='sphere'):
            wait_until(lambda: len(one) > 3 and len(two) > 3, 'both odometries')


@pytest.mark.parametrize(
    ('parameters', 'words'),
    [
        ({'scene': 'atlantis'}, "scene 'atlantis' is not known; scenes: "),
        ({'scnee': 'rov'}, "parameter 'scnee' is not known; parameters: scene"),
        ({'pacing': 'lock'}, 'allowed: realtime, free, lockstep'),
        ({'use_sim_time': True}, 'must be false for this node'),
        ({'scene': 'sphere', 'odom__rate': 333.0}, 'does not divide the step rate'),
        ({'scene': 'sphere', 'pacing': 'lockstep'}, 'lockstep needs a topic to wait for'),
        (
            {'scene': 'quadrotor', 'pacing': 'lockstep', 'lockstep__wait_for': '[a/b]'},
            "'a/b' is no command topic of this scene; it has: x500/cmd/thrust",
        ),
        (
            {'scene': 'quadrotor', 'pacing': 'lockstep', 'odom__rate': 50.0},
            'not a multiple of the',
        ),
    ],
)
def test_a_wrong_start_is_one_line_and_exit_code_2(parameters, words):
    with node(**parameters) as process:
        assert process.wait() == 2
    (line,) = [line for line in process.lines if line.startswith('fluid_sim_node: error:')]
    assert words in line
    assert 'Traceback' not in process.output


def test_a_wrong_domain_is_one_line(monkeypatch):
    monkeypatch.setenv('ROS_DOMAIN_ID', 'seven')
    with node(scene='sphere') as process:
        assert process.wait() == 2
    assert process.lines == ["fluid_sim_node: error: ROS_DOMAIN_ID is 'seven'; allowed: 0 to 232"]


def test_a_scene_file_as_parameter_file_is_refused(tmp_path):
    path = tmp_path / 'scene.yaml'
    path.write_text('model: rov\nschedule: [{at: 1}]\n')
    with Process(NODE, '--ros-args', '--params-file', str(path)) as process:
        assert process.wait() == 2
    assert "belongs in the parameter 'scene'" in process.output


def test_markers_are_shown_while_the_node_is_paused():
    with Peer() as peer, node(scene='quadrotor'):
        peer.call(SetBool, 'fluid_sim_node/pause', data=True)
        markers = peer.collect(MarkerArray, 'x500/markers')
        wait_until(lambda: len(markers) > 2, 'markers')
        assert len({stamp_ns(message.markers[0]) for message in markers}) == 1
