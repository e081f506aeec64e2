# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What an exchange repeats is made in the library: the same bytes as by its twins in Python."""

import json
import math
import random
import struct
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pymavlink.dialects.v20 import common as dialect

from fluid_sim_ros import Simulation
from fluid_sim_ros.mavlink.actuator_map import ActuatorMap
from fluid_sim_ros.mavlink.ardupilot.json_packets import write_state
from fluid_sim_ros.mavlink.ardupilot.json_state import ReplyWriter, StateReader
from fluid_sim_ros.mavlink.battery import Battery
from fluid_sim_ros.mavlink.mapping import load_mapping
from fluid_sim_ros.mavlink.px4.hil_answers import HilReader
from fluid_sim_ros.mavlink.px4.hil_messages import HilWriter
from fluid_sim_ros.mavlink.px4.hil_sensor import CompiledReadings, PlainReadings
from fluid_sim_ros.mavlink.px4.hil_state import HilState
from fluid_sim_ros.mavlink.px4.wire import Frame
from fluid_sim_ros.mavlink.sticks import Sticks
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.schema.sensors import Channel, SensorsFile
from test.support.autopilots.posed import Posed
from test.support.autopilots.recordings import FROM_AUTOPILOT, TO_AUTOPILOT, portions

ANSWER = Frame(dialect.MAVLink_hil_actuator_controls_message)
#: Scenes with their vehicles: in the air, with surfaces, under water with true poses.
SCENES = ('x500', 'aerosonde', 'bluerov2_heavy')
#: States of each scene; a million together in make test-full.
FEW, MANY = 400, 167_000
VOLUMES = [FEW, pytest.param(MANY, marks=[pytest.mark.full, pytest.mark.timeout(1200)])]


@pytest.mark.parametrize('count', VOLUMES)
@pytest.mark.parametrize('scene', SCENES)
def test_px4_gets_the_same_bytes(scene, count):
    posed = Posed(scene, timestep=0.002, seed=7)
    file = posed.mapping('px4')
    states = [
        HilState(posed.simulation, posed.vehicle.name, file, Sticks(file.rc, 0.0), earth, readings)
        for earth, readings in (('wgs84', PlainReadings), ('wgs84', CompiledReadings))
    ]
    writers = HilWriter(), HilWriter()
    for i in range(1, count + 1):
        posed.simulation.step(2)
        posed.pose()
        plain, compiled = (
            state.messages(writer, 4000 * i) for state, writer in zip(states, writers, strict=True)
        )
        assert plain == compiled


@pytest.mark.parametrize('count', VOLUMES)
@pytest.mark.parametrize('scene', SCENES)
def test_ardupilot_gets_the_same_bytes(scene, count):
    posed = Posed(scene, seed=7)
    file, limits = posed.mapping('ardupilot'), posed.vehicle.thrust_range[:, 1].tolist()
    battery = Battery(file.battery, limits) if file.battery else None
    sticks = Sticks(file.rc, 0.0, 12)
    plain = StateReader(posed.simulation, posed.vehicle.name, sticks, battery)
    compiled = ReplyWriter(posed.simulation, posed.vehicle.name, sticks, battery)
    rng = random.Random(3)
    for i in range(1, count + 1):
        posed.simulation.step()
        posed.pose()
        if battery is not None:
            battery.draw([rng.random() * limit for limit in limits], 0.0025)
        if i % 100 == 50:
            sticks.move([rng.uniform(-1, 1) for _ in range(rng.randrange(1, 13))], [])
        time_s = rng.choice([0.0025 * i, rng.uniform(0, 1e5)])
        assert compiled.reply(time_s) == write_state(plain.read(time_s))


def errors(**given):
    return Channel(density=0.01, deviation=0.02, bias_walk=0.05, **given)


def test_readings_with_every_error_and_turned_mounts_are_the_same():
    """Drift, rounding, saturation and a site with other axes, over several blocks of noise."""
    posed = Posed('bluerov2_heavy', timestep=0.004, seed=11)
    rates = {'rate': 250, 'latency': 0.0, 'site': 't5'}
    sensors = {
        'imu': {'accelerometer': errors(range=(-30, 20)), 'gyroscope': errors(resolution=0.01)},
        'magnetometer': {'field': errors(resolution=1e-3, range=(-0.05, 0.05))},
        'barometer': {'pressure': errors(resolution=3.0, range=(3e4, 1.1e5))},
    }
    x500 = Simulation('x500').vehicle('x500').sensors
    config = SensorsFile(dither=True).model_copy(update={
        kind: getattr(x500, kind).model_copy(update=rates | channels)
        for kind, channels in sensors.items()
    })  # fmt: skip
    plain, compiled = (
        readings(posed.simulation, posed.vehicle.name, config)
        for readings in (PlainReadings, CompiledReadings)
    )
    writers = HilWriter(), HilWriter()
    for i in range(1, 1200):
        posed.simulation.step()
        posed.pose()
        frames = [
            readings.frame(writer, 4000 * i, None)
            for readings, writer in zip((plain, compiled), writers, strict=True)
        ]
        assert frames[0] == frames[1]
    saturated = {kind: sensor.saturated for kind, sensor in plain.sensors.items()}
    assert min(saturated.values()) > 0
    assert saturated == compiled.saturated()


def test_a_flight_with_another_timestep_repeats_readings_of_the_same_tick():
    """ArduPilot at 1200 Hz: several replies fall into one tick of the scene."""
    replies = []
    for seed in (3, 3):
        simulation = Simulation('aerosonde', seed=seed)
        (vehicle,) = simulation.vehicles
        simulation.set_timestep(Fraction(833, 1_000_000))
        sticks = Sticks((), 0.0, 12)
        plain = StateReader(simulation, vehicle, sticks, None)
        compiled = ReplyWriter(simulation, vehicle, sticks, None)
        for i in range(60):
            simulation.step()
            replies.append(compiled.reply(i / 1200))
            assert replies[-1] == write_state(plain.read(i / 1200))
    assert replies[:60] == replies[60:]


@pytest.mark.parametrize('name', ['arducopter_json.bin.gz', 'ardusub_json.bin.gz'])
def test_recorded_states_are_written_alike(name):
    """The states of sessions with the real programs, put into the row."""
    posed = Posed('x500')
    plain, compiled = (
        kind(posed.simulation, 'x500', Sticks((), 0.0), None)
        for kind in (StateReader, ReplyWriter)
    )
    states = [json.loads(data) for data in portions(name, TO_AUTOPILOT)]
    for state in states:
        posed.simulation.step()
        north, east, down = state['position']
        w, x, y, z = state['quaternion']
        half = math.sqrt(0.5)
        flu = [half * (w + z), half * (x + y), half * (x - y), half * (w - z)]
        row = posed.row
        row[nat.POSITION], row[nat.QUATERNION] = (east, north, -down), flu
        row[nat.LINEAR_VELOCITY] = state['velocity']
        for columns, key in ((nat.ANGULAR_VELOCITY, 'gyro'), (nat.SPECIFIC_FORCE, 'accel_body')):
            forward, right, low = state['imu'][key]
            row[columns] = forward, -right, -low
        time_s = state['timestamp']
        reply = compiled.reply(time_s)
        assert reply == write_state(plain.read(time_s))
        assert json.loads(reply)['quaternion'] == pytest.approx(state['quaternion'], abs=1e-7)
    assert len(states) > 1000


def test_recorded_answers_are_read_alike():
    reader, whole = HilReader(), 0
    for portion in portions('px4_iris_hil.bin.gz', FROM_AUTOPILOT):
        fields, found = ANSWER.read(portion), reader.receive(portion)
        if fields is not None:
            whole += 1
            time_us, flags, *controls, mode = fields
            (answer,) = found.actuators
            assert (answer.time_us, list(answer.controls)) == (time_us, controls)
            assert (answer.armed, answer.lockstep) == (bool(mode & 128), bool(flags & 1))
    assert whole > 500


@given(
    st.integers(0, 2**64 - 1), st.integers(0, 2**64 - 1),
    st.lists(st.floats(width=32), min_size=16, max_size=16), st.integers(0, 255), st.data(),
)  # fmt: skip
def test_answers_are_read_as_by_the_twin(time_us, flags, controls, mode, data):
    frame = bytearray(ANSWER.pack(9, 1, 1, time_us, flags, *controls, mode))
    (answer,) = HilReader().receive(bytes(frame)).actuators
    assert answer.time_us == time_us
    assert struct.pack('<16f', *answer.controls) == struct.pack('<16f', *controls)
    place = data.draw(st.integers(0, len(frame) - 1))
    frame[place] ^= data.draw(st.integers(1, 255))
    assert ANSWER.read(bytes(frame)) is None
    assert not HilReader().receive(bytes(frame)).actuators


@pytest.mark.parametrize('count', VOLUMES)
@pytest.mark.parametrize(
    ('protocol', 'scene'),
    [('px4', 'x500'), ('px4', 'aerosonde'), ('ardupilot', 'bluerov2_heavy')],
)
def test_outputs_become_the_same_commands(protocol, scene, count):
    vehicle = next(iter(Simulation(scene).vehicles.values()))
    actuators = ActuatorMap(*load_mapping(protocol, vehicle.kind, ''), vehicle)
    rng, span = random.Random(1), (-1.3, 1.3) if protocol == 'px4' else (900, 2100)
    odd = (0, 1, -1, 0.5, math.nan, math.inf, -math.inf, 1100, 1500, 1900, 65535)
    for i in range(count):
        outputs = [rng.choice(odd) if i % 5 == 0 else rng.uniform(*span) for _ in range(16)]
        assert repr(actuators.commands(outputs)) == repr(actuators.plain_commands(outputs))
