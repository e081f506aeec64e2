# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``model: grid`` of wind and current in scene files: the flow, the roads, replay, the faults."""

import numpy as np
import pytest

from fluid_sim_ros import Scene, Simulation
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.loop.runner import NoSource, Pacing, Runner
from fluid_sim_ros.physics.environment.grid import grid_flow
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.recording.replay.resimulate import resimulate
from fluid_sim_ros.recording.sink import RecordingSink
from fluid_sim_ros.scene.grid_files import grid_numbers, pack, read_grid, unpack

AIR = """<mujoco><option density="1.2" viscosity="1.8e-5" gravity="0 0 0" timestep="0.01"/>
<worldbody><body name="kite" pos="1 2 5"><freejoint/><geom type="box" size=".3 .2 .1"/></body>
</worldbody></mujoco>"""
T, X, Y, Z = [0.0, 10.0], [-5.0, 0.0, 5.0], [-4.0, 4.0], [0.0, 10.0]
U, V = np.random.default_rng(1).normal(size=(2, 2, 3, 2, 2)) * 3


@pytest.fixture
def scene(tmp_path):
    (tmp_path / 'kite.xml').write_text(AIR)
    np.savez(tmp_path / 'flow.npz', t=T, x=X, y=Y, z=Z, u=U, v=V)

    def write(weather):
        path = tmp_path / 'scene.yaml'
        path.write_text(f'model: kite.xml\n{weather}\n')
        return path

    return write


def felt(simulation):
    return simulation.snapshot().vehicles['kite'].medium_velocity_w


def test_every_place_and_time_has_its_own_flow(scene, tmp_path):
    simulation = Simulation(scene('wind: {model: grid, file: flow.npz}'))
    grid = read_grid(tmp_path / 'flow.npz')
    np.testing.assert_allclose(felt(simulation), grid_flow(grid, [1, 2, 5], 0).velocity)
    simulation.step(150)
    place = simulation.snapshot().vehicles['kite'].position_w
    assert np.linalg.norm(place - [1, 2, 5]) > 1e-4  # MuJoCo's own drag takes it along
    np.testing.assert_allclose(felt(simulation), grid_flow(grid, place, 1.5).velocity)


def test_a_grid_rides_on_the_mean(scene, tmp_path):
    simulation = Simulation(
        scene('wind:\n- {model: steady, velocity: [4, 0, 1]}\n- {model: grid, file: flow.npz}')
    )
    own = grid_flow(read_grid(tmp_path / 'flow.npz'), [1, 2, 5], 0).velocity
    np.testing.assert_allclose(felt(simulation), own + np.array([4, 0, 1]))
    simulation.enable_wind(False)
    simulation.step(100)  # the mean dies down at a limited rate
    np.testing.assert_array_equal(felt(simulation), 0)


def test_a_log_holds_the_grid_and_flies_again_bit_by_bit(scene, tmp_path):
    path = scene('wind: {model: grid, file: flow.npz}')
    simulation = Simulation(path)
    log = tmp_path / 'log.mcap'
    sink = RecordingSink(simulation, log, {}, ('*',))
    Runner(simulation, NoSource(), [sink], Pacing()).run(until=200)
    sink.close()
    (tmp_path / 'flow.npz').unlink()
    outcome = resimulate(open_log(log))
    assert outcome.compared > 100
    assert outcome.difference is None


def test_packing_keeps_every_bit(tmp_path, scene):
    scene('')
    grid = read_grid(tmp_path / 'flow.npz')
    np.testing.assert_array_equal(unpack(pack(grid)), grid_numbers(grid))
    with pytest.raises(ConfigError, match='data of a grid'):
        unpack('no grid')


@pytest.mark.parametrize(
    ('weather', 'words'),
    [
        ('wind: {model: grid}', 'needs a file'),
        ('wind: {model: grid, file: none.npz}', 'none.npz: no such file'),
        ('wind: {model: grid, file: kite.xml}', "kind '.xml' is not known; allowed: .npz"),
        ('wind: {model: grid, file: flow.npz, scale: 2}', "unknown key 'wind.0.scale'"),
        (
            'wind:\n- {model: grid, file: flow.npz}\n- {model: grid, file: flow.npz}',
            'grid and grid; one grid at most',
        ),
    ],
)
def test_faults_are_one_line(scene, weather, words):
    path = scene(weather)
    with pytest.raises(ConfigError) as caught:
        Scene.load(path).compile()
    line = str(caught.value)
    assert words in line
    assert '\n' not in line
