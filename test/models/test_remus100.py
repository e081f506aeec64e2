# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The REMUS 100: every published coefficient, however its parts are switched, and its motion."""

import numpy as np
import pytest

from test.support import remus_equations as equations
from test.support import remus_runs as remus
from test.support import vehicle_runs as runs
from test.support.remus_equations import PUBLISHED

SHARE = 0.005  # of the value, as promised
#: What the coefficient set alone has to give: his totals less the fins, less the added mass.
REST = '2 1 2 18.96 3 1 3 18.96 5 1 3 4.42 6 1 2 -4.42'
#: Name -> (changes of the model, added mass there, fins there).
SWITCHINGS = {
    'as it is': ({}, True, True),
    'added mass off': ({'added_mass': None}, False, True),
    'parts instead of totals': (
        {'cross_damping': REST, 'cross_damping_total': 'false'}, True, True
    ),
    'fins off': ({}, True, False),
    'added mass and fins off': ({'added_mass': None}, False, False),
}  # fmt: skip


@pytest.fixture(scope='module')
def simulation():
    return remus.variant({})


@pytest.mark.parametrize('name', [name for name in PUBLISHED if name != 'Xuu'])
def test_every_published_coefficient(simulation, name):
    assert remus.coefficient(simulation, name) == pytest.approx(PUBLISHED[name], rel=SHARE)


@pytest.mark.parametrize('case', SWITCHINGS)
@pytest.mark.parametrize(('name', 'sign'), [('Muw', 1), ('Nuv', -1)])
def test_the_moment_of_drift_is_24_however_its_parts_are_switched(case, name, sign):
    changes, added, fins = SWITCHINGS[case]
    measured = remus.coefficient(remus.variant(changes, fins=fins), name, added=added)
    expected = 24 if fins else 24 + 9.64 * 0.638  # without fins it has to be less stable
    assert measured == pytest.approx(sign * expected, rel=SHARE)


def test_straight_speed_at_the_published_thrust():
    measured = remus.straight_speed(3.86)
    assert measured == pytest.approx(equations.straight_speed(3.86), rel=SHARE)
    assert measured == pytest.approx(1.54, rel=SHARE)


@pytest.mark.parametrize('axis', [2, 5])
def test_free_decay_in_heave_and_yaw(axis):
    initial = 0.5  # [m/s] or [rad/s]
    times, measured = runs.decay('remus100', axis, initial, 6.0)
    expected = equations.decay(times, initial * np.eye(6)[axis])[:, axis]
    np.testing.assert_allclose(measured, expected, atol=SHARE * initial)
    assert abs(expected[-1]) < 0.5 * initial


def test_propeller_torque_and_roll():
    simulation = remus.variant({'volume': f'{remus.NEUTRAL:.12g}'})
    runs.set_all(simulation, 'remus100', 3.86)
    simulation.step(5000)  # ten time constants of the lag
    thrust, torque = simulation.data.actuator_force[:2]
    assert [thrust, torque] == pytest.approx([3.86, -0.543], rel=1e-3)
    assert simulation.data.qfrc_actuator[3] == pytest.approx(-0.543, rel=1e-3)
