# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Weather in scene files: what reaches the model, by which road, and what is refused."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros import Scene, Simulation
from fluid_sim_ros.cli.scene import examine_scene
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.plugins.config import MEDIUM
from fluid_sim_ros.scene.media import OPTION

AIR = """
<mujoco>
  <option density="1.2" viscosity="1.8e-5" timestep="0.002"/>
  <worldbody>
    <body name="kite" pos="0 0 5"><freejoint/><geom type="box" size=".3 .2 .1"/></body>
  </worldbody>
</mujoco>
"""
SEA = AIR.replace(
    '<option density="1.2" viscosity="1.8e-5"', '<option'
).replace('<worldbody>', """<extension><plugin plugin="fluid_sim.body"/>
  <plugin plugin="fluid_sim.medium"><instance name="sea"><config key="surface" value="0"/>
  <config key="density" value="1000"/><config key="density_above" value="1.2"/>
  <config key="current" value="9 9 9"/></instance></plugin></extension><worldbody>""").replace(
    '<freejoint/>', '<freejoint/><plugin plugin="fluid_sim.body">'
    '<config key="volume" value="auto"/></plugin>'
)  # fmt: skip
DRYDEN = 'model: dryden, wind_6m: 8, height: 10, airspeed: 5'


@pytest.fixture
def scene(tmp_path):
    """Write a scene file of a model; return its path."""

    def write(weather, model=AIR):
        (tmp_path / 'kite.xml').write_text(model)
        path = tmp_path / 'scene.yaml'
        path.write_text(f'model: kite.xml\n{weather}\n')
        return path

    return write


def felt(simulation):
    return simulation.snapshot().vehicles['kite'].medium_velocity_w


def test_one_steady_velocity_takes_the_cheap_road(scene):
    simulation = Simulation(scene('wind: {model: steady, velocity: [3, 1, 0]}'))
    assert simulation.flow_source == OPTION
    assert simulation.model.nplugin == 0
    np.testing.assert_array_equal(felt(simulation), [3, 1, 0])
    simulation.set_wind([1, 0, 0])
    simulation.step()
    np.testing.assert_array_equal(felt(simulation), [1, 0, 0])


@pytest.mark.parametrize(
    'weather',
    [
        'wind: {model: power_law, velocity: [3, 1, 0]}',
        'wind: {model: ramp, amplitude: [3, 1, 0], duration: 2}',
        f'wind: {{{DRYDEN}}}',
    ],
)
def test_everything_else_is_local(scene, weather):
    simulation = Simulation(scene(weather))
    assert simulation.flow_source == MEDIUM


def test_profiles_count_from_the_ground(scene):
    power = scene('wind: {model: power_law, velocity: [6, 0, 0], exponent: 0.2, ground: -3}')
    np.testing.assert_allclose(felt(Simulation(power)), [6 * 0.8**0.2, 0, 0], rtol=1e-14)
    log = scene('wind: {model: logarithmic, velocity: [6, 0, 0], roughness: 0.1}')
    factor = np.log(50) / np.log(100)
    np.testing.assert_allclose(felt(Simulation(log)), [6 * factor, 0, 0], rtol=1e-14)


def test_a_shear_can_turn_bodies(scene):
    law = 'wind: {model: power_law, velocity: [6, 0, 0], rotational: true}'
    simulation, still = Simulation(scene(law)), Simulation(scene(law.replace('true', 'false')))
    torque = [run.wrench('kite')['drag'][1] for run in (simulation, still)]
    assert torque[0][1] > 0
    assert not torque[1].any()


def test_models_add_up_and_the_topic_replaces_the_mean_only(scene):
    weather = (
        'wind:\n- {model: steady, velocity: [4, 0, 0]}\n'
        '- {model: gust, amplitude: [0, 2, 0], start: 0, length: 10, airspeed: 100}'
    )
    simulation = Simulation(scene(weather))
    simulation.step(100)  # 0.2 s: the gust rose over 0.1 s
    np.testing.assert_allclose(felt(simulation), [4, 2, 0])
    simulation.set_wind([0, 0, 1])
    simulation.step(500)  # at 10 m/s^2
    np.testing.assert_allclose(felt(simulation), [0, 2, 1])
    simulation.enable_wind(False)
    simulation.step(500)
    np.testing.assert_allclose(felt(simulation), 0)
    simulation.enable_wind(True)
    simulation.step(500)
    np.testing.assert_allclose(felt(simulation), [0, 2, 1])
    simulation.reset()
    np.testing.assert_allclose(felt(simulation), [4, 0, 0])


def test_currents_lie_below_winds_above(scene):
    weather = (
        'current: {model: stratified, velocity: [1, 0, 0], depths: [0, 10], factors: [1, 0.5]}\n'
        'wind: {model: logarithmic, velocity: [5, 0, 0], roughness: 2.0e-4}'
    )
    simulation = Simulation(scene(weather, SEA))
    assert simulation.streams == ('wind', 'current')
    for z, expected in ((-4, 0.8), (-20, 0.5), (10, 5.0)):
        simulation.data.qpos[2] = z
        np.testing.assert_allclose(felt(simulation), [expected, 0, 0], rtol=1e-12)


def test_a_tide_is_a_sum_of_harmonics(scene):
    weather = """current:
  model: tide
  constituents:
  - {name: M2, amplitude: [1.2, 0.3, 0], phase_deg: 40}
  - {period_hours: 6, amplitude: [0, 0.2, 0]}"""
    simulation = Simulation(scene(weather + '\n  \n', SEA.replace('9 9 9', '0 0 0')))
    simulation.data.qpos[2] = -3
    for hours in (0.0, 2.5, 9.0):
        simulation.data.time = 3600 * hours
        m2 = np.cos(np.deg2rad(28.9841042 * hours - 40))
        expected = [1.2 * m2, 0.3 * m2 + 0.2 * np.cos(2 * np.pi * hours / 6), 0]
        np.testing.assert_allclose(felt(simulation), expected, atol=1e-9)


def test_a_series_comes_from_a_csv_file_and_stays_with_the_scene(scene, tmp_path):
    (tmp_path / 'wind.csv').write_text('t, x, y, z, note\n0,1,0,0,a\n2,3,0,0,b\n4,2,1,0,c\n')
    path = scene('wind: {model: series, file: wind.csv}')
    loaded = Scene.load(path)
    (tmp_path / 'wind.csv').unlink()
    simulation = Simulation(loaded)
    simulation.step(1000)
    np.testing.assert_allclose(felt(simulation), [3, 0, 0], atol=1e-9)


def test_the_seed_makes_the_gusts_and_steps_of_any_size_meet_the_same(scene):
    path = scene(f'wind:\n- {{model: steady, velocity: [5, 0, 0]}}\n- {{{DRYDEN}, span: 0.5}}')
    runs = []
    for seed, timestep in ((3, 0.002), (3, 0.001), (4, 0.002)):
        simulation = Simulation(path, seed=seed, timestep=timestep)
        simulation.step(round(0.5 / timestep))
        simulation.data.qpos[:3] = [0, 0, 5]  # the gusts at one place
        mujoco.mj_forward(simulation.model, simulation.data)
        runs.append(felt(simulation))
    np.testing.assert_allclose(runs[0], runs[1], atol=1e-9)
    assert np.abs(runs[0] - runs[2]).min() > 1e-3


def test_saved_states_go_on_to_the_bit(scene):
    simulation = Simulation(scene(f'wind: {{{DRYDEN}}}'), seed=8)
    simulation.step(77)
    saved = simulation.save_state()
    simulation.step(200)
    there = simulation.data.qpos.copy()
    simulation.load_state(saved)
    simulation.step(200)
    np.testing.assert_array_equal(simulation.data.qpos, there)


def test_the_weather_blows_on_every_rung(scene):
    path = scene(f'wind: {{{DRYDEN}}}')
    for rung in ('inertia', 'ellipsoid'):
        assert Simulation(path, fluid=rung).flow_source == MEDIUM
    assert Simulation(path, fluid='none').flow_source == OPTION


def test_the_doctor_says_which_road(scene):
    rows = {row.name: row for row in examine_scene(scene(f'wind: {{{DRYDEN}}}'))}
    assert MEDIUM in rows['flow'].found
    assert rows['wind'].found == 'dryden'
    rows = {r.name: r for r in examine_scene(scene('wind: {model: steady, velocity: [1, 0, 0]}'))}
    assert rows['flow'].found == 'opt.wind: one velocity for the whole scene'
    broken = examine_scene(scene('wind: {model: steady, velocity: [1, 0]}'))
    assert broken[0].state == 'broken'


BAD = {
    'wind: {model: storm}': ["key 'wind.0.model'", "'storm' is not known", 'dryden'],
    'wind: {velocity: [1, 0, 0]}': ["missing key 'wind.0.model'"],
    'wind: {model: dryden, wind_6m: 5, height: 5, airspeed: 0}': ['wind.0.airspeed', 'greater'],
    'wind: {model: dryden, wind_6m: 5, length: [5, -2, 5], airspeed: 1}': ['wind.0.length.1'],
    'wind: {model: dryden, height: 5, airspeed: 1}': ['wind.0', 'either wind_6m'],
    'wind: {model: von_karman, sigma: [1, 1, 1], airspeed: 1}': ['either height'],
    'wind: {model: dryden, wind_6m: 5, height: 5, airspeed: 1, hight: 3}': ['hight', 'allowed'],
    'wind: {model: gust, amplitude: [1, 0, 0], length: .nan, airspeed: 2}': ['finite'],
    'wind: {model: logarithmic, velocity: [1, 0, 0], roughness: 20}': ['above the roughness'],
    'current: {model: tide, constituents: [{name: M9, amplitude: [1, 0, 0]}]}': ['M9', 'M2'],
    'current: {model: steady, velocity: [1, 0, 0]}': ["key 'current'", 'it has: wind'],
    'wind: [{model: steady, velocity: [1, 0, 0]}, {model: power_law, velocity: [1, 0, 0]}]': [
        'steady and power_law', 'one mean flow at most',
    ],
    'wind: {model: series, times: [0, 2, 1], velocities: [[1,0,0], [1,0,0], [1,0,0]]}': ['rise'],
    'wind: {model: series}': ['needs a file'],
    'wind: {model: series, file: none.csv}': ['none.csv', 'no such file'],
}  # fmt: skip


@pytest.mark.parametrize('weather', BAD)
def test_bad_weather_is_one_line(scene, weather):
    with pytest.raises(ConfigError) as caught:
        Simulation(scene(weather))
    line = str(caught.value)
    assert '\n' not in line
    for word in BAD[weather]:
        assert word in line


@pytest.mark.parametrize(
    ('text', 'words'),
    [
        ('t,x,y\n0,1,1\n', ["no column 'z'", 't, x, y']),
        ('t,x,y,z\n0,1,1,1\n1,,1,1\n', ['line 3', "column 'x'", 'a gap']),
        ('t,x,y,z\n0,1,1,1\n1,1,1\n', ['line 3', "column 'z'", 'a gap']),
        ('t,x,y,z\n0,1,nan,1\n1,1,1,1\n', ['line 2', "column 'y'", 'not finite']),
        ('t,x,y,z\n0,1,1,1\n1,1,one,1\n', ['line 3', 'one']),
        ('t,x,y,z\n2,1,1,1\n1,1,1,1\n', ['rise', '1 after 2']),
        ('t,x,y,z\n0,1,1,1\n', ['1 rows', 'two or more']),
        ('', ["no column 't'"]),
    ],
)
def test_a_bad_csv_is_one_line(scene, tmp_path, text, words):
    (tmp_path / 'wind.csv').write_text(text)
    with pytest.raises(ConfigError) as caught:
        Scene.load(scene('wind: {model: series, file: wind.csv}'))
    line = str(caught.value)
    assert '\n' not in line
    for word in ('wind.csv', *words):
        assert word in line
