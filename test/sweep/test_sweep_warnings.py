# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Every watchdog speaks in a sweep, too: each row carries its warnings."""

import json

import pyarrow.parquet as pq
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.cli import main
from fluid_sim_ros.loop.pacing import Pacing
from fluid_sim_ros.loop.runner import NoSource, Runner
from fluid_sim_ros.loop.watchdogs import Watchdogs
from fluid_sim_ros.sweep.case_runs import CaseRunner
from fluid_sim_ros.sweep.run_sweep import run_sweep
from fluid_sim_ros.sweep.run_watch import RunWatch
from test.loop.test_watchdogs import CHAIN
from test.support.sweeps import sweep_of

VARY = {'integrator': {'values': ['Euler', 'RK4']}, 'timestep': {'values': [0.01, 1e-4]}}
#: A drop into water at a speed that passes the surface in one step.
DROP = """<mujoco><option timestep="0.01"/><extension><plugin plugin="fluid_sim.body"/>
<plugin plugin="fluid_sim.medium"><instance name="sea"><config key="density" value="1000"/>
<config key="surface" value="0"/></instance></plugin></extension><worldbody>
<body name="ball" pos="0 0 .3" simple="false"><freejoint/>
<geom type="ellipsoid" size=".05 .05 .05" density="500" fluidshape="ellipsoid"/>
<plugin plugin="fluid_sim.body"><config key="volume" value="auto"/>
<config key="added_mass" value="auto"/></plugin></body></worldbody>
<keyframe><key name="fast" qpos="0 0 .3 1 0 0 0" qvel="0 0 -10 0 0 0"/>
<key name="slow" qpos="0 0 .06 1 0 0 0"/></keyframe></mujoco>"""


@pytest.fixture
def chain(tmp_path):
    (tmp_path / 'chain.xml').write_text(CHAIN)
    path = tmp_path / 'chain.yaml'
    path.write_text('model: chain.xml\nkeyframe: spin\nduration: 2\n')
    return str(path)


def test_a_sweep_asks_the_energy_watchdog(chain, tmp_path, capsys):
    """An undamped chain gains 236 % in 2 s by Euler's steps of 10 ms; RK4 keeps its energy."""
    sweep = sweep_of(scene=chain, duration=2.0, vary=VARY)
    result = run_sweep(sweep, tmp_path / 'out', workers=2)
    rows = pq.read_table(result['table']).to_pylist()
    said = {(row['integrator'], row['timestep']): row['warnings'] for row in rows}
    assert said['Euler', 0.01].startswith('energy watchdog: by t = 2 s the integrator has added')
    assert said['Euler', 1e-4] == said['RK4', 0.01] == said['RK4', 1e-4] == ''
    assert result['runs_with_warnings'] == 1
    assert result['first_warning'] == f'run 0: {said["Euler", 0.01]}'
    # alone, the same words
    runner = CaseRunner(sweep)
    assert [runner.row(row['run'])['warnings'] for row in rows] == [r['warnings'] for r in rows]
    # and the same as those of a run, but for how often one looked before
    simulation = Simulation(chain, integrator='Euler')
    watchdogs = Watchdogs(simulation)
    Runner(simulation, NoSource(), [watchdogs], Pacing()).run(until=200)
    watchdogs.finish()
    (line,) = simulation.warnings.lines
    assert line.partition(' t = ')[0] == said['Euler', 0.01].partition(' t = ')[0]
    file = tmp_path / 'sweep.yaml'
    file.write_text(f'scene: {chain}\nvary: {{integrator: {{values: [Euler]}}}}\n')
    assert main(['sweep', str(file), '--out', str(tmp_path / 'b')]) == 0
    assert '1 runs with warnings' in ' '.join(capsys.readouterr().out.split())


def test_limits_of_the_forces_belong_to_their_run_alone(tmp_path):
    """A fast drop must not leave its warning to the slow one that follows it."""
    (tmp_path / 'drop.xml').write_text(DROP)
    rows = {}
    for key in ('fast', 'slow'):
        path = tmp_path / f'{key}.yaml'
        path.write_text(f'model: drop.xml\nkeyframe: {key}\nduration: 0.2\n')
        sweep = sweep_of(scene=str(path), duration=0.2, vary={'seed': {'values': [1, 2]}})
        rows[key] = CaseRunner(sweep).rows(0, 2)
    assert all("body 'ball' crossed the surface at" in row['warnings'] for row in rows['fast'])
    assert [row['warnings'] for row in rows['slow']] == ['', '']
    # one simulation, first fast and then slow
    simulation = Simulation(tmp_path / 'fast.yaml')
    watch = RunWatch(simulation)
    for key, said in (('fast', True), ('slow', False)):
        simulation.reset(key)
        watch.begin()
        simulation.step(20)
        assert bool(watch.end(complete=True)) is said


@pytest.mark.parametrize(
    ('scene', 'keys'),
    [
        ('rov', {'vary': {'thrust.bluerov2_heavy': {'uniform': [-1, 1]}}, 'duration': 1.0}),
        ('fish', {'duration': 1.0}),  # a gait: one by one
        ('x500', {'hold': {'law': 'multirotor', 'target': [0, 0, 1.5]}, 'duration': 1.0}),
        ('sphere', {'duration': 2.0}),
    ],
)
def test_a_sound_run_has_no_warning(scene, keys):
    sweep = sweep_of(scene=scene, **keys)
    assert CaseRunner(sweep).rows(0, 1)[0]['warnings'] == ''


def test_a_run_that_diverges_says_so_and_no_more():
    sweep = sweep_of(vary={'current.x': {'values': [1e7]}}, timestep=0.1, duration=2.0)
    (row,) = CaseRunner(sweep).rows(0, 1)
    alone = CaseRunner(sweep).row(0)
    assert row['status'] == 'diverged'
    assert row['warnings'] == alone['warnings']


def test_what_is_found_at_load_is_in_the_result(tmp_path):
    (tmp_path / 'two.xml').write_text(
        '<mujoco><option density="1000"/><worldbody><body name="wet"><freejoint/>'
        '<geom size=".1" fluidshape="ellipsoid"/></body></worldbody></mujoco>'
    )
    sweep = sweep_of(scene=str(tmp_path / 'two.xml'), vary={'seed': {'values': [0]}})
    result = run_sweep(sweep, tmp_path / 'out', workers=1)
    assert result['warnings'] == Simulation(sweep.scene).warnings.lines
    json.dumps(result)
