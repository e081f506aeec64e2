# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A log that is late against its actuators is found out, by how much, and signal by signal."""

import numpy as np
import pytest

from fluid_sim_ros.cli import main
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.flights.flight import STATE
from fluid_sim_ros.flights.reader import read_flight
from fluid_sim_ros.reality.driven import comparable_scene
from fluid_sim_ros.reality.fit import fit
from fluid_sim_ros.reality.fitting.delays import in_time, longest, seen
from fluid_sim_ros.reality.fitting.solver import Task
from fluid_sim_ros.reality.parameters import find_parameters
from test.support.flight_logs import csv_text
from test.support.flown import x500_table

NOISE = {'position': 0.002, 'attitude': 0.001, 'velocity': 0.01, 'rates': 0.005}
DRAG = 8.06428e-5


@pytest.fixture(scope='module')
def flown():
    return x500_table(seconds=4.0, every=1)


def late(path, table, seconds, names=STATE, noise=True):
    """Write a flight at 100 Hz whose state was true some time before its stamp."""
    times, rng = table['time'][50::5], np.random.default_rng(7)
    columns = {'time': times}
    for name, values in table.items():
        block = name.rpartition('_')[0]
        if name != 'time':
            at = times - (seconds if block in names else 0.0)
            spread = NOISE.get(block, 0.0) if noise else 0.0
            columns[name] = np.interp(at, table['time'], values) + rng.normal(0, spread, len(at))
    path.write_text(csv_text(columns))
    return path


@pytest.mark.parametrize(('name', 'names', 'seconds'), [
    ('delay', STATE, 0.023),
    pytest.param('delay.rates', ('rates',), 0.0371, marks=pytest.mark.full),
    pytest.param('delay', STATE, -0.0184, marks=pytest.mark.full),
])  # fmt: skip
def test_a_delay_is_found_within_three_errors(tmp_path, flown, name, names, seconds):
    flight = read_flight(late(tmp_path / 'late.csv', flown, seconds, names))

    found = fit([flight], Task('x500', (name, 'rotor_drag')))

    assert abs(found.values[0] - seconds) < 3 * found.errors[0]
    assert 0 < found.errors[0] < 1e-3
    assert abs(found.values[1] - DRAG) < 3 * found.errors[1]
    assert found.rms[1] == pytest.approx(1.0, abs=0.1)
    assert any(line.startswith(f'{name} ') and 'of the log' in line for line in found.lines)


def test_without_it_the_rest_is_off(tmp_path, flown):
    flight = read_flight(late(tmp_path / 'late.csv', flown, 0.023))

    found = fit([flight], Task('x500', ('rotor_drag',)))

    assert abs(found.values[0] - DRAG) > max(2.5 * found.errors[0], 0.09 * DRAG)


def test_a_log_put_right_is_in_time(tmp_path, flown):
    flight = read_flight(late(tmp_path / 'late.csv', flown, 0.02, ('rates',), noise=False))
    chosen = find_parameters(comparable_scene('x500'), ['delay', 'delay.rates'])

    right = in_time(flight, chosen, [0.005, 0.015])

    times = np.array([0.5, 1.0, 1.5])
    true = np.stack([np.interp(times + flight.begin, flown['time'], flown[f'rates_{a}'])
                     for a in 'xyz'], axis=1)  # fmt: skip
    assert right.signals['rates'].between(times) == pytest.approx(true, abs=1e-3)
    moved = flight.signals['position'].times - right.signals['position'].times
    assert moved == pytest.approx(0.005)
    assert right.actuators is flight.actuators


def test_states_are_seen_between_steps():
    along = np.arange(11.0)[None, :, None] * np.arange(1.0, 14.0)  # of 10 steps of .1 s

    found = seen(along, np.array([0.3, 0.5]), np.array([0.05, 0.0, -0.12, 0.3]), 0.1)

    assert found[0, 0, [0, 3, 7, 10]] == pytest.approx([2.5 * 1, 3.0 * 4, 4.2 * 8, 0.0])
    assert found[0, 1, [0, 3, 7, 10]] == pytest.approx([4.5 * 1, 5.0 * 4, 6.2 * 8, 2.0 * 11])


def test_what_cannot_be_is_one_line(tmp_path, flown, capsys):
    log = late(tmp_path / 'late.csv', flown, 0.0)
    call = ['fit', str(log), '--model', 'x500', '--parameters', 'delay', '--start', 'measured']

    assert main(call) == 2
    assert "parameter 'delay' needs --start free" in capsys.readouterr().err
    with pytest.raises(ConfigError, match=r"'delay.specific_force' is not one of x500"):
        find_parameters(comparable_scene('x500'), ['delay.specific_force'])
    assert longest(['rotor_drag'], 'measured') == 0.0
    assert longest(['delay', 'delay.rates'], 'free') == pytest.approx(0.2)
