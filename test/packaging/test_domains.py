# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import os
import subprocess
import sys

import pytest

ASK_FOR_LOCK = """
import fcntl, sys
try:
    fcntl.flock(open(sys.argv[1], 'w'), fcntl.LOCK_EX | fcntl.LOCK_NB)
except BlockingIOError:
    print('held')
"""


@pytest.mark.usefixtures('ros_domain_of_module')
def test_a_test_and_its_module_have_different_domains(ros_domain, ros_domain_of_module):
    assert ros_domain != ros_domain_of_module
    assert {ros_domain, ros_domain_of_module} <= set(range(1, 61))
    assert os.environ['ROS_DOMAIN_ID'] == str(ros_domain)


@pytest.mark.ros
def test_the_mark_alone_gives_a_domain():
    assert 1 <= int(os.environ['ROS_DOMAIN_ID']) <= 60


def test_nothing_leaves_this_host():
    assert os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] == 'LOCALHOST'


def test_no_other_process_gets_the_same_domain(ros_domain, request):
    folder = request.config.pluginmanager.get_plugin(
        str(request.config.rootpath / 'test' / 'conftest.py')
    )._LOCKS
    answer = subprocess.run(
        [sys.executable, '-c', ASK_FOR_LOCK, str(folder / str(ros_domain))],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert answer.stdout == 'held\n'
