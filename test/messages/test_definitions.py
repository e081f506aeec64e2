# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Message definitions kept as data equal those of the installed ROS."""

import json

import message_definitions
import pytest

from fluid_sim_ros.messages.commands import JOINT_STATE, JOY, MULTI_ARRAY, TWIST, WRENCH
from fluid_sim_ros.messages.definitions import definition
from fluid_sim_ros.messages.state_topics import CLOCK, DEFAULTS, ODOMETRY
from fluid_sim_ros.ros.parameters.simulator import TABLE

pytestmark = pytest.mark.ros


def test_the_kept_definitions_are_those_of_the_installed_ros():
    kept = json.loads(message_definitions.TARGET.read_text(encoding='utf-8'))
    assert kept == message_definitions.collect()


@pytest.mark.parametrize('name', [JOINT_STATE, MULTI_ARRAY, JOY, TWIST, WRENCH, CLOCK, ODOMETRY])
def test_every_type_in_use_has_a_definition(name):
    assert definition(name).hash.startswith('RIHS01_')


def test_every_setting_of_the_state_topics_is_a_parameter_of_the_node_with_the_same_default():
    assert {name: TABLE[name].default for name in DEFAULTS} == DEFAULTS
