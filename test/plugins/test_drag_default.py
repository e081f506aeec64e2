# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Who brakes a body that does not say so, and the drag of the inertia box in a local medium."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros.physics.inertia_box import equivalent_inertia_box, inertia_box_wrench
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.plugins.acting import acting_terms
from test.support.plugin_models import (
    body_plugin,
    config,
    ellipsoid,
    explicit_force,
    free_body,
    load,
    refusal,
    world,
)

SEA = {'density': 1000, 'viscosity': 1e-2}
STOCK = 'density="1000" viscosity="1e-2"'
COEF = (0.5, 0.25, 1.5, 1.0, 1.0)
GEOMS = {
    'ellipsoid': ellipsoid((0.3, 0.2, 0.1), 900, COEF),
    'two ellipsoids': ellipsoid((0.3, 0.2, 0.1), 900, COEF)
    + '<geom type="capsule" size=".05 .2" pos=".1 .2 -.1" euler="20 50 0" '
    'fluidshape="ellipsoid"/>',
    'inertia box': '<geom type="box" size=".3 .2 .1" pos=".05 0 .1" euler="10 20 30"/>'
    '<geom type="sphere" size=".1" pos="0 .3 0"/>',
}
BRAKES = ('drag', 'viscous', 'magnus', 'kutta')


def terms_of(model, data, body=1):
    """Return term -> force and torque on a body about its origin."""
    row, scratch = np.zeros((1, nat.ROW_WIDTH)), mujoco.MjData(model)
    bases = np.array([body], dtype=np.int32)
    nat.native().observe(
        model._address, data._address, scratch._address, bases.ctypes.data, 1, 2, row.ctypes.data
    )
    return {term: row[0][nat.term_columns(term)] for term in nat.TERMS}


def put_in_motion(data, rng):
    data.qpos[:3], data.qpos[3:7] = rng.normal(size=3), rng.normal(size=4)
    data.qpos[3:7] /= np.linalg.norm(data.qpos[3:7])
    data.qvel[:] = rng.normal(size=6)


@pytest.mark.parametrize('name', GEOMS)
@pytest.mark.parametrize('keys', [None, {}, {'volume': 'auto'}, {'added_mass': [1] * 6}])
def test_the_same_drag_whether_the_density_stands_in_opt_or_in_the_medium(name, keys):
    inside = GEOMS[name]
    if keys is None and name == 'inertia box':  # nothing on the body asks for a drag
        return
    plugin = '' if keys is None else body_plugin(**keys)
    ours, data = load(world(free_body(inside + plugin), medium=SEA))
    stock, twin = load(world(free_body(inside), option=STOCK))
    rng = np.random.default_rng(3)
    for _ in range(5):
        put_in_motion(data, rng)
        twin.qpos[:], twin.qvel[:] = data.qpos, data.qvel
        found, expected = terms_of(ours, data), terms_of(stock, twin)
        for term in BRAKES:
            np.testing.assert_allclose(found[term], expected[term], rtol=1e-11, atol=1e-11)
        assert np.abs(found['drag']).min() > 0
        assert np.abs(found['viscous']).min() > 0


def test_an_ellipsoid_without_the_plugin_does_not_fall_as_in_vacuum_beside_a_medium():
    body = free_body(GEOMS['ellipsoid']).replace(' simple="false"', '')
    model, data = load(world(body, gravity=(0, 0, -9.81), medium=SEA, integrator='implicitfast'))
    assert acting_terms(model, [1])[1] == ('drag', 'viscous', 'magnus', 'kutta')
    for _ in range(400):
        mujoco.mj_step(model, data)
    area = np.pi * 0.3 * 0.2
    weight = 9.81 * model.body_mass[1]
    assert data.qvel[2] == pytest.approx(-np.sqrt(weight / (1000 * 0.5 * area)), rel=0.01)


@pytest.mark.parametrize('integrator', ['Euler', 'implicitfast', 'RK4'])
@pytest.mark.parametrize('name', ['ellipsoid', 'inertia box'])
def test_the_drag_of_a_simple_body_is_explicit_like_stock(name, integrator):
    """MuJoCo stores only the diagonal there: the force is applied, the inertia stays."""
    still = {'integrator': integrator, 'timestep': 1e-3}
    geom = '<geom type="box" size=".3 .2 .1"/>' if name == 'inertia box' else GEOMS[name]
    body = free_body(geom + body_plugin(volume='auto')).replace(' simple="false"', '')
    model, data = load(world(body, medium=SEA, **still))
    assert model.body_simple[1]
    data.qvel[:] = [1, 0.5, -0.2, 0.3, 1, -2]
    mujoco.mj_forward(model, data)
    expected = data.qfrc_passive / np.r_[[model.body_mass[1]] * 3, model.body_inertia[1]]
    gyroscopic = np.cross(data.qvel[3:], model.body_inertia[1] * data.qvel[3:])
    expected[3:] -= gyroscopic / model.body_inertia[1]
    if integrator != 'implicitfast':
        np.testing.assert_allclose(data.qacc, expected, rtol=1e-9)
    mujoco.mj_step(model, data)
    assert np.isfinite(data.qvel).all()


def test_a_stated_drag_needs_the_whole_inertia():
    body = free_body(GEOMS['ellipsoid'] + body_plugin(drag='ellipsoid'))
    line = refusal(world(body.replace(' simple="false"', ''), medium=SEA), 'fluid_sim.body')
    assert 'simple="false"' in line


FOIL = """<plugin plugin="fluid_sim.foil"><instance name="fin">{}</instance></plugin>"""


def with_foil(xml):
    keys = config({'site': 'fin', 'span': 0.3, 'chord': 0.1})
    return xml.replace('</extension>', FOIL.format(keys) + '</extension>')


WITHOUT = {
    'damping stated': (world(free_body(GEOMS['ellipsoid'] + body_plugin(
        linear_damping=[1] * 6)), medium=SEA), ('damping',)),
    'a foil acts on it': (with_foil(world(free_body(
        GEOMS['ellipsoid'] + '<site name="fin"/>' + body_plugin(volume='auto')), medium=SEA,
        gravity=(0, 0, -9.81))), ('buoyancy', 'foil')),
    'a foil alone': (with_foil(world(free_body(
        GEOMS['ellipsoid'] + '<site name="fin"/>'), medium=SEA)), ('foil',)),
    'none said': (world(free_body(GEOMS['ellipsoid'] + body_plugin(
        added_mass='auto', drag='none')), medium=SEA), ('added_mass',)),
    'no plugin and no fluidshape': (world(free_body(GEOMS['inertia box']), medium=SEA), ()),
    'no fluid': (world(free_body(GEOMS['ellipsoid'] + body_plugin(
        added_mass=[1, 2, 3, 1, 1, 1])), medium={'surface': 50}), ('added_mass',)),
}  # fmt: skip


@pytest.mark.parametrize('name', WITHOUT)
def test_no_drag_by_default_where_something_else_brakes_or_nothing_asks(name):
    xml, expected = WITHOUT[name]
    model, data = load(xml)
    assert acting_terms(model, [1], data)[1] == expected
    put_in_motion(data, np.random.default_rng(4))
    for term, value in terms_of(model, data).items():
        assert value.any() == (term in expected)


def test_drag_builtin_beside_a_medium_that_mujoco_does_not_know_is_refused():
    body = free_body(GEOMS['ellipsoid'] + body_plugin(drag='builtin', volume='auto'))
    line = refusal(world(body, medium=SEA), 'fluid_sim.body')
    for word in ("drag = 'builtin'", 'ellipsoid, inertia_box or none', 'opt.density'):
        assert word in line
    load(world(body, option=STOCK))  # there it is MuJoCo's own
    load(world(body, option=STOCK, medium=SEA))


def test_the_inertia_box_is_the_numpy_twins_in_the_local_flow():
    inside = GEOMS['inertia box'] + body_plugin(drag='inertia_box', volume='auto')
    medium = SEA | {'current': [0.4, -0.2, 0.1], 'density_above': 1.2, 'surface': 50}
    model, data = load(world(free_body(inside), medium=medium))
    rng = np.random.default_rng(8)
    half = equivalent_inertia_box(model.body_mass[1], model.body_inertia[1])
    rotation_bi, rotation_wb = np.zeros(9), np.zeros(9)
    mujoco.mju_quat2Mat(rotation_bi, model.body_iquat[1])
    rotation_bi = rotation_bi.reshape(3, 3)
    for _ in range(5):
        put_in_motion(data, rng)
        mujoco.mju_quat2Mat(rotation_wb, data.qpos[3:7])
        turn = rotation_wb.reshape(3, 3)
        flow = turn.T @ np.array(medium['current'])
        v = turn.T @ data.qvel[:3] - flow + np.cross(data.qvel[3:], model.body_ipos[1])
        twin = inertia_box_wrench(
            half, rotation_bi.T @ v, rotation_bi.T @ data.qvel[3:], density=1000, viscosity=1e-2
        )
        found = terms_of(model, data)
        for term, (force, torque) in twin.items():
            force_b = rotation_bi @ force
            torque_b = rotation_bi @ torque + np.cross(model.body_ipos[1], force_b)
            expected = np.r_[force_b, torque_b]
            np.testing.assert_allclose(found[term], expected, rtol=1e-11, atol=1e-12)


@pytest.mark.parametrize('integrator', ['Euler', 'implicitfast'])
def test_the_inertia_box_drag_is_stable_at_any_timestep(integrator):
    """The secant holds it: a light box at 50 m/s in water, at half a second a step."""
    box = '<geom type="box" size=".3 .2 .1" density="20" euler="10 20 30"/>'
    inside = box + body_plugin(drag='inertia_box')
    model, data = load(world(free_body(inside), medium=SEA, integrator=integrator, timestep=0.5))
    data.qvel[:3] = [50, -30, 20]
    energy = [0.5 * model.body_mass[1] * float(data.qvel[:3] @ data.qvel[:3])]
    for _ in range(40):
        mujoco.mj_step(model, data)
        energy.append(0.5 * model.body_mass[1] * float(data.qvel[:3] @ data.qvel[:3]))
    assert np.all(np.diff(energy) <= 0)
    assert energy[-1] < 1e-4 * energy[0]


def test_the_inertia_box_leaves_the_water():
    """Drag in each fluid by the share of the volume: in air a thousandth of that in water."""
    inside = '<geom type="box" size=".3 .2 .1"/>' + body_plugin(drag='inertia_box')
    sea = {'density': 1000, 'density_above': 1, 'surface': 0}
    model, data = load(world(free_body(inside), medium=sea))
    forces = []
    for height in (-1.0, 0.0, 1.0):
        data.qpos[2], data.qvel[0] = height, 1
        forces.append(explicit_force(model, data)[0])
    assert forces[2] / forces[0] == pytest.approx(1e-3, rel=1e-12)
    assert forces[1] == pytest.approx(0.5 * (forces[0] + forces[2]), rel=1e-12)


def test_an_inertia_box_needs_mass():
    model, _ = load(world(free_body('<geom size=".1"/>' + body_plugin(volume='auto')), medium=SEA))
    assert acting_terms(model, [1])[1] == ('drag', 'viscous', 'buoyancy')
    light = (
        '<body name="hull" simple="false"><freejoint/><geom size=".1"/>'
        '<body name="tail" pos="1 0 0">'
        f'{body_plugin(drag="inertia_box")}</body></body>'
    )
    line = refusal(world(light, medium=SEA), 'fluid_sim.body')
    assert 'mass' in line
    assert "body 'tail'" in line
