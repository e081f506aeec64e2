# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The key ``waves:`` of scene files: what reaches fluid_sim.medium, and the faults."""

import numpy as np
import pytest

from fluid_sim_ros import Scene, Simulation
from fluid_sim_ros.errors import ConfigError, ModelError
from fluid_sim_ros.physics.environment.wave_spectrum import jonswap_waves
from fluid_sim_ros.physics.environment.waves import regular_waves, wave_flow, wave_surface
from fluid_sim_ros.plugins.drawn_waves import surface_heights

SURFACE = """<extension><plugin plugin="fluid_sim.body"/><plugin plugin="fluid_sim.medium">
<instance name="sea"><config key="density" value="1000"/><config key="surface" value="0"/>
</instance></plugin></extension>"""
MODEL = """<mujoco>{}<worldbody><body name="buoy" simple="false"><freejoint/>
<geom size=".1" density="500" fluidshape="ellipsoid"/>{}</body></worldbody></mujoco>"""
BODY = """<plugin plugin="fluid_sim.body"><config key="volume" value="auto"/></plugin>"""


@pytest.fixture
def scene(tmp_path):
    (tmp_path / 'still.xml').write_text(MODEL.format('', ''))
    (tmp_path / 'sea.xml').write_text(MODEL.format(SURFACE, BODY))

    def write(waves, model='sea'):
        path = tmp_path / 'scene.yaml'
        path.write_text(f'model: {model}.xml\nwaves: {waves}\n')
        return path

    return write


def heights(simulation, points, time):
    simulation.data.time = time
    return surface_heights(simulation.model, simulation.data, points)


POINTS = np.array([[0.0, 0.0], [3.0, -7.0], [-120.0, 55.0]])


def test_regular_waves(scene):
    simulation = Simulation(
        scene('{model: regular, height: 1.2, period: 5, direction: [3, 4], depth: 6}')
    )
    sea = regular_waves(1.2, 5.0, [3.0, 4.0], depth=6.0, gravity=9.81)
    for time in (0.0, 1.7, 400.0):
        expected = wave_surface(sea, POINTS, time).height
        np.testing.assert_allclose(heights(simulation, POINTS, time), expected, atol=1e-10)


@pytest.mark.parametrize(('seed', 'stated'), [(3, ''), (3, ', seed: 11'), (2**53 + 4, '')])
def test_a_random_sea_has_the_seed_of_the_simulation_unless_it_states_one(scene, seed, stated):
    waves = (
        '{model: jonswap, height: 1, period: 6, gamma: 2, spreading: 9, components: 30, '
        f'repeat: 900, cutoff: 3{stated}}}'
    )
    simulation = Simulation(scene(waves), seed=seed)
    sea = jonswap_waves(
        1.0, 6.0, gamma=2.0, spreading=9, components=30, repeat=900.0, cutoff=3.0,
        seed=11 if stated else seed % 2**53,
    )  # fmt: skip
    np.testing.assert_allclose(
        heights(simulation, POINTS, 77.0), wave_surface(sea, POINTS, 77.0).height, atol=1e-10
    )


def test_the_snapshot_has_the_orbital_velocity(scene):
    simulation = Simulation(scene('{model: regular, height: 1, period: 5}'))
    simulation.data.qpos[2] = -2
    velocity = simulation.snapshot().vehicles['buoy'].medium_velocity_w
    flow = wave_flow(regular_waves(1.0, 5.0), [0, 0, -2], 0.0)
    np.testing.assert_allclose(velocity, flow.velocity, rtol=1e-12)


def test_a_forced_rung_has_no_surface_and_no_waves():
    simulation = Simulation('wave_buoy', fluid='none')
    assert surface_heights(simulation.model, simulation.data, POINTS) is None


def test_still_water_has_no_waves(scene):
    simulation = Simulation(Scene.load(scene('null')))
    assert surface_heights(simulation.model, simulation.data, POINTS) is None


@pytest.mark.parametrize(
    ('waves', 'words'),
    [
        ('{model: stokes, height: 1, period: 5}', ["'waves.model'", 'regular', 'stokes']),
        ('{model: regular, period: 5}', ["missing key 'waves.height'"]),
        ('{model: regular, height: 1, period: 0}', ["'waves.period'", 'greater than 0']),
        ('{model: regular, height: .nan, period: 5}', ["'waves.height'", 'finite']),
        ('{model: regular, height: 1, period: 5, seed: 3}', ['seed is for jonswap only']),
        ('{model: regular, height: 1, period: 5, direction: [0, 0]}', ['direction must not be']),
        ('{model: regular, height: 1, period: 5, angle: 3}', ["unknown key 'waves.angle'"]),
        ('{model: jonswap, height: 1, period: 5, components: 2.5}', ["'waves.components'"]),
        ('{model: jonswap, height: 1, period: 5, gamma: 0}', ["'waves.gamma'", '1']),
    ],
)
def test_faults_are_one_line(scene, waves, words):
    path = scene(waves)
    with pytest.raises(ConfigError) as caught:
        Scene.load(path)
    line = str(caught.value)
    assert line.startswith(str(path))
    assert '\n' not in line
    for word in words:
        assert word in line


def test_a_model_without_a_surface_is_refused(scene):
    with pytest.raises(ConfigError, match="key 'waves': the model has no free surface"):
        Scene.load(scene('{model: regular, height: 1, period: 5}', 'still')).compile()


def test_what_only_the_plugin_sees_is_one_line_too(scene):
    path = scene('{model: jonswap, height: 1, period: 5, repeat: 60}')
    with pytest.raises(
        ModelError, match=r"wave_repeat = '60\.0'; allowed: wave_repeat >= 302"
    ) as e:
        Scene.load(path).compile()
    assert '\n' not in str(e.value)


def test_the_buoy_follows_the_sea():
    """Small against the waves: its heave is the surface's height, the slow drift aside."""
    simulation = Simulation('wave_buoy', seed=1)
    rows = []
    for _ in range(400):
        simulation.step(20)
        place = simulation.snapshot().vehicles['buoy'].position_w
        rows.append([place[2], heights(simulation, place[np.newaxis, :2], simulation.time)[0]])
    heave, surface = np.array(rows[50:]).T
    assert np.corrcoef(heave, surface)[0, 1] > 0.98
    assert heave.std() == np.clip(heave.std(), 0.95 * surface.std(), 1.05 * surface.std())


def test_the_rov_is_carried_along_the_orbits():
    """Without thrust it goes around with the water: a e^kz, less what its drag and mass make."""
    simulation = Simulation('bluerov2_waves')
    path = []
    for _ in range(240):
        simulation.step(50)
        path.append(simulation.snapshot().vehicles['bluerov2'].position_w)
    last = np.array(path[-60:])  # one period
    across = (np.ptp(last[:, 0]) + np.ptp(last[:, 2])) / 4
    k = (2 * np.pi / 6) ** 2 / 9.81
    assert across == pytest.approx(0.4 * np.exp(k * last[:, 2].mean()), rel=0.25)
