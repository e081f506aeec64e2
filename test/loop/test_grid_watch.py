# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A vehicle that leaves the grid of its wind or current: said once, with the place."""

import json

import mujoco
import numpy as np
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.cli import main
from fluid_sim_ros.loop.grid_watch import GridWatch
from fluid_sim_ros.physics.environment.grid import checked_grid
from fluid_sim_ros.scene.grid_files import grid_numbers

MODEL = """<mujoco><option gravity="0 0 0" timestep="0.01"/><extension>
<plugin plugin="fluid_sim.medium"><instance name="sea"><config key="density" value="1000"/>
<config key="surface" value="0"/>{}</instance></plugin></extension>
<custom><numeric name="flow" size="{}" data="{}"/></custom>
<worldbody><body name="drifter" pos="0 0 -1"><freejoint/><geom size=".1"/></body></worldbody>
<keyframe><key name="go" qpos="0 0 -1 1 0 0 0" qvel="2 0 0 0 0 0"/></keyframe></mujoco>"""


@pytest.fixture
def scene(tmp_path):
    def write(*streams):
        grid = checked_grid(
            ([0.0, 1.5], [-1.0, 2.0], [0.0], [-3.0, 0.0]), np.zeros((2, 2, 1, 2, 3))
        )
        numbers = grid_numbers(grid)
        keys = ''.join(f'<config key="{stream}_grid" value="flow"/>' for stream in streams)
        text = ' '.join(f'{number:g}' for number in numbers)
        (tmp_path / 'sea.xml').write_text(MODEL.format(keys, len(numbers), text))
        path = tmp_path / 'scene.yaml'
        path.write_text('model: sea.xml\nkeyframe: go\n')
        return path

    return write


def test_each_end_is_said_once_with_the_place(scene):
    simulation = Simulation(scene('current'))
    watch = GridWatch(simulation)
    assert watch.new_lines() == []
    simulation.step(110)
    assert watch.new_lines() == [
        "current grid: 'drifter' at x = 2.2 m is beyond its end at 2 m: the edge value holds "
        '(t = 1.1 s)'
    ]
    assert watch.new_lines() == []
    simulation.step(60)
    (line,) = watch.new_lines()
    assert line.startswith("current grid: 'drifter' at t = 1.7 s is beyond its end at 1.5 s")
    assert len(watch.lines) == 2


def test_only_the_fluid_that_the_vehicle_is_in_matters(scene):
    simulation = Simulation(scene('wind'))
    simulation.step(200)
    watch = GridWatch(simulation)
    assert watch.new_lines() == []
    simulation.data.qpos[2] = 0.5
    assert [line.split(' at ')[1][0] for line in watch.new_lines()] == ['t', 'x', 'z']


def test_scenes_without_a_grid_are_not_looked_at(scene):
    simulation = Simulation(scene())
    simulation.step(300)
    mujoco.mj_resetData(simulation.model, simulation.data)
    assert GridWatch(simulation).new_lines() == []


def test_a_run_ends_with_what_was_said(scene, tmp_path, capsys):
    out = tmp_path / 'result.json'
    assert main(['run', str(scene('current')), '--duration', '2', '--json', str(out)]) == 0
    felt, *warnings = json.loads(out.read_text())['warnings']
    assert felt.startswith("vehicle 'drifter': no fluid acts on it")
    assert [line.split(' is beyond')[0] for line in warnings] == [
        "current grid: 'drifter' at x = 2.02 m", "current grid: 'drifter' at t = 1.51 s"
    ]  # fmt: skip
    assert f'warning: {warnings[0]}\n' in capsys.readouterr().err
