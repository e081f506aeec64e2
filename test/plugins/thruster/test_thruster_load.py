# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What fluid_sim.thruster refuses when a model is loaded, each with one line."""

from pathlib import Path

import pytest

from fluid_sim_ros.plugins.native import native
from test.support.plugin_models import load, refusal
from test.support.thruster_models import AEROSONDE, T200, X500, rotor_world

ROTOR = {**X500, 'time_constant': 0}
SEA = {'surface': 0.0, 'density': 1000, 'density_above': 1.2}
TABLE = {'curve': 'table', 'command': 'pwm_us', 'thrust_coefficient': 1e-4}


def without(values, *keys):
    return {key: value for key, value in values.items() if key not in keys}


BAD = {
    # case: (values, what the line must name)
    'no curve': (without(ROTOR, 'curve'), ['curve is missing', 'quadratic', 'coefficients']),
    'unknown curve': ({**ROTOR, 'curve': 'cubic'}, ['cubic', 'polynomial, table, coefficients']),
    'unknown command': ({**ROTOR, 'command': 'volts'}, ['volts', 'newton, normalized, rad_s']),
    'no k': (without(ROTOR, 'thrust_coefficient'), ['thrust_coefficient is missing', 'N/(rad/s)']),
    'negative k': ({**ROTOR, 'thrust_coefficient': -1}, ['thrust_coefficient', "'-1'", '> 0']),
    'no limit': (without(ROTOR, 'rad_s_max'), ['rad_s_max is missing', 'rad/s']),
    'infinite limit': ({**ROTOR, 'rad_s_max': 'inf'}, ['rad_s_max', 'inf']),
    'falling polynomial': (
        {'curve': 'polynomial', 'polynomial_forward': [1, -1], 'rad_s_max': 2},
        ['polynomial_forward', 'rising'],
    ),
    'one-sided polynomial': (
        {'curve': 'polynomial', 'polynomial_forward': [1], 'rad_s_max': [2, 2]},
        ['polynomial_reverse', 'rad_s_max'],
    ),
    'voltage above the sheets': ({**T200, 'voltage': 22}, ['voltage', "'22'", '10..20 [V]']),
    'voltage below the sheets': ({**T200, 'voltage': 9.5}, ['voltage', "'9.5'", '10..20 [V]']),
    'unknown table': ({**TABLE, 'table': 't500'}, ['table', 't500', 't200']),
    'odd table': ({**TABLE, 'table': [1500, 0, 1900]}, ['table', 'pairs']),
    'table not rising in pulse': (
        {**TABLE, 'table': [1500, 0, 1900, 5, 1800, 6]}, ['table', 'pulse rising', 'pair 3']
    ),
    'table falling in thrust': (
        {**TABLE, 'table': [1500, 0, 1700, 5, 1800, 4]}, ['table', 'not falling', 'pair 3']
    ),
    'table not zero at neutral': (
        {**TABLE, 'table': [1100, -5, 1900, 6]}, ['table', 'zero at 1500 us']
    ),
    'table without k': (
        {'curve': 'table', 'table': [1500, 0, 1900, 5]}, ['thrust_coefficient is missing']
    ),
    'table and limit': ({**T200, 'rad_s_max': 3}, ['rad_s_max', 'table']),
    'key of another curve': (
        {**ROTOR, 'torque_coefficients': 1}, ['torque_coefficients', 'curve']
    ),
    'four coefficients': (
        {**AEROSONDE, 'thrust_coefficients': [1, 2, 3, 4]}, ['thrust_coefficients', 'got 4']
    ),
    'no diameter': (without(AEROSONDE, 'diameter'), ['diameter is missing', '[m]']),
    'no density': (without(AEROSONDE, 'density'), ['density', '[kg/m^3]']),
    'density without use': ({**ROTOR, 'density': 1}, ['density needs', 'local']),
    'negative lag': ({**ROTOR, 'time_constant': -1}, ['time_constant', '>= 0 [s]']),
    'unknown spin': ({**ROTOR, 'spin': 'left'}, ['spin', 'left', 'ccw, cw']),
    'bad pulses': (
        {**ROTOR, 'pwm_range': [2000, 1500, 1000]}, ['pwm_range', 'rising', '[us]']
    ),
    'dead zone outside': ({**ROTOR, 'dead_zone': [900, 1100]}, ['dead_zone', 'within pwm_range']),
    'ground without effect': ({**ROTOR, 'ground': 0}, ['ground needs ground_effect']),
    'ground effect without size': (
        {**ROTOR, 'ground_effect': 'cheeseman_bennett'}, ['diameter is missing']
    ),
    'unknown ground effect': ({**ROTOR, 'ground_effect': 'big'}, ['ground_effect', 'big']),
    'unknown fluid': ({**ROTOR, 'fluid': 'oil'}, ['fluid', 'oil', 'constant, local, water, air']),
    'water without surface': ({**ROTOR, 'fluid': 'water', 'diameter': 1}, ['fluid', 'surface']),
}  # fmt: skip


def line_of(xml):
    return refusal(xml, 'fluid_sim.thruster: ')


@pytest.mark.parametrize('case', BAD)
def test_bad_values_are_refused_with_one_line(case):
    values, words = BAD[case]
    line = line_of(rotor_world(values))
    assert line.startswith("fluid_sim.thruster: actuator 'thrust': ")
    for word in words:
        assert word in line


def test_share_of_the_disc_needs_its_size():
    assert 'diameter is missing' in line_of(rotor_world({**ROTOR, 'fluid': 'air'}, medium=SEA))


def test_actuators():
    good = rotor_world(X500)
    load(good)
    assert 'add a second one' in line_of(rotor_world(X500, torque=False))
    assert 'no torque' in line_of(rotor_world({**X500, 'torque_ratio': 0}, torque=True))
    assert 'actdim="2"' in line_of(good.replace('actdim="2"', ''))
    assert 'time_constant > 0' in line_of(rotor_world(ROTOR, actuator='actdim="2"'))
    assert 'wrong gear' in line_of(good.replace('gear="0 0 1 0 0 0"', 'gear="0 0 2 0 0 0"'))
    assert 'wrong gear' in line_of(good.replace('gear="0 0 1 0 0 0"', 'gear="0 0 .5 0 0 .5"'))
    assert 'about the thrust' in line_of(good.replace('gear="0 0 0 0 0 1"', 'gear="0 0 0 0 1 0"'))
    only = good.replace('name="thrust" gear="0 0 1 0 0 0"', 'gear="0 0 0 0 0 1"', 1)
    assert 'drives another actuator' in line_of(only)
    assert 'delay' in line_of(rotor_world(X500, actuator='delay=".02" nsample="2"'))


def test_a_thruster_needs_a_site():
    xml = rotor_world(ROTOR, torque=False).replace(
        '<freejoint/>', '<joint name="j" type="slide"/>'
    )
    line = line_of(xml.replace('site="rotor"', 'joint="j"'))
    assert 'acts at a site' in line


def test_an_instance_without_actuators():
    xml = rotor_world(ROTOR)
    line = line_of(xml[: xml.index('<actuator>')] + '</mujoco>')
    assert "instance 't'" in line
    assert 'no actuator gives thrust' in line


def test_unknown_key():
    line = line_of(rotor_world({**ROTOR, 'trust': 1}))
    assert "unknown key 'trust'" in line
    assert 'thrust_coefficient' in line


def test_every_key_is_documented():
    page = (Path(__file__).parents[3] / 'doc' / 'thruster.md').read_text(encoding='utf-8')
    for key in native().plugin_keys('fluid_sim.thruster'):
        assert f'| `{key}` |' in page
