# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Logs of earlier versions name thrusters alone in joint_states; those are compared."""

from fluid_sim_ros.recording.replay.compare import of_the_same_joints

NEW = {
    'header.frame_id': '', 'name[0]': 'flap', 'name[1]': 'T1', 'name[2]': 'T2',
    'position[0]': 0.5, 'position[1]': 0.0, 'position[2]': 0.0,
    'effort[0]': 1.0, 'effort[1]': 2.0, 'effort[2]': 3.0,
}  # fmt: skip


def test_the_thrusters_of_an_old_log_are_found_by_name():
    old = {'header.frame_id': '', 'name[0]': 'T1', 'name[1]': 'T2', 'effort[0]': 2.0}

    assert of_the_same_joints(old, NEW) == {
        'header.frame_id': '', 'name[0]': 'T1', 'name[1]': 'T2',
        'position[0]': 0.0, 'position[1]': 0.0, 'effort[0]': 2.0, 'effort[1]': 3.0,
    }  # fmt: skip


def test_a_joint_that_is_gone_and_other_messages_are_compared_as_they_are():
    assert of_the_same_joints({'name[0]': 'T9'}, NEW) is NEW
    assert of_the_same_joints(NEW, NEW) is NEW
    assert of_the_same_joints({'name': 'T1', 'x': 1.0}, {'x': 2.0}) == {'x': 2.0}
    assert of_the_same_joints(NEW, {}) == {}
