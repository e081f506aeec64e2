# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import sys

import numpy as np
import pytest

from benchmarks.peers import peer_simulators as peers
from benchmarks.peers.peer_mujoco import own_runs, stock_runs
from benchmarks.peers.peer_picture import draw
from benchmarks.peers.peer_tasks import TASKS, TIMES, air_rates, air_start, scipy_runs
from benchmarks.peers.peer_underwater import (
    lagged_runs,
    own_model,
    plain_runs,
    reference,
    simulation_runs,
)
from fluid_sim_ros.errors import DivergedError
from fluid_sim_ros.lab.problems.closed_forms import scene_of


def contestants(task):
    """Return runs of every simulator at a task, those from outside where they are installed."""
    runs = own_runs(task, [0.02]) + stock_runs(task, [0.02])
    if peers.find_spec('jsbsim'):
        from benchmarks.peers.peer_jsbsim import jsbsim_runs

        runs += jsbsim_runs(task, [0.02])
    if peers.find_spec('rotorpy'):
        from benchmarks.peers.peer_rotorpy import rotorpy_runs

        runs += rotorpy_runs(task, [0.1])
    if peers.find_spec('drone_models'):
        from benchmarks.peers.peer_drone_models import drone_models_runs

        runs += drone_models_runs(task, [0.02])
    return runs


def error(run):
    return np.linalg.norm(run.prepare()() - run.reference, axis=1).max()


@pytest.fixture(scope='module')
def underwater():
    return reference()


@pytest.mark.parametrize('make', TASKS)
def test_the_closed_form_solves_the_equations(make):
    task = make()
    runs = scipy_runs(air_start(task), air_rates(task), task.reference(TIMES), [1e-12])
    assert all(error(run) < 1e-9 for run in runs)


@pytest.mark.parametrize('make', TASKS)
def test_every_simulator_does_the_task(make):
    bounds = {
        '1': 1e-7,
        '100': 1e-7,
        'RK4': 1e-7,
        'implicitfast': 0.3,
        'default': 0.01,
        'AB4': 0.01,
        'DOP853': 1e-9,
    }
    for run in contestants(make()):
        name = run.peer.split()[1]
        bound = 1e-5 if run.peer == 'RotorPy default' else bounds[name]
        assert error(run) < bound, run.peer


def test_a_run_starts_anew_each_time():
    run = own_runs(TASKS[2](), [0.05])[0]
    assert np.array_equal(run.prepare()(), run.prepare()())


def test_the_plain_vehicle_and_ours_meet_the_reference(underwater):
    ours = simulation_runs(scene_of('underwater', own_model()), [0.02], underwater)
    plain = plain_runs([], [1e-11], underwater)
    assert error(ours[0]) < 1e-6
    assert all(error(run) < 1e-8 for run in plain)


def test_lagged_added_mass_beyond_the_own_mass_diverges_at_any_timestep(underwater):
    runs = lagged_runs([0.1, 0.001], underwater)
    for run in runs[:2]:
        with pytest.raises(DivergedError):
            run.prepare()()
    assert error(runs[2]) < 3


def test_times_at_equal_error_are_interpolated_in_the_logarithms():
    points = [
        {'peer': peer, 'us_per_s': cost, 'error_m': error}
        for peer, rows in {
            'order 2': [(10.0, 1e-2), (100.0, 1e-4), (1000.0, 1e-6)],
            'coarse': [(10.0, 1e-1)],
            'fine': [(50.0, 1e-9)],
        }.items()
        for cost, error in rows
    ]
    points.append({'peer': 'lost', 'error_m': None})

    found = peers.times_at(points, 1e-3)

    assert list(found) == ['order 2', 'fine', 'coarse', 'lost']
    assert found['order 2'] == {'us_per_s': pytest.approx(10**1.5), 'bound': False}
    assert found['fine'] == {'us_per_s': 50.0, 'bound': True}
    assert found['coarse'] is None
    assert found['lost'] is None


def test_a_comparison_becomes_text_and_a_picture(underwater, tmp_path):
    runs = own_runs(TASKS[0](), [0.1, 0.05]) + lagged_runs([0.1], underwater)[:1]
    task = {'title': 'A fall'} | peers.compare(runs, 1)
    result = {'tasks': {'fall': task}}

    lost = task['points'][-1]
    assert lost['peer'] == 'MuJoCo lagged'
    assert 0 < lost['diverged_at_s'] < 5
    assert '| MuJoCo lagged | diverges | diverges |' in peers.table(result)
    assert draw(result, tmp_path / 'picture.png').stat().st_size > 10_000


def test_without_the_peers_one_line_says_what_to_install(monkeypatch):
    monkeypatch.setattr(peers, 'find_spec', lambda name: None)
    monkeypatch.setattr(sys, 'argv', ['peer_simulators.py'])
    with pytest.raises(SystemExit) as end:
        peers.main()
    line = str(end.value)
    assert line.startswith('peer_simulators: jsbsim, rotorpy, drone_models not installed')
    assert 'fluid_sim_ros[peers]' in line
    assert '\n' not in line
