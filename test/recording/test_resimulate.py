# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A log flown again gives every state to the last bit, and a difference is named."""

import json
import struct

import numpy as np
import pytest
from mcap.writer import CompressionType, Writer

from fluid_sim_ros import Simulation, cli, scene_names
from fluid_sim_ros.errors import ConfigError, FluidSimError
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.recording.replay.repetition import Repetition, has_old_transforms
from fluid_sim_ros.recording.replay.resimulate import parse_changes, resimulate
from fluid_sim_ros.recording.sink import RecordingSink
from test.support.recorded_flights import record_flight
from test.support.volumes import quick

FULL = pytest.mark.full


def flown(number, folder):
    """Record a flight with a random scene, integrator, seed and commands."""
    names = scene_names()
    random = np.random.default_rng(number)
    scene = names[number % len(names)]
    integrator = str(random.choice(['RK4', 'implicitfast', 'Euler']))
    path = folder / f'{number}.mcap'
    record_flight(path, scene, seconds=0.5, seed=number, integrator=integrator)
    return path


def check_bits(path):
    outcome = resimulate(open_log(path))
    assert outcome.difference is None and not outcome.largest and not outcome.notes
    assert outcome.compared > 100
    return outcome


@pytest.mark.parametrize('number', quick(range(4), 0, 3))
def test_a_random_flight_is_repeated_to_the_last_bit(number, tmp_path):
    check_bits(flown(number, tmp_path))


@pytest.mark.full
@pytest.mark.parametrize('number', range(4, 24))
def test_twenty_random_flights_are_repeated_to_the_last_bit(number, tmp_path):
    check_bits(flown(number, tmp_path))


def test_commands_are_fed_in(tmp_path):
    path = tmp_path / 'a.mcap'
    record_flight(path, 'quadrotor', seconds=1.0, seed=5)
    assert check_bits(path).commands >= 100


@pytest.mark.parametrize('scene', ['x500_turbulence', 'bluerov2_current'])
def test_gusts_are_repeated_and_another_seed_brings_others(scene, tmp_path):
    path = tmp_path / 'a.mcap'
    record_flight(path, scene, seconds=0.5, seed=5)
    check_bits(path)
    topic = '/medium/current' if 'current' in scene else '/medium/wind'
    for seed, same in ((5, True), (6, False)):
        again = resimulate(open_log(path), changes={'seed': seed}, keep=[topic])
        pairs = [pair for rows in again.pairs.values() for pair in rows]
        assert pairs
        assert all(old == new for _, old, new in pairs) == same


def test_a_scene_file_elsewhere_is_not_needed(tmp_path):
    model = tmp_path / 'ball.xml'
    model.write_text(
        '<mujoco><option density="1.2" viscosity="1.8e-5" timestep="0.002"/><worldbody>'
        '<body name="ball" pos="0 0 5"><freejoint/><geom size=".1"/></body>'
        '</worldbody></mujoco>'
    )
    record_flight(tmp_path / 'a.mcap', str(model), seconds=0.5, seed=2)
    model.unlink()
    check_bits(tmp_path / 'a.mcap')


def test_a_start_beside_the_keyframe_is_restored(tmp_path):
    simulation = Simulation('sphere')
    simulation.data.qpos[:3] = 1.25, -3.5, 17.0
    simulation.set_current([1.0, 2.0, 0.5])
    sink = RecordingSink(simulation, tmp_path / 'a.mcap')
    for _ in range(50):
        sink.write(simulation)
        simulation.step(sink.period)
    sink.close()
    check_bits(tmp_path / 'a.mcap')


def changed_copy(path, target, topic, number, offset, by):
    """Copy a log with one double of one message changed."""
    log = open_log(path)
    count = 0
    with target.open('xb') as stream:
        writer = Writer(stream, 1 << 20, CompressionType.ZSTD)
        writer.start(profile='ros2')
        for name, data in log.attachments.items():
            writer.add_attachment(0, 0, name, '', data)
        ids = {}
        for entry in log.topics.values():
            schema = writer.register_schema(entry.type, 'ros2msg', entry.definition.encode())
            ids[entry.name] = writer.register_channel(entry.name, 'cdr', schema, entry.metadata)
        for message in log.messages():
            data = bytearray(message.data)
            if message.topic == topic:
                if count == number:
                    (value,) = struct.unpack_from('<d', data, offset)
                    struct.pack_into('<d', data, offset, value + by)
                count += 1
            writer.add_message(ids[message.topic], message.log_ns, bytes(data), 0, message.step)
        writer.finish()


def test_the_first_difference_is_named(tmp_path, capsys):
    path, bad = tmp_path / 'a.mcap', tmp_path / 'b.mcap'
    record_flight(path, 'sphere', seconds=0.3, piloted=False)
    # the sixth odometry's height: header 4, stamp 8, two strings, two doubles before it
    offset = 4 + 8 + 4 + len('sphere/odom') + 1 + 4 + len('sphere/base_link') + 1
    offset += -(offset - 4) % 8 + 16
    changed_copy(path, bad, '/sphere/odom', 5, offset, 0.25)
    assert cli.main(['replay', str(bad), '--resimulate', '--json', '-']) == 1
    result = json.loads(capsys.readouterr().out)
    different = result['difference']
    assert (different['topic'], different['step']) == ('/sphere/odom', 25)
    assert different['field'] == 'pose.pose.position.z'
    assert different['recorded'] - different['simulated'] == 0.25
    assert different['time_s'] == pytest.approx(0.05)
    assert cli.main(['replay', str(bad), '--resimulate', '--tolerance', '1']) == 0
    assert 'as tolerated' in capsys.readouterr().out


def test_a_changed_command_is_a_difference(tmp_path):
    path, bad = tmp_path / 'a.mcap', tmp_path / 'b.mcap'
    record_flight(path, 'quadrotor', seconds=0.3, seed=1)
    changed_copy(path, bad, '/x500/cmd/thrust', 10, 20, 1e-3)
    difference = resimulate(open_log(bad)).difference
    assert difference is not None and difference.step >= 50


def test_a_change_is_flown(tmp_path):
    path = tmp_path / 'a.mcap'
    record_flight(path, 'sphere', seconds=0.5, piloted=False)
    log = open_log(path)
    for change in ('integrator=RK4', 'timestep=0.001', 'fluid=inertia', 'current=3,0,0'):
        outcome = resimulate(log, changes=parse_changes([change]), keep=('/odom',))
        pairs = outcome.pairs['/sphere/odom']
        assert len(pairs) == 51 and outcome.compared == 0
        assert pairs[-1][1] != pairs[-1][2]
        assert struct.unpack_from('<iI', pairs[-1][2], 4) == (0, 500_000_000)


def test_a_change_is_drawn_beside_the_recording(tmp_path, capsys):
    path, picture = tmp_path / 'a.mcap', tmp_path / 'a.png'
    # with wind commands, which the change replaces
    record_flight(path, 'quadrotor', seconds=0.5, seed=3)
    arguments = ['replay', str(path), '--with', 'wind=5,0,0', '--out', str(picture)]
    assert cli.main([*arguments, '--json', '-']) == 0
    apart = json.loads(capsys.readouterr().out)['differences']['x500']
    assert 0.001 < apart['apart_at_end_m'] <= apart['largest_apart_m'] < 1.0
    assert picture.read_bytes().startswith(b'\x89PNG')


@pytest.mark.parametrize('pair', ['moon=1', 'wind', 'wind=a,b,c', 'timestep=fast'])
def test_a_wrong_change_is_one_line(pair):
    with pytest.raises(ConfigError, match='--with'):
        parse_changes([pair])


def test_tf_of_a_log_from_before_tf_static_is_not_compared(tmp_path):
    record_flight(tmp_path / 'a.mcap', 'sphere', seconds=0.1, piloted=False)
    description = open_log(tmp_path / 'a.mcap').description()
    assert not has_old_transforms(description)
    assert {'/tf', '/tf_static'} <= set(Repetition(description, {}).states)
    del description.run['settings']['tf.root']  # as no earlier version had it
    assert has_old_transforms(description)
    states = Repetition(description, {}).states
    assert '/tf' not in states and '/sphere/odom' in states


@pytest.mark.parametrize(
    ('place', 'words'),
    [
        ([], 'must be a mapping'),
        pytest.param({'entity': 'sphere', 'pose': [1, 2]}, 'needs 7 numbers, or null', marks=FULL),
        pytest.param({'entity': 'sphere', 'twist': ['a'] * 6}, 'must hold numbers', marks=FULL),
        ({'entity': 'moon', 'pose': None, 'twist': None}, "entity 'moon' is not known"),
        pytest.param(
            {'entity': 'sphere', 'pose': [0] * 7, 'twist': None},
            'quaternion must not be zero',
            marks=FULL,
        ),
    ],
)
def test_a_body_that_an_event_places_wrongly_is_one_line(tmp_path, place, words):
    sink = RecordingSink(Simulation('sphere'), tmp_path / 'a.mcap')
    sink.event(place=place)
    sink.close()
    with pytest.raises(FluidSimError, match=words) as caught:
        resimulate(open_log(tmp_path / 'a.mcap'))
    assert '\n' not in str(caught.value)
