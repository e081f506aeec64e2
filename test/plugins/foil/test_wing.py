# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A wing: the plugin against its numpy twin, limits of theory, Dickinson's fly wing."""

import mujoco
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics import foil
from fluid_sim_ros.plugins import native as nat
from test.support.foil_models import (
    AIR,
    DICKINSON,
    foil_world,
    generalized,
    in_flow,
    lift_drag,
    wing_params,
)
from test.support.plugin_models import explicit_force, load

WING = {
    'span': 1.2, 'chord': 0.2, 'lift_0': 0.25, 'drag_0': 0.01, 'pitch_0': -0.05,
    'efficiency': 0.9, 'reverse': 0.8, 'stall_angle': 0.3, 'stall_sharpness': 40,
    'lift_delta': 1.2, 'drag_delta': 0.05, 'pitch_delta': -0.4, 'panels': 5,
    'center_of_pressure': 'moving', 'velocity_point': 0.5,
}  # fmt: skip
AROUND = np.deg2rad(np.arange(-180, 181, 7.5))
ALPHAS = st.floats(-np.pi, np.pi)


@pytest.mark.parametrize('plate', ['newton', 'sine'])
@pytest.mark.parametrize('seed', range(4))
def test_wrench_is_the_twins(plate, seed):
    """Any attitude, site, spin and current; deflected by a hinge."""
    rng = np.random.default_rng(seed)
    current = rng.normal(size=3)
    values = {**WING, 'plate': plate}
    flap = '<body><joint name="flap" axis="0 1 0"/><geom size=".01" mass=".001"/></body>'
    model, data = load(
        foil_world(
            {**values, 'deflection': 'joint flap -0.5'}, site='pos=".1 -.2 .3" euler="20 -30 40"',
            medium={'density': 900, 'current': current}, inside=flap,
        )
    )  # fmt: skip
    data.qpos[3:7] = rng.normal(size=4)
    data.qpos[3:7] /= np.linalg.norm(data.qpos[3:7])
    data.qpos[7] = 0.3
    data.qvel[:6] = 2 * rng.normal(size=6)
    found = generalized(model, data)
    rotation, site = data.xmat[1].reshape(3, 3), data.site_xmat[0].reshape(3, 3)
    omega_w = rotation @ data.qvel[3:6]
    arm_w = data.site_xpos[0] - data.qpos[:3]
    v_w = data.qvel[:3] + np.cross(omega_w, arm_w) - current
    force, torque = foil.wing_wrench(
        wing_params(values), site.T @ v_w, site.T @ omega_w, density=900, deflection=-0.15
    )
    wanted = np.r_[site @ force, rotation.T @ (site @ torque + np.cross(arm_w, site @ force))]
    np.testing.assert_allclose(found, wanted, rtol=1e-10, atol=1e-10)
    np.testing.assert_array_equal(data.qfrc_fluid, data.qfrc_passive)
    np.testing.assert_allclose(explicit_force(model, data), data.qfrc_fluid, atol=1e-10)


# Each constant on its own: with it the wrench changes, and as the twin says.
ALONE = {
    'lift_0': 0.3, 'lift_slope': 3.0, 'section_slope': 5.0, 'aspect_ratio': 2.0, 'drag_0': 0.1,
    'pitch_0': 0.2, 'efficiency': 0.5, 'reverse': 0.5, 'plate_normal': 1.2, 'lift_delta': 2.0,
    'drag_delta': 0.3, 'pitch_delta': 0.5, 'stall_angle': 0.1, 'stall_sharpness': 20,
    'plate': 'sine', 'center_of_pressure': 'moving', 'velocity_point': 0.5, 'panels': 4,
    'area': 0.5,
}  # fmt: skip
BARE = {'span': 1.0, 'chord': 0.3}


@pytest.mark.parametrize('key', ALONE)
def test_each_constant_on_its_own(key):
    actuator = (
        '<actuator><general name="flap" site="wing" gear="0 0 0 0 0 0" dyntype="none" '
        'ctrllimited="true" ctrlrange="-.2 .2"/></actuator>'
    )
    wrenches = []
    for values in (BARE, {**BARE, key: ALONE[key]}):
        model, data = load(foil_world({**values, 'deflection': 'actuator flap'}, extra=actuator))
        twin = dict(values)
        if 'section_slope' in twin:
            slope = twin.pop('section_slope')
            twin['lift_slope'] = float(foil.helmbold_slope(1 / 0.3, slope))
        params = wing_params(twin)
        data.ctrl[0] = 0.3  # beyond the range: 0.2 counts
        rows = []
        for alpha in (0.1, 0.25, 1.0, 3.0):
            data.qvel[:3], data.qvel[3:] = in_flow(alpha, 3.0), [0.4, -0.7, 0.2]
            rows.append(generalized(model, data))
            wanted = foil.wing_wrench(
                params, data.qvel[:3], data.qvel[3:], density=AIR, deflection=0.2
            )
            np.testing.assert_allclose(rows[-1], np.r_[wanted], rtol=1e-11, atol=1e-12)
        wrenches.append(np.array(rows))
    assert np.max(np.abs(wrenches[1] - wrenches[0])) > 1e-3


@pytest.mark.parametrize('ratio', [1, 1.5, 2, 3, 4, 6, 8, 10])
def test_lift_slope_is_helmbolds(ratio):
    chord = 0.2
    model, data = load(foil_world({'span': ratio * chord, 'chord': chord}))
    small = 1e-3
    rows = lift_drag(model, data, [-small, small], ratio * chord**2)
    slope = (rows[1, 0] - rows[0, 0]) / (2 * small)
    helmbold = 2 * np.pi * ratio / (2 + np.sqrt(ratio**2 + 4))
    assert slope == pytest.approx(helmbold, rel=0.001)


def test_helmbold_at_both_ends():
    assert foil.helmbold_slope(1e6) == pytest.approx(2 * np.pi, rel=1e-5)
    assert foil.helmbold_slope(1e-3) == pytest.approx(np.pi * 1e-3 / 2, rel=1e-3)


def dickinson(alpha):
    degrees = np.rad2deg(alpha)
    lift = 0.225 + 1.58 * np.sin(np.deg2rad(2.13 * degrees - 7.2))
    return lift, 1.92 - 1.55 * np.cos(np.deg2rad(2.04 * degrees - 9.82))


def test_dickinsons_fly_wing():
    alphas = np.deg2rad(np.arange(0, 91, 1.0))
    model, data = load(foil_world({'span': 0.25, 'chord': 0.067, **DICKINSON}))
    rows = lift_drag(model, data, alphas, 0.25 * 0.067)
    for found, wanted in zip(rows.T, dickinson(alphas), strict=True):
        assert np.sqrt(np.mean((found - wanted) ** 2)) <= 0.1


@pytest.mark.parametrize(('plate', 'normal'), [('newton', 2.0), ('sine', 1.2)])
def test_flat_plate_limits(plate, normal):
    """Stalled: the force is normal to the plate; broadside it is all drag."""
    values = {'span': 2.0, 'chord': 0.5, 'plate': plate, 'plate_normal': normal}
    model, data = load(foil_world(values))
    for alpha in np.deg2rad([40, 60, 90, 120, 140, -50, -90, -130]):
        data.qvel[:3] = in_flow(alpha)
        force = generalized(model, data)[:3] / (0.5 * AIR * 1.0)
        power = 1 if plate == 'sine' else 2
        wanted = normal * np.sign(alpha) * np.abs(np.sin(alpha)) ** power
        np.testing.assert_allclose(force, [0, 0, wanted], atol=2e-3)
    data.qvel[:3] = in_flow(np.pi / 2)
    assert generalized(model, data)[2] == pytest.approx(normal * 0.5 * AIR, rel=1e-6)


def test_edge_on_a_plain_plate_feels_nothing():
    model, data = load(foil_world(BARE))
    for velocity in ([3, 0, 0], [-3, 0, 0], [0, 2, 0]):
        data.qvel[:3] = velocity
        np.testing.assert_allclose(generalized(model, data), 0, atol=1e-14)


@pytest.mark.parametrize('velocity', [0.0, 1e-200, 1e-12])
@pytest.mark.parametrize('axis', range(3))
def test_no_nan_at_zero_speed(velocity, axis):
    model, data = load(foil_world(WING))
    data.qvel[axis] = velocity
    found = generalized(model, data)
    assert np.isfinite(found).all()
    assert np.max(np.abs(found)) <= 10 * velocity


@pytest.mark.parametrize('angle', [0.02, 0.05, 0.1])
def test_reverse_flow(angle):
    """Seen from the trailing edge a thin plate is the same plate."""
    model, data = load(foil_world({**BARE, 'center_of_pressure': 'moving'}))
    data.qvel[:3] = in_flow(angle)
    ahead = generalized(model, data)
    data.qvel[:3] = in_flow(np.pi - angle)
    back = generalized(model, data)
    np.testing.assert_allclose(back[:3], ahead[:3] * [-1, 1, 1], rtol=1e-12, atol=1e-14)
    assert ahead[2] > 0  # the flow comes from below
    # quarter chord from the edge that leads: at the site, and half a chord behind it
    assert ahead[4] == pytest.approx(0, abs=1e-4 * ahead[2])
    assert back[4] == pytest.approx(0.15 * back[2], rel=1e-3)
    data.qvel[:3] = -in_flow(angle)  # going back along the same line: the flow is from above
    assert generalized(model, data)[2] < 0


def test_reverse_efficiency_and_camber():
    params = wing_params({**BARE, 'reverse': 0.7, 'lift_0': 0.3})
    forward = foil.wing_coefficients(params, 0.05)
    back = foil.wing_coefficients(params, np.pi - 0.05)
    assert forward.lift == pytest.approx(0.3 + params.slope * 0.05, rel=1e-4)
    # positive camber lifts the plate up in both flows: in reverse that is negative C_L
    assert back.lift == pytest.approx(-0.7 * (params.slope * 0.05 + 0.3), rel=1e-4)


@given(alpha=ALPHAS, deflection=st.floats(-0.5, 0.5))
def test_coefficients_are_bounded_and_drag_brakes(alpha, deflection):
    c = foil.wing_coefficients(wing_params(WING), alpha, deflection)
    assert np.isfinite(c).all()
    assert c.drag >= 0
    assert abs(c.lift) < 3
    assert 0 <= c.center <= 0.5


@given(alpha=ALPHAS)
def test_a_symmetric_wing_is_symmetric(alpha):
    wing = wing_params({**BARE, 'drag_0': 0.02, 'center_of_pressure': 'moving'})
    up, down = foil.wing_coefficients(wing, alpha), foil.wing_coefficients(wing, -alpha)
    np.testing.assert_allclose(
        [down.lift, down.drag, down.pitch, down.center],
        [-up.lift, up.drag, -up.pitch, up.center], atol=1e-12,
    )  # fmt: skip


@given(alpha=st.floats(-3.14, 3.14), step=st.floats(-1e-6, 1e-6))
def test_coefficients_are_continuous(alpha, step):
    """Also across 90 deg, where flow from ahead turns to flow from behind."""
    wing = wing_params(WING)
    near = foil.wing_coefficients(wing, np.array([alpha, alpha + step]))
    ninety = foil.wing_coefficients(wing, np.array([np.pi / 2 - 1e-9, np.pi / 2 + 1e-9]))
    for pair in (*near, *ninety):
        assert abs(pair[1] - pair[0]) < 1e-4


def test_around_the_clock_with_a_wing_of_one_panel():
    values = {**WING, 'panels': 1, 'velocity_point': 0}
    model, data = load(foil_world(values))
    rows = lift_drag(model, data, AROUND, 0.24)
    c = foil.wing_coefficients(wing_params(values), AROUND)
    np.testing.assert_allclose(rows, np.c_[c.lift, c.drag], atol=1e-12)


def test_rolling_is_damped_by_panels():
    def roll_damping(panels):
        model, data = load(foil_world({**BARE, 'panels': panels}))
        data.qvel[:] = [10, 0, 0, 0.5, 0, 0]
        return generalized(model, data)[3]

    assert roll_damping(1) == pytest.approx(0, abs=1e-12)
    # strip theory: -rho/2 V S a p b^2/12
    slope = float(foil.helmbold_slope(1 / 0.3))
    exact = -0.5 * AIR * 10 * 0.3 * slope * 0.5 / 12
    assert roll_damping(32) == pytest.approx(exact, rel=0.01)


def test_attached_share_is_beard_and_mclains():
    alpha = np.linspace(-1, 1, 41)
    m, a0 = 50.0, 0.47
    e1, e2 = np.exp(-m * (alpha - a0)), np.exp(m * (alpha + a0))
    sigma = (1 + e1 + e2) / ((1 + e1) * (1 + e2))
    np.testing.assert_allclose(foil.attached_share(alpha, a0, m), 1 - sigma, atol=1e-14)


def test_plate_law_names_its_powers():
    with pytest.raises(ConfigError, match='1, 2'):
        foil.plate_coefficients(0.1, power=3)


def test_foil_term_holds_the_whole_force():
    model, data = load(foil_world(WING, site='pos=".3 0 0"'))
    data.qvel[:] = [5, 0.3, -0.5, 0.1, 0.2, 0.3]
    row = np.zeros((1, nat.ROW_WIDTH))
    bases, scratch = np.array([1], dtype=np.int32), mujoco.MjData(model)
    nat.native().observe(
        model._address, data._address, scratch._address, bases.ctypes.data, 1, 2, row.ctypes.data
    )
    found = row[0][nat.term_columns('foil')]
    np.testing.assert_allclose(found, generalized(model, data), rtol=1e-12)
    np.testing.assert_array_equal(row[0][nat.TOTAL], found)
    for term in set(nat.TERMS) - {'foil'}:
        np.testing.assert_array_equal(row[0][nat.term_columns(term)], 0)
