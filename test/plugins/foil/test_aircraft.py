# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The coefficient set of Beard and McLain: every derivative on its own, and its limits."""

import mujoco
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluid_sim_ros.physics.aircraft import AircraftParams, aircraft_wrench
from test.support.foil_models import AEROSONDE, AIR, foil_world, generalized, in_flow
from test.support.plugin_models import load

NAMES = {
    'lift': ('0', 'alpha', 'q', 'elevator'),
    'side': ('0', 'beta', 'p', 'r', 'aileron', 'rudder'),
}
SETS = {
    'lift': 'lift',
    'drag': 'lift',
    'pitch': 'lift',
    'side': 'side',
    'roll': 'side',
    'yaw': 'side',
}
DERIVATIVES = [(name, part) for name, kind in SETS.items() for part in NAMES[kind]]
SIZE = {'kind': 'aircraft', 'area': 0.55, 'span': 2.8956, 'chord': 0.18994}
SURFACES = {
    'aileron': 'actuator aileron', 'elevator': 'actuator elevator', 'rudder': 'actuator rudder',
}  # fmt: skip
CONTROLS = (
    '<actuator>'
    + ''.join(f'<general name="{name}" site="wing" gear="0 0 0 0 0 0"/>' for name in SURFACES)
    + '</actuator>'
)
DEFLECTION = np.array([0.1, -0.2, 0.15])
FLIGHT = (
    # velocity and spin, FLU: slow and straight, gliding, turning, beyond the stall, tail first
    ([20, 0, 0], [0, 0, 0]),
    ([25, 1.5, -2], [0.4, -0.3, 0.2]),
    ([22, -4, -3], [-1, 0.5, -0.7]),
    ([10, 1, -9], [0.3, 0.2, 0.1]),
    ([-12, 2, 1], [0.1, -0.4, 0.3]),
)  # fmt: skip


def twin(values):
    """Return the numpy twin's constants for configuration values."""
    sets = {
        name: tuple(values.get(f'{name}_{part}', 0.0) for part in NAMES[kind])
        for name, kind in SETS.items()
    }
    return AircraftParams(
        area=values['area'], span=values['span'], chord=values['chord'],
        efficiency=values.get('efficiency'), stall_angle=values.get('stall_angle', 0.26),
        stall_sharpness=values.get('stall_sharpness', 50), **sets,
    )  # fmt: skip


def wrenches(values):
    """Return the plugin's and the twin's wrenches over the flight conditions, shape (n, 6)."""
    model, data = load(foil_world({**values, **SURFACES}, extra=CONTROLS))
    data.ctrl[:] = DEFLECTION
    found, wanted = [], []
    for velocity, spin in FLIGHT:
        data.qvel[:] = [*velocity, *spin]
        found.append(generalized(model, data))
        wanted.append(
            np.r_[aircraft_wrench(
                twin(values), velocity, spin, density=AIR, deflection=DEFLECTION
            )]
        )  # fmt: skip
    return np.array(found), np.array(wanted)


@pytest.mark.parametrize(('name', 'part'), DERIVATIVES)
def test_every_derivative_on_its_own(name, part):
    """Against the twin, against the formula by hand, and it is not another one's value."""
    value = 0.37
    found, wanted = wrenches({**SIZE, f'{name}_{part}': value})
    np.testing.assert_allclose(found, wanted, rtol=1e-11, atol=1e-11)
    nothing, _ = wrenches(SIZE)
    difference = found[1] - nothing[1]  # gliding, well below the stall
    velocity, (wx, wy, wz) = np.array(FLIGHT[1][0]), FLIGHT[1][1]
    speed = np.linalg.norm(velocity)
    alpha = np.arctan2(-velocity[2], velocity[0])
    beta = np.arcsin(-velocity[1] / speed)
    b, c = SIZE['span'], SIZE['chord']
    arguments = {
        '0': 1, 'alpha': alpha, 'beta': beta, 'q': c * -wy / (2 * speed),
        'p': b * wx / (2 * speed), 'r': b * -wz / (2 * speed),
        'aileron': 0.1, 'elevator': -0.2, 'rudder': 0.15,
    }  # fmt: skip
    size = 0.5 * AIR * speed**2 * SIZE['area'] * value * arguments[part]
    axes = {
        'lift': [np.sin(alpha), 0, np.cos(alpha), 0, 0, 0],
        'drag': [-np.cos(alpha), 0, np.sin(alpha), 0, 0, 0],
        'side': [0, -1, 0, 0, 0, 0],
        'roll': [0, 0, 0, b, 0, 0],
        'pitch': [0, 0, 0, 0, -c, 0],
        'yaw': [0, 0, 0, 0, 0, -b],
    }
    np.testing.assert_allclose(difference, size * np.array(axes[name]), atol=1e-3 * abs(size) * b)
    assert np.max(np.abs(difference)) > 1e-3


@pytest.mark.parametrize('induced', [False, True])
def test_the_whole_set(induced):
    values = AEROSONDE | ({'efficiency': 0.9, 'drag_alpha': 0.0} if induced else {})
    found, wanted = wrenches(values)
    np.testing.assert_allclose(found, wanted, rtol=1e-11, atol=1e-10)


@pytest.mark.parametrize('key', ['efficiency', 'stall_angle', 'stall_sharpness', 'area'])
def test_other_constants_on_their_own(key):
    values = {**AEROSONDE, 'stall_sharpness': 30}
    changed = {**values, key: {'efficiency': 0.8, 'stall_angle': 0.3}.get(key, 40)}
    if key == 'area':
        changed[key] = 0.7
    found, wanted = wrenches(changed)
    np.testing.assert_allclose(found, wanted, rtol=1e-11, atol=1e-10)
    assert np.max(np.abs(found - wrenches(values)[0])) > 1e-6


def test_signs_for_the_pilot():
    """Elevator up (negative) raises the nose, right rudder (positive) goes right, roll right."""
    model, data = load(foil_world({**AEROSONDE, **SURFACES}, extra=CONTROLS))
    data.qvel[0] = 25
    still = generalized(model, data)

    def turn(surface, angle):
        data.ctrl[:] = 0
        data.ctrl[model.actuator(surface).id] = angle
        return (generalized(model, data) - still)[3:]

    assert turn('elevator', -0.1)[1] < 0  # FLU: nose up is negative about y
    assert turn('rudder', 0.1)[2] > 0  # yaw_rudder < 0: nose left, about +z
    assert turn('aileron', 0.1)[0] > 0  # right wing down, about +x


def test_weathercock_and_static_stability():
    model, data = load(foil_world(AEROSONDE))
    for direction in (1, -1):
        data.qvel[:3] = [25, 3 * direction, 0]  # flow from the left for +1
        assert generalized(model, data)[5] * direction > 0
        assert generalized(model, data)[1] * direction < 0
    data.qvel[:3] = in_flow(0.2, 25)
    up = generalized(model, data)[4]
    data.qvel[:3] = in_flow(0.0, 25)
    assert up > generalized(model, data)[4]  # nose down, against alpha


@pytest.mark.parametrize('axis', range(6))
@pytest.mark.parametrize('value', [0.0, 1e-200, 1e-12, -1e-12])
def test_no_nan_at_zero_speed(axis, value):
    model, data = load(foil_world(AEROSONDE))
    data.qvel[axis] = value
    found = generalized(model, data)
    assert np.isfinite(found).all()
    assert np.max(np.abs(found)) <= 100 * abs(value)


ANGLES = st.floats(-np.pi, np.pi)


@given(alpha=ANGLES, beta=st.floats(-1.5, 1.5))
def test_forces_stay_bounded_at_every_angle(alpha, beta):
    force, torque = aircraft_wrench(twin(AEROSONDE), in_flow(alpha, 1.0, beta), density=2 / 0.55)
    assert np.isfinite([*force, *torque]).all()
    assert np.max(np.abs(force)) < 4
    assert np.max(np.abs(torque)) < 4


@given(alpha=ANGLES)
def test_beyond_the_stall_it_is_a_plate(alpha):
    values = {**SIZE, 'lift_alpha': 5.61, 'drag_0': 0.043, 'stall_angle': 0.3}
    if abs(abs(alpha) - np.pi / 2) > 1.0:  # attached, or tail first along the body
        return
    force, _ = aircraft_wrench(twin(values), in_flow(alpha), density=2 / 0.55)
    v = in_flow(alpha)
    wanted = np.array([0, 0, 2 * np.sign(np.sin(alpha)) * np.sin(alpha) ** 2]) - 0.043 * v
    np.testing.assert_allclose(force, wanted, atol=1e-4)


def test_at_the_centre_of_mass_by_default():
    """On a body, without a site: axes of the body, point its centre of mass."""
    xml = foil_world({**AEROSONDE, 'site': ''})
    xml = xml.replace('<config key="site" value=""/>', '').replace(
        '<inertial pos="0 0 0"',
        '<plugin plugin="fluid_sim.foil" instance="foil"/><inertial pos=".3 0 .1"',
    )
    model, data = load(xml)
    data.qvel[:3] = in_flow(0.1, 20)
    found = generalized(model, data)
    force, torque = aircraft_wrench(twin(AEROSONDE), data.qvel[:3], density=AIR)
    np.testing.assert_allclose(found, np.r_[force, torque + np.cross([0.3, 0, 0.1], force)])


def test_a_steady_glide_is_the_one_of_the_polar():
    """Held at an angle, free to fall: terminal speed and path by the lift-to-drag ratio."""
    values = {**AEROSONDE, 'pitch_0': 0.0, 'pitch_alpha': 0.0}
    xml = foil_world(values, option='timestep=".01" integrator="RK4"')
    xml = xml.replace(
        '<freejoint/>', '<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/>'
    ).replace('mass="2"', 'mass="11"')
    model, data = load(xml)
    data.qvel[0] = 25
    mujoco.mj_step(model, data, 20000)
    speed = np.hypot(*data.qvel)
    alpha = np.arctan2(-data.qvel[1], data.qvel[0])
    lift, drag = 0.23 + 5.61 * alpha, 0.043 + 0.03 * alpha
    assert -data.qvel[1] / data.qvel[0] == pytest.approx(drag / lift, rel=1e-3)
    weight = 0.5 * AIR * speed**2 * 0.55 * np.hypot(lift, drag)
    assert weight == pytest.approx(11 * 9.81, rel=1e-3)
