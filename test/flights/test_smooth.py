# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A smoothed state is nearer to the truth than what was measured, wherever the markers sit."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fluid_sim_ros.cli import main
from fluid_sim_ros.flights.flight import FlightError
from fluid_sim_ros.flights.reader import read_flight
from fluid_sim_ros.flights.smooth import smoothed
from fluid_sim_ros.flights.units import rotations
from test.support.flown import write_x500

#: Where the markers are [m], how their axes are turned [rad], biases of gyro and accelerometer.
POINT, TURN = np.array([0.01, -0.02, 0.03]), np.array([0.01, -0.02, 0.03])
GYRO, FORCE = np.array([0.01, -0.02, 0.005]), np.array([0.1, -0.05, 0.08])


@pytest.fixture(scope='module')
def true(tmp_path_factory):
    return read_flight(write_x500(tmp_path_factory.mktemp('flown') / 'x500.csv', seconds=5.0,
                                  every=1))  # fmt: skip


@pytest.fixture(scope='module')
def seen(true):
    """Return the flight as motion capture at 100 Hz, a gyro and an accelerometer see it."""
    rng = np.random.default_rng(4)
    signals = dict(true.signals)
    del signals['velocity']
    facing = rotations(signals['attitude'].values)
    place = signals['position'].values + facing.apply(POINT)
    place += rng.normal(0, 5e-4, place.shape)
    turned = facing * Rotation.from_rotvec(TURN + rng.normal(0, 4e-3, (len(place), 3)))
    rare = slice(0, None, round(signals['position'].rate / 100))
    for name, values in (('position', place), ('attitude', np.roll(turned.as_quat(), 1, 1))):
        signals[name] = replace(
            signals[name], values=values[rare], times=signals[name].times[rare],
            outliers=signals[name].outliers[rare],
        )  # fmt: skip
    for name, bias, noise in (('rates', GYRO, 0.02), ('specific_force', FORCE, 0.2)):
        values = signals[name].values
        signals[name] = replace(
            signals[name], values=values + bias + rng.normal(0, noise, values.shape)
        )
    return replace(true, signals=signals)


def test_the_state_is_nearer_to_the_truth_and_the_markers_are_found(true, seen):
    found = smoothed(seen)

    assert found.point == pytest.approx(POINT, abs=5e-3)
    assert found.turn[:2] == pytest.approx(TURN[:2], abs=5e-3)
    assert found.surprise == pytest.approx(1.0, abs=0.2)
    assert found.apart[0] == pytest.approx(5e-4, rel=0.3)
    assert found.apart[1] is None
    signals = found.flight.signals
    times = signals['position'].times[60:-60]

    def off(name):
        values = signals[name].between(times) - true.signals[name].between(times)
        return np.sqrt((values**2).mean())

    assert off('position') < 6e-3  # the point itself is told to millimetres
    assert off('velocity') < 0.01
    assert off('attitude') < 2e-3
    assert signals['rates'].values.mean(0) == pytest.approx(
        true.signals['rates'].values.mean(0), abs=2e-3
    )
    # the errors that it states are those that it has, to a factor
    assert 0.3 < off('velocity') / found.sigmas[1] < 3


def test_what_it_needs_is_named(true):
    signals = {k: v for k, v in true.signals.items() if k != 'specific_force'}

    with pytest.raises(
        FlightError, match=r'--smooth needs position, .* specific_force is missing'
    ):
        smoothed(replace(true, signals=signals))


def test_compare_takes_it(tmp_path, capsys):
    log = write_x500(tmp_path / 'x500.csv', seconds=3.0, noise={'position': 1e-3})

    assert main(['compare', str(log), '--model', 'x500', '--smooth', '--horizons', '0.5']) == 0

    assert 'state smoothed from pose, gyro and accelerometer' in capsys.readouterr().out
