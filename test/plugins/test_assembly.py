# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The C++ assembly against numpy, for articulated bodies with full random matrices."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros.physics.added_mass import added_mass_coriolis
from test.support.plugin_models import (
    body_plugin,
    explicit_force,
    free_body,
    kinetic_energy,
    load,
    text,
    world,
)

FLOW = np.array([0.3, -0.2, 0.4])
NAMES = ('hull', 'arm', 'hand')


def random_matrix(rng, scale):
    root = rng.normal(size=(6, 6))
    return scale * root @ root.T


class Chain:
    """A free hull with a ball-jointed arm and a hinged hand on it, each with its own A."""

    def __init__(self, seed=3, *, integrator='RK4', damping=False, timestep=0.01):
        rng = np.random.default_rng(seed)
        self.added = {name: random_matrix(rng, 0.3) for name in NAMES}
        self.damping = {name: random_matrix(rng, 0.2) for name in NAMES}
        self.points = {name: rng.uniform(-0.1, 0.1, size=3) for name in NAMES}

        def part(name):
            values = {'added_mass': self.added[name], 'reference_point': self.points[name]}
            if damping:
                values['linear_damping'] = self.damping[name]
            center, turn = rng.uniform(-0.05, 0.05, size=3), rng.normal(size=4)
            return (
                f'<inertial pos="{text(center)}" quat="{text(turn)}" mass="2" '
                'diaginertia=".05 .04 .03"/>' + body_plugin(**values)
            )

        hand = (
            '<body name="hand" pos=".3 .1 0"><joint type="hinge" axis="1 2 3" armature=".02"/>'
            f'{part("hand")}</body>'
        )
        arm = (
            f'<body name="arm" pos="0 .2 .1"><joint type="ball"/>{part("arm")}'
            f'<body name="fixed" pos="0 0 .1"><geom size=".02"/></body>{hand}</body>'
        )
        xml = world(
            free_body(part('hull') + arm),
            integrator=integrator, timestep=timestep, option=f'wind="{text(FLOW)}"',
        )  # fmt: skip
        self.model, self.data = load(xml)
        self.data.qpos[:] += rng.normal(size=self.model.nq) * 0.3
        mujoco.mj_normalizeQuat(self.model, self.data.qpos)
        self.data.qvel[:] = rng.normal(size=self.model.nv)

    def jacobians(self, name):
        """Return J and Jdot of the body's reference point in body axes, shape (6, nv) each."""
        model, data = self.model, self.data
        body = model.body(name).id
        rotation = data.xmat[body].reshape(3, 3)
        point = data.xpos[body] + rotation @ self.points[name]
        both = []
        for function in (mujoco.mj_jac, mujoco.mj_jacDot):
            linear, angular = np.zeros((2, 3, model.nv))
            function(model, data, linear, angular, point, body)
            both.append(np.vstack([rotation.T @ linear, rotation.T @ angular]))
        return both[0], both[1], rotation

    def oracle(self):
        """Return J'AJ summed over the bodies and the explicit generalized force."""
        matrix = np.zeros((self.model.nv, self.model.nv))
        force = np.zeros(self.model.nv)
        for name in NAMES:
            jac, jac_dot, rotation = self.jacobians(name)
            nu = jac @ self.data.qvel
            nu[:3] -= rotation.T @ FLOW
            bias = jac_dot @ self.data.qvel
            bias[:3] -= np.cross(nu[3:], nu[:3])
            wrench = np.concatenate(added_mass_coriolis(self.added[name], nu[:3], nu[3:]))
            force += jac.T @ (wrench - self.added[name] @ bias)
            matrix += jac.T @ self.added[name] @ jac
        return matrix, force

    def full_inertia(self):
        dense = np.zeros((self.model.nv, self.model.nv))
        mujoco.mj_fullM(self.model, self.data, dense)
        return dense


def test_inertia_and_force_of_a_chain():
    chain = Chain()
    mujoco.mj_forward(chain.model, chain.data)
    matrix, force = chain.oracle()
    total = chain.full_inertia()
    mujoco.mj_makeM(chain.model, chain.data)
    np.testing.assert_allclose(total - chain.full_inertia(), matrix, atol=1e-12)
    np.testing.assert_allclose(chain.data.qfrc_passive, force, atol=1e-12)
    np.testing.assert_allclose(explicit_force(chain.model, chain.data), force, atol=1e-12)


@pytest.mark.parametrize('integrator', ['Euler', 'implicitfast', 'discrete'])
def test_first_order_integrators_add_the_secant_of_the_damping(integrator):
    chain = Chain(integrator=integrator, damping=True)
    mujoco.mj_forward(chain.model, chain.data)
    matrix, _ = chain.oracle()
    for name in NAMES:
        jac = chain.jacobians(name)[0]
        matrix += 0.01 * jac.T @ chain.damping[name] @ jac
    total = chain.full_inertia()
    mujoco.mj_makeM(chain.model, chain.data)
    np.testing.assert_allclose(total - chain.full_inertia(), matrix, atol=1e-12)


def test_rk4_never_gets_the_secant():
    with_damping, without = Chain(damping=True), Chain()
    for chain in (with_damping, without):
        mujoco.mj_forward(chain.model, chain.data)
    np.testing.assert_array_equal(with_damping.full_inertia(), without.full_inertia())


def test_evaluating_twice_changes_nothing():
    chain = Chain(integrator='implicitfast', damping=True)
    mujoco.mj_forward(chain.model, chain.data)
    before = chain.data.M.copy(), chain.data.qacc.copy(), chain.data.qfrc_passive.copy()
    mujoco.mj_fwdVelocity(chain.model, chain.data)
    mujoco.mj_forward(chain.model, chain.data)
    after = chain.data.M, chain.data.qacc, chain.data.qfrc_passive
    for a, b in zip(before, after, strict=True):
        np.testing.assert_array_equal(a, b)


def test_a_chain_in_an_ideal_fluid_keeps_its_energy_to_fourth_order():
    errors = []
    for timestep in (0.004, 0.002):
        chain = Chain(timestep=timestep)
        # in the frame of the flow the energy of bodies and fluid is constant
        chain.model.opt.wind[:] = 0
        start = kinetic_energy(chain.model, chain.data).sum()
        mujoco.mj_step(chain.model, chain.data, round(1 / timestep))
        errors.append(abs(kinetic_energy(chain.model, chain.data).sum() / start - 1))
    assert errors[0] < 1e-5
    assert errors[0] / errors[1] > 2**3.5


def test_a_free_body_alone_and_in_a_chain_are_the_same_to_rounding():
    """A massless child sends the body over the general path; the physics must not notice."""
    rng = np.random.default_rng(5)
    added, point = random_matrix(rng, 2), rng.uniform(-0.1, 0.1, size=3)
    inside = '<geom type="box" size=".2 .1 .05" density="500" pos=".03 .02 .01"/>' + body_plugin(
        added_mass=added, reference_point=point, linear_damping=random_matrix(rng, 1)
    )
    finals = []
    for child in ('', '<body name="child"/>'):
        model, data = load(world(free_body(inside + child), integrator='implicitfast'))
        data.qvel[:] = [1, 2, 3, 3, 2, 1]
        mujoco.mj_step(model, data, 100)
        finals.append(np.r_[data.qpos, data.qvel])
    np.testing.assert_allclose(finals[0], finals[1], atol=1e-11)


def test_one_instance_shared_by_two_bodies_is_as_good_as_two():
    values = {'added_mass': [1, 2, 3, 0.1, 0.2, 0.3], 'linear_damping': [1] * 6}
    box = '<geom type="box" size=".2 .1 .05" density="500"/>'
    shared = (
        body_plugin(**values)
        .replace(
            '<plugin plugin="fluid_sim.body">',
            '<plugin plugin="fluid_sim.body"><instance name="h">',
        )
        .replace('</plugin>', '</instance></plugin>')
    )
    finals = []
    for own in (True, False):
        part = body_plugin(**values) if own else '<plugin instance="h"/>'
        bodies = ''.join(
            free_body(box + part, name=name, position=[x, 0, 0])
            for name, x in (('a', 0), ('b', 2))
        )
        xml = world(bodies, integrator='implicitfast')
        if not own:
            xml = xml.replace('<plugin plugin="fluid_sim.body"/>', shared)
        model, data = load(xml)
        data.qvel[:] = np.linspace(-1, 1, 12)
        mujoco.mj_step(model, data, 50)
        finals.append(np.r_[data.qpos, data.qvel])
    np.testing.assert_array_equal(finals[0], finals[1])
