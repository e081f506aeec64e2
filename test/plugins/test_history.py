# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""History force of a small sphere: closed form, quadrature, measurements, state, refusals."""

import copy

import mujoco
import numpy as np
import pytest

from benchmarks.vehicles.validation_bodies import NU, SPHERES, WATER, settle, tau95
from fluid_sim_ros.physics.drag import HISTORY_KERNELS, history_kernel
from fluid_sim_ros.physics.reynolds import sphere_cd_brown_lawler
from test.support.plugin_models import body_plugin, explicit_force, free_body, load, refusal, world

DRAG = {
    'added_mass': 'auto',
    'volume': 'auto',
    'drag': 'ellipsoid',
    'drag_reynolds': 'brown_lawler',
}
FULL = mujoco.mjtState.mjSTATE_FULLPHYSICS
RADIUS = 1e-3


def sphere(
    history='dorgan_loth', *, center=0.0, density=2560.0, integrator='implicitfast', step=5e-4,
    medium=None, size=None, inside='', shared='',
):  # fmt: skip
    """Return MJCF of a free sphere in water, its centre ``center`` [m] off the body's origin."""
    keys = {**DRAG, 'history': history} if history else DRAG
    size = size or f'{RADIUS} {RADIUS} {RADIUS}'
    geom = (
        f'<geom type="ellipsoid" size="{size}" pos="{center} 0 0" density="{density}" '
        'fluidshape="ellipsoid" fluidcoef="0 0 0 0 0" contype="0" conaffinity="0"/>'
    )
    plugin = shared or body_plugin(**keys)
    return world(
        free_body(geom + plugin + inside), gravity=(0, 0, -9.81), timestep=step,
        integrator=integrator, medium=medium or {'density': WATER, 'viscosity': NU * WATER},
    )  # fmt: skip


def memory(model, data):
    """Return what the body's plugin remembers."""
    instance = model.body_plugin[1]
    first = model.plugin_stateadr[instance]
    return data.plugin_state[first : first + model.plugin_statenum[instance]]


def falls(xml, seconds):
    model, data = load(xml)
    speeds = [0.0]
    while data.time < seconds - 1e-9:
        mujoco.mj_step(model, data)
        speeds.append(-data.qvel[2])
    return np.array(speeds)


def quadrature(diameter, ratio, seconds, kernel, step=1e-4):
    """Return speeds of a sinking sphere with the whole integral summed up anew in every step."""
    radius, volume = diameter / 2, np.pi / 6 * diameter**3
    mass, weight = (ratio + 0.5) * WATER * volume, (ratio - 1) * WATER * volume * 9.81
    diffusion, viscous = radius**2 / (np.pi * NU), 6 * np.pi * NU * WATER * radius
    count = round(seconds / step)
    v, a = np.zeros(count + 1), np.zeros(count)

    def drag(speed):
        reynolds = max(abs(speed) * diameter / NU, 1e-12)
        return sphere_cd_brown_lawler(reynolds) * WATER / 2 * speed**2 * np.pi * radius**2

    for k in range(count):
        # the kernel is singular as lag^-1/2: substituting its root
        root = np.sqrt(np.arange(k + 1, -1, -1) * step / diffusion)
        middle, width = (root[:-1] + root[1:]) / 2, root[:-1] - root[1:]
        weights = history_kernel(middle**2, v[k] * diameter / NU, kernel) * 2 * middle * width
        weights *= viscous * diffusion
        slope = (drag(v[k] + 1e-6) - drag(v[k])) / 1e-6
        a[k] = (weight - drag(v[k]) - weights[:k] @ a[:k]) / (mass + weights[k] + slope * step / 2)
        v[k + 1] = v[k] + step * a[k]
    return v


@pytest.mark.parametrize('kernel', ['basset', *HISTORY_KERNELS])
def test_sum_of_exponentials_against_the_whole_integral(kernel):
    expected = quadrature(1.5e-3, 2.56, 0.2, kernel)[::10]
    _, speeds = settle(1.5e-3, 2.56, 0.2, history=kernel)
    np.testing.assert_allclose(speeds, expected, atol=0.005 * expected.max())


@pytest.mark.parametrize('name', SPHERES)
def test_time_to_95_percent_is_within_a_tenth_of_the_measured(name):
    diameter, ratio, _, measured = SPHERES[name]
    assert tau95(*settle(diameter, ratio, 12 * measured)) < 0.8 * measured
    found = tau95(*settle(diameter, ratio, 12 * measured, history='dorgan_loth'))
    assert found == pytest.approx(measured, rel=0.1)


def test_the_terminal_speed_stays():
    plain, mended = (
        settle(0.5e-3, 2.56, 0.8, **more)[1][-1] for more in ({}, {'history': 'mei_adrian'})
    )
    assert mended == pytest.approx(plain, rel=1e-3)


@pytest.mark.parametrize('integrator', ['RK4', 'implicitfast'])
def test_basset_force_at_a_constant_acceleration(integrator):
    # F = -6 pi mu r a 2 sqrt(t T): a sphere so heavy that it falls freely
    medium = {'density': WATER, 'viscosity': 0.1}
    forces = []
    for history in ('basset', None):
        model, data = load(sphere(history, density=1e9, integrator=integrator, medium=medium))
        mujoco.mj_step(model, data, 40)
        mujoco.mj_forward(model, data)
        forces.append(explicit_force(model, data)[2])
    diffusion = RADIUS**2 * WATER / (np.pi * 0.1)
    expected = 6 * np.pi * 0.1 * RADIUS * 9.81 * 2 * np.sqrt(data.time * diffusion)
    assert forces[0] - forces[1] == pytest.approx(expected, rel=0.01)


def test_every_integrator_gives_the_same_fall():
    falls_of = {
        name: falls(sphere(integrator=name), 0.1)
        for name in ('RK4', 'Euler', 'implicit', 'implicitfast', 'discrete')
    }
    for name, speeds in falls_of.items():
        np.testing.assert_allclose(speeds, falls_of['RK4'], atol=0.004, err_msg=name)


@pytest.mark.parametrize('integrator', ['RK4', 'implicitfast'])
def test_a_finer_timestep_changes_little(integrator):
    coarse = falls(sphere(integrator=integrator, step=2e-3), 0.1)
    fine = falls(sphere(integrator=integrator, step=1e-4), 0.1)[::20]
    np.testing.assert_allclose(coarse, fine, atol=0.012 * fine[-1])


def test_long_steps_stay_stable_by_a_first_order_integrator():
    speeds = falls(sphere(step=0.02), 4.0)
    assert speeds[-1] == pytest.approx(settle(2 * RADIUS, 2560 / WATER, 1.5)[1][-1], rel=2e-3)


def test_off_by_default_and_to_the_bit():
    np.testing.assert_array_equal(falls(sphere('none'), 0.05), falls(sphere(None), 0.05))


def test_a_sphere_off_the_bodys_origin_falls_alike():
    np.testing.assert_allclose(
        falls(sphere(center=0.0), 0.05), falls(sphere(center=4e-3), 0.05), rtol=1e-6, atol=1e-12
    )


def test_a_steady_current_carries_the_fall_along():
    medium = {'density': WATER, 'viscosity': NU * WATER, 'current': [0.4, 0, 0]}
    model, data = load(sphere(medium=medium))
    data.qvel[0] = 0.4
    still, rest = load(sphere())
    for _ in range(100):
        mujoco.mj_step(model, data)
        mujoco.mj_step(still, rest)
    np.testing.assert_allclose(data.qvel[:3] - [0.4, 0, 0], rest.qvel[:3], atol=1e-9)


def test_copies_saved_states_and_resets_repeat_to_the_bit():
    model, data = load(sphere())
    mujoco.mj_step(model, data, 30)
    saved = np.zeros(mujoco.mj_stateSize(model, FULL))
    mujoco.mj_getState(model, data, saved, FULL)
    twin, other = copy.copy(data), mujoco.MjData(model)
    mujoco.mj_setState(model, other, saved, FULL)
    for each in (data, twin, other):
        mujoco.mj_step(model, each, 30)
    np.testing.assert_array_equal(twin.qpos, data.qpos)
    np.testing.assert_array_equal(other.qpos, data.qpos)
    mujoco.mj_resetData(model, data)
    assert not memory(model, data).any()
    mujoco.mj_step(model, data, 60)
    np.testing.assert_array_equal(twin.qpos, data.qpos)


def test_looking_at_the_forces_changes_nothing():
    model, data = load(sphere())
    _, undisturbed = load(sphere())
    for _ in range(50):
        mujoco.mj_step(model, data)
        mujoco.mj_forward(model, data)
        explicit_force(model, data)
        mujoco.mj_step(model, undisturbed)
    np.testing.assert_array_equal(data.qpos, undisturbed.qpos)


def test_a_new_fluid_remembers_nothing():
    medium = {
        'surface': 0.0, 'density': WATER, 'viscosity': NU * WATER, 'density_above': 1.2,
        'viscosity_above': 1.8e-5,
    }  # fmt: skip
    model, data = load(sphere(medium=medium))
    data.qpos[2] = 5e-3
    sides = []
    for _ in range(200):
        mujoco.mj_step(model, data)
        sides.append(memory(model, data)[0])
        assert np.isfinite(data.qvel).all()
    assert (sides[0], sides[-1]) == (2.0, 1.0)
    assert sum(np.diff(sides) != 0) == 1


@pytest.mark.parametrize(
    ('xml', 'words'),
    [
        (sphere('wake'), "history = 'wake'; allowed: none, basset, mei_adrian, dorgan_loth"),
        (sphere(size='1e-3 1e-3 2e-3'), 'longest axis is at most 1.5 times'),
        (sphere(inside='<body><geom size="1e-3"/></body>'), 'needs a body with a freejoint'),
        (sphere(medium={'density': WATER, 'viscosity': 0}), 'a density and a viscosity above 0'),
        (
            world(
                free_body('<geom size="1e-3"/>' + body_plugin(history='basset')),
                medium={'density': WATER, 'viscosity': 1e-3},
            ),
            'history needs drag="ellipsoid"',
        ),
    ],
)
def test_what_is_refused(xml, words):
    assert words in refusal(xml, 'fluid_sim.body')


def test_an_instance_that_several_bodies_share_is_refused():
    instance = ''.join(
        f'<config key="{k}" value="{v}"/>' for k, v in {**DRAG, 'history': 'basset'}.items()
    )
    body = sphere(shared='<plugin instance="s"/>')
    both = body.replace('</worldbody>', free_body(
        f'<geom type="sphere" size="{RADIUS}" pos="0 0 0" density="2560" fluidshape="ellipsoid"/>'
        '<plugin instance="s"/>', name='second', position=(1, 0, 0),
    ) + '</worldbody>')  # fmt: skip
    xml = both.replace(
        '<plugin plugin="fluid_sim.body"/>',
        f'<plugin plugin="fluid_sim.body"><instance name="s">{instance}</instance></plugin>',
    )
    assert 'several bodies share it' in refusal(xml, 'fluid_sim.body')
