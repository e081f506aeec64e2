# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Where the plate begins to tumble: plugin, theory, theory with the plugin's drag, stock."""

import numpy as np
import pytest

from benchmarks.plugins import plugin_falling_plate as bench
from fluid_sim_ros.physics.falling_plate import PlateParams, falling_plate_rhs


def test_transition_of_the_plugin_lies_in_the_bounds():
    low, high = bench.BOUNDS
    assert bench.regime(bench.fall(low, plugin=True)) == 'flutter'
    assert bench.regime(bench.fall(high, plugin=True)) == 'tumble'


def test_transition_of_the_theory_is_the_published_one():
    found = bench.transition(bench.theory, 1.2, 1.24)
    assert found == pytest.approx(bench.PUBLISHED, abs=2e-3)


@pytest.mark.parametrize(('inertia', 'expected'), [(1.27, 'flutter'), (1.28, 'tumble')])
def test_the_plugin_gives_the_theory_with_its_own_drag_for_a_thin_plate(inertia, expected):
    """The mapping is exact but for the drag's shape and terms in the thickness."""
    thin = 0.002
    assert bench.regime(bench.theory_by_shadow(inertia, thin)) == expected
    assert bench.regime(bench.fall(inertia, plugin=True, beta=thin)) == expected


def test_the_plugin_follows_the_theory_with_its_own_drag_before_chaos():
    thin = 0.001
    plugin = bench.fall(1.1, plugin=True, beta=thin)
    theory = bench.theory_by_shadow(1.1, thin)
    early = slice(0, round(4 / bench.STEP / bench.KEPT))  # 4 a/U
    assert np.abs(plugin[early] - theory[early]).max() < 0.01
    assert np.ptp(theory[early], axis=0).min() > 0.1


def test_both_drags_agree_edge_on_and_broadside():
    params = PlateParams(1.3)
    for vx, vy in ((0.7, 0.0), (0.0, -0.7), (0.0, 0.0)):
        state = np.array([0, 0, 0.3, vx, vy, 0.4])
        np.testing.assert_allclose(
            bench.shadow_rhs(0.0, state, params, 0.0), falling_plate_rhs(0.0, state, params)
        )


@pytest.mark.parametrize('inertia', [0.5, 1.3, 2.0])
def test_stock_defaults_never_tumble(inertia):
    assert bench.turns(bench.fall(inertia, plugin=False)) < 0.5


def test_an_interval_without_a_transition_is_refused():
    with pytest.raises(RuntimeError, match=r'between 1\.3 and 1\.4'):
        bench.transition(bench.theory, 1.3, 1.4)
