# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Logs of PX4 and ArduPilot in simulation: no axis, sign or clock of a signal is wrong."""

import gzip
import lzma

import numpy as np
import pytest

from fluid_sim_ros.flights.checks.consistency import check_flight
from fluid_sim_ros.flights.mapping import FlightMap, default_mapping
from fluid_sim_ros.flights.reader import read_flight
from fluid_sim_ros.flights.units import rotations
from test.support.paths import ROOT

FLIGHTS = ROOT.parent / 'shared' / 'reference' / 'flights'
LOGS = {
    'px4': ('px4_sitl_x500.ulg.xz', lzma.open, 'flight.ulg'),
    'ardupilot': ('arducopter_sitl_x500.bin.gz', gzip.open, 'flight.bin'),
}
#: Largest median distance of the estimate from the truth, by axis: [m], [m/s], [rad].
NEAR = {'position': 0.5, 'velocity': 0.15, 'attitude': 0.03}
#: An axis moves by more than this, or says nothing of its sign: [m], [m/s], [rad].
MOVES = {'position': 2.0, 'velocity': 0.5, 'attitude': 0.1}
#: Axes that move so far: PX4 flew to a waypoint, ArduCopter up and down.
MOVED = {
    'px4': {'position': 2, 'velocity': 2, 'attitude': 1},
    'ardupilot': {'position': 1, 'velocity': 1, 'attitude': 0},
}


@pytest.fixture(scope='module', params=list(LOGS))
def flights(request, tmp_path_factory):
    name, opened, plain = LOGS[request.param]
    if not (FLIGHTS / name).exists():
        pytest.skip('the recordings are not here')
    path = tmp_path_factory.mktemp('sitl') / plain
    with opened(FLIGHTS / name) as file:
        path.write_bytes(file.read())
    mapping = default_mapping(request.param).model_dump()
    for quantity, places in mapping['signals'].items():
        mapping['signals'][quantity] = [p for p in places if not p['truth']]
    mapping['signals'] = {q: p for q, p in mapping['signals'].items() if p}
    return read_flight(path), read_flight_leniently(path, mapping)


def read_flight_leniently(path, mapping):
    from fluid_sim_ros.flights.assemble import flight_of
    from fluid_sim_ros.flights.reader import read_log

    raw, known = read_log(path, FlightMap.model_validate(mapping))
    return flight_of(raw, known)


def axes_of(flight, quantity, times):
    """Return a quantity by axis; of an attitude, where the axes of the body point."""
    values = flight.signals[quantity].between(times)
    if quantity != 'attitude':
        return values
    turn = rotations(values / np.linalg.norm(values, axis=1, keepdims=True))
    return np.concatenate([turn.apply([1.0, 0, 0]), turn.apply([0, 0, 1.0])], axis=1)


@pytest.mark.parametrize('quantity', list(NEAR))
def test_the_estimate_is_the_truth_axis_by_axis(flights, quantity):
    truth, estimate = flights
    assert truth.signals[quantity].truth
    assert not estimate.signals[quantity].truth
    late = truth.begin - estimate.begin
    last = min(truth.signals[quantity].times[-1], estimate.signals[quantity].times[-1] - late)
    times = np.arange(15.0, last - 1.0, 0.1)
    true, found = axes_of(truth, quantity, times), axes_of(estimate, quantity, times + late)
    off = found - true
    if quantity == 'position':  # the origin of an estimate is where it was started
        off = off - np.median(off, axis=0)

    assert np.median(np.abs(off), axis=0).max() < NEAR[quantity]
    moved = 0
    for column, (a, b) in enumerate(zip(true.T, found.T, strict=True)):
        if np.ptp(a) < MOVES[quantity]:
            continue
        moved += 1
        slope = np.polyfit(a, b, 1)[0]
        assert slope == pytest.approx(1.0, abs=0.1), (quantity, column)
    assert moved >= MOVED[truth.raw.format][quantity]


def test_signals_of_the_log_agree_with_each_other(flights):
    truth, _ = flights

    for check in check_flight(truth):
        assert check.finding == '', check
        if check.offset is not None and 'after' not in check.what:
            assert abs(check.offset) < 0.03, check
