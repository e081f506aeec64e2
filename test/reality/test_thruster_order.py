# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Thrusters in another order than the log's columns are named in the order that fits."""

import itertools

import pytest

from fluid_sim_ros.flights.mapping import FlightMap
from fluid_sim_ros.flights.reader import read_flight
from fluid_sim_ros.reality.compare import Part, compare
from test.support.flight_logs import csv_text
from test.support.flown import x500_table

TABLE = x500_table()
NAMES = ('m1', 'm2', 'm3', 'm4')
ORDERS = [order for order in itertools.permutations(range(4)) if order != (0, 1, 2, 3)]


@pytest.mark.parametrize('order', [
    (1, 0, 3, 2), (2, 0, 3, 1),
    *(pytest.param(order, marks=pytest.mark.full) for order in ORDERS),
])  # fmt: skip
def test_the_order_that_fits_is_named(tmp_path, order):
    path = tmp_path / 'x500.csv'
    moved = {f'rotor_speed_{i + 1}': TABLE[f'rotor_speed_{k + 1}'] for i, k in enumerate(order)}
    path.write_text(csv_text(TABLE | moved))

    found = compare(read_flight(path), 'x500', part=Part(horizons=(0.1,)))

    names = ', '.join(NAMES[k] for k in order)
    assert any(f'say thrusters: [{names}] in' in line for line in found.numbers['words'])
    mapped = read_flight(path, FlightMap(thrusters=[NAMES[k] for k in order]))
    right = compare(mapped, 'x500', part=Part(horizons=(0.1,)))
    assert not any('order' in line for line in right.numbers['words'])
    assert right.numbers['horizons']['0.1']['position_m']['p90'] < 1e-3
