# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Where the forces go: axis, reaction, rotor inertia, drag, wind, the ground and the surface."""

import mujoco
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluid_sim_ros.physics import rotor_effects
from fluid_sim_ros.plugins import native as nat
from test.support.plugin_models import explicit_force, load
from test.support.thruster_models import AEROSONDE, X500, read, rotor_world, settle

ROTOR = {**X500, 'time_constant': 0}
TILT = np.deg2rad(30)
SITE = f'pos=".1 -.2 .05" euler="{np.rad2deg(TILT)} 0 0"'
DRAG = {'rotor_drag': [8.06e-5, 3e-5], 'rolling_moment': 1e-6}


def random_motion(model, data, seed=0):
    rng = np.random.default_rng(seed)
    data.qpos[3:7] = rng.normal(size=4)
    data.qpos[3:7] /= np.linalg.norm(data.qpos[3:7])
    data.qvel[:] = rng.normal(size=6)


@pytest.mark.parametrize('axis', ['0 0 1', '1 0 0', '0 -0.6 0.8'])
@pytest.mark.parametrize('spin', ['ccw', 'cw'])
def test_thrust_and_reaction_torque_act_at_the_site(axis, spin):
    model, data = load(rotor_world({**ROTOR, 'spin': spin}, axis=axis, site=SITE))
    load_now = settle(model, data, 500)
    thrust = 8.54858e-6 * 500**2
    assert load_now['thrust'] == pytest.approx(thrust, rel=1e-14)
    assert load_now['torque'] == pytest.approx(0.016 * thrust, rel=1e-14)
    rotation = data.site_xmat[0].reshape(3, 3)
    axis_b = rotation @ np.array(axis.split(), dtype=float)
    reaction = -0.016 * thrust * (1 if spin == 'ccw' else -1)
    wanted = np.r_[
        axis_b * thrust, np.cross([0.1, -0.2, 0.05], axis_b * thrust) + axis_b * reaction
    ]
    np.testing.assert_allclose(data.qfrc_actuator, wanted, atol=1e-14)


def test_reverse_turns_the_reaction_round():
    model, data = load(rotor_world({**ROTOR, 'rad_s_max': [1000, 1000]}))
    settle(model, data, 400)
    ahead = data.actuator_force.copy()
    settle(model, data, -400)
    np.testing.assert_array_equal(data.actuator_force, -ahead)


@pytest.mark.parametrize('spin', ['ccw', 'cw'])
def test_angular_momentum_of_body_and_rotor_is_kept(spin):
    """A free body in a vacuum with a rotor that speeds up and turns with it."""
    inertia = np.array([0.02, 0.03, 0.04])
    values = {
        **X500, 'spin': spin, 'rotor_inertia': 2e-4, 'torque_ratio': 0,
        'thrust_coefficient': 1e-30, 'time_constant': [0.3, 0.3],
    }  # fmt: skip
    sign = 1 if spin == 'ccw' else -1
    option = 'timestep=".002" integrator="RK4" gravity="0 0 0"'
    model, data = load(rotor_world(values, site='euler="40 0 0"', option=option))
    data.qvel[3:] = [1, -2, 0.5]
    data.ctrl[0] = 900

    def momentum():
        mujoco.mj_forward(model, data)
        axis = data.site_xmat[0].reshape(3, 3)[:, 2]
        body = data.xmat[1].reshape(3, 3) @ (inertia * data.qvel[3:])
        return body + 2e-4 * sign * read(model, data)['rad_s'] * axis

    start = momentum()
    mujoco.mj_step(model, data, 500)
    assert read(model, data)['rad_s'] > 800
    np.testing.assert_allclose(momentum(), start, atol=1e-9)


def test_gyroscopic_torque_is_the_twins_and_does_no_work():
    values = {**ROTOR, 'rotor_inertia': 2e-4, 'spin': 'cw'}
    model, data = load(rotor_world(values, site=SITE))
    random_motion(model, data)
    settle(model, data, 700)
    axis = np.array([0, -np.sin(TILT), np.cos(TILT)])
    wanted = rotor_effects.gyroscopic_torque(700, data.qvel[3:], axis, inertia=2e-4, spin=-1)
    np.testing.assert_allclose(data.qfrc_passive[3:], wanted, rtol=1e-10)
    np.testing.assert_allclose(data.qfrc_passive[:3], 0, atol=1e-15)
    np.testing.assert_array_equal(data.qfrc_fluid, 0)  # no force of the fluid
    assert abs(data.qfrc_passive @ data.qvel) < 1e-15


@pytest.mark.parametrize('omega', [0, 700])
@pytest.mark.parametrize('seed', range(3))
def test_rotor_drag_in_wind_is_the_twins(omega, seed):
    wind = np.array([3.0, -1, 0.5])
    medium = {'density': 1.2, 'wind': wind}
    model, data = load(rotor_world({**ROTOR, **DRAG, 'spin': 'cw'}, site=SITE, medium=medium))
    random_motion(model, data, seed)
    settle(model, data, omega)
    rotation = data.xmat[1].reshape(3, 3)
    arm = np.array([0.1, -0.2, 0.05])
    v = rotation.T @ (data.qvel[:3] - wind) + np.cross(data.qvel[3:], arm)
    axis = np.array([0, -np.sin(TILT), np.cos(TILT)])
    force, moment = rotor_effects.rotor_drag(
        omega, v, axis, across=8.06e-5, along=3e-5, rolling=1e-6, spin=-1
    )
    assert force @ v <= 0
    wanted = np.r_[rotation @ force, moment + np.cross(arm, force)]
    np.testing.assert_allclose(data.qfrc_passive, wanted, atol=1e-14)
    np.testing.assert_array_equal(data.qfrc_fluid, data.qfrc_passive)
    np.testing.assert_allclose(explicit_force(model, data), data.qfrc_fluid, atol=1e-14)
    assert read(model, data)['inflow'] == pytest.approx(v @ axis, rel=1e-12)


def test_rotor_drag_is_in_the_term_drag_and_thrust_is_apart():
    model, data = load(rotor_world({**ROTOR, **DRAG}, medium={'density': 1.2}))
    data.qvel[:3] = [2, 0, 1]
    data.ctrl[0] = 700
    row = np.zeros((1, nat.ROW_WIDTH))
    bases, scratch = np.array([1], dtype=np.int32), mujoco.MjData(model)
    nat.native().observe(
        model._address, data._address, scratch._address, bases.ctypes.data, 1, 2, row.ctypes.data
    )
    wanted = [-700 * 8.06e-5 * 2, 0, -700 * 3e-5]
    np.testing.assert_allclose(row[0][nat.term_columns('drag')][:3], wanted, rtol=1e-12)
    np.testing.assert_array_equal(row[0][nat.TOTAL], row[0][nat.term_columns('drag')])
    assert row[0][nat.THRUST][2] == pytest.approx(8.54858e-6 * 700**2, rel=1e-12)


@pytest.mark.parametrize('effect', ['cheeseman_bennett', 0.5])
def test_ground_effect(effect):
    radius = 0.2
    values = {**ROTOR, 'ground_effect': effect, 'ground': -3.0, 'diameter': 2 * radius}
    model, data = load(rotor_world(values))
    strength = None if effect == 'cheeseman_bennett' else effect
    far = 8.54858e-6 * 600**2
    for height in (0.01, 0.1, 0.2, 0.4, 1.0, 5.0):
        data.qpos[2] = height - 3
        factor = rotor_effects.ground_effect_factor(height, radius, strength)
        assert settle(model, data, 600)['thrust'] == pytest.approx(far * factor, rel=1e-12)
    assert rotor_effects.ground_effect_factor(radius, radius) == pytest.approx(16 / 15, rel=1e-14)
    data.qpos[2], data.qpos[3:7] = 0.3 - 3, [np.cos(0.5), np.sin(0.5), 0, 0]  # wake is longer
    factor = rotor_effects.ground_effect_factor(0.3 / np.cos(1), radius, strength)
    assert settle(model, data, 600)['thrust'] == pytest.approx(far * factor, rel=1e-12)
    data.qpos[3:7] = [0, 1, 0, 0]  # wake goes up
    assert settle(model, data, 600)['thrust'] == pytest.approx(far, rel=1e-12)


SEA = {
    'surface': 0.0, 'density': 1000, 'viscosity': 1e-3, 'density_above': 1.2,
    'viscosity_above': 1.8e-5, 'current': [0, 0, 0], 'wind': [5, 0, 0],
}  # fmt: skip


@pytest.mark.parametrize(('fluid', 'other'), [('water', 0), ('local', 1.2 / 1000)])
def test_propeller_leaves_the_water(fluid, other):
    values = {
        'curve': 'quadratic', 'thrust_coefficient': 4e-4, 'rad_s_max': [400, 400],
        'command': 'newton', 'fluid': fluid, 'diameter': 0.1,
    }  # fmt: skip
    if fluid == 'local':
        values['density'] = 1000
    model, data = load(rotor_world(values, axis='1 0 0', medium=SEA))
    for depth in (1.0, 0.04, 0.01, 0.0, -0.02, -0.05, -1.0):
        data.qpos[2] = -depth
        share = rotor_effects.disc_share(depth, 0.05, 0.0)
        wanted = 20 * (share + (1 - share) * other)
        assert settle(model, data, 20)['thrust'] == pytest.approx(wanted, rel=1e-12)


def test_rotor_of_the_air_does_nothing_in_the_water():
    model, data = load(rotor_world({**ROTOR, 'fluid': 'air', 'diameter': 0.2}, medium=SEA))
    for height, share in ((1, 1), (0, 0.5), (-1, 0)):
        data.qpos[2] = height
        found = settle(model, data, 500)
        assert found['thrust'] == pytest.approx(share * 8.54858e-6 * 500**2, rel=1e-12)
        assert found['torque'] == pytest.approx(0.016 * found['thrust'], rel=1e-12)


@given(depth=st.floats(-2, 2), axis_z=st.floats(-1, 1))
def test_share_of_a_disc(depth, axis_z):
    share = rotor_effects.disc_share(depth, 0.5, axis_z)
    assert 0 <= share <= 1
    assert share + rotor_effects.disc_share(-depth, 0.5, axis_z) == pytest.approx(1, abs=1e-12)
    if abs(depth) >= 0.5:
        assert share == (depth > 0)


def test_coefficients_take_the_density_of_their_fluid():
    free = {key: value for key, value in AEROSONDE.items() if key != 'density'}
    both = []
    for values, medium in (
        ({**AEROSONDE, 'density': 1000}, None),
        ({**free, 'fluid': 'local'}, {'density': 1000}),
    ):
        model, data = load(rotor_world(values, medium=medium))
        data.qvel[2] = 3
        both.append([settle(model, data, 300)[key] for key in ('thrust', 'torque')])
    assert both[0] == both[1]


def test_inflow_of_a_current_is_that_of_a_moving_rotor():
    model, data = load(rotor_world(AEROSONDE, medium={'density': 1.2682, 'current': [0, 0, -7]}))
    still = settle(model, data, 500)['thrust']
    model, data = load(rotor_world(AEROSONDE))
    data.qvel[2] = 7
    assert settle(model, data, 500)['thrust'] == pytest.approx(still, rel=1e-14)


def test_reading_other_actuators():
    extra = '<body><joint name="j"/><geom size=".1"/></body>'
    xml = rotor_world(ROTOR, extra=extra).replace('</actuator>', '<motor joint="j"/></actuator>')
    model, data = load(xml)
    out = np.zeros(6)
    kinds = [
        nat.native().thruster(model._address, data._address, i, out.ctypes.data)
        for i in (-1, 0, 1, 2, 3)
    ]
    assert kinds == [0, 1, 2, 0, 0]


def test_a_wave_covers_and_bares_a_propeller():
    """At the mean level: wet under the crest, half under the zero crossing, dry in the trough."""
    values = {
        'curve': 'quadratic', 'thrust_coefficient': 4e-4, 'rad_s_max': [400, 400],
        'command': 'newton', 'fluid': 'water', 'diameter': 0.1,
    }  # fmt: skip
    sea = SEA | {'waves': 'regular 1 6', 'wind': [0, 0, 0]}
    option = 'timestep="0.01" integrator="implicitfast" gravity="0 0 -9.81"'
    model, data = load(rotor_world(values, axis='1 0 0', medium=sea, option=option))
    for data.time, share in ((0.0, 1.0), (1.5, 0.5), (3.0, 0.0), (1.49, None)):
        if share is None:
            share = rotor_effects.disc_share(0.5 * np.cos(2 * np.pi * 1.49 / 6), 0.05, 0.0)
            assert 0.5 < share < 0.7
        assert settle(model, data, 20)['thrust'] == pytest.approx(20 * share, abs=1e-9)
