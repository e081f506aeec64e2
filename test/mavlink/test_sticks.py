# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Sticks of a radio control become channels, and are lost when nobody holds them."""

import math

import pytest

from fluid_sim_ros.errors import CommandError
from fluid_sim_ros.mavlink import sticks as sticks_module
from fluid_sim_ros.mavlink.sticks import Sticks
from test.support.autopilots.autopilot_peers import BridgedFlight
from test.support.autopilots.px4_stand_in import Px4

IDLE = [0.0] * 4


def test_axes_come_first_then_buttons():
    sticks = Sticks((), 0.0)
    assert sticks.pulses() == ()
    sticks.move([0.0, 1.0, -0.5, 7.0], [0, 1])
    assert sticks.pulses() == (1500, 2000, 1250, 2000, 1000, 2000)


def test_the_mapping_speaks_until_somebody_moves_them():
    sticks = Sticks((1500, 1100), 0.5)
    assert sticks.pulses() == (1500, 1100)
    sticks.move([1.0], [])
    assert sticks.pulses() == (2000,)


def test_sticks_that_nobody_holds_are_a_lost_radio(monkeypatch):
    now = 100.0
    monkeypatch.setattr(sticks_module.time, 'monotonic', lambda: now)
    sticks = Sticks((1500,), 0.5)
    sticks.move([0.2], [])
    now += 0.4
    assert sticks.pulses() == (1600,)
    now += 0.2
    assert sticks.pulses() == ()
    assert (sticks.pulses(), sticks.lost) == ((), 1)
    sticks.move([0.4], [])  # the radio is back
    assert sticks.pulses() == (1700,)


@pytest.mark.parametrize(
    ('axes', 'buttons', 'line'),
    [
        ([], [], '0 axes and buttons; a radio control has 1 to 18'),
        ([0.0] * 12, [0] * 7, '19 axes and buttons'),
        ([0.0, math.nan], [], r'\[0.0, nan\] holds a value that is not finite'),
    ],
)
def test_what_is_no_radio_control_is_refused(axes, buttons, line):
    sticks = Sticks((1500,), 0.5)
    with pytest.raises(CommandError, match=line):
        sticks.move(axes, buttons)
    assert sticks.pulses() == (1500,)


def test_px4_gets_them_and_loses_them():
    with BridgedFlight('x500_ground', 'px4', sticks_timeout=0.2).running() as flight:
        px4 = Px4(flight.port, silent=0)

        def received(exchanges):
            px4.latest.pop('RC_CHANNELS', None)
            for _ in range(exchanges):
                px4.exchange(IDLE)
            return px4.latest.get('RC_CHANNELS')

        assert received(50) is None
        flight.bridge.set_sticks([0.5, -1.0], [1])
        sticks = received(50)
        assert sticks['chancount'] == 3
        assert [sticks[f'chan{i}_raw'] for i in range(1, 5)] == [1750, 1000, 2000, 65535]
        sticks_module.time.sleep(0.25)
        received(25)  # one may have been on its way
        assert received(50) is None
        assert flight.bridge.status().values['sticks_lost'] == 1


def test_ardupilot_takes_12_channels():
    flight = BridgedFlight('x500_ground', 'ardupilot')
    with pytest.raises(CommandError, match='13 axes and buttons; a radio control has 1 to 12'):
        flight.bridge.set_sticks([0.0] * 13, [])
    flight.bridge.set_sticks([0.0] * 12, [])
    flight.bridge.close()
