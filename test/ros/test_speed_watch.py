# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Real-time pacing that does not keep its pace is reported, with what takes the time."""

import pytest

from test.support.ros_processes import Peer, node, wait_until

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]


def loop_of(peer):
    return peer.diagnostics.get('loop', (0, '', {}))


def test_a_real_time_factor_below_95_percent_is_a_warning_with_what_takes_the_time():
    """A thousand times real time is more than any machine does."""
    with Peer() as peer:
        peer.watch_diagnostics()
        with node(scene='rov', realtime__factor=1000.0) as process:
            wait_until(lambda: 'real-time factor' in loop_of(peer)[1], 'the warning')
        level, line, values = loop_of(peer)
        assert level == 1
        assert 'instead of 1000' in line and 'steps ' in line and '%' in line
        assert 0.2 < float(values['steps_share']) <= 1.0
        assert {'messages_share', 'commands_share', 'processor_share'} <= values.keys()
        assert 'instead of 1000' in process.output


def test_a_pace_that_is_kept_is_no_warning_nor_is_a_pause():
    with Peer() as peer:
        peer.watch_diagnostics()
        with node(scene='sphere', realtime__factor=0.2) as process:
            seen = []

            def seven():
                if loop_of(peer)[2].get('step') not in seen:
                    seen.append(loop_of(peer)[2].get('step'))
                return len(seen) > 4

            wait_until(seven, 'some diagnostics')
            assert loop_of(peer)[:2] == (0, 'running')
            assert 'real-time factor' not in process.output
