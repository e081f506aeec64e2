# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Scene files: what loads, and the one line that each fault gives."""

import numpy as np
import pytest

from fluid_sim_ros import Scene, Simulation, scene_names
from fluid_sim_ros.errors import ConfigError, ModelError
from fluid_sim_ros.schema.settings import RunSettings

MODEL = """
<mujoco>
  <option density="1000" viscosity="1e-3" timestep="0.002"/>
  <worldbody>
    <body name="boat"><freejoint/>
      <geom name="hull" type="ellipsoid" size=".3 .2 .1" fluidshape="ellipsoid"/>
      <site name="s1"/><site name="s2"/>
      <body pos=".4 0 0"><joint name="fin" axis="0 0 1"/><geom size=".02"/></body>
    </body>
  </worldbody>
  <actuator>
    <motor name="m1" site="s1" gear="0 0 1 0 0 0" ctrllimited="true" ctrlrange="-2 3"/>
    <motor name="m2" site="s2" gear="1 0 0 0 0 0"/>
    <position name="fin" joint="fin" ctrllimited="true" ctrlrange="-1 1"/>
  </actuator>
  <keyframe><key name="deep" qpos="0 0 -5 1 0 0 0 0"/></keyframe>
</mujoco>
"""


@pytest.fixture
def model(tmp_path):
    path = tmp_path / 'boat.xml'
    path.write_text(MODEL)
    return path


@pytest.fixture
def write_scene(model):
    def write(text):
        path = model.with_name('scene.yaml')
        path.write_text(text)
        return path

    return write


def test_every_named_scene_compiles_with_at_least_one_vehicle():
    assert {'sphere', 'quadrotor', 'rov', 'swimmer'} <= set(scene_names())
    for name in scene_names():
        compiled = Scene.load(name).compile()
        assert compiled.vehicles, name


def test_unknown_scene_lists_the_known_ones():
    line = r"scene 'rovv' is not known; did you mean 'rov'\? scenes: .*\brov\b"
    with pytest.raises(ConfigError, match=line):
        Scene.load('rovv')


def test_a_bare_model_has_its_free_bodies_as_vehicles(model):
    compiled = Scene.load(model).compile()
    boat = compiled.vehicles['boat']
    assert boat.thrusters == ('m1', 'm2')
    assert boat.joints == ('fin',)
    np.testing.assert_array_equal(boat.thrust_range, [[-2, 3], [-np.inf, np.inf]])
    assert compiled.streams == ('current',)


def test_yaml_names_vehicle_thrusters_and_keyframe(write_scene):
    scene = Scene.load(write_scene(
        'model: boat.xml\nkeyframe: deep\nvehicles: {b: {body: boat, thrusters: [m2, m1]}}\n'
        'schedule: [{at: 1e-1, current: [1, 0, 0]}]'
    ))  # fmt: skip
    compiled = scene.compile()
    assert compiled.vehicles['b'].thrusters == ('m2', 'm1')
    assert Simulation(scene).data.qpos[2] == compiled.model.key('deep').qpos[2]
    assert compiled.schedule.next_step == 50


@pytest.mark.parametrize(
    ('text', 'line'),
    [
        (
            'model: boat.xml\nintegrator: foo',
            r"scene\.yaml: key 'integrator': 'foo' is not known; allowed: euler, rk4",
        ),
        ('model: boat.xml\nfluid: foo', r"scene\.yaml: key 'fluid': 'foo' is not known; allowed:"),
        ('model: boat.xml\ntimestep: 0', r"scene\.yaml: key 'timestep': must be greater"),
        ('modle: boat.xml', r"unknown key 'modle'; allowed: model, description|missing key"),
        ('model: boat.xml\nmedium: lava', r"key 'medium'.*'air' or 'water'"),
        ('model: boat.xml\nduration: .nan', r"key 'duration': must be finite"),
        ('model: boat.xml\nduration: yes', r"key 'duration': must be a number"),
        ('model: nowhere', r"key 'model': no model 'nowhere'; models: "),
        ('model: boat.xml\nmodel: boat.xml', r"key 'model' stands twice"),
        ('model: [boat', 'not valid YAML'),
        ('- a list', 'must be a mapping with the keys: model'),
        ('model: boat.xml\nvehicles: {9x: {body: boat}}', '9x'),
        ('model: boat.xml\nvehicles: {b: nobody}', "vehicle file 'nobody' is not known"),
        ('model: boat.xml\nvehicles: {b: {body: boat, mass: 3}}', "unknown key 'vehicles.b.mass'"),
        ('model: boat.xml\nschedule: [{at: 1}]', 'changes nothing; allowed: wind, current'),
        ('model: boat.xml\nschedule: [{at: 1, wind: [1, 2]}]', "key 'schedule.0.wind'"),
    ],
)
def test_a_fault_in_the_yaml_is_one_line_with_file_and_key(write_scene, text, line):
    with pytest.raises(ConfigError, match=line) as caught:
        Scene.load(write_scene(text))
    assert '\n' not in str(caught.value)
    assert 'scene.yaml' in str(caught.value)


@pytest.mark.parametrize(
    ('text', 'line'),
    [
        ('vehicles: {b: {body: ship}}', "body 'ship' is not in the model; it has: boat"),
        ('vehicles: {b: {body: boat, thrusters: [m9]}}', "actuator 'm9' .*it has: m1, m2, fin"),
        ('vehicles: {b: {body: boat, thrusters: [m1, m1]}}', 'stands twice'),
        ('keyframe: up', "keyframe 'up' is not in the model; it has: deep"),
        ('schedule: [{at: 1, thrust: {x: [1]}}]', "vehicle 'x' is not in the scene; it has: boat"),
        ('schedule: [{at: 1, thrust: {boat: [1]}}]', 'has 1 values; it needs 2'),
        ('gait: {x: {frequency: 1, amplitudes: [1], phases: [0]}}', "gait: vehicle 'x' is not in"),
        ('gait: {boat: {frequency: 1, amplitudes: [1, 2], phases: [0, 0]}}', 'each of: fin'),
        (
            'gait: {boat: {frequency: 1, amplitudes: [1], phases: [0], rate: 3333}}',
            'rate 3333 Hz is above the step rate',
        ),
    ],
)
def test_a_name_that_the_model_lacks_is_named_with_those_it_has(write_scene, text, line):
    with pytest.raises(ConfigError, match=line):
        Scene.load(write_scene(f'model: boat.xml\n{text}')).compile()


def test_an_actuator_without_a_name_is_told_of(tmp_path):
    path = tmp_path / 'a.xml'
    path.write_text(
        '<mujoco><worldbody><body name="b"><freejoint/><geom size=".1"/><site name="s"/></body>'
        '</worldbody><actuator><motor site="s" gear="1 0 0 0 0 0"/></actuator></mujoco>'
    )
    with pytest.raises(ConfigError, match=r"vehicle 'b': one of its actuators has no name"):
        Scene.load(path).compile()


def test_a_model_without_a_free_body_says_so(tmp_path):
    path = tmp_path / 'fixed.xml'
    path.write_text(
        '<mujoco><worldbody><body name="b"><geom size="1"/></body></worldbody></mujoco>'
    )
    with pytest.raises(ModelError, match='no body with a free joint'):
        Scene.load(path).compile()


def test_a_broken_model_is_one_line(tmp_path):
    path = tmp_path / 'broken.xml'
    path.write_text('<mujoco><worldbody><body nam="b"/></worldbody></mujoco>')
    with pytest.raises(
        ModelError, match=r"broken\.xml: .*unrecognized attribute: 'nam'"
    ) as caught:
        Scene.load(path).compile()
    assert '\n' not in str(caught.value)


def test_missing_files_are_named(tmp_path):
    with pytest.raises(ConfigError, match='no such MJCF file'):
        Scene.load(tmp_path / 'gone.xml')
    with pytest.raises(ConfigError, match='no such file'):
        Scene.load(tmp_path / 'gone.yaml')


@pytest.mark.parametrize(
    ('options', 'line'),
    [
        (
            {'integrator': 'rk5'},
            "integrator: 'rk5' is not known; allowed: euler, rk4",
        ),
        ({'fluid': 'honey'}, "fluid: 'honey' is not known; allowed: none, inertia, ellipsoid"),
        ({'timestep': -1.0}, 'timestep: must be greater than 0'),
        ({'timestep': float('nan')}, 'timestep: must be finite'),
        ({'seed': 1.5}, 'seed: must be a valid integer'),
    ],
)
def test_a_wrong_option_is_refused(model, options, line):
    with pytest.raises(ConfigError, match=line):
        Scene.load(model).compile(RunSettings.checked(**options))


def test_fluid_rungs_switch_the_models(model):
    scene = Scene.load(model)
    assert scene.compile(RunSettings(fluid='none')).model.opt.density == 0
    assert not scene.compile(RunSettings(fluid='inertia')).model.geom_fluid[:, 0].any()
    assert scene.compile(RunSettings(fluid='ellipsoid')).model.geom_fluid[0, 0] == 1


@pytest.mark.parametrize('name', ['model', 'model.txt', 'model.obj', 'model.json', 'picture.png'])
def test_a_file_that_is_no_model_leaves_no_log_of_mujoco(tmp_path, monkeypatch, capfd, name):
    monkeypatch.chdir(tmp_path)
    (tmp_path / name).write_text('hello')
    with pytest.raises(
        ConfigError, match=r'is no model; allowed: \.xml, \.mjcf, \.urdf'
    ) as caught:
        Scene.load(name).compile()
    assert str(caught.value).startswith(f'{name}: ')
    assert [path.name for path in tmp_path.iterdir()] == [name]
    assert capfd.readouterr() == ('', '')


def test_times_that_no_timestep_divides_are_rounded_and_told(write_scene):
    scene = Scene.load(write_scene(
        'model: boat.xml\nschedule: [{at: 0.0015, wind: [1, 0, 0]}]\n'
        'gait: {boat: {frequency: 1, amplitudes: [1], phases: [0], rate: 333}}'
    ))  # fmt: skip
    compiled = scene.compile()
    assert compiled.schedule.next_step == 1
    event, gait = compiled.rounded
    assert event.startswith('schedule at 0.0015: 0.0015 s is not a whole number of timesteps')
    assert gait.startswith("gait of 'boat': rate 333 Hz does not divide the step rate of 500 Hz")
    assert set(compiled.rounded) <= set(compiled.warnings)
