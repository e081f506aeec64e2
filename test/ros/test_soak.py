# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The measurement of long flights, on a short one."""

import pytest

from benchmarks.robustness.soak import fly


@pytest.mark.ros
@pytest.mark.full
def test_a_short_soak_measures_what_grows(tmp_path):
    found = fly(tmp_path, 20.0)
    assert found['exit_codes'] == {'node': 0, 'controller': 0}
    assert not found['log']['faults'] and found['log']['topics'] > 10
    assert found['simulated_h'] == pytest.approx(found['log']['end_h'], abs=0.05)
    assert set(found['processes']) == {'node', 'writer', 'controller'}
    for process in found['processes'].values():
        assert process['more_handles_and_threads'] == 0
        # a few states wait in queues of fixed length
        assert process['resident_mib'][1] - process['resident_mib'][0] < 16
