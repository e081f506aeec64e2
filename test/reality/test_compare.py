# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A model against a flight of its own is at rounding; a wrong model is named for what is wrong."""

import json

import mujoco
import numpy as np
import pytest

from fluid_sim_ros.cli import main
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.flights.flight import FlightError
from fluid_sim_ros.flights.mapping import FlightMap
from fluid_sim_ros.flights.reader import read_flight
from fluid_sim_ros.plugins import load_plugins
from fluid_sim_ros.reality.compare import Part, compare
from fluid_sim_ros.reality.driven import without_air
from fluid_sim_ros.resources import models_folder
from test.support.flight_logs import csv_text
from test.support.flown import thrust_scaled, write_x500, x500_table

HORIZONS = (0.1, 0.5)


@pytest.fixture(scope='module')
def log(tmp_path_factory):
    return write_x500(tmp_path_factory.mktemp('flown') / 'x500.csv')


def test_the_models_own_flight_is_repeated(log):
    found = compare(read_flight(log), 'x500', part=Part(horizons=HORIZONS))
    numbers = found.numbers

    assert numbers['windows']['used'] > 50
    for horizon in ('0.1', '0.5'):
        errors = numbers['horizons'][horizon]
        assert set(errors) >= {'position_m', 'velocity_m_s', 'attitude_deg'}
        # rotor speeds between two samples are interpolated: a rounding of the log
        assert errors['position_m']['p90'] < 1e-3, errors
        assert errors['attitude_deg']['p90'] < 0.2
        held = numbers['baselines']['hold_velocity']['horizons'][horizon]
        assert errors['position_m']['median'] < 0.05 * held['position_m']['median']
    assert numbers['residuals']['specific_force']['z_rms_of_g'] < 1e-3
    assert numbers['words'][-1].startswith('specific force along z: 0.0 %')


def test_a_model_that_is_too_weak_is_said_to_be(log):
    found = compare(read_flight(log), 'x500', part=Part(horizons=(0.1,)), edit=thrust_scaled(0.92))

    assert 'the model is 9 % too weak along z' in found.numbers['words']


def test_without_a_fluid_drag_is_missing(log):
    from fluid_sim_ros.reality.driven import without_air

    found = compare(read_flight(log), 'x500', part=Part(horizons=(0.5,)), edit=without_air)

    assert any('drag is missing along x' in line for line in found.numbers['words'])
    rigid = found.numbers['baselines']['rigid_body']['horizons']['0.5']['position_m']['median']
    assert found.numbers['horizons']['0.5']['position_m']['median'] <= rigid + 1e-9


def test_commands_go_through_the_models_lag(tmp_path):
    columns = x500_table()
    speed = np.stack([columns.pop(f'rotor_speed_{i}') for i in range(1, 5)], axis=1)
    thrust = 8.54858e-6 * speed**2
    columns |= {f'thrust_{i + 1}': thrust[:, i] for i in range(4)}
    path = tmp_path / 'x500.csv'
    path.write_text(csv_text(columns))

    found = compare(read_flight(path), 'x500', part=Part(horizons=(0.1,)))

    assert found.numbers['driven_by'] == 'thrust'
    # the log holds what came out of the lag: once more through it is late, but not far off
    assert found.numbers['horizons']['0.1']['position_m']['median'] < 2e-3


def test_the_command_writes_json_a_picture_and_a_page(log, tmp_path, capsys):
    out = tmp_path / 'out'

    code = main([
        'compare', str(log), '--model', 'x500', '--horizons', '.1', '.25', '--out', str(out),
        '--json', str(tmp_path / 'numbers.json'),
    ])  # fmt: skip

    assert code == 0
    numbers = json.loads((tmp_path / 'numbers.json').read_text())
    assert set(numbers['horizons']) == {'0.1', '0.25'}
    assert (out / 'x500.png').stat().st_size > 10_000
    page = (out / 'x500.html').read_text()
    assert 'data:image/png;base64,' in page
    assert 'open-loop windows' in page
    assert 'hold velocity' in capsys.readouterr().out


@pytest.mark.parametrize(('changed', 'words'), [
    ({'vehicle': 'rov'}, "vehicle 'rov' of the mapping is not in scene 'x500'"),
    ({'thrusters': ['m1', 'm2', 'm3', 'm5']}, "thruster 'm4' of 'x500' has no column"),
])  # fmt: skip
def test_a_mapping_that_does_not_fit_the_model_is_one_line(log, changed, words):
    from fluid_sim_ros.flights.mapping import default_mapping

    mapping = FlightMap.model_validate(default_mapping('table').model_dump() | changed)

    with pytest.raises((ConfigError, FlightError), match=words):
        compare(read_flight(log, FlightMap.model_validate(
            {k: v for k, v in mapping.model_dump().items() if k != 'signals'}
            | {'signals': {k: v for k, v in mapping.model_dump()['signals'].items()
                           if k in ('position', 'attitude', 'velocity', 'rates', 'rotor_speed')}}
        )), 'x500')  # fmt: skip


def test_another_airframe_is_refused(tmp_path):
    columns = x500_table()
    del columns['rotor_speed_4']
    path = tmp_path / 'x500.csv'
    path.write_text(csv_text(columns))

    with pytest.raises(FlightError, match=r'has 3 columns in use.*another'):
        compare(read_flight(path), 'x500')


def test_speeds_in_the_wrong_unit_are_refused(tmp_path):
    columns = x500_table()
    columns |= {f'rotor_speed_{i}': columns[f'rotor_speed_{i}'] * 30 / np.pi for i in range(1, 5)}
    path = tmp_path / 'x500.csv'
    path.write_text(csv_text(columns))

    with pytest.raises(FlightError, match='see its unit'):
        compare(read_flight(path), 'x500')


def test_windows_longer_than_the_flight_are_refused(log):
    with pytest.raises(FlightError, match=r'no window of 9 s is whole'):
        compare(read_flight(log), 'x500', part=Part(horizons=(9.0,)))


def test_rotors_with_inflow_are_known_without_air():
    load_plugins()
    spec = mujoco.MjSpec.from_file(str(models_folder() / 'x500.xml'))
    assert any('inflow_law' in plugin.config for plugin in spec.plugins)
    without_air(spec)
    spec.option.density = 0
    assert spec.compile().nplugin == len(spec.plugins)
