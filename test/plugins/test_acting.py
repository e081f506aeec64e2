# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The terms that can act on a body, against the wrenches that it feels in random motions."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.plugins.acting import acting_terms, terms_together
from test.support.paths import ROOT
from test.support.plugin_models import body_plugin, ellipsoid, free_body, load, world

MODELS = sorted(path.stem for path in (ROOT / 'models').glob('*.xml'))
DOWN = (0, 0, -9.81)
SEA = {'density': 1000, 'viscosity': 1e-3}
COEF = (0.5, 0.25, 1.5, 1.0, 1.0)


@pytest.fixture
def rng():
    return np.random.default_rng(5)


def felt(model, body, rng, samples=60):
    """Return the terms that act on a body's subtree in random states of motion."""
    data, scratch = mujoco.MjData(model), mujoco.MjData(model)
    row, bases = np.zeros((1, nat.ROW_WIDTH)), np.array([body], dtype=np.int32)
    found = set()
    for _ in range(samples):
        mujoco.mj_resetData(model, data)
        data.qvel[:] = rng.normal(0, 3, model.nv)
        for joint in range(model.njnt):
            if model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_FREE:
                start = model.jnt_qposadr[joint]
                data.qpos[start : start + 3] += rng.normal(0, 0.3, 3)
                data.qpos[start + 3 : start + 7] = rng.normal(size=4)
        data.ctrl[:] = model.actuator_ctrlrange[:, 1]
        data.act[:] = 1000
        nat.native().observe(
            model._address, data._address, scratch._address, bases.ctypes.data, 1, 2,
            row.ctypes.data,
        )  # fmt: skip
        size = {term: np.abs(row[0][nat.term_columns(term)]).max() for term in nat.TERMS}
        rounding = 1e-12 * max(size.values())
        found |= {term for term in size if size[term] > rounding}
    return found


@pytest.mark.parametrize('name', MODELS)
def test_terms_that_can_act_are_those_that_act_in_some_motion(name, rng):
    nat.native()
    model = mujoco.MjModel.from_xml_path(str(ROOT / 'models' / f'{name}.xml'))
    for root in range(1, model.nbody):
        if model.body_parentid[root] or not model.body_dofnum[root]:
            continue
        tree = [body for body in range(model.nbody) if model.body_rootid[body] == root]
        assert set(terms_together(acting_terms(model, tree))) == felt(model, root, rng)


def hull(coef=COEF, size=(0.3, 0.2, 0.1), **keys):
    return free_body(ellipsoid(size, 1000, coef) + (body_plugin(**keys) if keys else ''))


CASES = {
    'added mass of numbers needs no density': (
        world(hull(added_mass=[1, 2, 3, 0, 0, 0], drag='none')),
        ('added_mass',),
    ),
    'added mass of zeros': (
        world(
            hull(added_mass=[0] * 6, drag='none', volume='auto'), gravity=DOWN, medium=SEA
        ),
        ('buoyancy',),
    ),
    'damping of zeros is none': (
        world(
            hull(linear_damping=[0] * 6, drag='none', volume='auto'), gravity=DOWN, medium=SEA
        ),
        ('buoyancy',),
    ),
    'ellipsoid in a medium': (
        world(hull(drag='ellipsoid'), medium=SEA),
        ('drag', 'viscous', 'magnus', 'kutta'),
    ),
    'a sphere has no Kutta lift': (
        world(hull(drag='ellipsoid', size=(0.2, 0.2, 0.2)), medium=SEA),
        ('drag', 'viscous', 'magnus'),
    ),
    'coefficients of 0': (
        world(hull(drag='ellipsoid', coef=(0, 0, 0, 0, 0)), medium=SEA),
        ('viscous',),
    ),
    'fluid without viscosity': (
        world(hull(drag='ellipsoid', coef=(0.5, 0, 0, 0, 0)), medium={'density': 1000}),
        ('drag',),
    ),
    'density of the air alone': (
        world(
            hull(drag='ellipsoid', coef=(0.5, 0, 0, 0, 0)),
            medium={'density_above': 1.2, 'surface': 0},
        ),
        ('drag',),
    ),
    'stock ellipsoid': (
        world(hull(), option='density="1000" viscosity="1e-3"'),
        ('drag', 'viscous', 'added_mass', 'magnus', 'kutta'),
    ),
    'stock without viscosity': (
        world(hull(coef=(0, 0, 0, 0, 1)), option='density="1000"'),
        ('added_mass', 'magnus'),
    ),
    'stock inertia box': (
        world(free_body('<geom type="box" size=".1 .2 .3"/>'), option='density="1000"'),
        ('drag',),
    ),
    'no passive forces': (
        world(hull(), option='density="1000"', flag='spring="disable" damper="disable"'),
        (),
    ),
    'no fluid at all': (world(hull()), ()),
}  # fmt: skip


@pytest.mark.parametrize('case', CASES.values(), ids=CASES)
def test_acting_terms_of_a_body(case, rng):
    xml, expected = case
    model, data = load(xml)
    assert acting_terms(model, [1], data) == {1: expected}
    assert felt(model, 1, rng) == set(expected)


def test_a_body_that_feels_nothing_stands_out_beside_one_that_does():
    bodies = hull(volume='auto', drag='ellipsoid') + free_body(
        '<geom size=".1"/>', name='ball', position=(3, 0, 0)
    )
    model, _ = load(world(bodies, medium=SEA))
    acting = acting_terms(model, range(1, model.nbody))
    assert acting[2] == ()
    assert terms_together(acting) == ('drag', 'viscous', 'magnus', 'kutta', 'buoyancy')
