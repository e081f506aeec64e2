# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What holds a vehicle is no flight, what floats is; and the recorded wind acts as it changes."""

import numpy as np
import pytest

from fluid_sim_ros.cli import main
from fluid_sim_ros.flights.flight import FlightError
from fluid_sim_ros.flights.reader import read_flight
from fluid_sim_ros.reality.airborne import CARRIED, ON_GROUND
from fluid_sim_ros.reality.compare import Part, compare
from fluid_sim_ros.resources import models_folder
from test.support.flight_logs import csv_text
from test.support.flown import thrust_scaled, x500_table

PART = Part(horizons=(0.25,))
#: Speed of the rotors of an x500 that hovers [rad/s].
HOVER = 769.6


@pytest.fixture(scope='module')
def flown():
    return x500_table(seconds=2.0)


def before(table, seconds=4.0, speed=0.0, rotors=100.0):
    """Return a table that begins with a time at rest, or pulled along x."""
    count = round(seconds / 0.01)
    rest = {name: np.full(count, values[0]) for name, values in table.items()}
    rest['time'] = np.arange(count) * 0.01
    rest['position_x'] = table['position_x'][0] + speed * (rest['time'] - seconds)
    rest['velocity_x'] = np.full(count, speed)
    for name, value in zip('xyz', (0.0, 0.0, 9.81), strict=True):
        rest[f'specific_force_{name}'] = np.full(count, value)
    for i in range(1, 5):
        rest[f'rotor_speed_{i}'] = np.full(count, rotors)
    out = {name: np.concatenate([rest[name], table[name]]) for name in table}
    out['time'][count:] += seconds
    return out


def flight_of(tmp_path, table):
    path = tmp_path / 'flight.csv'
    path.write_text(csv_text(table))
    return read_flight(path)


@pytest.mark.parametrize(('rest', 'reason'), [
    ({}, ON_GROUND), ({'speed': 0.5}, CARRIED), ({'rotors': HOVER}, None),
    ({'rotors': 0.6 * HOVER}, ON_GROUND),
])  # fmt: skip
def test_what_holds_the_vehicle_is_left_out_and_hover_is_not(tmp_path, flown, rest, reason):
    found = compare(flight_of(tmp_path, before(flown, **rest)), 'x500', part=PART)

    left, words = found.numbers['windows']['left_out'], found.numbers['words']
    if reason is None:
        assert not left
    else:
        assert 70 <= left[reason] <= 80  # of 4 s, every 50 ms
    assert not any('along z the model gives' in line or '% too' in line for line in words), words


def test_a_model_that_is_far_too_weak_is_no_ground(tmp_path, flown):
    flight = flight_of(tmp_path, before(flown, rotors=HOVER))

    found = compare(flight, 'x500', part=PART, edit=thrust_scaled(0.45))

    assert found.numbers['windows']['left_out'] == {}
    assert any(line.startswith('along z the model gives 0.45') for line in found.numbers['words'])


def test_a_log_that_never_flies_is_one_line(tmp_path, flown):
    rest = {name: values[:400] for name, values in before(flown).items()}

    with pytest.raises(FlightError, match=r'no window flies.*gives 2 % of the weight'):
        compare(flight_of(tmp_path, rest), 'x500', part=PART)


def test_a_vehicle_that_floats_at_rest_flies_and_says_nothing_of_its_thrust(tmp_path):
    times = np.arange(0, 3, 0.02)
    table = {'time': times} | {
        f'{name}_{axis}': np.zeros(len(times))
        for name in ('position', 'velocity', 'rates', 'attitude', 'specific_force')
        for axis in ('wxyz' if name == 'attitude' else 'xyz')
    }
    table['attitude_w'] += 1
    table['position_z'] -= 5
    table['specific_force_z'] += 9.81
    table |= {f'thrust_{i}': np.zeros(len(times)) for i in range(1, 9)}

    numbers = compare(flight_of(tmp_path, table), 'bluerov2_heavy', part=PART).numbers

    assert numbers['windows']['left_out'] == {}
    axes = numbers['residuals']['specific_force']['axes']
    assert all(axes[axis]['scale'] is None for axis in 'xyz')
    assert any('nothing can be said of thrust along z' in line for line in numbers['words'])
    assert any('drag along x, y, z' in line for line in numbers['words'])


@pytest.mark.parametrize(('model', 'weather', 'seconds', 'most'), [
    # a gust all at once, in air without a surface: the series of 100 Hz rounds its edges
    ('crazyflie', 'schedule: [{at: 0.5, wind: [2, 0, 0]}]', 1.3, 3e-5),
    # a current that changes throughout, above it air
    ('bluerov2', 'current: [{model: sine, amplitude: [0.4, 0, 0.1], period: 1.5}]', 1.3, 3e-4),
])  # fmt: skip
def test_a_recorded_flow_acts_once_and_as_it_changes(tmp_path, model, weather, seconds, most):
    scene = tmp_path / f'{model}.yaml'
    scene.write_text(
        f'model: {models_folder() / model}.xml\nvehicles: {{{model}: {model}}}\n'
        f'duration: {seconds}\n{weather}\n'
    )
    assert main(['run', str(scene), '--hold', '--record', str(tmp_path / 'log.mcap')]) == 0
    flight = read_flight(next(tmp_path.rglob('*.mcap')))

    found = compare(flight, model, part=PART)

    assert np.ptp(flight.signals['wind'].values, axis=0).max() > 0.5
    assert found.errors['velocity_m_s'].max() < most
