# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The commands of the laboratory: others' scenes, failures beside others, progress, tables."""

import io
import json
import subprocess
import sys

import pytest
from rich.console import Console

from fluid_sim_ros.cli.lab import chart
from fluid_sim_ros.cli.lab.tables import advice_table, fronts_table
from fluid_sim_ros.cli.main import main
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.lab.problems.catalogue import problem
from fluid_sim_ros.lab.problems.problem import fits
from fluid_sim_ros.scene import Scene, scene_names
from test.support.terminal import shown_in_a_terminal

SCENE = """\
model: {model}
vehicles: {{{vehicle}}}
duration: {duration}
"""
MINE = """<mujoco><option timestep="0.005" density="1000" gravity="0 0 0"/><worldbody>
<body name="hull"><freejoint/><geom type="ellipsoid" size=".3 .2 .1" density="900"
fluidshape="ellipsoid"/></body></worldbody><keyframe>
<key name="start" qpos="0 0 0 1 0 0 0" qvel="1 .2 0 0 0 1"/></keyframe></mujoco>"""
ONE = ['--integrators', 'RK4', '--rounds', '1']


@pytest.fixture
def mine(tmp_path):
    (tmp_path / 'mine.xml').write_text(MINE)
    path = tmp_path / 'mine.yaml'
    path.write_text(SCENE.format(model='mine.xml', vehicle='hull: {body: hull}', duration=1.0)
                    + 'keyframe: start\n')  # fmt: skip
    return path


def test_chart_quick_of_any_scene_with_a_gait(tmp_path, capsys):
    walking = [name for name in scene_names() if Scene.load(name).gait]
    assert len(walking) >= 3
    for name in walking:
        case = problem(name)
        steps = chart.quick_timesteps(case)
        assert 1 <= len(steps) <= 4
        assert all(fits(case.rungs[case.richest], step, case.sample) for step in steps)
    text = (Scene.load('swimmer').model_path.parents[1] / 'config/scenes/swimmer.yaml').read_text()
    short = '\n'.join(
        'duration: 1.0' if line.startswith('duration') else line
        for line in text.split('advised:')[0].splitlines()
    )
    (tmp_path / 'short.yaml').write_text(short + '\n')
    arguments = ['chart', str(tmp_path / 'short.yaml'), '--quick', *ONE[:2]]
    assert main([*arguments, '--out', str(tmp_path / 'out'), '--json', '-']) == 0
    (result,) = json.loads(capsys.readouterr().out)['charts']
    assert {point['timestep_s'] for point in result['points']} == {0.01, 0.005, 0.002, 0.001}


def test_a_failing_problem_does_not_lose_the_others_of_the_call(tmp_path, capsys, monkeypatch):
    broken = tmp_path / 'broken.xml'
    broken.write_text('<mujoco>')
    out = tmp_path / 'out'
    from fluid_sim_ros.lab.charts import measure as module

    original = module.measure

    def measure(case, **options):
        if case.name == 'stokes':
            raise KeyError('unforeseen')
        return original(case, **options)

    monkeypatch.setattr(module, 'measure', measure)
    names = [str(broken), 'stokes', 'honey', 'spin_down']
    arguments = ['chart', *names, *ONE, '--timesteps', '.02', '--out', str(out), '--json', '-']
    assert main(arguments) == chart.FAILED
    shown, said = capsys.readouterr()
    result = json.loads(shown)
    assert [each['problem'] for each in result['charts']] == ['spin_down']
    assert list(result['failed']) == names[:3]
    assert result['failed']['stokes'] == "KeyError: 'unforeseen'"
    assert "problem 'honey' is not known" in result['failed']['honey']
    assert said.count(' failed: ') == 3
    assert {path.name for path in out.iterdir()} == {
        'spin_down.json', 'spin_down.csv', 'spin_down.png', 'chart.html',
    }  # fmt: skip


def test_a_chart_of_nothing_but_failures_is_refused(tmp_path, capsys):
    out = tmp_path / 'new' / 'out'
    assert main(['chart', 'honey', '--out', str(out)]) == 2
    assert "problem 'honey' is not known" in capsys.readouterr().err
    assert not (tmp_path / 'new').exists()


def test_chart_takes_a_users_scene(mine, tmp_path, capsys):
    for scene in (mine, mine.with_suffix('.xml')):
        arguments = ['chart', str(scene), *ONE, '--timesteps', '.01', '--out', str(tmp_path)]
        assert main([*arguments, '--json', '-']) == 0
        (result,) = json.loads(capsys.readouterr().out)['charts']
        assert result['problem'] == 'mine'
        assert result['judged_by'] == 'pose'


def test_stability_takes_a_users_scene(mine, tmp_path, capsys):
    arguments = ['stability', str(mine), '--cells', '4', '--out', str(tmp_path), '--json', '-']
    assert main(arguments) == 0
    result = json.loads(capsys.readouterr().out)
    assert result['problem'] == 'mine'
    assert len(result['map']) == 4 * 5
    assert [row['integrator'] for row in result['largest_steps']] == result['integrators']
    assert all(row['outcome'] in ('stable', 'wrong', 'blow-up', 'lost') for row in result['map'])
    assert (tmp_path / 'mine_timestep.png').stat().st_size > 10_000
    assert main(['stability', str(mine), '--cells', '2', '--out', str(tmp_path)]) == 0
    assert 'lasts' in capsys.readouterr().out


@pytest.mark.parametrize(
    ('options', 'line'),
    [
        (['--y', 'speed'], 'its one axis is the timestep'),
        (['--set', 'aspect=2'], 'its one axis is the timestep'),
        (['--x-range', '.1', '.01'], 'allowed: 0 < low < high <= 0.1 s'),
        (['--x-range', '.01', '5'], 'allowed: 0 < low < high <= 0.1 s'),
        (['--cells', '0'], '0 cells: must be at least 1'),
    ],
)
def test_what_a_scene_has_no_axis_for_is_refused(mine, tmp_path, capsys, options, line):
    out = tmp_path / 'out'
    assert main(['stability', str(mine), *options, '--out', str(out)]) == 2
    assert line in capsys.readouterr().err
    assert not out.exists()


def test_stability_of_a_name_that_is_neither_is_refused(capsys):
    assert main(['stability', 'honey']) == 2
    error = capsys.readouterr().err
    assert "'honey' is no stability problem and no scene; problems: drag" in error


@pytest.mark.parametrize(('text', 'value'), [('1%', 0.01), ('0.01', 0.01), ('2.5 %', 0.025)])
def test_a_tolerance_may_be_a_percentage(mine, capsys, text, value):
    arguments = ['advise', str(mine), '--tolerance', text, '--duration', '0.5', '--json', '-']
    assert main(arguments) in (0, 1)
    assert json.loads(capsys.readouterr().out)['tolerance'] == pytest.approx(value)


@pytest.mark.parametrize('text', ['one', '1%%', '%', 'nan', '1% of it', ''])
def test_a_tolerance_that_is_no_share_is_refused(capsys, text):
    for command in (['advise', 'rov'], ['replay', 'a.mcap', '--resimulate']):
        with pytest.raises(SystemExit) as caught:
            main([*command, '--tolerance', text])
        assert caught.value.code == 2
        assert 'must be a share, such as 0.01 or 1%' in capsys.readouterr().err


def test_progress_during_advise(mine, capfd):
    """A bar in a terminal; elsewhere one line for each part; standard output is the result."""
    command = [sys.executable, '-m', 'fluid_sim_ros.cli', 'advise', str(mine), '--tolerance', '1%']
    done = subprocess.run([*command, '--json', '-'], capture_output=True, text=True, check=True)
    json.loads(done.stdout)
    parts = ('manoeuvre', 'reference (RK4)', 'search', 'cost of a step', 'limits')
    for part in parts:
        assert f'mine: {part}: 0 of' in done.stderr
    seen = shown_in_a_terminal(command)
    assert 'mine: search' in seen.decode()
    assert '0 of' not in seen.decode()


def shown(renderable, width=80) -> list[str]:
    stream = io.StringIO()
    Console(file=stream, width=width).print(renderable, crop=False)  # as the commands do
    return stream.getvalue().splitlines()


def table_rows(lines):
    return [line for line in lines if line.startswith('│')]


def test_tables_of_the_laboratory_fit_80_columns(tmp_path):
    """With the longest names that there are, and no cell on two lines."""
    point = {
        'pareto': True, 'cpu_us_per_s': 123456.7, 'rung': '+ buoyancy and damping',
        'integrator': 'implicitfast', 'timestep_s': 5e-5, 'error': {'pose': 1.234e-12},
    }  # fmt: skip
    result = {'problem': 'vehicle_in_current', 'judged_by': 'pose', 'points': [point] * 3,
              'note': 'a note'}  # fmt: skip
    path = tmp_path / ('long' * 30)
    lines = shown(fronts_table([result], [path]))
    assert len(table_rows(lines)) == 3
    assert str(path) in lines  # can be copied
    each = {
        'rung': 'no_added_mass', 'integrator': 'implicitfast', 'timestep': 5e-5, 'error': 1.2e-10,
        'cpu_us_per_s': 123456.7, 'fails_at_s': None, 'tried_to_s': 0.1, 'margin': 2000.0,
        'margin_is_a_bound': True,
    }  # fmt: skip
    advice = {
        'scene': 'aerosonde_turbulence', 'tolerance': 0.01, 'metric': 'pose', 'note': '',
        'candidates': [each, each | {'fails_at_s': 0.0123456}], 'not_tried': [], 'choice': each,
        'baseline': {'timestep': 1e-3}, 'cheaper_than_baseline': 12.3, 'written': [str(path)],
        'command': 'fluid_sim advise aerosonde_turbulence --tolerance 0.01',
    }  # fmt: skip
    lines = shown(advice_table(advice, 'pose'))
    rows = table_rows(lines)
    assert len(rows) == 2
    assert '> 100 ms' in rows[0] and '12.3 ms' in rows[1]
    assert str(path) in lines
    assert max(len(row) for row in rows) <= 80


@pytest.mark.parametrize('command', [['stability'], ['chart']])
def test_lists_fit_80_columns(command, capsys, monkeypatch):
    monkeypatch.setenv('COLUMNS', '80')
    assert main(command) == 0
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= 80
    assert '…' not in ''.join(lines)


def test_a_map_shows_only_outcomes_that_occur(tmp_path, capsys, monkeypatch):
    monkeypatch.setenv('COLUMNS', '80')
    arguments = ['stability', 'drag', '--cells', '2', '--x-range', '1e-5', '1e-4', '--integrators']
    assert main([*arguments, 'RK4', '--out', str(tmp_path)]) == 0
    out = capsys.readouterr().out
    assert 'stable' in out and 'energy gain' not in out


def test_a_folder_that_stays_empty_is_taken_away(tmp_path):
    from fluid_sim_ros.cli.shared import made_folder

    new = tmp_path / 'a' / 'b'
    with pytest.raises(ConfigError), made_folder(new):
        assert new.is_dir()
        raise ConfigError('no')
    assert not (tmp_path / 'a').exists()
    (tmp_path / 'c').mkdir()  # one that was there stays, and so does what holds something
    with pytest.raises(ConfigError), made_folder(tmp_path / 'c' / 'd'):
        (tmp_path / 'c' / 'e').write_text('')
        raise ConfigError('no')
    assert (tmp_path / 'c' / 'e').exists() and not (tmp_path / 'c' / 'd').exists()
    (tmp_path / 'file').write_text('')
    with (
        pytest.raises(ConfigError, match=r'--out .*file/x: Not a directory'),
        made_folder(tmp_path / 'file' / 'x'),
    ):
        pass
