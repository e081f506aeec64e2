"""Signals, noise and turbulence of fluid_sim.medium against their numpy twins."""

import mujoco
import numpy as np
import pytest
from mujoco import rollout
from scipy.interpolate import CubicHermiteSpline

from fluid_sim_ros.physics.environment.coloured_noise import (
    NoiseFilter,
    between_ticks,
    noise_samples,
    noise_stream,
)
from fluid_sim_ros.physics.environment.turbulence import turbulence_filters
from fluid_sim_ros.physics.environment.turbulence_scales import turbulence_intensity
from fluid_sim_ros.plugins.native import native
from test.support.plugin_models import (
    body_plugin,
    ellipsoid,
    explicit_force,
    free_body,
    load,
    refusal,
    world,
)

AIR = {'density': 1.2}
#: A body whose damping reads the flow: force = -(v - u) for unit coefficients.
PROBE = free_body(ellipsoid([0.3, 0.2, 0.1], 1e6) + body_plugin(linear_damping=[1, 1, 1, 0, 0, 0]))
DRYDEN = AIR | {
    'wind': [6, 0, 0], 'turbulence': 'dryden', 'turbulence_sigma': [1.5, 1.2, 0.8],
    'turbulence_length': [60, 50, 20], 'turbulence_airspeed': [12], 'seed': [5],
}  # fmt: skip


def flow(model, data, point=(0, 0, 0), body=1):
    """Return velocity, material derivative and spin of the flow at a point."""
    out, place = np.zeros(9), np.array(point, dtype=float)
    native().flow(model._address, data._address, body, place.ctypes.data, out.ctypes.data)
    return out[:3], out[3:6], out[6:]


def at(model, data, time):
    data.time = time
    return flow(model, data)


def weather(medium, **options):
    return load(world(PROBE, medium=medium, **options))


# ---- signals ------------------------------------------------------------------------------------


def test_ramp_sine_and_gust_have_their_values_and_derivatives():
    signals = 'ramp 2 0 0 1 4 sine 0 3 0 5 .7 gust 0 0 4 2 1.5 gust 1 0 0 3 2 1'
    model, data = weather(AIR | {'wind': [6, 0, 0], 'wind_signal': signals})
    for t in (0.0, 0.9, 1.3, 2.2, 3.1, 3.6, 4.9, 5.2, 6.4, 7.7, 8.5, 12.0):
        ramp = np.clip((t - 1) / 4, 0, 1)
        gust = (1 - np.cos(np.pi * np.clip((t - 2) / 1.5, 0, 1))) / 2
        rise, fall = np.clip((t - 3) / 2, 0, 1), np.clip((t - 6) / 2, 0, 1)
        pulse = (np.cos(np.pi * fall) - np.cos(np.pi * rise)) / 2
        expected = [6 + 2 * ramp + pulse, 3 * np.sin(2 * np.pi * t / 5 + 0.7), 4 * gust]
        velocity, rate, _ = at(model, data, t)
        np.testing.assert_allclose(velocity, expected, rtol=1e-14, atol=1e-14)
        difference = (at(model, data, t + 1e-6)[0] - at(model, data, t - 1e-6)[0]) / 2e-6
        np.testing.assert_allclose(rate, difference, rtol=1e-6, atol=1e-8)


def test_a_series_is_a_cubic_hermite_spline_with_held_ends():
    times = np.array([0.0, 0.7, 1.1, 2.5, 3.0])
    rows = np.random.default_rng(2).normal(size=(5, 3))
    words = np.column_stack([times, rows]).reshape(-1)
    model, data = weather(AIR | {'current_series': words})
    slopes = np.zeros((5, 3))
    for i in range(1, 4):  # the parabola through three rows
        coefficients = np.polyfit(times[i - 1 : i + 2] - times[i], rows[i - 1 : i + 2], 2)
        slopes[i] = coefficients[1]
    spline = CubicHermiteSpline(times, rows, slopes)
    for t in (0.0, 0.3, 0.7, 1.0, 1.9, 2.9):
        np.testing.assert_allclose(at(model, data, t)[0], spline(t), atol=1e-12)
        np.testing.assert_allclose(at(model, data, t)[1], spline.derivative()(t), atol=1e-11)
    for t, row in ((-1.0, rows[0]), (99.0, rows[-1])):
        np.testing.assert_array_equal(at(model, data, t)[0], row)
        assert not at(model, data, t)[1].any()


def test_a_signal_goes_with_the_profile():
    medium = AIR | {
        'wind': [6, 0, 0], 'wind_profile': 'power .5 10', 'wind_signal': 'ramp 0 2 0 0 4'
    }  # fmt: skip
    model, data = weather(medium)
    data.time = 2.0
    velocity, rate, _ = flow(model, data, [0, 0, 2.5])
    np.testing.assert_allclose(velocity, [3, 0.5, 0], rtol=1e-14)
    np.testing.assert_allclose(rate, [0, 0.25, 0], rtol=1e-14)


# ---- noise --------------------------------------------------------------------------------------


def rows_of(model, data, steps):
    out = []
    for _ in range(steps):
        out.append(np.concatenate(flow(model, data)))
        mujoco.mj_step(model, data)
    return np.array(out)


@pytest.mark.parametrize('kind', ['dryden', 'von_karman'])
@pytest.mark.parametrize('span', [None, 2.0])
def test_turbulence_is_that_of_the_numpy_twin(kind, span):
    medium = DRYDEN | {'turbulence': kind} | ({'turbulence_span': [span]} if span else {})
    model, data = weather(medium, timestep=0.004)
    model.body_mass[1] = 1e9
    outputs = 6 if span else 3
    samples = noise_samples(
        turbulence_filters(kind, [60, 50, 20], 12.0, span),
        outputs,
        0.01,
        5,
        noise_stream('hull'),
        90,
    )
    for k, row in enumerate(rows_of(model, data, 200)):
        value, rate = between_ticks(samples, 0.01, k * 0.004)
        sigma = np.array([1.5, 1.2, 0.8])
        np.testing.assert_allclose(row[:3], [6, 0, 0] + sigma * value[:3], atol=2e-10)
        np.testing.assert_allclose(row[3:6], sigma * rate[:3], atol=1e-7)
        if span:
            np.testing.assert_allclose(row[6:], np.array([0.8, 0.8, 1.2]) * value[3:], atol=2e-10)


def test_gauss_markov_is_that_of_the_numpy_twin():
    medium = {'density': 1000, 'current_gauss_markov': [0.3, 0.2, 0.1, 40], 'current_tick': [0.2]}
    model, data = weather(medium | {'seed': [11]}, timestep=0.05)
    model.body_mass[1] = 1e9
    one = [
        NoiseFilter(np.array([[-1 / 40]]), np.sqrt([2 / 40]), {i: np.array([sigma])})
        for i, sigma in enumerate((0.3, 0.2, 0.1))
    ]
    samples = noise_samples(one, 3, 0.2, 11, 0, 30)
    for k, row in enumerate(rows_of(model, data, 80)):
        value, rate = between_ticks(samples, 0.2, k * 0.05 + 1e-12)
        np.testing.assert_allclose(row[:3], value, atol=1e-10)
        np.testing.assert_allclose(row[3:6], rate, atol=1e-8)


@pytest.mark.parametrize('timestep', [0.001, 0.0025, 0.01, 0.02, 0.05])
def test_the_same_gusts_whatever_the_timestep(timestep):
    fine = weather(DRYDEN, timestep=0.0005)
    coarse = weather(DRYDEN, timestep=timestep)
    for model, data in (fine, coarse):
        model.body_mass[1] = 1e9
        mujoco.mj_step(model, data, round(0.5 / model.opt.timestep))
    a, b = (np.concatenate(at(*run, 0.5001)) for run in (fine, coarse))
    np.testing.assert_array_equal(a, b)


def test_another_vehicle_changes_nothing_for_the_first():
    alone = weather(DRYDEN)
    model, data = load(world(PROBE.replace('hull', 'other') + PROBE, medium=DRYDEN))
    mujoco.mj_forward(model, data)
    np.testing.assert_array_equal(flow(model, data, body=2)[0], flow(*alone)[0])


def test_vehicles_meet_gusts_of_their_own_and_static_bodies_none():
    bodies = PROBE + PROBE.replace('hull', 'other') + '<body name="mast"><geom size=".1"/></body>'
    model, data = load(world(bodies, medium=DRYDEN))
    mujoco.mj_forward(model, data)
    first, second, mast = (flow(model, data, body=i)[0] for i in (1, 2, 3))
    assert np.abs(first - second).min() > 1e-3
    np.testing.assert_array_equal(mast, [6, 0, 0])


def test_intensity_goes_with_the_height_and_its_gradient_with_the_vertical_wind():
    medium = {k: v for k, v in DRYDEN.items() if k != 'turbulence_sigma'}
    medium |= {'turbulence_wind_6m': [9], 'turbulence_ground': [-3]}
    model, data = weather(medium)
    unit = weather(medium | {'wind': [0, 0, 0]})
    for z in (2.0, 30.0, 280.0, 450.0, 3000.0):
        sigma, slope = turbulence_intensity(z + 3, 9.0)
        (u, du, _), (v, dv, _) = flow(model, data, [0, 0, z]), flow(*unit, [0, 0, z])
        xi = v / sigma
        np.testing.assert_allclose(u, np.add([6, 0, 0], v), rtol=1e-12)
        base = flow(*unit, [0, 0, 2.0])
        sigma_2 = turbulence_intensity(5.0, 9.0)[0]
        np.testing.assert_allclose(xi, base[0] / sigma_2, rtol=1e-11)
        # Du/Dt = sigma xi' + u_z sigma' xi
        slope_2 = turbulence_intensity(5.0, 9.0)[1]
        xi_rate = (base[1] - base[0][2] * slope_2 * xi) / sigma_2
        np.testing.assert_allclose(dv, sigma * xi_rate + v[2] * slope * xi, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(du, dv, rtol=1e-12)


def test_the_axis_is_the_mean_wind_or_a_stated_direction():
    along = weather(DRYDEN | {'wind': [0, 2, 0]})
    stated = weather(DRYDEN | {'wind': [0, 0, 0], 'turbulence_direction': [0, 1, 0]})
    x_axis = weather(DRYDEN | {'wind': [0, 0, 0]})
    u = flow(*x_axis)[0]
    np.testing.assert_allclose(flow(*along)[0], [-u[1], 2 + u[0], u[2]], atol=1e-14)
    np.testing.assert_allclose(flow(*stated)[0], [-u[1], u[0], u[2]], atol=1e-14)


def test_turbulence_with_a_span_rotates_the_air_about_the_vehicle():
    model, data = weather(DRYDEN | {'turbulence_span': [2.0]})
    data.qpos[:3] = [3, 1, 2]
    mujoco.mj_forward(model, data)
    u, _, spin = flow(model, data, [3, 1, 2])
    assert np.abs(spin).min() > 1e-4
    arm = np.array([0.3, -0.5, 0.2])
    np.testing.assert_allclose(
        flow(model, data, np.array([3, 1, 2]) + arm)[0], u + np.cross(spin, arm), rtol=1e-12
    )


def test_half_the_curl_of_a_shear_turns_a_body():
    """A free ball in u = (z, 0, 0): the flow turns with half the curl, (0, 1/2, 0)."""
    medium = AIR | {
        'wind': [10, 0, 0], 'wind_profile': 'table 0 0 10 1', 'rotational_gust': 'curl'
    }  # fmt: skip
    ball = free_body(
        ellipsoid([0.2] * 3, 500) + body_plugin(linear_damping=[1, 1, 1, 0.3, 0.3, 0.3])
    )
    model, data = load(world(ball, medium=medium))
    np.testing.assert_allclose(flow(model, data, [0, 0, 5])[2], [0, 0.5, 0], atol=1e-15)
    data.qpos[2] = 5
    np.testing.assert_allclose(explicit_force(model, data), [5, 0, 0, 0, 0.15, 0], atol=1e-14)
    data.qvel[:] = [5, 0, 0, 0, 0.5, 0]  # moves and turns with the air
    np.testing.assert_allclose(explicit_force(model, data), 0, atol=1e-14)


@pytest.mark.parametrize('shape', ['', 'fluidshape="ellipsoid" fluidcoef=".5 .3 1.2 0 0"'])
def test_stock_drag_sees_the_air_turn(shape):
    """At rest in turning air as turning the other way in air that does not."""
    body = free_body(f'<geom type="ellipsoid" size=".3 .2 .1" density="500" {shape}/>')
    option = 'density="1.2" viscosity="1.8e-5"'
    shear = {'wind': [10, 0, 0], 'wind_profile': 'table 0 0 10 1', 'rotational_gust': 'curl'}
    model, data = load(world(body, option=option, medium=shear))
    plain, turning = load(world(body, option=option + ' wind="5 0 0"'))
    for copy in (data, turning):
        copy.qpos[:] = [1, 2, 5, 0.8, 0, 0, 0.6]
    turning.qvel[3:] = [-0.5 * 0.96, -0.5 * 0.28, 0]  # (0, -1/2, 0) in the body's axes
    mujoco.mj_forward(model, data)
    mujoco.mj_forward(plain, turning)
    torque = turning.qfrc_fluid[3:].copy()
    if shape:  # less the convection of its added mass, which the turning air does not cause
        terms = np.zeros(plain.nv)
        turning.qvel[3:] *= -1
        mujoco.mj_forward(plain, turning)
        terms[3:] = (torque + turning.qfrc_fluid[3:]) / 2  # even in the rotation
        turning.qvel[3:] = 0
        mujoco.mj_forward(plain, turning)
        torque += turning.qfrc_fluid[3:] - terms[3:]
    np.testing.assert_allclose(data.qfrc_fluid[3:], torque, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(explicit_force(model, data), data.qfrc_fluid, rtol=1e-10)


# ---- state --------------------------------------------------------------------------------------


@pytest.mark.parametrize('integrator', ['RK4', 'implicitfast'])
def test_copies_saved_states_and_restarts_agree_to_the_bit(integrator):
    medium = DRYDEN | {'turbulence': 'von_karman', 'wind_gauss_markov': [1, 1, 1, 5]}
    model, data = weather(medium, integrator=integrator, timestep=0.003)
    start = data.plugin_state.copy()
    mujoco.mj_step(model, data, 100)
    copy = mujoco.MjData(model)
    mujoco.mj_copyState(model, data, copy, mujoco.mjtState.mjSTATE_INTEGRATION)
    for d in (data, copy):
        mujoco.mj_step(model, d, 100)
    np.testing.assert_array_equal(data.qpos, copy.qpos)
    np.testing.assert_array_equal(data.plugin_state, copy.plugin_state)
    end = data.qpos.copy()
    mujoco.mj_resetData(model, data)
    np.testing.assert_array_equal(data.plugin_state, start)
    mujoco.mj_step(model, data, 200)
    np.testing.assert_array_equal(data.qpos, end)


def test_a_rollout_is_the_same_flight():
    model, data = weather(DRYDEN, integrator='implicitfast', timestep=0.004)
    spec = mujoco.mjtState.mjSTATE_FULLPHYSICS
    start = np.empty(mujoco.mj_stateSize(model, spec))
    mujoco.mj_getState(model, data, start, spec)
    states, _ = rollout.rollout(model, data, start, nstep=150)
    mujoco.mj_resetData(model, data)
    mujoco.mj_step(model, data, 150)
    end = np.empty_like(start)
    mujoco.mj_getState(model, data, end, spec)
    np.testing.assert_array_equal(states[0, -1], end)


def test_time_set_back_gives_the_same_gusts_again():
    model, data = weather(DRYDEN)
    model.body_mass[1] = 1e9
    before = rows_of(model, data, 120)[:100]
    data.time = 0
    mujoco.mj_forward(model, data)
    mujoco.mj_step(model, data)  # the noise is drawn at the end of a step
    data.time = 0
    np.testing.assert_allclose(rows_of(model, data, 100)[2:, :3], before[2:, :3], atol=1e-12)


def test_a_seed_is_another_flight_and_can_be_set_again():
    model, data = weather(DRYDEN)
    other = weather(DRYDEN | {'seed': [6]})
    assert np.abs(flow(model, data)[0] - flow(*other)[0]).min() > 1e-3
    assert native().seed_medium(model._address, data._address, 6.0)
    np.testing.assert_array_equal(flow(model, data)[0], flow(*other)[0])


def test_switched_off_only_the_mean_is_left():
    model, data = weather(DRYDEN | {'wind_signal': 'ramp 0 5 0 0 1'})
    mujoco.mj_step(model, data, 50)
    assert native().enable_medium(model._address, data._address, 0)
    np.testing.assert_array_equal(flow(model, data)[0], [6, 0, 0])
    assert native().enable_medium(model._address, data._address, 1)
    assert flow(model, data)[0][1] > 1  # 2.5 and a gust


def test_turbulence_that_follows_goes_with_height_and_airspeed():
    """At the stated height and airspeed it is the same; faster, the gusts pass faster."""
    medium = {k: v for k, v in DRYDEN.items() if k != 'turbulence_length'}
    medium |= {'turbulence_height': [20], 'wind': [0, 0, 0]}
    fixed = weather(medium, timestep=0.01)
    steady = weather(medium | {'turbulence_follow': 'vehicle'}, timestep=0.01)
    fast = weather(medium | {'turbulence_follow': 'vehicle'}, timestep=0.01)
    for (model, data), speed in ((fixed, 12), (steady, 12), (fast, 48)):
        model.body_mass[1] = model.body_inertia[1] = 1e9
        data.qpos[2], data.qvel[0] = 20, speed
    u = [rows_of(*run, 1500)[:, 0] for run in (fixed, steady, fast)]
    np.testing.assert_allclose(u[1], u[0], atol=1e-6)  # damping takes 1e-8 of the speed
    assert np.diff(u[2][10:]).std() == pytest.approx(2 * np.diff(u[0][10:]).std(), rel=0.1)


# ---- forces -------------------------------------------------------------------------------------


def neutral(medium, **options):
    body = ellipsoid([0.3, 0.2, 0.1], 1000) + body_plugin(
        added_mass='auto', volume='auto', linear_damping=[3, 4, 5, 0.1, 0.1, 0.1]
    )
    return load(world(free_body(body), medium={'density': 1000} | medium, **options))


def test_a_neutral_body_reaches_the_velocity_of_the_current():
    model, data = neutral({'current': [0.4, -0.2, 0.1]}, timestep=0.05)
    mujoco.mj_step(model, data, 6000)
    np.testing.assert_allclose(data.qvel[:3], [0.4, -0.2, 0.1], atol=1e-9)


def test_a_neutral_body_at_the_velocity_of_a_gust_stays_with_it():
    """A uniform flow that changes in time accelerates body and fluid alike."""
    signal = 'gust .5 .2 0 .2 .6 .1 sine 0 0 .3 2 1.5707963267948966'
    model, data = neutral({'current_signal': signal}, timestep=0.005)
    data.qvel[:3] = flow(model, data)[0]
    for _ in range(300):
        mujoco.mj_step(model, data)
        np.testing.assert_allclose(data.qvel[:3], flow(model, data)[0], atol=1e-7)


def test_a_body_moving_with_the_current_feels_nothing():
    model, data = neutral({'current': [1.5, -0.7, 0.2]})
    data.qvel[:3] = [1.5, -0.7, 0.2]
    np.testing.assert_allclose(explicit_force(model, data), 0, atol=1e-9)


def test_motion_and_opposite_wind_give_the_same_wrench():
    moving, windy = neutral({'wind': [0, 0, 0]}), neutral({'wind': [-3, 1, -0.5]})
    moving[1].qvel[:3] = [3, -1, 0.5]
    np.testing.assert_allclose(explicit_force(*moving), explicit_force(*windy), rtol=1e-12)


def test_start_reset_and_seed_give_no_force_of_acceleration():
    """The pressure force rho V Du/Dt at the start is that of the gust's own slope."""
    body = free_body(ellipsoid([0.2] * 3, 500) + body_plugin(volume='auto'))
    model, data = load(world(body, medium=DRYDEN | {'density': 1000}))
    volume = 4 / 3 * np.pi * 0.008
    for action in (lambda: None, lambda: mujoco.mj_resetData(model, data),
                   lambda: native().seed_medium(model._address, data._address, 77.0)):  # fmt: skip
        action()
        expected = 1000 * volume * flow(model, data)[1]
        np.testing.assert_allclose(explicit_force(model, data)[:3], expected, rtol=1e-9)
        assert np.abs(expected).max() < 1000 * volume * 40


def test_rk4_keeps_its_order_in_turbulence_with_aligned_ticks():
    """Steps that divide the tick: each sees a smooth flow."""

    def final(timestep):
        medium = DRYDEN | {'turbulence_tick': [0.04]}
        body = free_body(
            ellipsoid([0.3, 0.2, 0.1], 1.2)
            + body_plugin(
                added_mass='auto', volume='auto', linear_damping=[0.05] * 3 + [0.001] * 3
            )
        )
        model, data = load(world(body, medium=medium, timestep=timestep))
        mujoco.mj_step(model, data, round(0.8 / timestep))
        return data.qpos[:3].copy()

    exact = final(0.04 / 128)
    errors = [np.linalg.norm(final(0.04 / n) - exact) for n in (8, 16, 32)]
    assert np.log2(errors[0] / errors[1]) > 3.9
    assert np.log2(errors[1] / errors[2]) > 3.9


# ---- bad input ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ('keys', 'words'),
    [
        ({'wind_signal': 'ramp 1 0 0 0 0'}, ['wind_signal', 'DURATION']),
        ({'wind_signal': 'gost 1 0 0 0 1'}, ['wind_signal', 'gost', 'gust']),
        ({'wind_signal': 'sine 1 0 0 5'}, ['wind_signal', 'PERIOD PHASE']),
        ({'wind_series': '0 1 0 0'}, ['wind_series', 'two or more rows']),
        ({'wind_series': '1 1 0 0 0 1 0 0'}, ['wind_series', 'rising']),
        ({'current_gauss_markov': '1 1 1 0'}, ['current_gauss_markov', 'TIME > 0']),
        ({'current_gauss_markov': '1 -1 1 3'}, ['current_gauss_markov', '>= 0']),
        ({'turbulence': 'dreyden'}, ['turbulence', 'dreyden', 'dryden, von_karman']),
        ({'turbulence': 'dryden'}, ['turbulence_airspeed']),
        (DRYDEN | {'turbulence_airspeed': [0]}, ['turbulence_airspeed', '> 0']),
        (DRYDEN | {'turbulence_length': '10 -3 2'}, ['turbulence_length', '> 0']),
        (DRYDEN | {'turbulence_sigma': '1 -3 2'}, ['turbulence_sigma', '>= 0']),
        (DRYDEN | {'turbulence_wind_6m': [3]}, ['either', 'turbulence_wind_6m']),
        (DRYDEN | {'turbulence_height': [3]}, ['either', 'turbulence_height']),
        (DRYDEN | {'turbulence_exceedance': '3e-2'}, ['turbulence_exceedance', '1e-2']),
        (DRYDEN | {'turbulence_direction': [0, 0, 1]}, ['turbulence_direction', 'vertical']),
        (DRYDEN | {'turbulence_follow': 'vehicle'}, ['turbulence_follow', 'turbulence_length']),
        (DRYDEN | {'turbulence_span': [1], 'rotational_gust': 'curl'}, ['curl', 'either']),
        ({'seed': [1.5]}, ['seed', 'whole']),
        ({'seed': [-1]}, ['seed', '>= 0']),
    ],
)
def test_bad_weather_is_refused_in_one_line(keys, words):
    line = refusal(world(PROBE, medium=AIR | keys), 'fluid_sim.medium')
    for word in words:
        assert word in line, line
