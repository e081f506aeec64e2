# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Every way to run a model gives the bits of a plain loop."""

import copy

import mujoco
import numpy as np
import pytest
from mujoco import rollout
from mujoco.batch import Batch

from test.support.plugin_models import load
from test.support.sea_models import sea_xml, start

STEPS = 60
INTEGRATORS = ('RK4', 'implicitfast', 'implicit', 'Euler', 'discrete')
FULL = mujoco.mjtState.mjSTATE_FULLPHYSICS


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
