# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Models with plugins: medium, terms, rungs of fluid."""

import numpy as np
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.errors import FluidSimError
from test.support.small_models import AMPHIBIOUS


def test_a_scene_with_a_surface_has_wind_and_current_with_limited_slew(buoy):
    assert buoy.streams == ('wind', 'current')
    buoy.set_current([1.1, 0, 0])
    buoy.set_wind([3, 0, 0])
    buoy.step(50)
    current = buoy.snapshot().vehicles['buoy'].medium_velocity_w[0]
    assert current == pytest.approx(0.1 + 0.1, abs=1e-12)  # 1 m/s^2 by default, 0.1 s
    buoy.reset()
    assert buoy.snapshot().vehicles['buoy'].medium_velocity_w[0] == 0.1


def test_a_plugin_scene_is_saved_and_loaded_bit_for_bit(buoy):
    buoy.set_current([1, 0.5, 0])
    buoy.step(30)
    state = buoy.save_state()
    buoy.step(100)
    expected = buoy.data.qpos.copy()
    buoy.reset()
    buoy.load_state(state)
    buoy.step(100)
    np.testing.assert_array_equal(buoy.data.qpos, expected)


def test_published_terms_of_a_plugin_body_hold_buoyancy_and_added_mass(buoy):
    buoy.step(10)
    terms = buoy.wrench('buoy')
    volume = 4 / 3 * np.pi * 0.3 * 0.2 * 0.1
    np.testing.assert_allclose(np.linalg.norm(terms['buoyancy'][0]), 1000 * volume * 9.81)
    assert terms['added_mass'][0][2] < 0  # it accelerates upward


@pytest.mark.parametrize(
    ('fluid', 'terms'), [('none', set()), ('ellipsoid', {'drag', 'viscous', 'added_mass'})]
)
def test_a_lower_rung_takes_the_plugins_away_and_keeps_the_body_afloat(tmp_path, fluid, terms):
    path = tmp_path / 'buoy.xml'
    path.write_text(AMPHIBIOUS)
    simulation = Simulation(path, fluid=fluid)
    assert simulation.model.nplugin == 0
    assert simulation.model.opt.density == (0 if fluid == 'none' else 1000)
    simulation.data.qvel[:6] = [0.3, 0.2, 0.1, 0.3, 0.1, 0.2]
    found = {name for name, (force, _) in simulation.wrench('buoy').items() if force.any()}
    assert terms <= found
    assert 'buoyancy' not in found
    before = simulation.data.qvel[2]
    simulation.step(1)
    if fluid == 'none':
        assert simulation.data.qvel[2] == pytest.approx(before, abs=1e-12)


@pytest.mark.parametrize('fluid', ['none', 'inertia', 'ellipsoid'])
def test_a_foil_on_a_body_goes_with_the_rung(tmp_path, fluid):
    path = tmp_path / 'glider.xml'
    path.write_text(
        '<mujoco><option density="1.2" viscosity="1.8e-5"/><extension>'
        '<plugin plugin="fluid_sim.foil"><instance name="wing"><config key="kind" value="wing"/>'
        '<config key="span" value="2"/><config key="chord" value=".3"/>'
        '<config key="stock_drag" value="keep"/></instance></plugin>'
        '</extension><worldbody><body name="glider" simple="false"><freejoint/>'
        '<geom type="box" size=".3 1 .01"/><plugin instance="wing"/></body></worldbody></mujoco>'
    )
    assert Simulation(path, fluid=fluid).model.nplugin == 0


def test_a_plugin_that_refuses_its_configuration_is_one_line(tmp_path):
    path = tmp_path / 'buoy.xml'
    path.write_text(AMPHIBIOUS.replace('key="volume" value="auto"', 'key="volume" value="-1"'))
    with pytest.raises(FluidSimError, match=r'buoy\.xml: fluid_sim\.body: .*volume') as caught:
        Simulation(path)
    assert '\n' not in str(caught.value)
