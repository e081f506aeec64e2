# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Models drawn from a grammar over all keys of the plugins load, and are stepped from any state.

The large volume, under sanitizers: ``benchmarks/robustness/valid_models.py``.
"""

import re
import time
from collections import Counter, defaultdict

import mujoco
import numpy as np
import pytest

from fluid_sim_ros.plugins.messages import load_error_line
from fluid_sim_ros.plugins.native import native
from test.support.hostile.models.grammar import (
    BODY,
    FOIL,
    MEDIUM,
    NOOP,
    THRUSTER,
    drawn_model,
)
from test.support.hostile.models.states import used
from test.support.paths import ROOT
from test.support.volumes import quick

SEEDS, STEPPED = 500, 120


@pytest.fixture(scope='module', autouse=True)
def _quiet():
    native()
    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(lambda _: None)
    yield
    mujoco.set_mju_user_warning(before)


@pytest.fixture(scope='module')
def drawn():
    return [drawn_model(seed) for seed in range(SEEDS)]


def test_the_grammar_has_every_plugin_of_the_library():
    sources = (ROOT / 'fluid_sim_ros' / 'plugins' / 'src').rglob('*.cc')
    headers = (ROOT / 'fluid_sim_ros' / 'plugins' / 'src').rglob('*.h')
    text = '\n'.join(path.read_text() for path in (*sources, *headers))
    assert set(re.findall(r'"(fluid_sim\.\w+)"', text)) == {BODY, MEDIUM, FOIL, THRUSTER, NOOP}


@pytest.mark.parametrize('plugin', [BODY, MEDIUM, FOIL, THRUSTER])
def test_every_key_of_each_plugin_occurs(plugin, drawn):
    """A new key that the grammar does not draw is missing here."""
    seen = Counter(key for model in drawn for key in model.keys[plugin])
    assert set(seen) == set(native().plugin_keys(plugin))
    assert min(seen.values()) >= 5


def test_drawn_models_load(drawn):
    refused = defaultdict(int)
    for model in drawn:
        try:
            mujoco.MjModel.from_xml_string(model.xml)
        except ValueError as error:
            refused[load_error_line(error)] += 1
    assert sum(refused.values()) <= 0.05 * SEEDS, dict(refused)


@pytest.mark.parametrize('first', quick(range(0, 10 * STEPPED, STEPPED), 0))
def test_drawn_models_are_stepped_from_any_state(first):
    """RK4 and implicitfast, from the start and from states and times that are no numbers."""
    finite = 0
    for seed in range(first, first + STEPPED):
        model = mujoco.MjModel.from_xml_string(drawn_model(seed).xml)
        start = time.process_time()
        finite += used(model, seed)
        assert time.process_time() - start < 10, seed
    assert finite > 0.6 * STEPPED  # the others have a number in them that throws them far away


def test_a_look_far_ahead_draws_a_bounded_number_of_ticks():
    """A state whose time is not that of its noise: every force would draw a million ticks."""
    weather = {
        'wind': '5 0 0', 'turbulence': 'von_karman', 'turbulence_airspeed': '20',
        'turbulence_wind_6m': '5', 'turbulence_height': '50', 'turbulence_span': '1',
        'turbulence_tick': '1e-5', 'density': '1.2',
    }  # fmt: skip
    keys = ''.join(f'<config key="{key}" value="{value}"/>' for key, value in weather.items())
    model = mujoco.MjModel.from_xml_string(f"""<mujoco><option timestep="0.002"/><extension>
<plugin plugin="fluid_sim.medium"><instance name="m">{keys}</instance></plugin></extension>
<worldbody><body><freejoint/><geom size=".1" mass="1" fluidshape="ellipsoid"/></body></worldbody>
</mujoco>""")
    data = mujoco.MjData(model)
    data.time = 9.9
    start = time.process_time()
    for _ in range(20):
        mujoco.mj_forward(model, data)
    assert time.process_time() - start < 5
    assert np.isfinite(data.qacc).all()
