"""Waves of fluid_sim.medium: the numpy twin's flow and surface, and what they do to bodies."""

import mujoco
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from fluid_sim_ros.physics.environment.wave_spectrum import jonswap_waves
from fluid_sim_ros.physics.environment.waves import Sea, regular_waves, wave_flow, wave_surface
from fluid_sim_ros.physics.free_surface import box_cut
from fluid_sim_ros.plugins.native import MEDIUM_VELOCITY, ROW_WIDTH, native
from test.support.plugin_models import (
    body_plugin,
    ellipsoid,
    explicit_force,
    free_body,
    kinetic_energy,
    load,
    world,
)

G = 9.81
LEVEL = 1.5  # of the surface, world z [m]
MEAN = np.array([0.0, 0.0, LEVEL])
BASE = {'density': 1000, 'surface': LEVEL}
PULL = [0, 0, -G]
CASES: dict[str, tuple[dict, Sea]] = {
    'deep': (
        {'waves': 'regular 1.2 5', 'wave_direction': [3, 4]},
        regular_waves(1.2, 5.0, [3.0, 4.0], gravity=G),
    ),
    'shallow': (
        {'waves': 'regular .4 4', 'wave_direction': [1, -2], 'water_depth': 3},
        regular_waves(0.4, 4.0, [1.0, -2.0], depth=3.0, gravity=G),
    ),
    'sea': (
        {'waves': 'jonswap 1 6', 'wave_seed': 7},
        jonswap_waves(1.0, 6.0, seed=7, gravity=G),
    ),
    'short-crested': (
        {
            'waves': 'jonswap 2 8 5', 'wave_spreading': 12, 'wave_seed': 2**53,
            'wave_components': 40, 'wave_repeat': 1200, 'wave_cutoff': 3, 'water_depth': 20,
            'wave_direction': [-1, 0.3],
        },
        jonswap_waves(
            2.0, 8.0, gamma=5.0, spreading=12, seed=2**53, components=40, repeat=1200.0,
            cutoff=3.0, depth=20.0, direction=[-1, 0.3], gravity=G,
        ),
    ),
}  # fmt: skip
VOLUME = 4 / 3 * np.pi * 0.1**3


def sea_model(bodies, waves, *, weight=True, **options):
    """Return a model in waves; without weight only the flow acts."""
    flag = '' if weight else 'gravity="disable"'
    medium = BASE | waves | options.pop('medium', {})
    return load(world(bodies, medium=medium, gravity=PULL, flag=flag, **options))


def sphere(density=1000, radius=0.1, **plugin):
    return free_body(ellipsoid([radius] * 3, density) + body_plugin(**plugin))


@pytest.mark.parametrize('name', CASES)
def test_the_flow_is_that_of_the_numpy_twin(name):
    """Velocity by a linear damping of 1 N s/m, Du/Dt by rho V Du/Dt, at points in the water."""
    waves, sea = CASES[name]
    felt = sphere(linear_damping=[1, 1, 1, 0, 0, 0])
    pushed = sphere(volume='auto')
    damped, pushed = (sea_model(body, waves, weight=False) for body in (felt, pushed))
    rng = np.random.default_rng(5)
    for point, time in zip(
        rng.uniform([-80, -80, -25], [80, 80, -1.2], (30, 3)),
        rng.uniform(0, 2000, 30),
        strict=True,
    ):
        flow = wave_flow(sea, point, time)
        for model, data in (damped, pushed):
            data.qpos[:3], data.time = point + MEAN, time
            force = explicit_force(model, data)[:3]
            expected = flow.velocity if model is damped[0] else 1000 * VOLUME * flow.acceleration
            np.testing.assert_allclose(force, expected, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize('name', CASES)
def test_current_and_waves_add_up_and_carry_each_other(name):
    """Du/Dt of the sum: the current carries the waves' gradient, and the waves the profile's."""
    waves, sea = CASES[name]
    current = {'current': [0.5, -0.3, 0], 'current_profile': 'table -30 0 0 1'}
    model, data = sea_model(sphere(volume='auto'), waves, weight=False, medium=current)
    point, time = np.array([4.0, 9.0, -2.0]), 33.0
    data.qpos[:3], data.time = point + MEAN, time
    flow = wave_flow(sea, point, time)
    velocity = flow.velocity + (1 - 2 / 30) * np.array([0.5, -0.3, 0])
    gradient = flow.gradient.copy()
    gradient[:, 2] += np.array([0.5, -0.3, 0]) / 30
    expected = 1000 * VOLUME * (flow.rate + gradient @ velocity)
    np.testing.assert_allclose(explicit_force(model, data)[:3], expected, rtol=1e-9, atol=1e-9)


def box_and_cut(sea, position, quat, time, half):
    """Return the numpy cut of a box by the tangent plane over its centre, and its normal."""
    surface = wave_surface(sea, position[:2], time)
    up = np.r_[-surface.slope, 1.0]
    up /= np.linalg.norm(up)
    rotation = np.zeros(9)
    mujoco.mju_quat2Mat(rotation, quat)
    rotation = rotation.reshape(3, 3)
    above = up[2] * (LEVEL + surface.height - position[2])
    return box_cut(half, rotation.T @ up, above), rotation


@pytest.mark.parametrize('name', CASES)
def test_buoyancy_of_a_box_cut_by_the_wave(name):
    """-rho V_wet (g - Du/Dt) at the centre of the part below the tangent plane."""
    waves, sea = CASES[name]
    half, quat = np.array([0.4, 0.3, 0.2]), np.array([0.9, 0.3, -0.2, 0.25])
    quat /= np.linalg.norm(quat)
    box = '<geom type="box" size=".4 .3 .2" density="400"/>'
    model, data = sea_model(free_body(box + body_plugin(volume='auto')), waves)
    for time in (0.0, 1.3, 3.9):
        place = np.array([2.0, -1.0, 0.0])
        place[2] = LEVEL + float(wave_surface(sea, place[:2], time).height) - 0.05
        data.qpos[:3], data.qpos[3:], data.time = place, quat, time
        cut, rotation = box_and_cut(sea, place, quat, time, half)
        flow = wave_flow(sea, place - MEAN, time)
        force = 1000 * cut.volume * (flow.acceleration - PULL)
        torque = np.cross(cut.center_b, rotation.T @ force)
        expected = np.r_[force, torque]
        np.testing.assert_allclose(explicit_force(model, data), expected, rtol=1e-9, atol=1e-9)


def test_the_wetted_share_changes_at_the_rate_that_slams():
    """-(ds/dt)+ A nu with ds/dt by difference along the motion; turning body, moving wave."""
    waves, sea = CASES['deep']
    half, mass = np.array([0.4, 0.3, 0.2]), 50.0
    box = '<geom type="box" size=".4 .3 .2" density="400"/>'
    plugin = body_plugin(added_mass=[mass] * 3 + [0] * 3)
    model, data = sea_model(free_body(box + plugin), waves)
    rng, seen = np.random.default_rng(6), 0
    for _ in range(20):
        time, place = rng.uniform(0, 5), np.r_[rng.uniform(-5, 5, 2), 0]
        quat, velocity = rng.normal(size=4), rng.normal(size=6)
        quat /= np.linalg.norm(quat)
        place[2] = (
            LEVEL + float(wave_surface(sea, place[:2], time).height) + rng.uniform(-0.1, 0.1)
        )

        def share(step, place=place, quat=quat, velocity=velocity, time=time):
            moved = quat.copy()
            mujoco.mju_quatIntegrate(moved, velocity[3:], step)
            cut, _ = box_and_cut(sea, place + step * velocity[:3], moved, time + step, half)
            return float(cut.volume) / (8 * half.prod())

        rate = (share(1e-6) - share(-1e-6)) / 2e-6
        data.qpos[:3], data.qpos[3:], data.qvel[:], data.time = place, quat, velocity, time
        level = place - MEAN
        top = float(wave_surface(sea, place[:2], time).height)
        flow = wave_flow(sea, np.r_[level[:2], min(level[2], top)], time)
        relative = velocity[:3] - flow.velocity
        # an isotropic A: its convective terms cancel, w x v against v x w
        pushed = mass * share(0) * flow.acceleration - mass * max(rate, 0) * relative
        np.testing.assert_allclose(
            explicit_force(model, data)[:3], pushed, rtol=1e-6, atol=1e-5 * mass
        )
        seen += rate > 0
    assert 5 <= seen <= 15


def test_the_force_on_a_small_held_sphere_is_one_and_a_half_froude_krylov():
    """(rho V + m_a) Du/Dt with m_a = rho V/2: amplitude 3/2 rho V a omega^2 e^kz."""
    model, data = sea_model(
        sphere(volume='auto', added_mass='auto'), CASES['deep'][0], weight=False
    )
    omega, k, z = 2 * np.pi / 5, (2 * np.pi / 5) ** 2 / G, -3.0
    data.qpos[:3] = [0, 0, z + LEVEL]
    push = 1.5 * 1000 * VOLUME * 0.6 * omega**2 * np.exp(k * z)
    steady = 1.5 * 1000 * VOLUME * k * (0.6 * omega * np.exp(k * z)) ** 2  # of (u.grad)u, upward
    for time in np.arange(16) / 16 * 5:
        data.time = time
        sine, cosine = np.sin(-omega * time), np.cos(-omega * time)
        # a held body's added mass also has its convective part: none for a sphere without spin
        expected = [0.6 * push * sine, 0.8 * push * sine, steady - push * cosine]
        np.testing.assert_allclose(explicit_force(model, data)[:3], expected, atol=1e-6 * push)


@pytest.mark.parametrize('name', ['deep', 'shallow', 'short-crested'])
def test_a_neutral_body_moves_with_the_water(name):
    """No drag: (rho V + A) Du/Dt = (m + A) a along the path of the water particle."""
    waves, sea = CASES[name]
    model, data = sea_model(
        sphere(volume='auto', added_mass='auto'), waves, timestep=0.02, weight=False
    )
    start = np.array([1.0, 2.0, -1.4])
    data.qpos[:3] = start + MEAN
    data.qvel[:3] = wave_flow(sea, start, 0.0).velocity
    path = solve_ivp(
        lambda t, x: wave_flow(sea, x, t).velocity, (0, 10), start,
        method='DOP853', rtol=1e-11, atol=1e-12,
    )  # fmt: skip
    mujoco.mj_step(model, data, 500)
    assert np.ptp(path.y[2]) > 0.1
    np.testing.assert_allclose(data.qpos[:3] - MEAN, path.y[:, -1], atol=1e-6)


def test_orbits_are_circles_of_the_textbook_radius():
    """Radius a e^kz, to first order in the steepness (here k a = 0.0016)."""
    waves = {'waves': 'regular .02 5'}
    k = (2 * np.pi / 5) ** 2 / G
    for z in (-1.0, -4.0):
        model, data = sea_model(
            sphere(volume='auto', added_mass='auto'), waves, timestep=0.05, weight=False
        )
        data.qpos[2] = z + LEVEL
        data.qvel[:3] = wave_flow(regular_waves(0.02, 5.0), [0, 0, z], 0.0).velocity
        path = []
        for _ in range(100):
            mujoco.mj_step(model, data)
            path.append(data.qpos[[0, 2]].copy())
        across = np.ptp(path, axis=0) / 2
        np.testing.assert_allclose(across, 0.01 * np.exp(k * z), rtol=4 * k * 0.01)


def test_a_floating_box_follows_long_waves():
    """Wave 156 m long, box 1 m: heave is the surface, pitch its slope, to first order."""
    box = '<geom type="box" size=".5 .5 .1" density="500"/>'
    plugin = body_plugin(
        volume='auto', added_mass=[10, 10, 80, 3, 3, 1],
        linear_damping=[0, 0, 300, 60, 60, 5],
    )  # fmt: skip
    sea = regular_waves(2.0, 10.0, [0.6, 0.8], gravity=G)
    model, data = sea_model(
        free_body(box + plugin), {'waves': 'regular 2 10', 'wave_direction': [0.6, 0.8]}
    )
    data.qpos[2] = LEVEL + 1.0
    data.qvel[:3] = wave_flow(sea, [0, 0, 1.0], 0.0).velocity
    heave, tilt, slopes = [], [], []
    for step in range(3000):
        mujoco.mj_step(model, data)
        if step < 1000:
            continue
        surface = wave_surface(sea, data.qpos[:2], data.time)
        rotation = data.xmat[1].reshape(3, 3)
        heave.append(data.qpos[2] - LEVEL - surface.height)
        tilt.append(-rotation[:2, 2] / rotation[2, 2])
        slopes.append(surface.slope)
    assert np.max(np.abs(heave)) < 0.012  # of 1 m
    assert np.max(np.abs(np.array(tilt) - slopes)) < 0.05 * np.max(np.abs(slopes))
    # it goes around with the water, 1 m to either side, and drifts as slowly (Stokes: 2.5 cm/s)
    assert np.hypot(*data.qpos[:2]) < 3


def test_order_of_convergence_in_a_sea():
    """RK4 keeps order 4 in waves: error against a fine step."""
    waves = {
        'waves': 'jonswap .5 3', 'wave_seed': 1, 'wave_components': 20, 'wave_spreading': 8,
    }  # fmt: skip
    hull = free_body(
        ellipsoid([0.3, 0.2, 0.1], 990) + body_plugin(volume='auto', added_mass='auto')
    )

    def end(timestep):
        model, data = sea_model(hull, waves, timestep=timestep)
        data.qpos[2], data.qvel[:] = LEVEL - 3, [0.3, 0, 0, 0.2, 0.5, -0.4]
        mujoco.mj_step(model, data, round(2 / timestep))
        return data.qpos.copy()

    reference = end(0.0025)
    errors = [np.linalg.norm(end(h) - reference) for h in (0.04, 0.02)]
    assert np.log2(errors[0] / errors[1]) >= 3.9


def test_the_motion_in_still_water_is_that_of_waves_of_no_height():
    box = '<geom type="box" size=".5 .5 .1" density="500"/>'
    bodies = free_body(box + body_plugin(volume='auto', linear_damping=[1] * 6))
    ends = []
    for waves in ({}, {'waves': 'none'}, {'waves': 'regular 0 5'}):
        model, data = sea_model(bodies, waves, weight=True)
        data.qpos[:], data.qvel[3:] = [0, 0, LEVEL + 0.05, 0.98, 0.1, 0.15, 0], [0.5, 0.2, 0.1]
        mujoco.mj_step(model, data, 200)
        ends.append(data.qpos.copy())
    np.testing.assert_array_equal(ends[1], ends[0])
    np.testing.assert_allclose(ends[2], ends[0], rtol=0, atol=1e-12)


def test_far_from_the_surface_a_body_is_wet_or_dry():
    """The short cut for bodies out of the waves' reach changes nothing that is felt."""
    waves, sea = CASES['short-crested']
    model, data = sea_model(sphere(volume='auto', added_mass='auto'), waves)
    reach = float(sea.amplitude.sum())
    for height, wet in [(-reach - 4, True), (reach + 4, False)]:
        data.qpos[2] = LEVEL + height
        lift = explicit_force(model, data)[2]
        flow = wave_flow(sea, [0, 0, height], 0.0)
        full = 1000 * VOLUME * (1.5 * flow.acceleration[2] + G)
        assert lift == pytest.approx(full if wet else 0.0, rel=1e-9, abs=1e-12)


def test_the_sum_of_the_terms_is_the_force_and_the_flow_has_energy():
    waves, _ = CASES['sea']
    model, data = sea_model(
        sphere(volume='auto', added_mass='auto', drag='ellipsoid'), waves, option=''
    )
    data.qpos[2] = LEVEL - 2
    mujoco.mj_forward(model, data)
    np.testing.assert_allclose(data.qfrc_fluid, explicit_force(model, data), rtol=1e-10)
    assert kinetic_energy(model, data)[1] > 0


def test_what_lies_under_a_crest_is_water_and_over_a_trough_air():
    """The medium that is published for a vehicle, between trough and crest."""
    medium = {
        'waves': 'regular 2 6', 'current': [0.4, 0, 0], 'wind': [0, 9, 0],
        'density_above': 1.2,
    }  # fmt: skip
    model, data = sea_model(sphere(volume='auto'), medium)
    scratch, bases = mujoco.MjData(model), np.array([1], dtype=np.int32)
    rows = np.zeros((1, ROW_WIDTH))
    for time, under in [(0.0, True), (3.0, False)]:
        data.qpos[2], data.time = LEVEL + 0.2 * (1 if under else -1), time
        native().observe(
            model._address, data._address, scratch._address, bases.ctypes.data, 1, 0,
            rows.ctypes.data,
        )  # fmt: skip
        velocity = rows[0, MEDIUM_VELOCITY]
        if under:
            expected = wave_flow(regular_waves(2, 6, gravity=G), [0, 0, 0.2], 0.0).velocity
            np.testing.assert_allclose(velocity, expected + np.array([0.4, 0, 0]), rtol=1e-12)
        else:
            np.testing.assert_allclose(velocity, [0, 9, 0])
