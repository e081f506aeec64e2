# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""run --hold: the laws of the example controllers in process."""

import json

import numpy as np
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.cli import main
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.loop.hold import Hold
from fluid_sim_ros.loop.pacing import Pacing
from fluid_sim_ros.loop.runner import NoSource, Runner


@pytest.mark.parametrize('scene', ['x500', 'crazyflie', 'quadrotor', 'rov', 'bluerov2_heavy'])
def test_hold_keeps_a_vehicle_where_it_begins(scene):
    simulation = Simulation(scene)
    begin = simulation.data.qpos[:3].copy()
    hold = Hold(simulation)
    Runner(simulation, NoSource(), [hold], Pacing()).run(round(12 / simulation.timestep))
    assert np.linalg.norm(simulation.data.qpos[:3] - begin) < 0.15


@pytest.mark.parametrize(('scene', 'speed'), [('aerosonde', 25.0), ('remus100', 1.5)])
def test_hold_keeps_height_and_heading_of_what_must_move(scene, speed):
    simulation = Simulation(scene)
    begin = simulation.data.qpos[:3].copy()
    hold = Hold(simulation)
    Runner(simulation, NoSource(), [hold], Pacing()).run(round(40 / simulation.timestep))
    (state,) = simulation.snapshot().vehicles.values()
    assert abs(state.position_w[2] - begin[2]) < 0.3
    assert state.velocity_b[0] == pytest.approx(speed, rel=0.1)


def test_the_command_holds_and_its_log_repeats(tmp_path, capsys):
    log = str(tmp_path / 'a.mcap')
    assert main(['run', 'x500', '--hold', '--duration', '2', '--record', log, '--json', '-']) == 0
    result = json.loads(capsys.readouterr().out)
    assert result['remarks'] == []
    assert result['vehicles']['x500']['position_w_m'][2] > 0.5
    assert main(['replay', log, '--resimulate']) == 0


def test_nothing_to_hold_is_one_line():
    with pytest.raises(ConfigError, match='--hold: no vehicle has thrusters; the scene has: sphe'):
        Hold(Simulation('sphere'))


def test_hold_and_an_autopilot_do_not_go_together(capsys):
    assert main(['run', 'x500', '--hold', '--autopilot', 'px4']) == 2
    assert '--hold and --autopilot' in capsys.readouterr().err


@pytest.mark.parametrize(('timestep', 'steps'), [('0.003', 333), ('0.004166666', 240)])
def test_a_duration_is_rounded_to_whole_steps_and_said_so(capsys, timestep, steps):
    assert main(['run', 'sphere', '--timestep', timestep, '--duration', '1', '--json', '-']) == 0
    captured = capsys.readouterr()
    result = json.loads(captured.out)
    assert result['steps'] == steps
    assert f'rounded to {steps} steps' in result['warnings'][0]
    assert 'warning: duration: 1 s is not a whole number of timesteps' in captured.err
