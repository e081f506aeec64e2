# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Watchdogs of a run: energy, MuJoCo's limits, and how the vehicles ended."""

import json

import mujoco
import pytest

from fluid_sim_ros import Simulation, scene_names
from fluid_sim_ros.cli import main
from fluid_sim_ros.loop.pacing import Pacing
from fluid_sim_ros.loop.runner import NoSource, Runner
from fluid_sim_ros.loop.watchdogs import Watchdogs

LINK = '<geom type="capsule" fromto="0 0 0 .3 0 0" size=".03"/>'
CHAIN = f"""<mujoco><option timestep="0.01" gravity="0 0 0"/><worldbody>
  <body name="chain"><freejoint/>{LINK}
    <body pos=".3 0 0"><joint axis="0 1 0"/>{LINK}
      <body pos=".3 0 0"><joint axis="0 0 1"/>{LINK}</body></body></body></worldbody>
  <keyframe><key name="spin" qvel="0 0 0 1 3 2 8 -6"/></keyframe></mujoco>"""
FLOOR = '<geom name="floor" type="plane" size="9 9 .1" {}/>'


def run(scene, duration=None, **settings):
    """Return the simulation after a run, its lines as they were shown, and the remarks."""
    simulation, shown = Simulation(scene, **settings), []
    watchdogs = Watchdogs(simulation, shown.append)
    seconds = duration or simulation.scene.duration
    steps = round(seconds / simulation.timestep)
    Runner(simulation, NoSource(), [watchdogs], Pacing()).run(until=steps)
    remarks = watchdogs.finish()
    assert shown == simulation.warnings.lines
    return simulation, shown, remarks


@pytest.fixture
def chain(tmp_path):
    (tmp_path / 'chain.xml').write_text(CHAIN)
    path = tmp_path / 'chain.yaml'
    path.write_text('model: chain.xml\nkeyframe: spin\nduration: 2\n')
    return path


@pytest.mark.parametrize('integrator', ['Euler', 'implicit', 'implicitfast'])
def test_an_undamped_chain_that_gains_energy_is_told_of(chain, integrator):
    _, (line,), _ = run(chain, integrator=integrator)
    assert line.startswith('energy watchdog: by t = 1.0')
    assert 'the integrator has added' in line and line.endswith('use RK4 or a smaller timestep')


def test_an_undamped_chain_under_rk4_keeps_its_energy_and_is_not(chain):
    assert run(chain, integrator='RK4')[1] == []


def test_the_command_shows_and_returns_the_energy_watchdog(chain, capsys):
    assert main(['run', str(chain), '--json', '-']) == 0
    captured = capsys.readouterr()
    (line,) = json.loads(captured.out)['warnings']
    assert captured.err == f'warning: {line}\n'


@pytest.mark.parametrize('name', scene_names())
def test_no_shipped_scene_raises_a_false_alarm(name):
    lines = run(name, duration=5.0)[1]
    beyond_the_drag_curve = [line for line in lines if 'reached Re = ' in line]  # doc/limits.md
    assert lines == beyond_the_drag_curve
    assert not lines or name in ('wave_buoy', 'buoyant_sphere')


def test_limits_of_mujoco_are_told_of(chain):
    simulation = Simulation(chain)
    watchdogs = Watchdogs(simulation)
    watchdogs.write(simulation)
    assert simulation.warnings.lines == []
    simulation.data.warning[mujoco.mjtWarning.mjWARN_CONTACTFULL].number = 3
    watchdogs.write(simulation)
    watchdogs.write(simulation)
    assert simulation.warnings.lines == ['MuJoCo: contacts were left out: raise <size memory>']


def test_a_vehicle_that_ended_on_the_ground_upside_down():
    _, _, remarks = run('x500')
    assert remarks == ["vehicle 'x500' ended on 'ground', upside down (tilt 180 deg)"]


@pytest.mark.parametrize('name', ['x500_ground', 'aerosonde_ground', 'rov', 'remus100', 'fish'])
def test_a_vehicle_that_ended_as_it_began_is_no_matter(name):
    assert run(name, duration=3.0)[2] == []


@pytest.mark.parametrize(
    ('floor', 'start', 'words'),
    [
        ('contype="0" conaffinity="0"', 'pos="0 0 1"', 'm from its start, beyond the scene'),
        ('contype="2" conaffinity="2"', 'pos="0 0 1"', "ended below 'floor', through which it"),
        ('', 'pos="0 0 .3"', "ended on 'floor'"),
        ('', 'pos="0 0 .1"', ''),
    ],
)
def test_a_vehicle_that_ended_beyond_the_scene(tmp_path, floor, start, words):
    path = tmp_path / 'drop.xml'
    path.write_text(
        f'<mujoco><statistic extent="1"/><worldbody>{FLOOR.format(floor)}'
        f'<body name="a" {start}><freejoint/><geom size=".1"/></body></worldbody></mujoco>'
    )
    remarks = run(path, duration=5.0)[2]
    assert (remarks == []) if not words else (words in remarks[0])


def test_the_command_says_how_a_vehicle_ended(capsys):
    assert main(['run', 'x500', '--json', '-']) == 0
    captured = capsys.readouterr()
    result = json.loads(captured.out)
    assert captured.err.strip() == result['remarks'][0]
    assert result['vehicles']['x500']['terms'] == ['drag', 'viscous']
