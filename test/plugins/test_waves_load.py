# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Keys of the waves: what a model refuses to load with, each with one line."""

import pytest

from test.support.plugin_models import body_plugin, ellipsoid, free_body, refusal, world

HULL = free_body(ellipsoid([0.3, 0.2, 0.1], 500) + body_plugin(volume='auto'))
SEA = {'density': 1000, 'surface': 0}
RANDOM = SEA | {'waves': 'jonswap 1 6'}
REGULAR = SEA | {'waves': 'regular 1 6'}
CASES = {
    'unknown word': (SEA | {'waves': 'stokes 1 6'}, ['waves', 'stokes', 'regular HEIGHT PERIOD']),
    'no period': (SEA | {'waves': 'regular 1'}, ['waves', "'regular 1'", 'PERIOD > 0']),
    'a word for a number': (SEA | {'waves': 'regular high 6'}, ['waves', 'high', 'HEIGHT >= 0']),
    'negative height': (SEA | {'waves': 'jonswap -1 6'}, ['waves', '-1 6', 'HEIGHT >= 0']),
    'zero period': (SEA | {'waves': 'regular 1 0'}, ['waves', 'PERIOD > 0']),
    'breaking': (SEA | {'waves': 'regular 1 2'}, ['waves', 'regular 1 2', 'HEIGHT up to 0.886']),
    'breaking in shallow water': (
        SEA | {'waves': 'jonswap 2 8', 'water_depth': 1}, ['HEIGHT up to 0.87', 'break']
    ),
    'gamma': (SEA | {'waves': 'jonswap 1 6 .5'}, ['waves', 'GAMMA 1 to 10']),
    'infinite': (SEA | {'waves': 'regular inf 6'}, ['waves', 'inf']),
    'no surface': ({'density': 1000, 'waves': 'regular 1 6'}, ['waves', 'give surface']),
    'without waves': (SEA | {'wave_seed': 3}, ['wave_seed without waves']),
    'depth without waves': (SEA | {'waves': 'none', 'water_depth': 3}, ['water_depth without']),
    'depth': (REGULAR | {'water_depth': 0}, ['water_depth', "'0'", '> 0 [m]']),
    'direction': (REGULAR | {'wave_direction': [0, 0]}, ['wave_direction', 'not both 0']),
    'direction in degrees': (REGULAR | {'wave_direction': 90}, ['wave_direction', 'x and y']),
    'seed of regular': (REGULAR | {'wave_seed': 3}, ['wave_seed with regular waves']),
    'spreading': (RANDOM | {'wave_spreading': -1}, ['wave_spreading', '0 (long-crested)']),
    'half a component': (RANDOM | {'wave_components': 8.5}, ['wave_components', 'whole number']),
    'no component': (RANDOM | {'wave_components': 0}, ['wave_components', '1 to 10000']),
    'cutoff': (RANDOM | {'wave_cutoff': 1}, ['wave_cutoff', '> 1']),
    'negative seed': (RANDOM | {'wave_seed': -1}, ['wave_seed', '0 to 2^53']),
    'half a seed': (RANDOM | {'wave_seed': 0.5}, ['wave_seed', 'whole number']),
    'short repeat': (RANDOM | {'wave_repeat': 60}, ['wave_repeat', "'60'", '>= 363.3', '[s]']),
    'many components': (
        RANDOM | {'wave_components': 1000}, ['wave_components', '1000', 'wave_repeat >= 5764.78']
    ),
}  # fmt: skip


@pytest.mark.parametrize('case', CASES)
def test_bad_waves_are_refused_with_one_line(case):
    medium, words = CASES[case]
    line = refusal(world(HULL, medium=medium, gravity=[0, 0, -9.81]), 'fluid_sim.medium')
    assert line.startswith('fluid_sim.medium: model: ')
    for word in words:
        assert word in line


@pytest.mark.parametrize('gravity', [[0, 0, 0], [0, 0, 9.81], [1, 0, -9.81]])
def test_waves_need_gravity_straight_down(gravity):
    line = refusal(world(HULL, medium=REGULAR, gravity=gravity), 'fluid_sim.medium')
    assert 'set opt gravity to 0 0 -g' in line
