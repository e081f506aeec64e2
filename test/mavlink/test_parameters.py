# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Parameters that a frame needs: stated by its mapping, given to its program, replaced."""

import shlex
import sys

import pytest

from fluid_sim_ros.cli import main
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.mavlink.mapping import load_mapping
from fluid_sim_ros.mavlink.program.parameters import (
    needed_parameters,
    parse_parameters,
    px4_environment,
)
from fluid_sim_ros.resources import config_folder
from test.support.autopilots.autopilot_peers import BridgedFlight, free_port
from test.support.autopilots.px4_stand_in import Px4
from test.support.paths import ROOT

MAPPINGS = sorted(path.stem for path in (config_folder() / 'autopilots').glob('*.yaml'))
ARDUPILOT = f'env PYTHONPATH={ROOT} {sys.executable} -m test.support.autopilots.ardupilot_program'


@pytest.mark.parametrize('name', MAPPINGS)
def test_every_shipped_parameter_has_its_reason(name):
    file, _ = load_mapping(name.partition('_')[0], '', name)
    assert file.parameters
    assert all(entry.reason for entry in file.parameters.values())


@pytest.mark.parametrize(
    ('protocol', 'vehicle', 'expected'),
    [
        ('px4', 'bluerov2_heavy', {'UUV_THRUST_SAT': 1}),
        ('px4', 'x500', {'MPC_THR_HOVER': 0.77}),
        ('px4', 'aerosonde', {'FW_THR_MAX': 1, 'FW_AIRSPD_MIN': 16, 'FW_AIRSPD_MAX': 32}),
        ('ardupilot', 'x500', {'FRAME_CLASS': 1, 'FRAME_TYPE': 1, 'MOT_THST_HOVER': 0.65,
                               'RNGFND1_TYPE': 100, 'BATT_MONITOR': 4}),
        ('ardupilot', 'bluerov2', {'FRAME_CONFIG': 1, 'SIM_BARO_RND': 0.02}),
        ('ardupilot', 'bluerov2_heavy', {'FRAME_CONFIG': 2, 'SIM_BARO_RND': 0.02}),
        ('ardupilot', 'aerosonde', {'SERVO3_MIN': 1100, 'SERVO3_MAX': 1900, 'ARSPD_USE': 1,
                                    'AIRSPEED_CRUISE': 25, 'AIRSPEED_MIN': 18}),
    ],
)  # fmt: skip
def test_what_each_frame_needs(protocol, vehicle, expected):
    file, _ = load_mapping(protocol, vehicle)
    needed = needed_parameters(file, {})
    assert {name: needed[name] for name in expected} == expected


def test_sticks_of_a_mapping_bring_the_parameters_without_which_px4_ignores_them(tmp_path):
    path = tmp_path / 'px4.yaml'
    shipped = (config_folder() / 'autopilots' / 'px4_x500.yaml').read_text()
    path.write_text(shipped + 'rc: [1500, 1500, 1000, 1500, 1900]\n')
    file, _ = load_mapping('px4', 'x500', str(path))
    needed = needed_parameters(file, {'RC_MAP_YAW': 5.0})
    assert needed == {
        'RC_CHAN_CNT': 5, 'COM_RC_IN_MODE': 0, 'RC_MAP_ROLL': 1, 'RC_MAP_PITCH': 2,
        'RC_MAP_THROTTLE': 3, 'RC_MAP_YAW': 5, 'MPC_THR_HOVER': 0.77,
        'SIM_BAT_DRAIN': 0,
    }  # fmt: skip
    with BridgedFlight('x500_ground', 'px4', mapping=str(path)).running() as flight:
        px4 = Px4(flight.port, silent=0)
        for _ in range(30):
            px4.exchange([0.0] * 4)
    assert px4.sticks(needed) == [1500, 1500, 1000, 1500, 1900]
    assert px4.sticks({'COM_RC_IN_MODE': 0}) == []  # as PX4 is without them


def test_a_number_alone_is_a_parameter(tmp_path):
    path = tmp_path / 'px4.yaml'
    shipped = (config_folder() / 'autopilots' / 'px4_x500.yaml').read_text()
    path.write_text(shipped.replace('{value: 0.77, ', 'X: {value: 0.77, ').replace('X: {', '{'))
    text = path.read_text()
    begin = text.index('MPC_THR_HOVER: {')
    path.write_text(text[:begin] + 'MPC_THR_HOVER: 0.5' + text[text.index('}', begin) + 1 :])
    file, _ = load_mapping('px4', 'x500', str(path))
    assert needed_parameters(file, {}) == {'MPC_THR_HOVER': 0.5, 'SIM_BAT_DRAIN': 0}


def test_the_environment_of_the_user_stays():
    parameters = {'FW_THR_MAX': 1.0, 'FW_THR_TRIM': 0.72}
    assert px4_environment(parameters, {'PX4_PARAM_FW_THR_MAX': '0.9'}) == {
        'PX4_PARAM_FW_THR_TRIM': '0.72'
    }


@pytest.mark.parametrize('word', ['FRAME', 'frame=1', 'A=b', 'A=nan', 'A=inf', '=1', ''])
def test_a_parameter_that_is_none_is_refused(word):
    with pytest.raises(ConfigError, match='must be NAME=NUMBER, such as FRAME_TYPE=1'):
        parse_parameters([word])


def test_px4_gets_them_by_its_environment(capfd):
    command = shlex.join(['sh', '-c', 'env | grep ^PX4_ | sort'])
    arguments = ['run', 'aerosonde_ground', '--autopilot', 'px4', '--port', str(free_port('px4')),
                 '--exec', command, '--param', 'FW_THR_TRIM=0.7']  # fmt: skip
    assert main(arguments) == 1  # it ends before it flies
    lines = capfd.readouterr().err.splitlines()
    assert 'PX4_SYS_AUTOSTART=1030' in lines
    assert 'PX4_PARAM_FW_THR_MAX=1' in lines
    assert 'PX4_PARAM_FW_THR_TRIM=0.7' in lines
    (given,) = [line for line in lines if line.startswith('parameters given to the program: ')]
    assert 'FW_THR_MAX 1, FW_THR_TRIM 0.7' in given


def test_ardupilot_gets_them_behind_the_users_file(tmp_path, capfd):
    user = tmp_path / 'copter.parm'
    user.write_text('FRAME_TYPE 0\nFENCE_RADIUS 150\n')
    arguments = ['run', 'x500_ground', '--autopilot', 'ardupilot', '--duration', '0.1',
                 '--port', str(free_port('ardupilot')), '--param', 'MOT_SPIN_MIN=0.1',
                 '--exec', f'{ARDUPILOT} --defaults {user}']  # fmt: skip
    assert main(arguments) == 0
    lines = capfd.readouterr().err.splitlines()
    first, second = [line for line in lines if line.startswith('defaults: ')]
    assert first == 'defaults: FRAME_TYPE 0 FENCE_RADIUS 150'
    assert 'FRAME_CLASS 1 FRAME_TYPE 1' in second
    assert 'MOT_SPIN_MIN 0.1' in second


def test_without_a_program_it_is_said_what_to_set():
    flight = BridgedFlight('aerosonde_ground', 'ardupilot')
    flight.bridge.close()
    assert flight.opening == [
        'ardupilot_aerosonde: the autopilot needs SERVO3_MIN 1100, SERVO3_MAX 1900, '
        'AIRSPEED_CRUISE 25, AIRSPEED_MIN 18, AIRSPEED_MAX 35, ARSPD_USE 1'
    ]  # fmt: skip
