# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Models of others: other units, names that become the same, bodies without a name."""

import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.errors import ModelError

FREE = '<body {}><freejoint/><geom size=".1"/></body>'


@pytest.fixture
def write(tmp_path):
    def model(*bodies, option=''):
        path = tmp_path / 'model.xml'
        path.write_text(
            f'<mujoco><option {option}/><worldbody>{"".join(bodies)}</worldbody></mujoco>'
        )
        return path

    return model


@pytest.mark.parametrize(
    ('gravity', 'words'),
    [
        ('0 0 -981', 'the model seems to be in centimetres'),
        ('0 0 -9810', 'the model seems to be in millimetres'),
        ('0 0 -386.1', 'the model seems to be in inches'),
        ('0 -32.2 0', 'the model seems to be in feet'),
        ('0 0 -100', 'is the model in metres?'),
    ],
)
def test_a_model_in_other_units_is_said_not_to_be_in_metres_and_newtons(write, gravity, words):
    path = write(FREE.format('name="a"'), option=f'gravity="{gravity}"')
    (line,) = Simulation(path).warnings.lines
    assert words in line and 'metres, kilograms, seconds and newtons' in line


@pytest.mark.parametrize('gravity', ['0 0 0', '0 0 -9.81', '0 0 -1.62', '0 0 -24.79'])
def test_gravity_of_the_planets_is_in_metres(write, gravity):
    path = write(FREE.format('name="a"'), option=f'gravity="{gravity}"')
    assert Simulation(path).warnings.lines == []


@pytest.mark.parametrize('pair', [('uav/1', 'uav_1'), ('uav 1', 'uav-1')])
def test_two_vehicles_whose_names_become_the_same_are_refused(write, pair):
    path = write(*(FREE.format(f'name="{name}" pos="{i} 0 0"') for i, name in enumerate(pair)))
    with pytest.raises(ModelError, match="both become the vehicle 'uav_1'; rename one") as caught:
        Simulation(path)
    assert all(repr(name) in str(caught.value) for name in pair)
    scene = path.with_suffix('.yaml')
    scene.write_text(
        f'model: model.xml\nvehicles: {{a: {{body: "{pair[0]}"}}, b: {{body: "{pair[1]}"}}}}\n'
    )
    assert list(Simulation(scene).vehicles) == ['a', 'b']


def test_a_nameless_free_body_is_scenery_and_said_so(write):
    nameless = FREE.format('pos="1 0 0"')
    simulation = Simulation(write(FREE.format('name="a"'), nameless))
    assert list(simulation.vehicles) == ['a']
    (line,) = simulation.warnings.lines
    assert line == 'one free body has no name: left out as scenery; a vehicle needs a name'
    simulation.step(10)
    both = Simulation(write(FREE.format('name="a"'), nameless, FREE.format('pos="2 0 0"')))
    assert both.warnings.lines[0].startswith('2 free bodies have no name')


def test_only_nameless_free_bodies_are_no_vehicle(write):
    with pytest.raises(ModelError, match='the bodies with a free joint have no names, so there'):
        Simulation(write(FREE.format('')))


@pytest.mark.parametrize('fluid', ['none', 'inertia', 'ellipsoid', 'no_added_mass'])
def test_a_nameless_body_with_a_plugin_on_every_fluid_rung(tmp_path, fluid):
    path = tmp_path / 'model.xml'
    path.write_text("""<mujoco><option density="1000" viscosity="1e-3"/>
      <extension><plugin plugin="fluid_sim.body"/></extension>
      <worldbody><body name="a" simple="false"><freejoint/><geom size=".1" fluidshape="ellipsoid"/>
        <body pos=".3 0 0" simple="false"><joint axis="0 1 0"/>
          <geom size=".05" fluidshape="ellipsoid"/>
          <plugin plugin="fluid_sim.body"><config key="volume" value="auto"/>
            <config key="added_mass" value="auto"/></plugin>
        </body></body></worldbody></mujoco>""")
    simulation = Simulation(path, fluid=fluid)
    simulation.step(10)
    nameless = simulation.model.nbody - 1
    kept_afloat = fluid != 'no_added_mass'
    assert bool(simulation.model.body_gravcomp[nameless]) == kept_afloat
