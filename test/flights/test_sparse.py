# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A log that is written seldom is said to be, once, with its rate and what is lost in between."""

import numpy as np
import pytest

from fluid_sim_ros.flights.flight import Signal
from fluid_sim_ros.flights.reader import read_flight
from fluid_sim_ros.flights.sparse import sparse_lines, straight_error
from fluid_sim_ros.reality.compare import Part, compare
from test.support.flown import write_x500


@pytest.fixture(scope='module')
def sparse(tmp_path_factory):
    """Return a flight of 10 Hz."""
    path = write_x500(tmp_path_factory.mktemp('flown') / 'x500.csv', seconds=4.0, every=50)
    return read_flight(path)


def test_a_sparse_log_is_said_once_with_rate_and_size(sparse):
    found = compare(sparse, 'x500', part=Part(horizons=(0.5,))).numbers

    lines = [line for line in found['notes'] if line.startswith('sparse')]
    assert len(lines) == 1
    for name in ('position 10 Hz (about', 'attitude', 'velocity', 'rates', 'm/s off', 'deg off'):
        assert name in lines[0]


def test_a_full_log_needs_no_word(tmp_path):
    assert sparse_lines(read_flight(write_x500(tmp_path / 'x500.csv', seconds=2.0))) == []


def test_the_size_is_that_of_a_parabola():
    times = np.arange(0.0, 2.0, 0.1)
    signal = Signal('position', times, 4.0 * times[:, None] ** 2 * [1.0, 0.0, 0.0], 'here')

    # half way between two samples: acceleration times distance squared over 8
    assert straight_error(signal) == pytest.approx(8.0 * 0.1**2 / 8)
