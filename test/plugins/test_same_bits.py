"""Every way to run a model gives the bits of a plain loop."""

import copy

import mujoco
import numpy as np
import pytest
from mujoco import rollout
from mujoco.batch import Batch
from plugin_common import body_plugin, ellipsoid, free_body, load, set_medium, world

SEA = {
    'density': 1025, 'viscosity': 1e-3, 'density_above': 1.2, 'viscosity_above': 1.8e-5,
    'surface': 0.1, 'current': [0.3, -0.1, 0.0], 'wind': [3, 1, 0],
    'turbulence': 'von_karman', 'turbulence_wind_6m': [3], 'turbulence_height': [5],
    'turbulence_airspeed': [3], 'turbulence_span': [0.5], 'turbulence_tick': [0.02],
    'wind_gauss_markov': [0.1, 0.1, 0, 5], 'current_signal': 'sine 0 .1 0 3 0',
    'waves': 'jonswap .3 3', 'wave_components': 8, 'wave_spreading': 10, 'water_depth': 5,
}  # fmt: skip
STEPS = 60
INTEGRATORS = ('RK4', 'implicitfast', 'implicit', 'Euler', 'discrete')
FULL = mujoco.mjtState.mjSTATE_FULLPHYSICS


def part(name, order):
    values = {
        'added_mass': 'auto', 'volume': 'auto', 'drag': 'ellipsoid',
        'quadratic_damping': [9, 8, 7, 1, 1, 1], 'reference_point': [0.02, 0, 0.01],
    }  # fmt: skip
    fin = (
        f'<body name="fin_{name}" pos="-.4 0 0"><joint name="j_{name}" axis="0 1 0"/>'
        f'{ellipsoid([0.1, 0.08, 0.01], 900, (0.5, 0.25, 1.5, 1, 1))}{body_plugin(**values)}'
        '</body>'
    )
    hull = ellipsoid([0.3, 0.2, 0.1], 800, (0.5, 0.25, 1.5, 1, 1)) + body_plugin(**values)
    return free_body(hull + (fin if order else ''), name=name, position=[2 * order, 0, 0.05])


def sea_xml(names='ab', integrator='implicitfast'):
    """Two vehicles, one with a fin and one alone, in any order of declaration."""
    bodies = ''.join(part(name, 'ab'.index(name)) for name in names)
    motor = '<actuator><motor joint="j_b"/></actuator>'
    return world(
        bodies, gravity=[0, 0, -9.81], medium=SEA, integrator=integrator, timestep=0.002,
        extra=motor,
    )  # fmt: skip


def start(model, data):
    rng = np.random.default_rng(4)
    for name in 'ab':
        joint = model.body(name).jntadr[0]
        data.qvel[model.jnt_dofadr[joint] :][:6] = rng.normal(size=6)
    set_medium(model, data, current=[1, 0, 0])
    data.ctrl[:] = 0.3


def state(model, data):
    out = np.zeros(mujoco.mj_stateSize(model, FULL))
    mujoco.mj_getState(model, data, out, FULL)
    return out


@pytest.fixture(scope='module', params=INTEGRATORS)
def plain(request):
    """Return the model, the start data and the states of a plain loop."""
    model, data = load(sea_xml(integrator=request.param))
    start(model, data)
    first = copy.copy(data)
    states = []
    for _ in range(STEPS):
        mujoco.mj_step(model, data)
        states.append(state(model, data))
    assert sum(warning.number for warning in data.warning) == 0  # no silent reset
    return model, first, np.array(states)


def run(model, data, steps=STEPS):
    for _ in range(steps):
        mujoco.mj_step(model, data)
    return state(model, data)


def test_reset_and_again(plain):
    model, _first, states = plain
    data = mujoco.MjData(model)
    start(model, data)
    run(model, data, 17)
    mujoco.mj_resetData(model, data)
    start(model, data)
    np.testing.assert_array_equal(run(model, data), states[-1])


def test_copies_in_mid_run(plain):
    model, first, states = plain
    data = copy.copy(first)
    run(model, data, 20)
    twin = copy.copy(data)
    other = mujoco.MjData(model)
    mujoco.mj_copyState(model, data, other, mujoco.mjtState.mjSTATE_INTEGRATION)
    for one in (data, twin, other):
        np.testing.assert_array_equal(run(model, one, STEPS - 20), states[-1])


def test_step_in_one_call_or_split(plain):
    model, first, states = plain
    data = copy.copy(first)
    mujoco.mj_step(model, data, STEPS)
    np.testing.assert_array_equal(state(model, data), states[-1])
    if model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4:
        return  # mj_step1 and mj_step2 are not for RK4
    data = copy.copy(first)
    for _ in range(STEPS):
        mujoco.mj_step1(model, data)
        mujoco.mj_step2(model, data)
    np.testing.assert_array_equal(state(model, data), states[-1])


@pytest.mark.parametrize('threads', [0, 3])
def test_rollout(plain, threads):
    model, first, states = plain
    count = 4
    initial = np.tile(state(model, first), (count, 1))
    control = np.full((count, STEPS, model.nu), 0.3)
    datas = [mujoco.MjData(model) for _ in range(max(threads, 1))]
    with rollout.Rollout(nthread=threads) as pool:
        for _ in range(2):
            result, _ = pool.rollout([model] * count, datas, initial, control)
            for i in range(count):
                np.testing.assert_array_equal(result[i], states)


@pytest.mark.parametrize('persistent', [False, True])
def test_batch(plain, persistent):
    model, first, states = plain
    batch = Batch(model, nsim=5, nthread=3, persistent=persistent)
    for field in ('qpos', 'qvel', 'ctrl', 'plugin_state'):
        batch.bind(field)[:] = getattr(first, field)
    for i in range(STEPS):
        batch.step()
        for simulation in range(batch.nsim):
            data = batch.get_data(simulation)
            np.testing.assert_array_equal(state(model, data), states[i])


def test_transition_derivatives_leave_the_run_alone(plain):
    model, first, states = plain
    if model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4:
        return  # MuJoCo refuses RK4 there
    data = copy.copy(first)
    run(model, data, 10)
    size = 2 * model.nv + model.na
    transition = np.zeros((2, size, size))
    for i in range(2):
        mujoco.mjd_transitionFD(model, data, 1e-6, True, transition[i], None, None, None)
    np.testing.assert_array_equal(transition[0], transition[1])
    np.testing.assert_array_equal(run(model, data, STEPS - 10), states[-1])


def test_two_models_in_one_process(plain):
    model, first, states = plain
    other, other_data = load(sea_xml('ba', integrator='Euler').replace('1025', '800'))
    start(other, other_data)
    data = copy.copy(first)
    for i in range(STEPS):
        mujoco.mj_step(model, data)
        mujoco.mj_step(other, other_data)
        np.testing.assert_array_equal(state(model, data), states[i])


def test_any_order_of_declaration(plain):
    model, _first, states = plain
    swapped, data = load(sea_xml('ba'))
    swapped.opt.integrator = model.opt.integrator
    start(swapped, data)
    run(swapped, data)
    reference = mujoco.MjData(model)
    mujoco.mj_setState(model, reference, states[-1], FULL)
    for name in 'ab':
        rows = []
        for one, values in ((model, reference), (swapped, data)):
            joint = one.body(name).jntadr[0]
            q, v = one.jnt_qposadr[joint], one.jnt_dofadr[joint]
            rows.append(np.r_[values.qpos[q + 2 : q + 7], values.qvel[v : v + 6]])
        np.testing.assert_array_equal(rows[0], rows[1])
