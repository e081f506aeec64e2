# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Warnings where forces are not good any more: a crossing in few steps, the drag crisis."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros.loop.watchdogs import Watchdogs
from fluid_sim_ros.physics.reynolds import sphere_cd_brown_lawler
from fluid_sim_ros.plugins.limits import DRAG_CRISIS, LimitWatch
from fluid_sim_ros.simulation import Simulation
from test.support.plugin_models import body_plugin, ellipsoid, free_body, load, world

RADIUS, DENSITY = 0.1, 300
SEA = {'density': 1000, 'surface': 0}


def entry(speed, timestep, integrator='implicitfast', medium=SEA, height=1.0, gravity=0.0):
    """Return speed left over that of a fully resolved entry, and what the watch says."""
    plugin = body_plugin(added_mass='auto', drag='none')
    model, data = load(
        world(
            free_body(ellipsoid([RADIUS] * 3, DENSITY) + plugin, position=(0, 0, height)),
            integrator=integrator, timestep=timestep, medium=medium,
            gravity=(0, 0, -gravity),
        )
    )  # fmt: skip
    data.qvel[2] = -speed
    watch = LimitWatch(model, data)
    for _ in range(round(2.5 * height / speed / timestep)):
        mujoco.mj_step(model, data)
        watch.look()
    return -data.qvel[2] / (speed * DENSITY / (DENSITY + 500)), watch.lines


@pytest.mark.parametrize('integrator', ['Euler', 'implicitfast', 'RK4'])
@pytest.mark.parametrize('share', [0.01, 0.1, 0.2])
def test_an_entry_that_the_steps_resolve_is_right_and_quiet(integrator, share):
    left, lines = entry(10, share * 2 * RADIUS / 10, integrator)
    assert lines == []
    assert left == pytest.approx(1, abs=0.01 if share <= 0.1 else 0.05)


@pytest.mark.parametrize('integrator', ['Euler', 'implicitfast', 'RK4'])
@pytest.mark.parametrize('share', [0.3, 1.0, 3.0, 12.5])
def test_slamming_that_the_steps_do_not_resolve_is_said_once_with_the_step_that_would_do(
    integrator, share
):
    """Even where no step finds the body cut: at 12.5 it is above, then below."""
    speed, timestep = 10, share * 2 * RADIUS / 10
    left, lines = entry(speed, timestep, integrator)
    assert len(lines) == 1
    for word in ("body 'hull' crossed the surface at", f'of its {2 * RADIUS:g} m', 'timestep'):
        assert word in lines[0]
    enough = float(lines[0].rsplit('below ', 1)[1].split()[0])
    assert entry(speed, enough, integrator)[1] == []
    assert entry(speed, enough, integrator)[0] == pytest.approx(1, abs=0.02)
    if share > 2:
        assert abs(left - 1) > 0.02


def test_the_watch_counts_every_evaluation_between_two_looks():
    model, data = load(
        world(
            free_body(ellipsoid([RADIUS] * 3, DENSITY) + body_plugin(volume='auto', drag='none'),
                      position=(0, 0, 0.5)), timestep=0.02, medium=SEA, integrator='Euler',
        )
    )  # fmt: skip
    data.qvel[2] = -10
    mujoco.mj_step(model, data, 20)
    assert data.qpos[2] < -2
    assert len(LimitWatch(model, data).look()) == 1


@pytest.mark.parametrize('height', [0.5, 5.0])
def test_jumping_through_waves_counts_from_their_crests(height):
    waves = SEA | {'waves': 'regular 1 6', 'water_depth': 50}
    assert len(entry(60, 0.02, medium=waves, height=height, gravity=9.81)[1]) == 1
    assert entry(2, 0.002, medium=waves, height=height, gravity=9.81)[1] == []


def test_a_body_that_stays_in_one_fluid_may_be_as_fast_as_it_likes():
    assert entry(100, 0.02, medium={'density': 1000})[1] == []
    sea = SEA | {'surface': -1000}
    assert entry(50, 0.02, medium=sea)[1] == []


def test_a_thin_plate_is_small_along_its_normal():
    """Broadside 2 mm of plate pass in a step that a ball of its size would not notice."""
    geom = '<geom type="box" size=".3 .2 .001" density="2000"/>'
    said = []
    for quat in ('1 0 0 0', '.7071068 0 .7071068 0'):
        body = free_body(geom + body_plugin(volume='auto', drag='none'), position=(0, 0, 0.4))
        body = body.replace('<body name="hull"', f'<body name="hull" quat="{quat}"')
        model, data = load(world(body, timestep=0.002, medium=SEA, integrator='Euler'))
        data.qvel[2] = -3
        mujoco.mj_step(model, data, 300)
        said.append(LimitWatch(model, data).look())
    assert len(said[0]) == 1
    assert '0.002 m' in said[0][0]
    assert said[1] == []


@pytest.mark.parametrize('reynolds', [0.5 * DRAG_CRISIS, 2 * DRAG_CRISIS])
def test_the_drag_curve_of_spheres_beyond_the_drag_crisis_is_said_once(reynolds):
    sea = {'density': 1000, 'viscosity': 1e-3}
    plugin = body_plugin(drag='ellipsoid', drag_reynolds='brown_lawler', drag_area='true')
    model, data = load(
        world(free_body(ellipsoid([RADIUS] * 3, 1000, (0.5, 0, 0, 0, 0)) + plugin), medium=sea)
    )
    watch = LimitWatch(model, data)
    data.qvel[0] = reynolds * 1e-3 / (1000 * 2 * RADIUS)
    mujoco.mj_forward(model, data)
    cd = float(sphere_cd_brown_lawler(reynolds))
    dynamic = 0.5 * 1000 * data.qvel[0] ** 2 * np.pi * RADIUS**2
    assert data.qfrc_passive[0] == pytest.approx(-cd * dynamic, rel=1e-9)
    lines = watch.look()
    assert len(lines) == (reynolds > DRAG_CRISIS)
    if lines:
        for word in ("body 'hull'", 'Re = 4e+05', 'brown_lawler', '2e+05', 'drag crisis'):
            assert word in lines[0]
    mujoco.mj_step(model, data, 5)
    assert watch.look() == []


def test_a_constant_coefficient_has_no_drag_crisis():
    model, data = load(
        world(
            free_body(ellipsoid([RADIUS] * 3, 1000, (0.5, 0, 0, 0, 0))
                      + body_plugin(drag='ellipsoid')), medium={'density': 1e3, 'viscosity': 1e-3},
        )
    )  # fmt: skip
    data.qvel[0] = 50
    mujoco.mj_forward(model, data)
    assert LimitWatch(model, data).look() == []


def test_a_run_tells_it_among_its_warnings():
    """The watchdogs of run and node: with the time, and in the same list as the other lines."""
    simulation = Simulation('buoyant_sphere')
    watchdogs = Watchdogs(simulation)
    simulation.step(50)
    watchdogs.write(simulation)
    assert simulation.warnings.lines == []
    simulation.data.qpos[2], simulation.data.qvel[2] = 0.3, -100
    simulation.step(10)
    watchdogs.write(simulation)
    lines = list(simulation.warnings.lines)
    assert 'crossed the surface' in lines[0]
    assert f'(t = {simulation.time:g} s)' in lines[0]
    watchdogs.write(simulation)
    assert simulation.warnings.lines == lines


@pytest.mark.parametrize('name', ['amphibious', 'buoyant_sphere', 'wave_buoy'])
def test_shipped_scenes_resolve_their_surface(name):
    simulation = Simulation(name)
    watchdogs = Watchdogs(simulation)
    simulation.step(round(5 / simulation.timestep))
    watchdogs.write(simulation)
    assert not any('crossed the surface' in line for line in simulation.warnings.lines)
