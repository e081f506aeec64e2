"""Energy of bodies with large added mass, and the lagged method that the plugin replaces."""

import numpy as np
import plugin_stability as bench
import pytest
from plugin_common import FIRST_ORDER


@pytest.mark.parametrize('ratio', [0.0, 1.0, 10.0, 100.0])
def test_rk4_keeps_the_energy_without_drag(ratio):
    assert np.max(np.abs(bench.energies(ratio, 'RK4', 0.01, 60.0) - 1)) <= 1e-3


@pytest.mark.parametrize('integrator', FIRST_ORDER)
@pytest.mark.parametrize('ratio', [1.0, 10.0, 100.0])
def test_with_the_plugins_drag_energy_never_rises(integrator, ratio):
    energy = bench.energies(ratio, integrator, 0.01, 20.0, quadratic_damping=bench.DAMPING)
    assert energy.max() <= 1
    assert np.all(np.diff(energy) <= 0)


def test_a_first_order_integrator_without_drag_is_not_to_be_trusted(tmp_path, monkeypatch):
    """What the stability notes warn about: the energy of an undamped light body grows."""
    monkeypatch.chdir(tmp_path)  # MuJoCo writes its warning log there
    assert bench.energies(10.0, 'implicitfast', 0.01, 5.0).max() > 2


@pytest.mark.parametrize('timestep', [0.01, 0.001])
def test_the_lagged_method_diverges_once_the_added_mass_exceeds_the_mass(
    timestep, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    assert bench.lagged_steps(0.9, timestep, 400) == 400
    assert bench.lagged_steps(1.62, timestep, 400) < 100
