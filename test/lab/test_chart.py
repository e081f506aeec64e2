# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The chart: orders, reproducible errors, failures that stay, and its files."""

import csv
import json
import shutil
import subprocess

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluid_sim_ros.cli import main
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.lab.charts.cost import Curve, step_costs
from fluid_sim_ros.lab.charts.measure import measure
from fluid_sim_ros.lab.charts.pareto import FRONT_RANGE, _price_of_more, mark_front, tie
from fluid_sim_ros.lab.problems.catalogue import problem
from test.support.paths import ROOT

STEPS = (0.05, 0.01, 0.005, 0.0025, 0.00125)
SETTING = ('rung', 'integrator', 'timestep_s')


@pytest.fixture(scope='module')
def kirchhoff():
    return measure(problem('kirchhoff'), integrators=('Euler', 'RK4'), timesteps=STEPS, rounds=2)


def test_orders_of_convergence(kirchhoff):
    orders = kirchhoff['orders']['+ added inertia']
    assert orders['Euler'] == pytest.approx(1, abs=0.1)
    assert orders['RK4'] == pytest.approx(4, abs=0.2)


def test_the_plugin_reaches_what_no_stock_setting_does(kirchhoff):
    good = [point for point in kirchhoff['points'] if point['error']]
    ours = [p['error']['position_m'] for p in good if p['rung'] == '+ added inertia']
    stock = [p['error']['position_m'] for p in good if p['rung'] != '+ added inertia']
    assert min(ours) < 1e-6
    assert min(stock) > 0.1


def test_two_runs_give_the_same_errors_to_the_bit():
    first, again = (
        measure(problem('kirchhoff'), integrators=('RK4',), timesteps=STEPS[:2], rounds=2)
        for _ in range(2)
    )
    for key in (*SETTING, 'error', 'discretisation', 'status', 'fault'):
        assert [p[key] for p in again['points']] == [p[key] for p in first['points']]


def test_rings_judge_pose_as_advice_does(kirchhoff):
    """Position and attitude at all sample times, not the position at the end alone."""
    assert kirchhoff['judged_by'] == 'pose'
    for each in kirchhoff['points']:
        if each['error']:
            error = each['error']
            assert error['pose'] == max(error['position'], error['attitude'])
    # at the end the place may be right by chance: a spinning sphere stays where it is
    spin = measure(problem('spin_down'), integrators=('Euler',), timesteps=(0.02,), rounds=1)
    wrong = next(p for p in spin['points'] if p['rung'] == 'none')
    assert wrong['error']['position_m'] < 1e-12
    assert wrong['error']['pose'] > 0.5
    assert not wrong['pareto'] or wrong['cpu_us_per_s'] < min(
        p['cpu_us_per_s'] for p in spin['points'] if p['rung'] != 'none'
    )
    by_place = measure(
        problem('spin_down'), integrators=('Euler',), timesteps=(0.02,), metric_name='position',
        rounds=1,
    )  # fmt: skip
    assert by_place['judged_by'] == 'position'
    with pytest.raises(ConfigError, match="metric 'beauty' is not known; allowed: pose"):
        measure(problem('spin_down'), metric_name='beauty')


def test_a_failed_run_is_a_point(kirchhoff):
    failed = [point for point in kirchhoff['points'] if point['status'] == 'failed']
    assert failed
    for point in failed:
        assert 'diverged' in point['fault']
        assert point['cpu_us_per_s'] > 0
        assert 0 < point['failed_at_s'] <= 5
        assert point['error'] is None
        assert not point['pareto']


def test_model_error_is_told_from_the_timestep(kirchhoff):
    rungs = kirchhoff['rungs']
    assert rungs['ellipsoid']['model_error'] == pytest.approx(0.98, abs=0.01)
    assert rungs['+ added inertia']['model_error'] < 1e-10
    stock = [p for p in kirchhoff['points'] if p['rung'] == 'inertia' and p['integrator'] == 'RK4']
    assert stock[-1]['discretisation'] < 1e-9


def point(cost, error):
    return {'cpu_us_per_s': cost, 'error': None if error is None else {'e': error}}


def test_the_front_holds_what_only_a_dearer_point_betters():
    points = [
        point(1, 1), point(10, 0.1), point(10, 0.2), point(100, 0.1), point(11, 0.1),
        point(5, None), point(20, 0.01),
    ]  # fmt: skip
    found = mark_front(points, 'e')
    assert [p['pareto'] for p in points] == [True, True, False, False, False, False, True]
    assert FRONT_RANGE[0] < found.factor < FRONT_RANGE[1]


def test_of_equal_errors_the_first_stays_unless_it_is_clearly_dearer():
    points = [point(10, 0.1), point(8, 0.1), point(2, 0.1)]
    mark_front(points, 'e')
    assert [p['pareto'] for p in points] == [False, False, True]
    points = [point(10, 0.1), point(9, 0.1)]
    mark_front(points, 'e')
    assert [p['pareto'] for p in points] == [True, False]


@given(st.lists(st.tuples(st.floats(1, 1e4), st.floats(1e-6, 1)), min_size=2, max_size=40),
       st.integers(0, 2**32 - 1))  # fmt: skip
def test_a_clock_that_is_off_by_less_than_the_gap_marks_the_same_front(rows, seed):
    points = [point(*row) for row in rows]
    found = mark_front(points, 'e')
    front = [p['pareto'] for p in points]
    assert any(front)
    # each cost by less than a quarter of the gap, so that no ratio crosses the factor
    noise = np.random.default_rng(seed).uniform(-1, 1, len(points)) * np.log(found.clear) / 4
    again = [point(cost * np.exp(d), error) for (cost, error), d in zip(rows, noise, strict=True)]
    prices = [_price_of_more([(p['error']['e'], p['cpu_us_per_s']) for p in again], place)
              for place in range(len(again))]  # fmt: skip
    assert all(price > found.factor for price, on in zip(prices, front, strict=True) if on)


def test_the_tie_factor_is_the_middle_of_the_widest_gap():
    assert tie([1.0, 1.2, 1.25, 3.0], (1.1, 2.0)) == pytest.approx(
        (np.sqrt(1.25 * 2.0), np.sqrt(2.0 / 1.25))
    )
    assert tie([], (1.1, 2.0)).factor == pytest.approx(np.sqrt(2.2))


def test_a_factor_is_kept_while_no_ratio_comes_near_it():
    """Of two gaps that are about equally wide, the one of the last time stays."""
    points = [point(10.0, 1), point(16.2, 0.9), point(32.0, 0.1)]  # gaps 1.1-1.62-1.975-2
    assert mark_front(points, 'e').factor == pytest.approx(np.sqrt(1.1 * 1.62))
    assert mark_front(points, 'e', before=1.8).factor == 1.8
    assert mark_front(points, 'e', before=1.64).factor == pytest.approx(np.sqrt(1.1 * 1.62))


def test_within_a_curve_cost_goes_exactly_with_the_number_of_steps(kirchhoff):
    for one in kirchhoff['step_us']:
        rows = [p for p in kirchhoff['points'] if (p['rung'], p['integrator']) == (
            one['rung'], one['integrator']
        )]  # fmt: skip
        assert len(rows) == len(STEPS)
        for row in rows:
            assert row['cpu_us_per_s'] == pytest.approx(one['cpu'] / row['timestep_s'], rel=1e-12)
            assert row['wall_us_per_s'] == pytest.approx(
                one['wall'] / row['timestep_s'], rel=1e-12
            )
            assert row['cpu_quartile_low_us_per_s'] <= row['cpu_us_per_s']
            assert row['cpu_us_per_s'] <= row['cpu_quartile_high_us_per_s']


def test_a_step_of_a_dearer_integrator_costs_more():
    curves = {Curve('+ added inertia', name): 0.01 for name in ('Euler', 'RK4')}
    costs = step_costs(problem('kirchhoff'), curves, rounds=9)
    euler, rk4 = costs.values()
    assert 2 < rk4.cpu / euler.cpu < 6
    with pytest.raises(ConfigError, match='0 timed bursts per curve: must be at least 1'):
        step_costs(problem('kirchhoff'), curves, rounds=0)


def test_a_wrong_setting_is_refused():
    case = problem('stokes')
    with pytest.raises(ConfigError, match=r"'RK5' is not known; allowed: euler, rk4, implicit,"):
        measure(case, integrators=('RK5',))
    with pytest.raises(ConfigError, match=r'stokes: sample: 0.01 s is not a whole number'):
        measure(case, timesteps=(0.003,))
    for timestep in (0.0, -0.1, float('nan')):
        with pytest.raises(ConfigError, match=r'timestep: must be'):
            measure(case, timesteps=(timestep,))


@pytest.fixture(scope='module')
def first_chart(tmp_path_factory):
    """Return the folder of a chart by the command, and the files that it names."""
    out = tmp_path_factory.mktemp('chart') / 'first'
    said = out.with_name('said.json')
    arguments = ['chart', 'spin_down', '--timesteps', '.02', '.01', '--rounds', '2']
    assert main([*arguments, '--out', str(out), '--json', str(said)]) == 0
    return out, json.loads(said.read_text())['files']


def test_the_command_writes_files_that_can_be_drawn_again(first_chart, tmp_path):
    out, files = first_chart
    assert [f.rsplit('/', 1)[1] for f in files] == [
        'spin_down.json', 'spin_down.csv', 'spin_down.png', 'chart.html',
    ]  # fmt: skip
    again = tmp_path / 'again'
    assert main(['chart', '--from', files[0], '--out', str(again)]) == 0
    for name in ('spin_down.json', 'spin_down.csv', 'chart.html'):
        assert (again / name).read_bytes() == (out / name).read_bytes()
    with (out / 'spin_down.csv').open(newline='') as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 3 * 5 * 2
    result = json.loads((out / 'spin_down.json').read_text())
    judged = [p['error']['pose'] for p in result['points']]
    np.testing.assert_array_equal([float(row['error']) for row in rows], judged)
    assert 'DATA' not in (out / 'chart.html').read_text()


def test_times_can_be_measured_again_for_errors_that_are_there(first_chart, tmp_path, capsys):
    (first, _), again = first_chart, tmp_path / 'again'
    file = str(first / 'spin_down.json')
    arguments = ['chart', '--from', file, '--time-again', '--rounds', '3', '--out', str(again)]
    assert main(arguments) == 0
    capsys.readouterr()
    old, new = (json.loads((f / 'spin_down.json').read_text()) for f in (first, again))
    assert (old['rounds'], new['rounds']) == (2, 3)
    for key in (*SETTING, 'error', 'discretisation', 'status'):
        assert [p[key] for p in new['points']] == [p[key] for p in old['points']]
    assert new['step_us'] != old['step_us']
    assert main(['chart', '--time-again']) == 2
    assert 'needs --from JSON' in capsys.readouterr().err


def test_times_of_a_scene_file_are_measured_again_with_that_file(tmp_path, capsys):
    scene = tmp_path / 'mine.yaml'
    shutil.copy(ROOT / 'config/scenes/sphere.yaml', scene)
    quick = ['--timesteps', '.02', '--integrators', 'RK4', '--rounds', '1', '--out', str(tmp_path)]
    assert main(['chart', str(scene), *quick]) == 0
    again = ['--from', str(tmp_path / 'mine.json'), '--time-again', '--rounds', '1']
    again += ['--out', str(tmp_path / 'again')]
    assert main(['chart', *again]) == 2
    assert 'name that file, too: fluid_sim chart mine.yaml --from' in capsys.readouterr().err
    assert main(['chart', str(scene), *again]) == 0


def test_the_command_lists_the_problems(capsys):
    assert main(['chart', '--json', '-']) == 0
    rows = json.loads(capsys.readouterr().out)
    assert {'kirchhoff', 'plate_chaos', 'rov_step'} < {row['name'] for row in rows}


@pytest.mark.full
def test_chromium_draws_every_plot_of_the_page(tmp_path):
    browser = shutil.which('chromium') or shutil.which('google-chrome')
    assert browser, 'this test needs chromium (Debian: apt-get install chromium)'
    arguments = ['chart', 'spin_down', 'kirchhoff', '--quick', '--out', str(tmp_path)]
    assert main(arguments) == 0
    command = [
        browser, '--headless', '--no-sandbox', '--disable-gpu', '--virtual-time-budget=3000',
        '--dump-dom', (tmp_path / 'chart.html').as_uri(),
    ]  # fmt: skip
    page = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60).stdout
    assert 'data-drawn="4"' in page


def test_a_file_that_is_no_result_is_refused(tmp_path, capsys):
    path = tmp_path / 'other.json'
    path.write_text('{}')
    assert main(['chart', '--from', str(path)]) == 2
    assert "it has no 'points'" in capsys.readouterr().err
