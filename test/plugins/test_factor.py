# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What a free body's own factoring leaves is what MuJoCo makes of the same matrix, to the bit."""

import mujoco
import numpy as np
import pytest

from test.support.plugin_models import body_plugin, ellipsoid, free_body, load, world
from test.support.strategies import positive_matrix

SEA = {'density': 1000, 'viscosity': 1e-3}


def bodies(seed):
    """Return three vehicles of all kinds, and a stock body whose block MuJoCo has factored."""
    full = positive_matrix(seed).ravel() if seed % 2 else np.diag(positive_matrix(seed))
    rows = (
        body_plugin(added_mass=full, reference_point=[0.1, -0.2, 0.05]),
        body_plugin(added_mass='auto', linear_damping=[4, 6, 5, 0.1, 0.2, 0.3]),
        body_plugin(added_mass='auto', volume='auto', drag='ellipsoid'),
    )
    shape = ellipsoid([0.25, 0.2, 0.15], 700)
    text = ''.join(
        free_body(shape + row, name=f'b{i}', position=(3 * i, 0, -2)) for i, row in enumerate(rows)
    )
    return text + free_body(shape, name='stock', position=(0, 5, 0))


@pytest.mark.parametrize('integrator', ['RK4', 'implicitfast', 'Euler'])
@pytest.mark.parametrize('seed', range(4))
def test_factors(integrator, seed):
    model, data = load(world(bodies(seed), integrator=integrator, medium=SEA))
    rng = np.random.default_rng(seed)
    data.qvel[:] = rng.normal(size=model.nv)
    for address in model.jnt_qposadr:
        data.qpos[address + 3 : address + 7] = rng.normal(size=4)
    model.dof_armature[:] = 0.01 * (seed > 1)
    mujoco.mj_forward(model, data)
    own = data.qLD.copy(), data.qLDiagInv.copy()
    mujoco.mj_factorM(model, data)
    assert own[0].tobytes() == data.qLD.tobytes()
    assert own[1].tobytes() == data.qLDiagInv.tobytes()


def test_a_nearly_singular_block_is_mended_and_said_by_mujoco():
    inside = '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'
    model, data = load(world(free_body(inside + body_plugin(added_mass=[1e-17] * 6))))
    model.body_mass[1], model.body_inertia[1] = 1e-16, 1e-16
    mujoco.mj_forward(model, data)
    whole = mujoco.MjData(model)
    mujoco.mj_copyData(whole, model, data)
    whole.warning[mujoco.mjtWarning.mjWARN_INERTIA].number = 0
    mujoco.mj_factorM(model, whole)
    for each in (data, whole):
        assert each.warning[mujoco.mjtWarning.mjWARN_INERTIA].number
    assert data.qLD.tobytes() == whole.qLD.tobytes()
