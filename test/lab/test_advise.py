# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The advisor: cheap enough, accurate enough, verified, and written into the scene."""

import json
from itertools import pairwise

import numpy as np
import pytest

from fluid_sim_ros import Scene, Simulation
from fluid_sim_ros.cli import main
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.lab.advisor.advice import settings, snippet, verify
from fluid_sim_ros.lab.advisor.advise import advise
from fluid_sim_ros.lab.advisor.budgeted_runs import BudgetedRuns
from fluid_sim_ros.lab.advisor.reference import find_reference
from fluid_sim_ros.lab.metrics import METRICS, metric
from fluid_sim_ros.lab.problems.catalogue import problem
from fluid_sim_ros.lab.problems.from_scene import of_scene
from fluid_sim_ros.scene import scene_names

STATED = """# a scene of mine
model: sphere
medium: water
vehicles: {sphere: sphere}
duration: 2.0  # [s]
keyframe: drop
timestep: 0.002
"""


@pytest.fixture(scope='module')
def sphere():
    return advise('sphere', 0.01, duration=2.0)


def test_the_choice_keeps_the_tolerance_and_is_the_cheapest(sphere):
    costs = [row['cpu_us_per_s'] for row in sphere['candidates']]
    assert all(a <= 1.35 * b for a, b in pairwise(costs))
    assert all(row['error'] <= 0.01 for row in sphere['candidates'])
    assert sphere['choice'] == sphere['candidates'][0]
    assert sphere['runner_up'] == sphere['candidates'][1]
    assert sphere['cheaper_than_baseline'] > 3
    assert sphere['choice']['margin'] >= 1


def test_an_independent_run_confirms_it(sphere):
    found = verify('sphere', sphere)
    assert found['within']
    assert 0 < found['error'] <= 0.01


def test_a_smaller_tolerance_costs_more(sphere):
    finer = advise('sphere', 1e-7, duration=2.0)
    assert finer['choice']['integrator'] == 'RK4'
    assert finer['choice']['cpu_us_per_s'] > sphere['choice']['cpu_us_per_s']


def test_what_is_missing_is_said():
    found = advise('sphere', 1e-16, duration=0.5)
    assert found['choice'] is None
    assert 'the richest model is known to' in found['missing']


@pytest.mark.parametrize(
    ('arguments', 'message'),
    [
        ({'tolerance': 1.0}, 'tolerance 1: must be above 0 and below 1'),
        (
            {'tolerance': 0.1, 'metric_name': 'beauty'},
            "metric 'beauty' is not known; allowed: pose",
        ),
        ({'tolerance': 0.1, 'rate': 1e7}, 'no timestep of 1, 2, 5 times a power of ten fits it'),
        ({'tolerance': float('nan')}, 'tolerance nan: must be above 0 and below 1'),
        ({'tolerance': 0.1, 'rate': 0.0}, 'rate 0 Hz: must be finite and above 0'),
        ({'tolerance': 0.1, 'budget': -1.0}, 'budget -1 s: must be finite and above 0'),
    ],
)
def test_wrong_input_is_refused(arguments, message):
    with pytest.raises(ConfigError, match=message):
        advise('sphere', duration=1.0, **arguments)


@pytest.mark.parametrize(('duration', 'words'), [(0.0, 'finite and above 0'), (1e-9, '0.01 s')])
def test_a_duration_that_leaves_nothing_is_refused(duration, words):
    with pytest.raises(ConfigError, match=words):
        advise('sphere', 0.1, duration=duration)


def test_metrics_are_relative_and_zero_for_the_same_motion():
    case = of_scene('ellipsoid', 1.0)
    states = np.zeros((len(case.times), 1, 13))
    states[:, 0, 3] = 1
    states[:, 0, 0] = 10 * case.times  # [m]: 10 m along x at 10 m/s
    states[:, 0, 7] = 10
    moved = states.copy()
    moved[-1, 0, 0] += 0.5
    moved[-1, 0, 7] += 0.2
    for name in METRICS:
        assert metric(name, case, states)(states, states) == 0
    for name, size in (('position', 0.05), ('pose', 0.05), ('velocity', 0.02), ('attitude', 0)):
        assert metric(name, case, states)(moved, states) == pytest.approx(size)


def test_the_lines_say_what_the_scene_then_does(sphere, tmp_path):
    path = tmp_path / 'mine.yaml'
    path.write_text(STATED.replace('timestep: 0.002\n', '') + snippet(sphere))
    simulation = Simulation(path)
    assert simulation.timestep == settings(sphere)['timestep'] == sphere['choice']['timestep']
    assert simulation.model.opt.integrator == Scene.load(path).compile().model.opt.integrator


def test_apply_writes_the_choice_and_keeps_the_rest(tmp_path, capsys):
    path = tmp_path / 'mine.yaml'
    path.write_text(STATED)
    for tolerance in ('0.05', '0.01'):
        arguments = ['advise', str(path), '--tolerance', tolerance, '--duration', '.5', '--apply']
        assert main([*arguments, '--json', '-']) == 0
        result = json.loads(capsys.readouterr().out)
    text = path.read_text()
    assert text.startswith('# a scene of mine\nmodel: sphere\n')
    assert text.count('timestep:') == text.count('integrator:') == text.count('# fluid_sim') == 1
    assert 'duration: 2.0  # [s]' in text
    loaded = Scene.load(path)
    assert loaded.timestep == result['choice']['timestep']
    assert loaded.integrator == result['choice']['integrator']
    assert main(['advise', 'sphere.xml', '--tolerance', '.1', '--apply']) == 2
    assert 'has no scene file' in capsys.readouterr().err


def test_a_scene_without_waves_and_currents_can_still_be_dry():
    """The rung none keeps the scene's own events from being refused."""
    simulation = Simulation('rov', fluid='none')
    simulation.set_current([0.3, 0, 0])
    simulation.step()


@pytest.mark.parametrize(('key', 'value'), [('integrator', 'RK5'), ('fluid', 'honey')])
def test_a_wrong_setting_in_a_scene_file_is_refused(tmp_path, key, value):
    path = tmp_path / 'mine.yaml'
    path.write_text(f'{STATED}{key}: {value}\n')
    with pytest.raises(ConfigError, match=f"mine.yaml: key '{key}': '{value}' is not known"):
        Simulation(path)


def test_what_was_tried_is_said(sphere):
    tried = {(row['rung'], row['integrator'], row['timestep']) for row in sphere['tried']}
    chosen = sphere['choice']
    assert (chosen['rung'], chosen['integrator'], chosen['timestep']) in tried
    assert {row['rung'] for row in sphere['not_tried']} >= {'none', 'inertia'}
    assert "the model's own error is" in sphere['not_tried'][0]['why']
    json.dumps(sphere, allow_nan=False)


def test_a_budget_that_is_too_small_is_said():
    found = advise('sphere', 0.01, budget=1e-9)
    assert any('time budget' in row['why'] for row in found['not_tried'])
    assert found['choice'] is None
    assert '--budget' in found['missing']


def test_a_sensitive_motion_is_compared_point_by_point_as_long_as_that_works():
    found = advise('kirchhoff', 0.01)
    assert found['reference']['chaotic']
    assert found['metric'] == 'pose'
    assert found['choice']['integrator'] == 'RK4'


def test_a_motion_that_forgets_its_start_is_judged_by_its_regime():
    """Sheets that flutter chaotically: no refinement agrees with the last one after a while."""
    budgeted = BudgetedRuns(problem('plate_chaos'), 60.0)
    found = find_reference(budgeted, 0.02, 0.01, 'pose', lambda *_: None)
    assert found.sensitivity.chaotic
    assert found.metric_name == 'regime'


KEPT = ['advise', '--tolerance', '0.05', '--duration', '.5', '--keep']


def test_advice_that_is_kept_changes_nothing_until_it_is_asked_for(tmp_path, capsys):
    path = tmp_path / 'mine.yaml'
    path.write_text(STATED)
    for _ in range(2):
        assert main([*KEPT, str(path), '--json', '-']) == 0
        result = json.loads(capsys.readouterr().out)
    text = path.read_text()
    assert text.startswith(STATED)
    assert text.count('advised:') == 1
    loaded = Scene.load(path)
    assert loaded.timestep == 0.002
    assert loaded.advised.timestep == result['choice']['timestep']
    assert loaded.advised.command == result['command']
    runs = {}
    for options in ((), ('--advised',), ('--advised', '--timestep', '.001')):
        assert main(['run', str(path), '--duration', '1', '--json', '-', *options]) == 0
        runs[options] = json.loads(capsys.readouterr().out)
    assert [run['timestep_s'] for run in runs.values()] == [0.002, loaded.advised.timestep, 0.001]
    integrators = [run['integrator'] for run in runs.values()]
    assert integrators[1:] == [loaded.advised.integrator.lower()] * 2


def test_advice_that_is_not_there_is_missed(tmp_path, capsys):
    path = tmp_path / 'mine.yaml'
    path.write_text(STATED)
    assert main(['run', str(path), '--advised']) == 2
    assert 'has no advised settings; fluid_sim advise' in capsys.readouterr().err


@pytest.mark.parametrize(
    ('line', 'message'),
    [
        ('integrator: RK5', r"'advised.integrator'.*is not known; allowed: euler"),
        ('integrator: RK4, fluid: honey', r"'advised.fluid'.*is not known; allowed: none"),
        ('integrator: RK4, colour: red', r"'advised.colour'"),
    ],
)
def test_wrong_advice_in_a_scene_file_is_refused(tmp_path, line, message):
    path = tmp_path / 'mine.yaml'
    head = 'command: c, tolerance: 0.01, metric: pose, error: 0.001, timestep: 0.01'
    path.write_text(f'{STATED}advised: {{{head}, {line}}}\n')
    with pytest.raises(ConfigError, match=message):
        Scene.load(path)


@pytest.mark.parametrize('name', scene_names())
def test_every_scene_ships_its_advice_or_has_none_to_give(name):
    scene = Scene.load(name)
    if name in ('aerosonde_ground', 'x500_ground'):  # rest on the ground: refused
        assert scene.advised is None
        return
    advised = scene.advised
    assert advised.command == f'fluid_sim advise {name} --tolerance 0.01'
    assert advised.error <= advised.tolerance == 0.01
    settings = {key: getattr(advised, key) for key in ('timestep', 'integrator', 'fluid')}
    simulation = Simulation(name, **settings)
    simulation.step(10)
