# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Stability: predicted boundaries, outcomes, watchdogs, maps that go on after an interruption."""

import json

import numpy as np
import pytest

from fluid_sim_ros.cli import main
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.lab.problems.bodies import FAMILIES, Body, family
from fluid_sim_ros.lab.problems.boundaries import amplification, critical
from fluid_sim_ros.lab.stability import stability_map
from fluid_sim_ros.lab.stability.false_alarms import random_run
from fluid_sim_ros.lab.stability.limits import bisect, measured_numbers
from fluid_sim_ros.lab.stability.outcomes import coast, outcome
from fluid_sim_ros.lab.stability.stability_map import plan, run_map

DRAGGED = [name for name, kind in FAMILIES.items() if kind.drag]


def test_critical_drag_numbers():
    """Euler: 1 - x. RK4, linear: |1 - x + x^2/2 - x^3/6 + x^4/24| = 1."""
    for drag in ('linear', 'quadratic'):
        assert critical('Euler', drag) == pytest.approx({'sign flip': 1, 'growth': 2})
    assert critical('RK4', 'linear') == pytest.approx({'growth': 2.7852936}, rel=1e-6)
    assert critical('RK4', 'quadratic') == pytest.approx({'growth': 2.5}, rel=0.03)
    x = 0.3
    assert amplification('RK4', 'linear', x) == pytest.approx(
        1 - x + x**2 / 2 - x**3 / 6 + x**4 / 24
    )


@pytest.mark.parametrize('name', DRAGGED)
@pytest.mark.parametrize('integrator', ['Euler', 'RK4'])
def test_the_predicted_boundaries_are_met(name, integrator):
    found = measured_numbers(family(name), integrator)
    assert found
    assert all(row['worst'] < 0.01 for row in found.values())


@pytest.mark.parametrize(
    ('name', 'integrator', 'timestep', 'word'),
    [
        ('drag', 'Euler', 0.01, 'reset'),
        ('drag', 'RK4', 0.01, 'reset'),
        ('drag', 'implicitfast', 0.01, 'stable'),
        ('drag', 'implicitfast', 0.5, 'underdamped'),
        ('stock_ideal', 'implicit', 0.01, 'energy loss'),
        ('stock_ideal', 'discrete', 0.01, 'energy gain'),
        ('stock_ideal', 'RK4', 0.01, 'stable'),
        ('kirchhoff', 'Euler', 0.01, 'energy gain'),
        ('kirchhoff', 'RK4', 0.01, 'stable'),
    ],
)
def test_fates(name, integrator, timestep, word):
    assert outcome(family(name).body, integrator, timestep).word == word


def test_the_watchdogs_see_silent_failures_and_say_nothing_of_a_good_run():
    body = family('stock_ideal').body
    for integrator, sign in (('implicit', 'takes'), ('discrete', 'adds')):
        run = coast(body, integrator, 0.01)
        assert run.reset_at is None
        assert f'the integrator {sign}' in run.alarm
    assert coast(body, 'RK4', 0.01).alarm == ''
    reset = coast(family('drag').body, 'Euler', 0.01)
    assert reset.reset_at == pytest.approx(0.03)
    assert reset.alarm


def test_random_stable_runs_raise_no_alarm():
    rng = np.random.default_rng(1)
    for _ in range(20):
        body, integrator, timestep = random_run(rng)
        found = outcome(body, integrator, timestep)
        assert (found.word, found.alarm) == ('stable', '')


@pytest.mark.full
def test_a_thousand_stable_runs_raise_no_alarm():
    rng = np.random.default_rng(2026)
    for _ in range(1000):
        body, integrator, timestep = random_run(rng)
        found = outcome(body, integrator, timestep)
        assert (found.word, found.alarm) == ('stable', '')


def test_drag_number_of_a_sphere():
    """X = h C rho pi r^2 v/m, with rho V/2 of added mass where the model has its inertia."""
    plain = Body(blunt=0.5, speed=3.0, density_ratio=0.2)
    volume = 4 / 3 * np.pi * 0.1**3
    drag = 0.5 * 1000 * np.pi * 0.1**2 * 3.0
    assert plain.drag_number(0.01) == pytest.approx(0.01 * drag / (200 * volume))
    heavier = Body(blunt=0.5, speed=3.0, density_ratio=0.2, plugin=True)
    assert heavier.drag_number(0.01) == pytest.approx(0.01 * drag / (700 * volume))
    light = plain.with_values({'added_mass_ratio': 10.0})
    assert light.lightness == pytest.approx(10.0)
    assert light.density_ratio == pytest.approx(0.05)


def test_bisection_stops_at_the_first_refusal():
    assert bisect(lambda h: h < 0.3, 0.01, 10, 1.001) == pytest.approx(0.3, rel=1e-3)
    assert bisect(lambda h: h < 0.3 or h > 2, 0.01, 10, 1.001) == pytest.approx(0.3, rel=1e-3)
    assert bisect(lambda h: True, 0.01, 10) == 10
    assert bisect(lambda h: False, 0.01, 10) is None


def test_a_map_goes_on_where_it_was_cut_off(tmp_path, monkeypatch):
    head = plan('drag', cells=3, integrators=('Euler',), x_range=(0.001, 0.1))
    whole = run_map(head, tmp_path / 'whole.jsonl')
    path = tmp_path / 'cut.jsonl'
    lines = (tmp_path / 'whole.jsonl').read_text().splitlines(keepends=True)
    path.write_text(''.join(lines[:6]) + lines[6][:20])  # killed in the middle of a line
    runs = []
    monkeypatch.setattr(
        stability_map, 'outcome', lambda *args: runs.append(args) or outcome(*args)
    )
    assert run_map(head, path)['map'] == whole['map']
    assert len(runs) == 9 - 5
    assert run_map(head, path)['map'] == whole['map']
    assert len(runs) == 9 - 5
    with pytest.raises(ConfigError, match=r'cut.jsonl: is of another map'):
        run_map({**head, 'cells': 4}, path)


def test_a_map_that_makes_no_sense_is_refused():
    for arguments, message in (
        ({'name': 'honey'}, "'honey' is not known; allowed: drag, drag_added_mass"),
        ({'name': 'drag', 'x': 'colour'}, "axis 'colour' is not known; allowed: timestep"),
        ({'name': 'drag', 'x': 'speed', 'y': 'speed'}, "both axes are 'speed'"),
        ({'name': 'drag', 'x_range': (1, 0.1)}, 'allowed: 0 < low < high'),
        ({'name': 'drag', 'integrators': ('RK5',)}, "'RK5' is not known"),
        ({'name': 'drag', 'cells': 0}, '0 cells per axis: must be at least 1'),
        ({'name': 'drag', 'x_range': (1, float('inf'))}, 'allowed: 0 < low < high'),
        ({'name': 'drag', 'fixed': {'speed': -1.0}}, 'speed -1: must be above 0'),
        ({'name': 'drag', 'fixed': {'mass': 1}}, "axis 'mass' is not known"),
        (
            {'name': 'drag', 'fixed': {'density_ratio': 1, 'added_mass_ratio': 1}},
            'set the same thing',
        ),
    ):
        with pytest.raises(ConfigError, match=message):
            plan(**arguments)


def test_the_command(tmp_path, capsys):
    arguments = [
        'stability', 'plate', '--x', 'timestep', '--y', 'speed', '--cells', '3',
        '--x-range', '.001', '.1', '--set', 'aspect=.05', '--integrators', 'Euler', 'discrete',
        '--bisect', '--out', str(tmp_path), '--json', '-',
    ]  # fmt: skip
    assert main(arguments) == 0
    result = json.loads(capsys.readouterr().out)
    assert len(result['map']) == 2 * 3 * 3
    assert {row['outcome'] for row in result['map']} >= {'stable', 'reset'}
    assert len(result['largest_steps']) == 2 * 3
    assert (tmp_path / 'plate_timestep_speed.png').stat().st_size > 10_000
    assert main(['stability', 'plate', '--set', 'aspect=wide']) == 2
    assert "--set 'aspect=wide': must be AXIS=NUMBER" in capsys.readouterr().err
    assert main(['stability', 'plate', '--set', 'aspect=nan']) == 2
    assert "--set 'aspect=nan': must be finite" in capsys.readouterr().err
    assert main(['stability', '--json', '-']) == 0
    assert set(json.loads(capsys.readouterr().out)['problems']) == set(FAMILIES)
