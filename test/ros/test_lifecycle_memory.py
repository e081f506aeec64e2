# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Configuring and cleaning up again and again holds no more memory, objects or handles."""

import json
import subprocess
import sys

import pytest

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]


def _held(warm_up, cycles, scene):
    done = subprocess.run(
        [sys.executable, '-m', 'test.support.lifecycle_cycles', str(warm_up), str(cycles), scene],
        capture_output=True, text=True, timeout=600, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return [json.loads(line) for line in done.stdout.splitlines()]


def _check(before, after, cycles):
    assert after['handles'] == before['handles']
    assert after['threads'] == before['threads']
    # a session has thousands of objects; a few are between two threads at any time
    assert after['objects'] - before['objects'] < 1000
    # of about 150 kB that stayed of each cycle; discovery keeps some of its tables
    assert (after['allocated_kb'] - before['allocated_kb']) / cycles < 3.0


def test_a_lifecycle_cycle_leaves_nothing_behind():
    _check(*_held(15, 60, 'sphere'), 60)


@pytest.mark.full
def test_a_thousand_lifecycle_cycles_leave_nothing_behind():
    before, after = _held(100, 1000, 'quadrotor')
    _check(before, after, 1000)
    # Measured on 2 cores (2026-11-29): 0.12 kB a cycle more allocated, 6.5 kB more resident, no
    # handle, thread or object. What is resident and not allocated is the heap's: it grows in steps
    # of megabytes, and mallinfo2 counts that of the main thread only.
    assert (after['resident_kb'] - before['resident_kb']) / 1000 < 10.0
