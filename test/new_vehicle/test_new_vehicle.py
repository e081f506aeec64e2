# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""New vehicles: whatever mass, size and layout, the files load and it hovers or floats at once."""

import json
import tempfile
from pathlib import Path

import mujoco
import numpy as np
import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import trapezoid

from fluid_sim_ros import Scene, Simulation, cli
from fluid_sim_ros.errors import ConfigError, FluidSimError
from fluid_sim_ros.new_vehicle.design import hover_thrusts
from fluid_sim_ros.new_vehicle.files import design_vehicle, write_vehicle
from fluid_sim_ros.new_vehicle.layout import PRESETS

AIR = [name for name, (medium, _) in PRESETS.items() if medium == 'air']
WATER = [name for name, (medium, _) in PRESETS.items() if medium == 'water']
QUAD = {'name': 'q', 'medium': 'air', 'mass': 2.0, 'size': (0.4, 0.4, 0.1), 'thrusters': 'quad'}
ROV = {'name': 'r', 'medium': 'water', 'mass': 11.0, 'size': (0.5, 0.4, 0.3),
       'thrusters': 'vectored6'}  # fmt: skip

sides = st.tuples(*[st.floats(0.3, 1.0)] * 3)
lengths = st.floats(-1.5, 0.5).map(lambda exponent: 10**exponent)  # .03 to 3 m


def made(**values):
    """Return a new vehicle in a folder that is gone afterwards, and its simulation."""
    with tempfile.TemporaryDirectory() as folder:
        vehicle = write_vehicle(design_vehicle(**values), Path(folder))
        return vehicle, Simulation(vehicle.scene)


def refusal(**values):
    with pytest.raises(ConfigError) as error:
        design_vehicle(**values)
    assert '\n' not in str(error.value)
    return str(error.value)


@settings(max_examples=25, deadline=None)
@given(lengths, sides, st.floats(20, 800), st.sampled_from(AIR))
def test_in_air_it_hovers_at_once(length, shape, density, layout):
    size = tuple(length * side for side in shape)
    mass = density * float(np.prod(size))
    vehicle, simulation = made(name='v', medium='air', mass=mass, size=size, thrusters=layout)
    assert vehicle.drift < 1e-6
    assert vehicle.design.hover.sum() == pytest.approx(mass * 9.81, rel=1e-9)
    np.testing.assert_allclose(simulation.data.ctrl[: len(vehicle.design.hover)],
                               vehicle.design.hover, rtol=1e-11)  # fmt: skip
    simulation.step(1000)
    assert np.abs(simulation.data.qvel).max() < 1e-6
    assert simulation.model.body_mass[1] == pytest.approx(mass, rel=1e-11)


@settings(max_examples=25, deadline=None)
@given(lengths, sides, st.floats(50, 1000), st.sampled_from(WATER), st.floats(-0.04, 0.04))
def test_in_water_it_floats_or_moves_by_its_buoyancy(length, shape, density, layout, share):
    size = tuple(length * side for side in shape)
    mass = density * float(np.prod(size))
    buoyancy = min(share, 0.999 * (1000 / density - 1)) * mass * 9.81
    values = {'name': 'v', 'medium': 'water', 'mass': mass, 'size': size, 'thrusters': layout}
    neutral, simulation = made(**values)
    assert neutral.drift < 1e-6
    simulation.data.qpos[3:7] = (np.cos(0.1), np.sin(0.1), 0, 0)
    simulation.step()
    assert simulation.data.qvel[3] < 0  # it rights itself

    _, simulation = made(**values, buoyancy=buoyancy)
    mujoco.mj_forward(simulation.model, simulation.data)
    force, _ = simulation.wrench('v')['buoyancy']
    assert force[2] - mass * 9.81 == pytest.approx(buoyancy, abs=1e-8 * mass)


@pytest.mark.parametrize('layout', PRESETS)
def test_every_preset_reaches_what_it_is_for(layout):
    medium = PRESETS[layout][0]
    values = QUAD if medium == 'air' else ROV
    design = design_vehicle(**{**values, 'thrusters': layout})
    matrix = np.array([thruster.wrench() for thruster in design.thrusters]).T
    rank = {'vectored8': 6, 'vectored6': 5, 'torpedo': 1}.get(layout, 4)  # it steers by fins
    assert np.linalg.matrix_rank(matrix, tol=1e-6) == rank
    above = [thruster.position[:2] for thruster in design.thrusters if thruster.spin]
    for i, place in enumerate(above):
        for other in above[:i]:
            assert np.linalg.norm(place - other) > design.thrusters[0].diameter


def test_quad_has_the_order_and_turn_of_px4():
    turns = [(np.sign(t.position[:2]).tolist(), t.spin)
             for t in design_vehicle(**QUAD).thrusters]  # fmt: skip
    assert turns == [([1, -1], 1), ([-1, 1], 1), ([1, 1], -1), ([-1, -1], -1)]


def list_file(folder, *thrusters):
    path = folder / 'thrusters.yaml'
    path.write_text(yaml.safe_dump({'thrusters': list(thrusters)}))
    return str(path)


def rotor(name, x, y, **more):
    return {'name': name, 'position': [x, y, 0], 'direction': [0, 0, 1], 'max_thrust': 9, **more}


def test_an_own_list_with_unequal_arms_hovers_balanced(tmp_path):
    """Two in front, one behind three times as far: the rear one carries a quarter."""
    source = list_file(
        tmp_path, rotor('left', 0.1, 0.2), rotor('right', 0.1, -0.2),
        rotor('rear', -0.3, 0, time_constant=0),
    )  # fmt: skip
    vehicle, simulation = made(**{**QUAD, 'mass': 1.6, 'thrusters': source})
    np.testing.assert_allclose(vehicle.design.hover / (1.6 * 9.81), [3 / 8, 3 / 8, 1 / 4])
    assert vehicle.drift < 1e-6
    assert simulation.vehicles['q'].thrusters == ('left', 'right', 'rear')


def test_limits_are_kept_where_the_least_norm_would_not(tmp_path):
    """A weak pair in the middle beside a strong one: together just enough."""
    places = [(0.2, 0), (-0.2, 0), (0.1, 0.0), (-0.1, 0.0)]
    strength = [2.0, 2.0, 9.0, 9.0]
    source = list_file(
        tmp_path,
        *[{**rotor(f'm{i}', x, y), 'max_thrust': f}
          for i, ((x, y), f) in enumerate(zip(places, strength, strict=True))],
    )  # fmt: skip
    design = design_vehicle(**{**QUAD, 'thrusters': source})
    assert (design.hover <= np.array(strength) + 1e-12).all()
    assert design.hover.sum() == pytest.approx(2 * 9.81, rel=1e-9)


@pytest.mark.parametrize(
    ('change', 'words'),
    [
        ({'mass': 0}, '--mass 0: must be above 0'),
        ({'mass': float('nan')}, 'must be above 0'),
        ({'size': (0.4, 0, 0.1)}, 'all three must be above 0'),
        ({'mass': 1000}, r'62500 kg/m^3, denser than any metal (22590); give at most 361.4 kg'),
        ({'mass': 0.01}, 'lighter than air (1.225); give more than 0.0196 kg'),
        ({'buoyancy': 3}, '--buoyancy is for water'),
        ({'max_thrust': 4}, 'hover needs 19.62 N upward and the thrusters give at most 16 N: '
                            '3.62 N short'),
        ({'max_thrust': -1}, '--max-thrust -1: must be above 0'),
        ({'thrusters': 'vectored6'}, 'is for water; for air: quad, hexa, octo'),
        ({'thrusters': 'tri'}, "'tri' is no preset; allowed: quad, hexa"),
        ({'thrusters': 'none.yaml'}, 'none.yaml: no such file'),
        ({'name': '2x'}, 'a letter first'),
        ({'name': 'world'}, 'not world'),
    ],
)  # fmt: skip
def test_what_cannot_be_is_refused_with_one_line(change, words):
    assert words in refusal(**{**QUAD, **change})


def test_a_vehicle_too_heavy_for_its_size_says_by_how_much():
    line = refusal(**{**ROV, 'mass': 75.0})
    assert 'displace 75 kg of water, and the whole box displaces 60 kg; 15 kg too heavy' in line
    assert '--buoyancy -147.2 N at most' in line
    assert 'more than -107.9 N' in refusal(**{**ROV, 'buoyancy': -200.0})


@pytest.mark.parametrize(
    ('entry', 'words'),
    [
        ({'max_thrust': 0}, "key 'thrusters.0.max_thrust'"),
        ({'position': [0, 1]}, "key 'thrusters.0.position'"),
        ({'direction': [0, 0, 0]}, "key 'thrusters.0.direction': is 0 0 0"),
        ({'spin': 'left'}, "key 'thrusters.0.spin'"),
        (
            {'thrust': 3},
            "'thrusters.0.thrust'; did you mean 'max_thrust'? allowed: name",
        ),
    ],
)
def test_a_malformed_list_names_file_and_key(tmp_path, entry, words):
    source = list_file(tmp_path, {**rotor('a', 0, 0), **entry})
    line = refusal(**{**QUAD, 'thrusters': source})
    assert line.startswith(source)
    assert words in line


def test_other_faults_of_a_list(tmp_path):
    twice = list_file(tmp_path, rotor('a', 0.1, 0), rotor('a', -0.1, 0))
    assert "the name 'a' stands twice" in refusal(**{**QUAD, 'thrusters': twice})
    taken = list_file(tmp_path, rotor('imu', 0.1, 0))
    assert "the name 'imu' is taken" in refusal(**{**QUAD, 'thrusters': taken})
    nothing = list_file(tmp_path)
    assert 'thrusters' in refusal(**{**QUAD, 'thrusters': nothing})
    lopsided = list_file(tmp_path, rotor('a', 0.1, 0, max_thrust=30))
    assert 'hover is impossible with this layout' in refusal(**{**QUAD, 'thrusters': lopsided})
    with pytest.raises(ConfigError, match='goes with a preset'):
        design_vehicle(**{**QUAD, 'thrusters': lopsided, 'max_thrust': 3.0})


def test_damping_of_the_box_is_that_of_its_strips():
    """rho/2 C_d |w x r| (w x r) r summed over strips of the faces that a turn about z moves."""
    design = design_vehicle(**ROV)
    length, width, height = design.size
    turn = 0.0
    for side in (length, width):
        strips = np.linspace(-side / 2, side / 2, 2001)
        turn += 0.5 * 1000 * height * trapezoid(np.abs(strips) ** 3, strips)
    assert design.quadratic_damping[5] == pytest.approx(turn, rel=1e-5)
    assert design.quadratic_damping[0] == pytest.approx(500 * width * height)


def test_what_does_not_load_leaves_nothing_behind(tmp_path):
    flea = design_vehicle(**{**QUAD, 'mass': 1e-9, 'size': (1e-4, 1e-4, 1e-4)})  # kg, m
    with pytest.raises(FluidSimError):
        write_vehicle(flea, tmp_path / 'flea')
    assert not (tmp_path / 'flea').exists()


def test_hover_of_nothing_to_lift():
    design = design_vehicle(**QUAD)
    np.testing.assert_allclose(hover_thrusts(design.thrusters, 0.0), 0, atol=1e-12)


@pytest.mark.parametrize(('medium', 'layout'), [('air', 'quad'), ('water', 'vectored6')])
def test_the_rung_inflow_takes_thrust_off_a_new_vehicle_that_moves(tmp_path, medium, layout):
    density = 100 if medium == 'air' else 900
    design = design_vehicle(
        name='v', medium=medium, mass=density * 0.5 * 0.4 * 0.3, size=(0.5, 0.4, 0.3),
        thrusters=layout,
    )  # fmt: skip
    scene = write_vehicle(design, tmp_path).scene
    rises = []
    for fluid in (None, 'inflow'):
        simulation = Simulation(scene, fluid=fluid)
        highest = simulation.vehicles['v'].thrust_range[:, 1]
        simulation.set_thrust('v', 0.9 * highest)
        simulation.step(1000)
        rises.append(np.linalg.norm(simulation.data.qvel[:3]))
    assert 0.2 * rises[0] < rises[1] < 0.99 * rises[0]


def test_every_guess_is_marked_and_the_files_are_plain(tmp_path):
    vehicle = write_vehicle(design_vehicle(**ROV), tmp_path)
    text = (tmp_path / 'r.xml').read_text()
    assert text.count('guess') >= 6
    assert max(map(len, text.splitlines())) < 120
    scene = Scene.load(vehicle.scene)
    assert scene.medium == 'water'
    assert scene.compile().streams == ('wind', 'current')


def test_the_command(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    command = ['new-vehicle', 'bee', '--medium', 'air', '--mass', '0.5', '--size', '.2', '.2',
               '.06', '--thrusters', 'hexa']  # fmt: skip
    assert cli.main([*command, '--json', '-']) == 0
    result = json.loads(capsys.readouterr().out)
    assert result['files'] == ['bee/bee.yaml', 'bee/bee_vehicle.yaml', 'bee/bee.xml']
    assert sum(result['hover_n']) == pytest.approx(0.5 * 9.81)
    assert result['drift_m'] < 1e-9

    assert cli.main(command) == 2  # nothing is overwritten
    assert 'bee/bee.yaml: exists; give another --out, or --force' in capsys.readouterr().err
    assert cli.main([*command, '--force']) == 0
    assert 'next: fluid_sim run bee/bee.yaml' in capsys.readouterr().out
    assert cli.main(['run', 'bee/bee.yaml', '--duration', '1', '--json', '-']) == 0
    assert json.loads(capsys.readouterr().out)['vehicles']['bee']['position_w_m'][2] > 1
