# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Which reading of a log is named where its signals contradict each other, or what is up."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fluid_sim_ros.flights.about import refuse_unclear
from fluid_sim_ros.flights.flight import FlightError
from fluid_sim_ros.flights.mapping import read_mapping
from fluid_sim_ros.flights.reader import read_flight
from test.support import flight_logs as logs

FLIGHT = logs.motion()
TURN = Rotation.from_quat(np.roll(FLIGHT.attitude, -1, axis=1))
SUM = np.sum(FLIGHT.rotor_speed**2, axis=1)


def columns(**blocks):
    """Return columns of a table for arrays of quantities."""
    return {
        f'{name}_{ending}': column
        for name, values in blocks.items()
        for ending, column in zip('wxyz'[4 - values.shape[1] :], values.T, strict=True)
    }


def flight_of(tmp_path, changed, mapping=None):
    path = tmp_path / 'flight.csv'
    path.write_text(logs.csv_text(logs.table(FLIGHT, **changed)))
    if mapping is None:
        return read_flight(path)
    (tmp_path / 'mapping.yaml').write_text(mapping)
    return read_flight(path, read_mapping(tmp_path / 'mapping.yaml'))


def late(values, seconds):
    """Return a signal that comes so much later, its first value held before."""
    count = round(seconds * 200)
    return np.vstack([values[:1]] * count + [values[:-count]])


INVERSE = FLIGHT.attitude * [1, -1, -1, -1]
ALL_NED = columns(
    position=logs.ned(FLIGHT.position), velocity=logs.ned(FLIGHT.velocity),
    attitude=logs.ned_frd(FLIGHT.attitude), rates=logs.frd(FLIGHT.rates),
    specific_force=logs.frd(FLIGHT.specific_force),
)  # fmt: skip
BODY_VELOCITY = TURN.inv().apply(FLIGHT.velocity)
WITHOUT_GRAVITY = FLIGHT.specific_force - TURN.inv().apply([0, 0, logs.GRAVITY])


@pytest.mark.parametrize(('changed', 'asked'), [
    (columns(velocity=BODY_VELOCITY), 'axes of the body: say axes: flu'),
    (columns(velocity=logs.frd(BODY_VELOCITY)), 'axes of the body: say axes: frd'),
    (ALL_NED, 'points down in the world.*axes ned'),
    (columns(specific_force=-FLIGHT.specific_force), 'axes -x -y -z'),
    (columns(specific_force=logs.frd(FLIGHT.specific_force)), r'axes x -y -z \(frd'),
    (columns(specific_force=FLIGHT.specific_force[:, [1, 0, 2]] * [1, -1, 1]), 'axes -y x z'),
    (columns(specific_force=WITHOUT_GRAVITY), 'gravity was taken out'),
    (columns(attitude=INVERSE), 'but does as the inverse, of the world in the body'),
    (columns(attitude=late(FLIGHT.attitude, 0.1)), 'offset: 0.1 at rates, or -0.1 at attitude'),
    (columns(velocity=late(FLIGHT.velocity, 0.25)), 'their clocks differ: say offset: -0.2'),
    ({'time': 1e6 * FLIGHT.times}, 'the time looks like us'),
    ({'time': 1e9 * FLIGHT.times}, 'the time looks like ns'),
])  # fmt: skip
def test_the_reading_that_fits_is_named(tmp_path, changed, asked):
    with pytest.raises(FlightError, match=asked):
        refuse_unclear(flight_of(tmp_path, changed))


def test_an_acceleration_without_gravity_is_told_from_one_in_g(tmp_path):
    small = columns(specific_force=0.3 * WITHOUT_GRAVITY)  # median below g / 2
    with pytest.raises(FlightError, match='gravity was taken out: an accelerometer shows'):
        refuse_unclear(flight_of(tmp_path, small))


def test_with_the_axes_that_were_named_the_flight_is_the_same(tmp_path):
    body = (
        'signals:\n  velocity: {stream: table, axes: frd,\n'
        '    columns: [velocity_x, velocity_y, velocity_z]}\n'
    )
    flight = flight_of(tmp_path, columns(velocity=logs.frd(BODY_VELOCITY)), body)
    assert refuse_unclear(flight) == []
    np.testing.assert_allclose(flight.signals['velocity'].values, FLIGHT.velocity, atol=1e-9)
    # and the other way round: what stands along the world's axes was said to be the body's
    wrong = flight_of(tmp_path, {}, body.replace('frd', 'flu'))
    with pytest.raises(FlightError, match='axes of the world: say axes: enu'):
        refuse_unclear(wrong)


def test_what_never_changes_or_comes_after_what_it_drives_is_said(tmp_path):
    force = FLIGHT.specific_force.copy()
    # along z what the rotors give, as of a vehicle that hovers
    force[:, 2] = logs.GRAVITY * SUM / SUM.mean()
    names = [f'rotor_speed_{i}' for i in range(1, 5)]
    still = flight_of(tmp_path, dict.fromkeys(names, np.full(len(FLIGHT.times), 700.0)))
    assert any('rotor_speed: it never changes' in line for line in refuse_unclear(still))
    for seconds, said in ((0.15, True), (0.0, False)):
        moved = late(FLIGHT.rotor_speed, seconds) if seconds else FLIGHT.rotor_speed
        changed = dict(zip(names, moved.T, strict=True)) | {'specific_force_z': force[:, 2]}
        path = tmp_path / 'late.csv'
        path.write_text(logs.csv_text(
            {k: v for k, v in logs.table(FLIGHT, **changed).items() if 'velocity' not in k}
        ))  # fmt: skip
        lines = refuse_unclear(read_flight(path))
        assert any('comes 150 ms before it' in line for line in lines) == said, lines


@pytest.mark.parametrize(('mark', 'decimal', 'remark'), [
    (';', '.', ''), (';', ',', ''), ('\t', '.', ''), ('\t', ',', ''),
    (',', '.', '# flown in the hall, without wind\n'), (',', '.', '# '), (';', ',', '# a\n# '),
])  # fmt: skip
def test_tables_of_other_programs_are_read(tmp_path, mark, decimal, remark):
    text = logs.csv_text(logs.table(FLIGHT)).replace(',', mark)
    if decimal != '.':
        text = text.replace('.', decimal)
    path = tmp_path / 'flight.csv'
    path.write_text(remark + text)

    flight = read_flight(path)

    np.testing.assert_array_equal(flight.signals['position'].values, FLIGHT.position)
