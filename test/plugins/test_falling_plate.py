"""The plugin's plate flutters below the transition and tumbles above it; stock never tumbles."""

import plugin_falling_plate as bench
import pytest


@pytest.mark.parametrize(('inertia', 'expected'), [(1.2, 'flutter'), (1.3, 'tumble')])
def test_transition_lies_between_1_2_and_1_3(inertia, expected):
    assert bench.regime(bench.fall(inertia, plugin=True)) == expected


def test_theory_has_it_there_too():
    assert bench.regime(bench.theory(1.2)) == 'flutter'
    assert bench.regime(bench.theory(1.24)) == 'tumble'


def test_stock_defaults_never_tumble():
    assert bench.regime(bench.fall(1.4, plugin=False)) == 'flutter'
