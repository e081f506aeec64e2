# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Loss of thrust by an axial inflow: the law, its twin, off unless asked, and what is refused."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros import Scene, Simulation
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.rotor_effects import inflow_thrust
from test.support import vehicle_runs as runs
from test.support.plugin_models import load, refusal
from test.support.thruster_models import T200, read, rotor_world

LINEAR = {'inflow': 'true', 'zero_thrust_advance': 0.73, 'diameter': 0.076}
#: An x500's rotor, both ways, by momentum theory.
ROTOR = {
    'curve': 'quadratic', 'thrust_coefficient': [8.54858e-6, 6e-6], 'rad_s_max': [1000, 800],
    'command': 'rad_s', 'torque_ratio': 0.016, 'inflow': 'true', 'inflow_law': 'momentum',
    'zero_thrust_advance': [0.6, 0.5], 'diameter': 0.254, 'density': 1.225,
}  # fmt: skip


def loads(values, command, inflow):
    model, data = load(rotor_world(values))
    data.ctrl[0], data.qvel[2] = command, inflow
    mujoco.mj_forward(model, data)
    return read(model, data)


@pytest.mark.parametrize('command', [900.0, 200.0, 1e-3, 0.0, -1e-3, -300.0, -800.0])
def test_momentum_theory_against_its_twin(command):
    side = int(command < 0)
    k = ROTOR['thrust_coefficient'][side]
    for inflow in (-40.0, -6.0, -0.5, 0.0, 0.5, 6.0, 19.0, 60.0):
        thrust, torque = inflow_thrust(
            command, k * command * abs(command), inflow, diameter=0.254, density=1.225,
            zero_advance=ROTOR['zero_thrust_advance'][side],
        )  # fmt: skip
        got = loads(ROTOR, command, inflow)
        at_rest = 0.016 * k * command * abs(command)
        assert got['thrust'] == pytest.approx(float(thrust), rel=1e-9, abs=1e-15)
        assert got['torque'] == pytest.approx(at_rest + float(torque), rel=1e-9, abs=1e-15)


def test_the_two_equations_of_momentum_theory_hold():
    omega, inflow = 700.0, 4.0
    thrust = loads(ROTOR, omega, inflow)['thrust']
    area, pitch_speed = np.pi / 4 * 0.254**2, 0.6 * 0.254 * omega / (2 * np.pi)
    at_rest = 8.54858e-6 * omega**2
    hover = np.sqrt(at_rest / (2 * 1.225 * area))
    drawn = pitch_speed - inflow - thrust / at_rest * (pitch_speed - hover)
    assert 2 * 1.225 * area * (inflow + drawn) * drawn == pytest.approx(thrust, rel=1e-9)
    assert 0.5 * at_rest < thrust < 0.95 * at_rest


def test_thrust_vanishes_at_the_stated_advance_and_is_that_at_rest_at_rest():
    turns = np.sqrt(51.4 / (51.4 / (3533 * np.pi / 30) ** 2)) / (2 * np.pi)
    full = loads({**T200, **LINEAR}, 1900.0, 0.0)
    assert full['thrust'] == pytest.approx(51.4, rel=1e-12)
    none = loads({**T200, **LINEAR}, 1900.0, 0.73 * turns * 0.076)
    assert none['thrust'] == pytest.approx(0.0, abs=1e-9)
    half = loads({**T200, **LINEAR}, 1900.0, 0.365 * turns * 0.076)
    assert half['thrust'] == pytest.approx(25.7, rel=1e-9)


def test_thrust_measured_in_motion_is_what_it_was_there():
    values = {
        'curve': 'quadratic', 'thrust_coefficient': 1.5644e-4, 'rad_s_max': 261.8,
        'diameter': 0.14, 'inflow': 'true', 'zero_thrust_advance': 1.094, 'measured_advance': 0.44,
        'command': 'rad_s',
    }  # fmt: skip
    assert loads(values, 50 * np.pi, 1.54)['thrust'] == pytest.approx(3.86, rel=1e-4)
    assert loads(values, 50 * np.pi, 0.0)['thrust'] == pytest.approx(
        3.86 / (1 - 0.44 / 1.094), 1e-4
    )


def test_inflow_from_behind_stays_bounded_by_momentum_theory():
    at_rest = loads(ROTOR, 700.0, 0.0)['thrust']
    found = [loads(ROTOR, 700.0, -speed)['thrust'] for speed in (1.0, 10.0, 100.0, 1e6)]
    assert np.all(np.diff([at_rest, *found]) > 0)
    hover_share = np.sqrt(2 * 8.54858e-6 / (np.pi * 1.225)) * 2 * np.pi / (0.6 * 0.254**2)
    assert found[-1] == pytest.approx(at_rest / (1 - hover_share), rel=1e-4)


@pytest.mark.parametrize('name', ['bluerov2', 'bluerov2_heavy', 'x500', 'remus100'])
def test_what_a_model_states_for_inflow_changes_nothing_until_it_is_asked_for(name):
    spec = Scene.load(name).read_model()
    stated, touched = spec.compile(), 0
    for plugin in spec.plugins:
        kept = {
            key: value for key, value in plugin.config.items()
            if key not in ('zero_thrust_advance', 'inflow_law', 'measured_advance')
        }  # fmt: skip
        if plugin.plugin_name == 'fluid_sim.thruster' and 'fluid' not in kept:
            kept.pop('density', None)  # no other key reads it
        touched += kept != dict(plugin.config)
        plugin.config = kept
    assert touched >= 1
    ends = []
    for model in (stated, spec.compile()):
        data = mujoco.MjData(model)
        mujoco.mj_resetDataKeyframe(model, data, 0)
        data.ctrl[:] = 3.0
        mujoco.mj_step(model, data, 300)
        ends.append(data.qpos.copy())
    np.testing.assert_array_equal(*ends)


def test_an_x500_gains_near_the_ground_and_loses_in_a_climb():
    simulation = Simulation('x500_landing')
    model, data = simulation.model, simulation.data

    def thrust(height, climb=0.0):
        data.qpos[2], data.qvel[2] = height, climb
        mujoco.mj_forward(model, data)
        return read(model, data)['thrust']

    far = thrust(50.0)
    radius, rotor = 0.127, 0.13 + 0.06
    assert thrust(0.13) / far == pytest.approx(1 / (1 - (radius / (4 * rotor)) ** 2), rel=1e-6)
    assert 0.96 < thrust(50.0, 1.0) / far < 0.97


def test_the_rung_inflow_brings_the_bluerov2_to_its_makers_top_speed():
    simulation = Simulation('bluerov2', fluid='inflow')
    simulation.data.qpos[2] = -50
    runs.set_all(simulation, 'bluerov2', runs.top_command('surge', 6))
    velocity = runs.held(simulation, np.array([1.0, 0, 0, 0]), 6.0)
    assert velocity[-1, 0] == pytest.approx(1.5, rel=0.06)  # 3 knots; 1.92 m/s without


def test_the_rung_inflow_is_refused_where_no_thruster_states_it():
    with pytest.raises(ConfigError, match='states zero_thrust_advance, at'):
        Simulation('sphere', fluid='inflow')


def test_the_rung_inflow_of_a_fleet_reaches_every_vehicle():
    simulation = Simulation('fleet_mixed', fluid='inflow')
    simulation.step(20)
    assert set(simulation.vehicles) == {'one', 'two', 'rov'}


@pytest.mark.parametrize(
    ('values', 'words'),
    [
        ({**T200, 'inflow': 'true'}, 'zero_thrust_advance is missing; give 1 or 2 numbers > 0'),
        ({**T200, 'inflow': 'yes'}, "'yes'; allowed: false, true"),
        ({**T200, **LINEAR, 'zero_thrust_advance': 0}, '1 or 2 numbers > 0 [-]'),
        ({**T200, 'zero_thrust_advance': 0.7}, 'diameter is missing'),
        ({**T200, **LINEAR, 'measured_advance': 0.73}, 'below zero_thrust_advance'),
        ({**ROTOR, 'measured_advance': 0.1}, 'inflow_law linear only'),
        ({**ROTOR, 'zero_thrust_advance': 0.2}, 'above 0.205273'),
        ({key: v for key, v in ROTOR.items() if key != 'density'}, 'give density [kg/m^3]'),
    ],
)
def test_what_is_refused(values, words):
    assert words in refusal(rotor_world(values), 'fluid_sim.thruster')
