"""Sweeps: what is varied, the same rows from whoever flies them, and what goes wrong."""

import json
import os
import signal
import subprocess
import sys
import textwrap
import types
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest

from fluid_sim_ros import Scene, Simulation
from fluid_sim_ros.errors import ConfigError, FluidSimError, MissingExtraError
from fluid_sim_ros.sweep.case_runs import CaseRunner
from fluid_sim_ros.sweep.results import as_table
from fluid_sim_ros.sweep.run_sweep import run_sweep
from fluid_sim_ros.sweep.sweep_file import Cases, SweepFile, read_sweep

ROOT = Path(__file__).resolve().parents[2]


def sweep_of(**keys) -> SweepFile:
    keys = {'scene': 'sphere', 'duration': 0.2, 'vary': {'seed': {'values': [0]}}, **keys}
    return SweepFile.model_validate(keys)


# ---- what is varied ----------------------------------------------------------------------------


def test_a_grid_is_every_combination_each_with_its_own_draws():
    sweep = sweep_of(
        runs=3, seed=5,
        vary={
            'integrator': {'values': ['Euler', 'RK4']},
            'wind.x': {'linspace': [0, 4, 3]},
            'mass.sphere': {'normal': [1.0, 0.1]},
            'wind.y': {'uniform': [-1, 1]},
            'wind.z': {'loguniform': [0.1, 10]},
        },
    )  # fmt: skip
    cases = Cases(sweep)
    rows = [cases[i] for i in range(len(cases))]
    assert len(rows) == 2 * 3 * 3
    assert {(r['integrator'], r['wind.x']) for r in rows} == {
        (i, x) for i in ('Euler', 'RK4') for x in (0.0, 2.0, 4.0)
    }
    assert len({r['mass.sphere'] for r in rows}) == len(rows)
    assert all(-1 <= r['wind.y'] <= 1 and 0.1 <= r['wind.z'] <= 10 for r in rows)
    # by index alone: no order, no earlier draw matters
    assert Cases(sweep)[11] == rows[11]
    assert Cases(sweep.model_copy(update={'seed': 6}))[11] != rows[11]


def test_draws_follow_their_distributions():
    sweep = sweep_of(
        runs=4000, vary={'mass.a': {'normal': [2.0, 0.5]}, 'wind.x': {'loguniform': [1, 100]}}
    )
    cases = Cases(sweep)
    mass = np.array([cases[i]['mass.a'] for i in range(len(cases))])
    wind = np.log10([cases[i]['wind.x'] for i in range(len(cases))])
    # five standard errors
    assert abs(mass.mean() - 2.0) < 5 * 0.5 / np.sqrt(4000)
    assert abs(mass.std() - 0.5) < 5 * 0.5 / np.sqrt(8000)
    assert abs(wind.mean() - 1.0) < 5 * (2 / np.sqrt(12)) / np.sqrt(4000)


@pytest.mark.parametrize('name', sorted(p.name for p in (ROOT / 'config/sweeps').glob('*.yaml')))
def test_the_shipped_sweeps_are_sound(name):
    CaseRunner(read_sweep(ROOT / 'config/sweeps' / name)).check()


@pytest.mark.parametrize(
    ('content', 'line'),
    [
        ('scene: sphere', "missing key 'vary'"),
        ('scene: sphere\nvary: {}', "key 'vary'"),
        ('scene: sphere\nvary: {colour: {values: [1]}}', "unknown key 'colour'; allowed: seed"),
        ('scene: sphere\nvary: {wind.x: {}}', 'needs one of: values, linspace, uniform'),
        ('scene: sphere\nvary: {wind.x: {values: [1], uniform: [0, 1]}}', 'needs one of'),
        ('scene: sphere\nvary: {wind.x: {normal: [0, -1]}}', 'greater than or equal to 0'),
        ('scene: sphere\nvary: {wind.x: {uniform: [0, .nan]}}', 'must be finite'),
        ('scene: sphere\nvary: {wind.x: {values: [1, two]}}', 'all numbers or all names'),
        ('scene: sphere\nvary: {seed: {uniform: [0, 9]}}', "'seed' cannot be drawn"),
        ('scene: sphere\nvary: {gain.position: {values: [1]}}', "needs a controller: key 'hold'"),
        ('scene: sphere\nruns: 0\nvary: {seed: {values: [1]}}', "key 'runs'"),
        ('scene: sphere\nruns: 1000000000000\nvary: {seed: {values: [1]}}', 'more than 10000000'),
        ('scene: sphere\nvary: {wind.x: {linspace: [0, 1, 1000000000]}}', 'more than 10000000'),
        ('scene: sphere\nvary: {wind.x: {linspace: [0, 1, 0]}}', 'linspace.2'),
        ('scene: sphere\nvary: {wind.x: {values: [1, .nan]}}', 'must be finite'),
        (
            'scene: sphere\nvary: {wind.x: {uniform: [3, 1]}}',
            "'vary.wind.x': uniform: 3 is above 1",
        ),
        ('scene: sphere\nvary: {wind.x: {gauss: [0, 1]}}', 'allowed: values, linspace, uniform'),
        ('scene: sphere\nvary: {wind.x: {values: [fast]}}', "'wind.x' takes numbers, not 'fast'"),
        (
            'scene: sphere\nvary: {seed: {values: [1.5]}}',
            "vary: 'seed': must be a valid integer",
        ),
        (
            'scene: sphere\nvary: {integrator: {values: [Euler, RK5]}}',
            "vary: 'integrator': 'RK5' is not",
        ),
        (
            'scene: sphere\nvary: {fluid: {values: [1]}}',
            "vary: 'fluid': must be a valid string",
        ),
        ('scene: sphere\nduration: .nan\nvary: {seed: {values: [1]}}', "key 'duration'"),
        ('scene: sphere\nintegrator: RK5', "key 'integrator': 'RK5' is not known"),
        ('scene: nowhere.xml\nvary: {seed: {values: [1]}}', 'no such file'),
    ],
)
def test_a_faulty_file_is_one_line(tmp_path, content, line):
    path = tmp_path / 'sweep.yaml'
    path.write_text(content)
    with pytest.raises(ConfigError) as caught:
        read_sweep(path)
    assert str(caught.value).startswith(str(path)) and line in str(caught.value)
    assert '\n' not in str(caught.value)


@pytest.mark.parametrize(
    ('keys', 'line'),
    [
        ({'scene': 'nowhere'}, "scene 'nowhere' is not known"),
        ({'vary': {'wind.x': {'values': [1]}}}, 'wind: the scene is in water only'),
        ({'vary': {'mass.moon': {'values': [2]}}}, "mass of 'moon': no such body; bodies: sphere"),
        ({'vary': {'mass.sphere': {'values': [-2]}}}, 'must be above 0'),
        ({'vary': {'thrust.sphere': {'values': [1]}}}, 'the vehicle has no thrusters'),
        ({'vary': {'thrust.moon': {'values': [1]}}}, "vehicle 'moon' is not in the scene"),
        ({'duration': 0.2001}, 'not a whole number of timesteps'),
        (
            {'scene': 'x500', 'hold': {'law': 'multirotor', 'target': [0, 0, 1]},
             'vary': {'gain.charm': {'values': [1]}}},
            "gain 'charm' is not one of them: position",
        ),
    ],
)  # fmt: skip
def test_what_the_scene_lacks_is_said_before_anything_flies(tmp_path, keys, line):
    with pytest.raises(FluidSimError, match=line):
        run_sweep(sweep_of(**keys), tmp_path)


# ---- one run -----------------------------------------------------------------------------------


def test_a_row_is_the_run_of_a_simulation():
    sweep = sweep_of(
        scene='sphere', timestep=0.001, integrator='RK4',
        vary={'current.x': {'values': [3.0]}, 'mass.sphere': {'values': [2.0]}},
    )  # fmt: skip
    row = CaseRunner(sweep).row(0)
    simulation = Simulation('sphere', timestep=0.001, integrator='RK4')
    scene = Scene.load('sphere')
    heavier = Simulation(
        Scene(**{**vars(scene), 'masses': {'sphere': 2.0}}), timestep=0.001, integrator='RK4'
    )
    body = heavier.vehicles['sphere'].body_id
    assert heavier.model.body_mass[body] == pytest.approx(2 * simulation.model.body_mass[body])
    heavier.set_current([3.0, 0.0, 0.0])
    heavier.step(200)
    state = heavier.snapshot().vehicles['sphere']
    assert [row[f'sphere.{axis}_m'] for axis in 'xyz'] == state.position_w.tolist()
    assert [row[f'sphere.v{axis}_m_s'] for axis in 'xyz'] == state.velocity_b.tolist()
    assert row['status'] == 'ok' and row['time_s'] == 0.2


def test_a_run_that_diverges_is_a_row_like_others():
    sweep = sweep_of(
        scene='sphere', duration=2.0,
        vary={'timestep': {'values': [0.5, 0.002]}, 'current.x': {'values': [1e7]}},
    )  # fmt: skip
    blown, sound = CaseRunner(sweep).rows(0, 2)
    assert blown['status'] == 'diverged' and 'diverged at t =' in blown['message']
    assert blown['time_s'] < 2.0
    assert sound['status'] in ('ok', 'diverged')
    assert blown.keys() == sound.keys()


def test_gains_and_errors_of_a_controller_in_the_loop():
    sweep = sweep_of(
        scene='x500', duration=2.0,
        hold={'law': 'multirotor', 'target': [0, 0, 1.5]},
        vary={'gain.integral': {'values': [0.5, 6.0]}, 'wind.x': {'values': [6.0]}},
    )  # fmt: skip
    weak, strong = CaseRunner(sweep).rows(0, 2)
    # steady wind is held by the integrator: more of it, less error
    assert strong['hold.end_error_m'] < 0.5 * weak['hold.end_error_m']
    assert strong['hold.rms_error_m'] <= strong['hold.largest_error_m'] < 0.5


@pytest.mark.parametrize(
    ('scene', 'vary'),
    [
        ('rov', {'thrust.bluerov2_heavy': {'uniform': [-0.5, 1]}, 'current.x': {'normal': [0, 1]},
                 'integrator': {'values': ['RK4', 'implicitfast']}}),
        ('sphere', {'timestep': {'values': [0.1, 0.002]}, 'current.x': {'values': [0, 2, 1e7]}}),
        ('bluerov2_waves', {'seed': {'values': [0, 1]}, 'current.y': {'uniform': [0, 1]}}),
        ('x500_turbulence', {'wind.x': {'normal': [0, 4]}, 'thrust.x500': {'uniform': [0, 1]}}),
        ('water_pendulum', {'current.x': {'normal': [0, 1]}}),  # a base without a free joint
        ('fish', {'current.x': {'normal': [0, 1]}}),  # a gait: one by one
    ],
)  # fmt: skip
def test_runs_flown_together_have_the_bits_of_a_run_alone(scene, vary):
    sweep = sweep_of(scene=scene, runs=3, vary=vary)
    runner = CaseRunner(sweep)
    total = len(runner.cases)
    # as text: a diverged run holds NaN, which equals nothing
    assert repr(CaseRunner(sweep).rows(0, total)) == repr([runner.row(i) for i in range(total)])


def test_a_run_that_fails_takes_nothing_from_the_others(tmp_path):
    sweep = sweep_of(vary={'mass.sphere': {'values': [1, -1, -1, 2]}})
    table = pq.read_table(run_sweep(sweep, tmp_path, workers=1)['table'])
    assert table['status'].to_pylist() == ['ok', 'failed', 'failed', 'ok']
    assert 'must be above 0' in table['message'][1].as_py()
    heights = table['sphere.z_m'].to_pylist()
    assert heights[1:3] == [None, None] and heights[0] > heights[3]  # the heavier one falls faster
    # in one portion, the failed ones first
    assert as_table(CaseRunner(sweep).rows(1, 4))['sphere.z_m'].to_pylist() == [
        None,
        None,
        heights[3],
    ]


# ---- many runs ---------------------------------------------------------------------------------

MANY = {
    'scene': 'rov', 'duration': 0.1, 'runs': 40, 'seed': 3,
    'vary': {'integrator': {'values': ['RK4', 'implicitfast']}, 'current.x': {'normal': [0, 1]}},
}  # fmt: skip


def test_threads_keep_order_and_bits(tmp_path):
    sweep = sweep_of(**MANY)
    told = []
    result = run_sweep(
        sweep, tmp_path / 'a', workers=2, report=lambda done, total: told.append((done, total))
    )
    assert result['runs'] == 80 and result['status'] == {'ok': 80}
    assert told[0] == (0, 80) and told[-1] == (80, 80)
    table = pq.read_table(result['table']).to_pylist()
    assert [row['run'] for row in table] == list(range(80))
    assert table == CaseRunner(sweep).rows(0, 80)


def test_a_killed_sweep_goes_on_where_it_was(tmp_path):
    sweep, out = sweep_of(**MANY), tmp_path / 'out'
    code = textwrap.dedent(f"""
        import os, signal
        from pathlib import Path
        from fluid_sim_ros.sweep.run_sweep import run_sweep
        from fluid_sim_ros.sweep.sweep_file import SweepFile
        def report(done, total):
            if done >= 20:
                os.kill(os.getpid(), signal.SIGKILL)
        run_sweep(SweepFile.model_validate({MANY!r}), Path({str(out)!r}), workers=2, report=report)
    """)
    assert subprocess.run([sys.executable, '-c', code], check=False).returncode == -signal.SIGKILL
    assert not (out / 'results.parquet').exists()
    # half a portion, as a dying file system leaves it
    sorted((out / 'parts').glob('*.parquet'))[0].write_bytes(b'PAR1half')
    result = run_sweep(sweep, out, workers=3)
    assert 0 < result['runs_kept_from_before'] < 80
    assert pq.read_table(result['table']).to_pylist() == CaseRunner(sweep).rows(0, 80)
    with pytest.raises(ConfigError, match='holds the results of another sweep'):
        run_sweep(sweep.model_copy(update={'seed': 4}), out)


@pytest.mark.parametrize(
    ('address', 'line'),
    [
        ('nonsense', "--ray 'nonsense': not an address; allowed: local, auto, HOST:PORT"),
        ('', "--ray '': not an address"),
        ('127.0.0.1:1', "--ray '127.0.0.1:1': no Ray answers there"),  # Ray would try for minutes
    ],
)
def test_an_address_without_ray_is_one_line(tmp_path, monkeypatch, address, line):
    monkeypatch.setitem(sys.modules, 'ray', types.ModuleType('ray'))  # not asked
    with pytest.raises(ConfigError, match=line):
        run_sweep(sweep_of(), tmp_path, ray_address=address)


def test_without_ray_one_line_says_what_to_type(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, 'ray', None)
    with pytest.raises(MissingExtraError, match=r'--ray needs ray.*fluid_sim_ros\[sweep\]'):
        run_sweep(sweep_of(), tmp_path, ray_address='local')


@pytest.mark.full
def test_ray_gives_the_same_bits_and_survives_a_killed_worker(tmp_path):
    """Two Ray workers on this machine; one is killed on the way."""
    sweep = sweep_of(**{**MANY, 'duration': 0.5})
    killed = []

    def kill_one(done: int, total: int) -> None:
        busy = [pid for pid in descendants(os.getpid()) if title(pid).startswith('ray::_run')]
        if done and busy and not killed:
            killed.append(busy[0])
            os.kill(busy[0], signal.SIGKILL)

    result = run_sweep(sweep, tmp_path, workers=2, ray_address='local', report=kill_one)
    assert killed
    assert result['status'] == {'ok': 80}
    assert pq.read_table(result['table']).to_pylist() == CaseRunner(sweep).rows(0, 80)


def descendants(parent: int) -> list[int]:
    """Return every process that this one started, directly or not."""
    try:
        children = Path(f'/proc/{parent}/task/{parent}/children').read_text().split()
    except OSError:  # it ended meanwhile
        return []
    return [pid for child in map(int, children) for pid in (child, *descendants(child))]


def title(pid: int) -> str:
    try:
        return Path(f'/proc/{pid}/cmdline').read_text()
    except OSError:
        return ''


def test_the_command(tmp_path):
    path = tmp_path / 'sweep.yaml'
    path.write_text('scene: sphere\nduration: 0.1\nvary: {current.x: {values: [0, 1, 2]}}\n')
    command = [sys.executable, '-m', 'fluid_sim_ros.cli', 'sweep', str(path), '--json', '-']
    done = subprocess.run(
        [*command, '--out', str(tmp_path / 'out')], capture_output=True, text=True, check=True
    )
    result = json.loads(done.stdout)
    assert result['runs'] == 3 and result['status'] == {'ok': 3}
    assert result['columns']['current.x'] == {'min': 0.0, 'median': 1.0, 'max': 2.0}
    assert len(pq.read_table(result['table'])) == 3
