# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""NaN states, far times and lengths from a number: no read out of bounds, no endless loop."""

import time

import mujoco
import numpy as np
import pytest

from fluid_sim_ros.plugins.native import native
from test.support.plugin_models import body_plugin, ellipsoid, free_body, load, refusal, world

AIR = {'density': 1.2, 'viscosity': 1.8e-5}
TURBULENCE = {
    'turbulence': 'dryden', 'turbulence_wind_6m': 5, 'turbulence_height': 700,
    'turbulence_airspeed': 20, 'turbulence_span': 1,
}  # fmt: skip
GRID = '4 2 1 1 ' + ' '.join(['0 1 2 3', '0 5', '0', '0', *['1 2 3'] * 8])
WEATHER = {
    'table': {'wind_profile': 'table 0 0.1 10 1 50 2', 'wind': [5, 0, 0]},
    'power': {'wind_profile': 'power 0.14 10', 'wind': [5, 0, 0]},
    'series': {'wind_series': '0 1 2 3 5 2 3 4 9 0 0 1'},
    'signals': {'wind_signal': 'ramp 1 0 0 0 5 sine 0 1 0 3 0 gust 0 0 1 1 2 3'},
    'gauss markov': {'wind_gauss_markov': '1 1 1 5'},
    'dryden': TURBULENCE,
    'von karman high': TURBULENCE | {'turbulence': 'von_karman', 'turbulence_ground': -1500},
    'follows': TURBULENCE | {'turbulence_follow': 'vehicle'},
    'grid': {'wind_grid': 'flow'},
    'waves': {'surface': 0, 'density': 1000, 'density_above': 1.2, 'waves': 'jonswap 1 6',
              'wave_components': 8, 'wave_repeat': 2000},
}  # fmt: skip
ROTOR = (
    '<actuator><plugin name="T" plugin="fluid_sim.thruster" site="p" gear="0 0 1 0 0 0">'
    '<config key="curve" value="table"/><config key="command" value="pwm_us"/>'
    '<config key="table" value="t200"/><config key="voltage" value="16"/></plugin></actuator>'
)


def world_with(keys, integrator='implicitfast', timestep=0.002):
    medium = AIR | keys
    inside = ellipsoid((0.3, 0.2, 0.1), 100, (0.5, 0.25, 1.5, 1, 1)) + body_plugin(
        added_mass='auto', volume='auto', drag='ellipsoid', drag_reynolds='brown_lawler'
    )
    count = len(GRID.split())
    extra = f'<custom><numeric name="flow" size="{count}" data="{GRID}"/></custom>'
    xml = world(
        free_body(inside + '<site name="p"/>'), medium=medium, gravity=(0, 0, -9.81),
        extra=extra + ROTOR,
        integrator=integrator, timestep=timestep,
    )  # fmt: skip
    return xml.replace('</extension>', '<plugin plugin="fluid_sim.thruster"/></extension>')


def within(seconds, action):
    start = time.monotonic()
    action()
    assert time.monotonic() - start < seconds


BAD = [np.nan, np.inf, -np.inf, 1e308, -1e308, 1e30, -1e30, 1e17]


@pytest.mark.parametrize('name', WEATHER)
@pytest.mark.parametrize('integrator', ['RK4', 'implicitfast'])
def test_positions_velocities_and_times_that_are_no_numbers(name, integrator):
    """Evaluated where MuJoCo's own check of the state does not come first."""
    model, data = load(world_with(WEATHER[name], integrator))
    out, point = np.zeros(9), np.zeros(3)
    for bad in BAD:
        for spoiled in ('time', 'qpos', 'qvel', 'plugin_state', 'ctrl', 'all'):
            mujoco.mj_resetData(model, data)
            if spoiled in ('qpos', 'all'):
                data.qpos[:3] = bad
            if spoiled in ('qvel', 'all'):
                data.qvel[:] = bad
            if spoiled in ('time', 'all'):
                data.time = bad
            if spoiled in ('ctrl', 'all'):
                data.ctrl[:] = bad
            if spoiled in ('plugin_state', 'all'):
                data.plugin_state[:] = bad
            point[:] = bad if spoiled in ('qpos', 'all') else 0
            within(5, lambda: mujoco.mj_forward(model, data))
            native().flow(model._address, data._address, 1, point.ctypes.data, out.ctypes.data)
            native().seed_medium(model._address, data._address, 3.0)
    mujoco.mj_resetData(model, data)
    mujoco.mj_step(model, data, 5)
    assert np.isfinite(data.qvel).all()


@pytest.mark.parametrize('name', WEATHER)
@pytest.mark.parametrize('bad', BAD)
def test_stepping_from_a_time_that_is_no_number_ends(name, bad):
    model, data = load(world_with(WEATHER[name]))
    data.time = bad
    within(5, lambda: mujoco.mj_step(model, data, 3))


LENGTHS = {
    'time constant far above the tick': (
        {'wind_gauss_markov': '1 1 1 1e30'}, ['wind_gauss_markov', '1e30', '1e-6 to 1e9 ticks']
    ),
    'time constant far below the tick': (
        {'wind_gauss_markov': '1 1 1 1e-300'}, ['wind_gauss_markov', '1e-6 to 1e9 ticks']
    ),
    'tick far below the timestep': (
        {'current_gauss_markov': '1 1 1 5', 'current_tick': 1e-12},
        ['current_tick', 'thousandth of the timestep', '0.002'],
    ),
    'tick of the turbulence': (
        TURBULENCE | {'turbulence_tick': 1e-9}, ['turbulence_tick', 'thousandth']
    ),
    'length of the turbulence': (
        {k: v for k, v in TURBULENCE.items() if k != 'turbulence_height'}
        | {'turbulence_length': '1e30 1 1'}, ['turbulence_length', 'turbulence_airspeed']
    ),
    'airspeed of the turbulence': (
        TURBULENCE | {'turbulence_airspeed': 1e12}, ['turbulence_airspeed', '1e-6 to 1e9 ticks']
    ),
    'span of the turbulence': (
        TURBULENCE | {'turbulence_span': 1e15}, ['turbulence_span', '1e-6 to 1e9 ticks']
    ),
    'waves that have no length': (
        WEATHER['waves'] | {'waves': 'regular 1 1e300', 'water_depth': 10}, ['waves']
    ),
}  # fmt: skip


@pytest.mark.parametrize('case', LENGTHS)
def test_a_loop_whose_length_would_come_from_a_number_is_refused_at_once(case):
    keys, words = LENGTHS[case]
    keys = {k: v for k, v in keys.items()}
    if case == 'waves that have no length':
        keys.pop('wave_components'), keys.pop('wave_repeat')
    start = time.monotonic()
    line = refusal(world_with(keys), 'fluid_sim.medium')
    assert time.monotonic() - start < 2
    for word in words:
        assert word in line


@pytest.mark.parametrize('ticks', [1e-6, 1.0, 1e9])
def test_time_constants_at_the_ends_of_what_is_allowed_load_and_step(ticks):
    keys = {'wind_gauss_markov': f'1 1 1 {0.1 * ticks:.17g}', 'wind_tick': 0.1}
    model, data = load(world_with(keys))
    within(5, lambda: mujoco.mj_step(model, data, 200))
    assert np.isfinite(data.qvel).all()


def noise_at(model, data, when):
    out, point = np.zeros(9), np.zeros(3)
    data.time = when
    native().flow(model._address, data._address, 1, point.ctypes.data, out.ctypes.data)
    return out[:3].copy()


def test_a_far_time_is_a_sample_of_the_same_process_and_the_same_each_time():
    """Over more than a million ticks the noise starts anew there; nearer it is drawn in order."""
    model, data = load(world_with({'wind_gauss_markov': '1 1 1 5'}))
    far = np.array([noise_at(model, data, 1e6 + 50 * i) for i in range(400)])
    assert far.std() == pytest.approx(1, abs=0.1)
    assert (noise_at(model, data, 1e6) == far[0]).all()
    near = noise_at(model, data, 40.0)
    mujoco.mj_resetData(model, data)
    data.time = 40.0
    native().seed_medium(model._address, data._address, 0.0)
    assert (noise_at(model, data, 40.0) == near).all()


@pytest.mark.parametrize('size', ['1e-200 1e-200 1e-200', '1e-160 1 1', '1e160 1e160 1e160'])
def test_added_mass_of_sizes_that_doubles_do_not_carry_is_refused(size):
    geom = f'<geom type="ellipsoid" size="{size}" mass="1" fluidshape="ellipsoid"/>'
    inertia = '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'
    body = free_body(inertia + geom + body_plugin(added_mass='auto', drag='none'))
    line = refusal(world(body, medium=AIR), 'fluid_sim.body')
    assert 'added_mass' in line
    assert 'too unlike, too large or too small' in line
