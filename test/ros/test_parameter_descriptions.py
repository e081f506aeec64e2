# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``ros2 param describe``: text, range and when it may change, for each parameter of each node."""

import pytest
from rcl_interfaces.msg import ParameterType
from rcl_interfaces.srv import DescribeParameters, ListParameters

from fluid_sim_ros.ros.parameters import simulator
from test.support.ros_processes import Peer, controller, node

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]

#: Those of rclpy itself.
ROS = ('use_sim_time', 'start_type_description_service', 'qos_overrides.')
NUMBERS = (ParameterType.PARAMETER_INTEGER, ParameterType.PARAMETER_DOUBLE)
KINDS = {
    'fluid_sim_node': lambda: node(scene='sphere'),
    'rov_controller': lambda: controller('rov'),
    'quad_controller': lambda: controller('quad'),
    'auv_controller': lambda: controller('auv'),
    'plane_controller': lambda: controller('plane'),
}

#: The others are of the same tables.
_QUICK = ('fluid_sim_node', 'quad_controller')


def described(peer, name):
    """Return the descriptor of each parameter of a node by its name."""
    names = peer.call(ListParameters, f'{name}/list_parameters').result.names
    own = [n for n in names if not n.startswith(ROS)]
    answer = peer.call(DescribeParameters, f'{name}/describe_parameters', names=own)
    return {each.name: each for each in answer.descriptors}


@pytest.mark.parametrize(
    'name',
    [pytest.param(kind, marks=[] if kind in _QUICK else pytest.mark.full) for kind in KINDS],
)
def test_each_parameter_says_what_it_is_and_when_it_may_change(name):
    with Peer() as peer, KINDS[name]():
        descriptors = described(peer, name)
    assert len(descriptors) > 5
    for each in descriptors.values():
        assert len(each.description) > 8, each.name
        rules = each.additional_constraints
        assert rules.endswith(('may change at run time', 'the controller runs', 'configured'))
        assert not each.read_only  # ros2 param load of the values that there are goes on
        if name.endswith('_controller') and each.name.startswith('gains.'):
            assert each.floating_point_range[0].from_value == 0.0, each.name


@pytest.mark.full
def test_ranges_choices_and_lengths_are_in_the_description():
    with Peer() as peer, node(scene='sphere'):
        found = described(peer, 'fluid_sim_node')
    assert found.keys() >= simulator.TABLE.keys()
    assert found['realtime.factor'].floating_point_range[0].to_value == 1e3
    assert found['autopilot.instance'].integer_range[0].to_value == 250
    assert found['pacing'].additional_constraints == (
        'one of: realtime, free, lockstep; may change at run time'
    )
    assert found['odom.pose_covariance'].additional_constraints == (
        '6 values; each at least 0; fixed while the node is configured'
    )
    assert 'unless allow_remote_paths' in found['scene'].additional_constraints
    assert found['tf.rate'].description.startswith('[Hz] of /tf;')
