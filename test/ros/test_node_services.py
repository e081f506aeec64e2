# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The node's services, parameters and lifecycle, and what it says of other nodes."""

import pytest
from geometry_msgs.msg import TwistStamped
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState, GetState
from nav_msgs.msg import Odometry
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from rosgraph_msgs.msg import Clock
from std_srvs.srv import SetBool, Trigger

from test.support.ros_processes import Peer, node, stamp_ns, wait_until

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]

SELF = '/fluid_sim_node'


def set_parameter(peer, name, **value):
    parameter = Parameter(name=name, value=ParameterValue(**value))
    response = peer.call(SetParameters, f'{SELF}/set_parameters', parameters=[parameter])
    return response.results[0]


def string(value):
    return {'type': ParameterType.PARAMETER_STRING, 'string_value': value}


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
        assert 'fixed after the start' in refused.reason
        refused = set_parameter(peer, 'integrator', **string('rk4'))
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
    with Peer() as peer, node(scene='sphere', autostart=False, allow_remote_paths=True) as process:

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
