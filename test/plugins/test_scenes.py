# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The scenes that show the plugins, each with the fact that it is there for."""

import subprocess
import sys
from pathlib import Path

import mujoco
import numpy as np
import pytest

from fluid_sim_ros import Simulation, load_plugins, plugin_library
from fluid_sim_ros.plugins.native import native
from test.support.plugin_models import kinetic_energy

MODELS = Path(__file__).parents[2] / 'models'


def load(name):
    load_plugins()
    model = mujoco.MjModel.from_xml_path(str(MODELS / f'{name}.xml'))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    return model, data


def run(model, data, seconds):
    mujoco.mj_step(model, data, round(seconds / model.opt.timestep))
    assert sum(warning.number for warning in data.warning) == 0


@pytest.mark.parametrize('name', ['kirchhoff', 'buoyant_sphere', 'amphibious'])
def test_scene_runs_in_the_simulation(name):
    simulation = Simulation(name)
    simulation.step(200)
    for vehicle in simulation.vehicles:
        assert all(np.isfinite(part).all() for part in simulation.wrench(vehicle)['added_mass'])


def test_kirchhoff_keeps_the_energy():
    model, data = load('kirchhoff')
    start = kinetic_energy(model, data).sum()
    run(model, data, 60)
    assert kinetic_energy(model, data).sum() == pytest.approx(start, rel=1e-6)


def test_buoyant_sphere_leaves_with_half_the_water_and_floats_upright():
    model, data = load('buoyant_sphere')
    mujoco.mj_resetData(model, data)
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4  # the true acceleration
    mujoco.mj_forward(model, data)
    assert data.qacc[2] == pytest.approx((997 - 498.5) * 9.81 / (498.5 + 498.5), rel=1e-5)
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    mujoco.mj_resetDataKeyframe(model, data, 0)
    run(model, data, 30)  # it still bobs a little: quadratic drag dies out like 1/t
    assert data.qpos[2] == pytest.approx(0, abs=5e-3)  # half of it is wet
    assert abs(data.qpos[3]) == pytest.approx(1, abs=1e-3)


def test_water_pendulum_swings_slower_than_in_air():
    model, data = load('water_pendulum')
    data.qpos[0] = 0.02
    crossings = []
    for _ in range(3000):
        before = data.qpos[0]
        mujoco.mj_step(model, data)
        if before > 0 >= data.qpos[0]:
            crossings.append(data.time)
    assert np.diff(crossings) == pytest.approx(2.132, rel=5e-3)  # drag lengthens it slightly


def test_amphibious_dives_surfaces_and_drifts_with_the_current():
    """No commands at all: it falls from the keyframe, floats up, and goes with the water."""
    model, data = load('amphibious')
    data.ctrl[:] = 0
    current = np.array([0.2, 0.1, 0.0])
    native().set_medium(model._address, data._address, 0, current.ctypes.data)
    heights = []
    for _ in range(150):
        run(model, data, 0.02)
        heights.append(data.qpos[2])
    assert min(heights) < -0.2  # under water
    run(model, data, 40)
    weight = model.body_mass[1] * 9.81
    mujoco.mj_forward(model, data)
    assert data.qfrc_passive[2] == pytest.approx(weight, rel=1e-2)
    np.testing.assert_allclose(data.qvel[:2], [0.2, 0.1], atol=5e-3)
    assert data.xmat[1].reshape(3, 3)[2, 2] > 0.999


def test_a_model_with_plugins_is_drawn_without_more_than_load_plugins():
    """What the renderer and the viewer draw from; the pixels need a GPU or EGL."""
    model, data = load('amphibious')
    run(model, data, 0.5)
    scene, camera = mujoco.MjvScene(model, 100), mujoco.MjvCamera()
    everything = mujoco.mjtCatBit.mjCAT_ALL
    mujoco.mjv_updateScene(model, data, mujoco.MjvOption(), None, camera, everything, scene)
    drawn = {scene.geoms[i].objid for i in range(scene.ngeom)}
    assert model.geom('hull').id in drawn


STOCK_PROGRAM = """
import sys
import mujoco
mujoco.mj_loadPluginLibrary(sys.argv[1])
model = mujoco.MjModel.from_xml_path(sys.argv[2])
data = mujoco.MjData(model)
mujoco.mj_step(model, data, 1500)
print(repr(data.qpos[2]), 'fluid_sim_ros' in sys.modules)
"""


def test_stock_mujoco_needs_the_library_alone():
    """No Python of ours: MuJoCo loads the library by itself and gets the same bits."""
    path = MODELS / 'amphibious.xml'
    done = subprocess.run(
        [sys.executable, '-c', STOCK_PROGRAM, str(plugin_library()), str(path)],
        capture_output=True,
        text=True,
        check=True,
    )
    height, ours_loaded = done.stdout.split()[-2:]
    assert ours_loaded == 'False'
    load_plugins()
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 1500)
    assert repr(data.qpos[2]) == height
