"""The chart: orders, reproducible errors, failures that stay, and its files."""

import csv
import json
import shutil
import subprocess

import numpy as np
import pytest

from fluid_sim_ros.cli import main
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.lab.catalogue import problem
from fluid_sim_ros.lab.measure import measure
from fluid_sim_ros.lab.pareto import mark_front

STEPS = (0.05, 0.01, 0.005, 0.0025, 0.00125)
SETTING = ('rung', 'integrator', 'timestep_s')


@pytest.fixture(scope='module')
def kirchhoff():
    return measure(problem('kirchhoff'), integrators=('Euler', 'RK4'), timesteps=STEPS, repeats=1)


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
        measure(problem('kirchhoff'), integrators=('RK4',), timesteps=STEPS[:2], repeats=1)
        for _ in range(2)
    )
    for key in (*SETTING, 'error', 'discretisation', 'status', 'fault'):
        assert [p[key] for p in again['points']] == [p[key] for p in first['points']]


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
    assert rungs['ellipsoid']['model_error'] == pytest.approx(4.0, abs=0.1)
    assert rungs['+ added inertia']['model_error'] < 1e-10
    stock = [p for p in kirchhoff['points'] if p['rung'] == 'inertia' and p['integrator'] == 'RK4']
    assert stock[-1]['discretisation'] < 1e-9


def test_the_front_holds_no_point_that_another_one_beats():
    def point(cost, error):
        return {'cpu_us_per_s': cost, 'error': None if error is None else {'e': error}}

    points = [
        point(1, 1), point(10, 0.1), point(10, 0.2), point(100, 0.1), point(11, 0.1),
        point(5, None), point(20, 0.01),
    ]  # fmt: skip
    mark_front(points, 'e')
    assert [p['pareto'] for p in points] == [True, True, False, False, False, False, True]


def test_a_wrong_setting_is_refused():
    case = problem('stokes')
    with pytest.raises(ConfigError, match=r"'RK5' is not known; allowed: Euler, RK4, implicit,"):
        measure(case, integrators=('RK5',))
    with pytest.raises(ConfigError, match=r'stokes: sample: 0.01 s is not a whole number'):
        measure(case, timesteps=(0.003,))


def test_the_command_writes_files_that_can_be_drawn_again(tmp_path, capsys):
    out = tmp_path / 'first'
    arguments = ['chart', 'spin_down', '--timesteps', '.02', '.01', '--repeats', '1']
    assert main([*arguments, '--out', str(out), '--json', '-']) == 0
    files = json.loads(capsys.readouterr().out)['files']
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
    judged = [p['error']['attitude_rad'] for p in result['points']]
    np.testing.assert_array_equal([float(row['error']) for row in rows], judged)
    assert 'DATA' not in (out / 'chart.html').read_text()


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
