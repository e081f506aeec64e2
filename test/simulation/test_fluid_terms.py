# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A vehicle that feels no fluid is never silent: terms, warnings and refusals at load."""

import pytest

from fluid_sim_ros import Scene, Simulation, scene_names
from fluid_sim_ros.errors import CommandError, ConfigError

MEDIUM = """<extension>{plugins}<plugin plugin="fluid_sim.medium"><instance name="m">
  <config key="density" value="1000"/><config key="viscosity" value="1e-3"/>
</instance></plugin></extension>"""
HULL = '<geom type="ellipsoid" size=".3 .1 .1" {}/>'
ARM = '<body pos=".4 0 0" name="arm"><joint axis="0 1 0"/><geom size=".05"/></body>'


@pytest.fixture
def model(tmp_path):
    """Return a function that writes a model with a vehicle 'hull' and returns its path."""

    def write(option='', extension='', body='', hull='', beside='', head=''):
        path = tmp_path / 'model.xml'
        path.write_text(
            f'<mujoco><option {option}/>{extension}<worldbody>{beside}'
            f'<body name="hull" {head}><freejoint/>{HULL.format(hull)}{body}</body>'
            '</worldbody></mujoco>'
        )
        return path

    return write


def scene(path, text):
    file = path.with_suffix('.yaml')
    file.write_text(f'model: {path.name}\n{text}\n')
    return file


def test_terms_of_every_vehicle_are_known_at_load(model):
    assert Simulation('x500').terms == {'x500': ('drag', 'viscous')}
    assert Simulation('aerosonde').terms == {'aerosonde': ('foil',)}
    assert Simulation(model()).terms == {'hull': ()}
    assert Simulation('rov', fluid='none').terms == {'bluerov2_heavy': ()}


@pytest.mark.parametrize('name', scene_names())
def test_shipped_scenes_have_nothing_to_warn_of(name):
    simulation = Simulation(name)
    assert simulation.warnings.lines == []
    assert all(simulation.terms.values())


def test_a_vehicle_without_fluid_is_not_warned_of_in_vacuum(model):
    assert Simulation(model(body=ARM)).warnings.lines == []


def test_an_air_vehicle_with_stock_drag_in_a_scene_with_a_medium(model):
    simulation = Simulation(model(extension=MEDIUM.format(plugins='')))
    (line,) = simulation.warnings.lines
    assert line.startswith(
        "vehicle 'hull': no fluid acts on it, though the scene has a fluid_sim."
    )
    assert 'fluid_sim.body' in line and 'fluidshape="ellipsoid"' in line


def test_a_fluidshape_body_beside_a_medium_feels_it(model):
    path = model(
        'gravity="0 0 0"', extension=MEDIUM.format(plugins=''), hull='fluidshape="ellipsoid"'
    )
    simulation = Simulation(path)
    assert 'drag' in simulation.terms['hull'] and simulation.warnings.lines == []


def test_a_body_plugin_without_drag_beside_a_medium_feels_it(model):
    plugins = '<plugin plugin="fluid_sim.body"/>'
    own = '<plugin plugin="fluid_sim.body"><config key="volume" value="auto"/></plugin>'
    simulation = Simulation(
        model(extension=MEDIUM.format(plugins=plugins), body=own, head='simple="false"')
    )
    assert {'drag', 'buoyancy'} <= set(simulation.terms['hull'])


def test_stock_ellipsoids_whose_coefficients_are_zero(model):
    simulation = Simulation(
        model('density="1000"', hull='fluidshape="ellipsoid" fluidcoef="0 0 0 0 0"')
    )
    assert simulation.terms == {'hull': ('added_mass',)}


def test_a_heavy_arm_that_feels_nothing_is_named_with_its_share(model):
    path = model(
        'gravity="0 0 0"',
        extension=MEDIUM.format(plugins=''),
        hull='fluidshape="ellipsoid"',
        body=ARM,
    )
    (line,) = Simulation(path).warnings.lines
    assert 'no fluid acts on 1 of its 2 bodies: arm (4.0% of its mass)' in line


def test_a_free_body_beside_the_vehicle(model):
    crate = '<body name="crate" pos="9 0 0"><freejoint/><geom size=".1"/></body>'
    path = model(
        'gravity="0 0 0"',
        extension=MEDIUM.format(plugins=''),
        hull='fluidshape="ellipsoid"',
        beside=crate,
    )
    named = Simulation(scene(path, 'vehicles: {hull: {body: hull}}'))
    (line,) = named.warnings.lines
    assert line.startswith('free bodies beside the vehicles: no fluid acts on crate')
    # without a file every free body is a vehicle, and is told of as one
    assert "vehicle 'crate': no fluid acts on it" in Simulation(path).warnings.lines[0]


@pytest.mark.parametrize(('medium', 'stream'), [('air', 'wind'), ('water', 'current')])
def test_wind_and_current_on_density_0_by_command(model, medium, stream):
    simulation = Simulation(scene(model(), f'medium: {medium}'))
    command = getattr(simulation, f'set_{stream}')
    with pytest.raises(CommandError, match=f'{stream}: no body of the model feels the {stream}'):
        command([8, 0, 0])
    command([0, 0, 0])


@pytest.mark.parametrize(
    ('text', 'key'),
    [
        ('wind: {model: steady, velocity: [8, 0, 0]}', 'wind'),
        ('wind: [{model: sine, amplitude: [1, 0, 0], period: 2}]', 'wind'),
        ('schedule: [{at: 1, wind: [8, 0, 0]}]', 'schedule'),
    ],
)
def test_wind_on_density_0_in_a_scene_file(model, text, key):
    with pytest.raises(ConfigError, match=f"model: key '{key}': wind: no body of the model feels"):
        Simulation(scene(model(), f'medium: air\n{text}'))


def test_wind_in_option_on_density_0(model):
    (line,) = Simulation(model('wind="8 0 0"')).warnings.lines
    assert 'though the scene has wind' in line


def test_wind_on_a_medium_that_no_body_feels(model):
    simulation = Simulation(scene(model(extension=MEDIUM.format(plugins='')), 'medium: water'))
    with pytest.raises(CommandError, match='no body of the model feels the current'):
        simulation.set_current([1, 0, 0])


def test_the_fluid_none_is_meant_and_only_said():
    simulation = Simulation('rov', fluid='none')
    simulation.set_current([0.3, 0, 0])
    simulation.set_current([0.5, 0, 0])
    assert simulation.warnings.lines == ["current: no effect, since the setting 'fluid' is none"]
    name = 'quadrotor'
    assert any(event.wind for event in Scene.load(name).schedule)
    assert Simulation(name, fluid='none').warnings.lines[0].startswith('wind: no effect')


def test_a_rotor_that_drags_in_the_wind_feels_it_without_any_fluid():
    simulation = Simulation('x500', fluid='none')
    simulation.set_wind([5, 0, 0])
    assert simulation.warnings.lines == []


@pytest.mark.parametrize('keys', [
    {'option': 'density="1000"', 'hull': 'fluidshape="ellipsoid"'},
    {'extension': MEDIUM.format(plugins=''), 'hull': 'fluidshape="ellipsoid"'},
])  # fmt: skip
def test_a_vehicle_in_a_liquid_without_buoyancy(model, keys):
    (line,) = Simulation(model(**keys)).warnings.lines
    assert line.startswith("vehicle 'hull': no buoyancy acts on it in a density of 1000 kg/m^3")
    assert Simulation(model(**keys, head='gravcomp="1"')).warnings.lines == []
    assert (
        Simulation(model(**{'option': 'density="1.2"', 'hull': keys['hull']})).warnings.lines == []
    )
