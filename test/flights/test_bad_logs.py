# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What is wrong with a log is one clear line; nothing is filled in or reinterpreted in silence."""

import numpy as np
import pytest

from fluid_sim_ros.cli import main
from fluid_sim_ros.errors import ConfigError, FluidSimError
from fluid_sim_ros.flights.about import about_flight, refuse_unclear, require_comparable
from fluid_sim_ros.flights.flight import FlightError
from fluid_sim_ros.flights.mapping import read_mapping
from fluid_sim_ros.flights.reader import read_flight
from fluid_sim_ros.flights.ulog import read_ulog
from test.support import flight_logs as logs
from test.support.hostile.foreign.kinds import foreign_file

FLIGHT = logs.motion()


def written(tmp_path, **changed):
    path = tmp_path / 'flight.csv'
    path.write_text(logs.csv_text(logs.table(FLIGHT, **changed)))
    return path


def test_a_log_cut_off_is_read_up_to_the_cut(tmp_path):
    path = tmp_path / 'log00.usd'
    path.write_bytes(logs.usd(FLIGHT, damage=1000))

    flight = read_flight(path)

    assert 'checksum' in flight.raw.faults[0]
    assert 'no whole event' in flight.raw.faults[1]
    signal = flight.signals['position']
    assert len(FLIGHT.times) - 20 < len(signal.times) < len(FLIGHT.times)
    assert np.abs(signal.values - FLIGHT.position[: len(signal.times)]).max() < 1e-6


@pytest.mark.parametrize('content', [
    b'', b'hello', b'\xbc', b'\xbc\x07\x00\x01\x00', b'\xbc\x02\x00\xff\xff' + bytes(100),
    b'ULog\x01\x12\x35\x01', b'ULog\x01\x12\x35' + bytes(range(256)), b'\xa3\x95\x80' + bytes(50),
])  # fmt: skip
@pytest.mark.parametrize('ending', ['usd', 'ulg', 'bin', 'csv', 'parquet', 'mcap', 'db3', 'txt'])
def test_what_is_no_log_is_one_line(tmp_path, content, ending):
    path = tmp_path / f'flight.{ending}'
    path.write_bytes(content)

    with pytest.raises(FluidSimError) as error:
        read_flight(path)

    assert str(path) in str(error.value)
    assert '\n' not in str(error.value)


def test_without_actuators_nothing_drives_a_model(tmp_path):
    path = tmp_path / 'flight.csv'
    columns = {k: v for k, v in logs.table(FLIGHT).items() if not k.startswith('rotor')}
    path.write_text(logs.csv_text(columns))

    with pytest.raises(FlightError, match='nothing drives the model'):
        require_comparable(read_flight(path))


def test_dropped_samples_leave_a_gap_that_is_marked(tmp_path):
    keep = (FLIGHT.times < 2.0) | (FLIGHT.times > 2.4)
    path = tmp_path / 'flight.csv'
    path.write_text(logs.csv_text({k: v[keep] for k, v in logs.table(FLIGHT).items()}))

    signal = read_flight(path).signals['position']

    assert len(signal.gaps) == 1
    assert signal.gaps[0] == pytest.approx((1.995, 2.405))
    assert signal.covers(0.5, 1.5)
    assert not signal.covers(1.5, 2.1)


def test_jumps_are_marked_and_kept(tmp_path):
    column = FLIGHT.position[:, 1].copy()
    column[[300, 700]] += 3.0

    flight = read_flight(written(tmp_path, position_y=column))

    assert np.flatnonzero(flight.signals['position'].outliers).tolist() == [300, 700]
    assert flight.signals['position'].values[300, 1] == column[300]
    assert about_flight(flight)['signals']['position']['outliers'] == 2


def test_time_that_goes_back_is_counted_and_left_out(tmp_path):
    times = FLIGHT.times.copy()
    times[100:103] -= 0.5
    times[200] = times[199]

    flight = read_flight(written(tmp_path, time=times))

    assert flight.signals['position'].dropped == {
        'at a time that goes back': 3, 'at the time of the sample before': 1,
    }  # fmt: skip
    assert any('goes back' in note for note in flight.notes)
    assert (np.diff(flight.signals['position'].times) > 0).all()


def test_two_flights_in_one_log_are_refused(tmp_path):
    with pytest.raises(FlightError, match='not the log of one flight'):
        read_flight(written(tmp_path, time=FLIGHT.times % 1.7))


def test_empty_cells_are_no_samples(tmp_path):
    column = FLIGHT.velocity[:, 0].copy()
    column[5:8] = np.nan

    flight = read_flight(written(tmp_path, velocity_x=column))

    assert flight.signals['velocity'].dropped == {'not finite': 3}
    assert len(flight.signals['position'].times) == len(FLIGHT.times)


@pytest.mark.parametrize(('changed', 'asked'), [
    ({f'rates_{n}': np.degrees(v) for n, v in zip('xyz', FLIGHT.rates.T, strict=True)},
     'looks like unit deg/s'),
    ({f'specific_force_{n}': v / logs.GRAVITY
      for n, v in zip('xyz', FLIGHT.specific_force.T, strict=True)}, 'unit: g'),
    ({f'velocity_{n}': v for n, v in zip('xyz', logs.ned(FLIGHT.velocity).T, strict=True)},
     'looks like axes y x -z'),
    ({f'rates_{n}': v for n, v in zip('xyz', logs.frd(FLIGHT.rates).T, strict=True)},
     'looks like axes x -y -z'),
    ({f'attitude_{n}': v for n, v in zip('xyzw', FLIGHT.attitude.T, strict=True)},
     'other order of its quaternions'),
    ({f'position_{n}': 100 * v for n, v in zip('xyz', FLIGHT.position.T, strict=True)},
     'looks like position in cm'),
    ({f'velocity_{n}': 3.6 * v for n, v in zip('xyz', FLIGHT.velocity.T, strict=True)},
     'looks like unit km/h'),
    ({'time': 1e3 * FLIGHT.times}, 'the time looks like ms'),
])  # fmt: skip
def test_units_axes_and_orders_are_recognised_and_asked_about(tmp_path, changed, asked):
    flight = read_flight(written(tmp_path, **changed))

    with pytest.raises(FlightError, match=asked):
        refuse_unclear(flight)


def test_a_stated_unit_is_taken_as_it_is_said(tmp_path):
    mapping = tmp_path / 'mapping.yaml'
    mapping.write_text(
        'signals:\n'
        '  specific_force: {stream: table, unit: m/s^2,\n'
        '    columns: [specific_force_x, specific_force_y, specific_force_z]}\n'
    )
    small = {
        f'specific_force_{n}': v / 10
        for n, v in zip('xyz', FLIGHT.specific_force.T, strict=True)
    }  # fmt: skip

    flight = read_flight(written(tmp_path, **small), read_mapping(mapping))

    assert 'looks like g' in refuse_unclear(flight)[0]


@pytest.mark.parametrize(('text', 'words'), [
    ('signals: {speed: {stream: table, columns: [a, b, c]}}', "'speed' is not known"),
    ('signals: {rates: {stream: table, columns: [a, b, c], unit: rpd}}', 'allowed: rad/s, deg/s'),
    ('signals: {rates: {stream: table, columns: [a, b, c], axes: enu}}', 'allowed: flu, frd'),
    ('signals: {rates: {stream: table, columns: [a, b]}}', 'needs 3, got 2'),
    ('signals: {attitude: {stream: t, columns: [a, b, c, d], order: zyxw}}', 'wxyz, xyzw, rpy'),
    ('time: {column: t, unit: h}', "'h' is not known"),
    ('actuators: [{output: 1, thruster: m1, input: [2, 1]}]', 'must rise'),
    ('streams: {}', 'unknown key'),
])  # fmt: skip
def test_faults_of_a_mapping_are_one_line(tmp_path, text, words):
    path = tmp_path / 'mapping.yaml'
    path.write_text(text)

    with pytest.raises(ConfigError, match=words) as error:
        read_mapping(path)

    assert str(path) in str(error.value)


def test_a_column_that_is_not_there_is_named_with_those_that_are(tmp_path):
    path = tmp_path / 'mapping.yaml'
    path.write_text('signals: {position: {stream: table, columns: [x, position_y, position_z]}}')

    with pytest.raises(FlightError, match=r"column 'x' is not in table; it has: position_x"):
        read_flight(written(tmp_path), read_mapping(path))


def test_info_shows_what_is_there_and_what_is_missing(tmp_path, capsys):
    columns = {k: v for k, v in logs.table(FLIGHT).items() if not k.startswith('rotor')}
    path = tmp_path / 'flight.csv'
    path.write_text(logs.csv_text(columns))

    assert main(['info', str(path), '--json', '-']) == 0
    text = capsys.readouterr().out
    assert '"position"' in text
    assert 'actuators: one of rotor_speed' in text

    assert main(['info', str(path)]) == 0
    assert 'missing for a comparison' in capsys.readouterr().out


def test_info_of_a_damaged_log_fails(tmp_path):
    path = tmp_path / 'log00.usd'
    path.write_bytes(logs.usd(FLIGHT, damage=1000))

    assert main(['info', str(path), '--json', str(tmp_path / 'info.json')]) == 1


@pytest.mark.parametrize(('rows', 'words'), [
    (None, 'the file is empty'), (0, 'has no samples'), (1, 'too few samples: .*1 of 1 samples'),
])  # fmt: skip
def test_a_table_without_samples_is_one_line(tmp_path, rows, words):
    path = tmp_path / 'flight.csv'
    columns = {name: values[:rows] for name, values in logs.table(FLIGHT).items()}
    path.write_text('' if rows is None else logs.csv_text(columns))

    with pytest.raises(FlightError, match=words):
        read_flight(path)


def test_samples_that_were_dropped_here_and_there_are_counted(tmp_path):
    keep = np.random.default_rng(0).random(len(FLIGHT.times)) > 0.3
    path = tmp_path / 'flight.csv'
    path.write_text(logs.csv_text({k: v[keep] for k, v in logs.table(FLIGHT).items()}))

    notes = read_flight(path).notes

    assert len(notes) == 1
    assert notes[0].startswith('position, attitude, velocity')
    assert notes[0].endswith(' % of the samples of table are missing')


def test_a_mapping_says_only_what_is_different(tmp_path):
    small = {
        f'specific_force_{n}': v / logs.GRAVITY
        for n, v in zip('xyz', FLIGHT.specific_force.T, strict=True)
    }  # fmt: skip
    mapping = tmp_path / 'mapping.yaml'
    mapping.write_text(
        'vehicle: x500\nsignals:\n  rotor_speed: []\n  specific_force: {stream: table, unit: g,'
        ' columns: [specific_force_x, specific_force_y, specific_force_z]}\n'
    )

    flight = read_flight(written(tmp_path, **small), read_mapping(mapping))

    assert flight.vehicle == 'x500'
    assert 'rotor_speed' not in flight.signals
    assert 'position' in flight.signals
    assert refuse_unclear(flight) == []


@pytest.mark.parametrize('kind', ['ulg', 'bin'])
@pytest.mark.parametrize('cut', [0, 5])
def test_a_log_of_an_autopilot_that_ends_within_a_message_says_so(tmp_path, kind, cut):
    path = tmp_path / f'flight.{kind}'
    content = logs.ulog(logs.px4(FLIGHT)) if kind == 'ulg' else (
        logs.dataflash(logs.ardupilot(FLIGHT))
    )  # fmt: skip
    path.write_bytes(content[: len(content) - cut])

    faults = read_flight(path).raw.faults

    assert [fault for fault in faults if 'cut off within a message' in fault] == list(
        faults[-1:] if cut else ()
    )
    assert bool(faults) == bool(cut)


def test_a_ulog_that_leads_back_to_the_same_place_ends(tmp_path):
    """Pyulog alone would read it for ever; found by the hostile files."""
    path = foreign_file('ulg', 213, tmp_path, tmp_path / 'kept')
    with pytest.raises(FlightError, match='no ULog that pyulog reads'):
        read_ulog(path)


def test_a_topic_of_a_ulog_without_times_is_left_out_and_told(tmp_path):
    """Found by the hostile files."""
    content = logs.ulog(logs.px4(FLIGHT))
    path = tmp_path / 'a.ulg'
    path.write_bytes(
        content.replace(
            b'sensor_combined:uint64_t timestamp', b'sensor_combined:uint64_t timestxmp'
        )
    )
    raw = read_ulog(path)
    assert 'sensor_combined' not in raw.streams and 'vehicle_attitude' in raw.streams
    assert any('without a timestamp' in f and 'sensor_combined' in f for f in raw.faults)
