# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Outputs of autopilots become commands: signs against the autopilots' own tables, and faults."""

import math
from functools import cache

import numpy as np
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.mavlink.actuator_map import ActuatorMap
from fluid_sim_ros.mavlink.mapping import load_mapping
from fluid_sim_ros.resources import config_folder
from fluid_sim_ros.simulation.plant import plant_of
from test.support.autopilots.ardupilot_stand_in import (
    QUAD_X,
    VECTORED,
    VECTORED_6DOF,
    quad_x_factors,
)
from test.support.autopilots.px4_pilots import HEAVY, IRIS

#: Force and torque in FRD axes of a wrench in FLU axes.
FRD = np.array([1, -1, -1, 1, -1, -1])


def mapped(protocol, scene, path=''):
    vehicle = next(iter(Simulation(scene).vehicles.values()))
    file, where = load_mapping(protocol, vehicle.name, str(path))
    return ActuatorMap(file, where, vehicle)


def wrench(scene, thrusts):
    return FRD * (matrix(scene) @ thrusts)


@cache
def matrix(scene):
    plant, _ = plant_of(scene, '')
    return plant.thruster_matrix


def padded(values, rest, count=16):
    return [*values, *[rest] * (count - len(values))]


def asks_for(result, axis):
    """Check that a wrench acts along one axis, in its positive sense, and hardly otherwise."""
    lever = np.array([1, 1, 1, 0.1, 0.1, 0.1])  # [N] and [N m] on one scale
    scaled = result / lever
    assert scaled[axis] > 0
    if axis in (3, 4, 5):  # a demand for turning may not push the vehicle away
        scaled = scaled[3:]
        axis -= 3
    assert abs(scaled[axis]) == max(abs(scaled))


@pytest.mark.parametrize(
    ('scene', 'factors'), [('bluerov2', VECTORED), ('bluerov2_heavy', VECTORED_6DOF)]
)
def test_ardusub_turns_and_moves_as_its_factors_say(scene, factors):
    actuators, driven = mapped('ardupilot', scene), np.array(factors, dtype=float)
    # roll, pitch, yaw, throttle (up), forward, lateral (right); the vectored frame has no pitch
    for demand, axis, sign in ((0, 3, 1), (1, 4, 1), (2, 5, 1), (3, 2, -1), (4, 0, 1), (5, 1, 1)):
        if not driven[:, demand].any():
            continue
        pulses = [round(1500 + 200 * f) for f in driven[:, demand]]
        thrusts, _ = actuators.commands(padded(pulses, 0))
        asks_for(sign * wrench(scene, np.array(thrusts)), axis)


def test_px4_turns_and_moves_its_submarine_as_its_geometry_says():
    actuators = mapped('px4', 'bluerov2_heavy')
    for rotor, (axis, position) in enumerate(HEAVY):
        controls = padded([0.0] * rotor + [0.5], 0.0)
        thrusts, _ = actuators.commands(controls)
        result = wrench('bluerov2_heavy', np.array(thrusts))
        expected = np.array([*axis, *np.cross(position, axis)], dtype=float)
        force, turn = result[:3], result[3:]
        assert np.sign(np.round(force, 6)).tolist() == np.sign(expected[:3]).tolist()
        # roll and pitch of the four vertical ones, yaw of the others: their weights are no metres
        chosen = [0, 1] if axis[2] else [2]
        assert np.sign(turn[chosen]).tolist() == np.sign(expected[3:][chosen]).tolist()


@pytest.mark.parametrize('scene', ['x500', 'quadrotor'])
def test_copters_turn_as_their_motors_say(scene):
    copter, iris = mapped('ardupilot', scene), mapped('px4', scene)
    table = np.array(quad_x_factors())
    geometry = np.array([(-math.copysign(1, y), math.copysign(1, x), k) for x, y, k in IRIS])
    for axis in (3, 4, 5):
        pulses = [round(1500 + 100 * f) for f in table[:, axis - 3]]
        asks_for(wrench(scene, np.array(copter.commands(padded(pulses, 0))[0])), axis)
        share = [0.5 + 0.1 * np.sign(f) for f in geometry[:, axis - 3]]
        asks_for(wrench(scene, np.array(iris.commands(padded(share, 0.0))[0])), axis)
    assert len(QUAD_X) == len(IRIS) == 4


def test_an_aircraft_answers_its_sticks():
    plane, px4 = mapped('ardupilot', 'aerosonde'), mapped('px4', 'aerosonde')
    # aileron (rolls right), elevator (pitches up), throttle, rudder (yaws right)
    thrust, joints = plane.commands(padded([1700, 1700, 1500, 1700], 0))
    assert thrust[0] > 0
    # of the model: > 0 rolls right, pitches down, yaws left
    assert [math.copysign(1, j) for j in joints] == [1, -1, -1]
    outputs = [0.0] * 16
    outputs[2], outputs[4], outputs[6], outputs[7] = 0.5, 0.5, 0.5, 0.5
    thrust, joints = px4.commands(outputs)
    assert thrust[0] > 0
    assert [math.copysign(1, j) for j in joints] == [1, -1, -1]


@pytest.mark.parametrize(
    ('pulse', 'share'), [(1000, 0), (1500, 0.25), (2000, 1), (2200, 1), (900, 0), (0, 0)]
)
def test_a_rotor_takes_its_pulse_as_speed(pulse, share):
    thrusts, _ = mapped('ardupilot', 'x500').commands(padded([pulse] * 4, 0))
    assert thrusts == pytest.approx([share * 8.54858] * 4)


@pytest.mark.parametrize(
    ('pulse', 'thrust'),
    # Blue Robotics' sheet at 16 V: ends and dead zone
    [(1100, -39.9), (1472, 0), (1500, 0), (1528, 0), (1900, 51.4), (0, 0), (2000, 51.4)],
)
def test_a_t200_takes_its_pulse_by_its_curve(pulse, thrust):
    thrusts, _ = mapped('ardupilot', 'bluerov2').commands(padded([pulse] * 6, 0))
    assert thrusts == pytest.approx([thrust] * 6)


@pytest.mark.parametrize('path', sorted((config_folder() / 'autopilots').glob('*.yaml')))
def test_every_mapping_fits_its_vehicle(path):
    protocol, _, vehicle = path.stem.partition('_')
    mapping = mapped(protocol, vehicle, path)
    thrusts, joints = mapping.commands([math.nan] * 16)
    assert not any(thrusts) and not any(joints)
    assert len(mapping.rest[0]) == len(thrusts)


GOOD = 'protocol: px4\nairframe: "1"\nactuators:\n'
MOTORS = [f'  - {{output: {i}, thruster: m{i}, input: [0, 1]}}\n' for i in range(1, 5)]


@pytest.mark.parametrize(
    ('lines', 'line'),
    [
        (MOTORS[:3], 'drives 3 of 4 thrusters; missing: m4'),
        ([*MOTORS, MOTORS[0].replace('m1', 'm9')], 'output 1; allowed: 1 to 16, each once'),
        (
            [*MOTORS, MOTORS[0].replace('output: 1', 'output: 9')],
            "thruster 'm1' is driven by two outputs",
        ),
        ([*MOTORS[:3], MOTORS[3].replace('m4', 'm9')], "thruster 'm9' is not in the vehicle"),
        ([*MOTORS[:3], MOTORS[3].replace('4,', '17,')], 'output 17; allowed: 1 to 16, each once'),
        ([*MOTORS[:3], MOTORS[3].replace('4,', '0,')], "key 'actuators.3.output'"),
        ([MOTORS[0].replace('[0, 1]', '[1, 0]')], 'input: the numbers must grow'),
        ([MOTORS[0].replace('}', ', joint: x}')], 'names either a thruster or a joint'),
        ([MOTORS[0].replace('}', ', reversed: true}')], 'needs an input of three numbers'),
        ([MOTORS[0].replace('}', ', curve: cubic}')], "key 'actuators.0.curve'"),
        (
            [MOTORS[0].replace('}', ', gain: 2}')],
            "unknown key 'actuators.0.gain'; allowed: output",
        ),
    ],
)
def test_a_wrong_mapping_is_one_line(tmp_path, lines, line):
    path = tmp_path / 'mine.yaml'
    path.write_text(GOOD + ''.join(lines))
    with pytest.raises(ConfigError) as error:
        mapped('px4', 'x500', path)
    assert line in str(error.value)
    assert str(path) in str(error.value)
    assert '\n' not in str(error.value)
