# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Sweeps on a device: what is refused, and that mujoco_warp flies what the processor flies."""

import json
import math
import subprocess
import sys
from importlib import util

import numpy as np
import pyarrow.parquet as pq
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.errors import ConfigError, MissingExtraError
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.sweep.case_runs import CaseRunner
from fluid_sim_ros.sweep.compare import against_cpu
from fluid_sim_ros.sweep.compiled_run import COLUMNS
from fluid_sim_ros.sweep.results import as_table
from fluid_sim_ros.sweep.run_sweep import run_sweep
from fluid_sim_ros.sweep.warp_models import motion_of, with_masses
from test.support.sweeps import sweep_of

#: Kernels are compiled for a minute in a fresh cache, so make test goes without them.
NO_WARP = pytest.mark.skipif(util.find_spec('mujoco_warp') is None, reason='no mujoco_warp here')


def with_warp(function):
    return pytest.mark.full(pytest.mark.timeout(600)(NO_WARP(function)))


def fly_on_cpu(tmp_path, **keys):
    sweep = sweep_of(**keys)
    result = run_sweep(sweep, tmp_path / 'out', device='cpu')
    return sweep, result, pq.read_table(result['table'])


# ---- what is refused ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    ('keys', 'line'),
    [
        (
            {'scene': 'bluerov2'},
            "scene 'bluerov2' uses fluid_sim.body, fluid_sim.medium, fluid_sim.thruster,",
        ),
        ({'scene': 'x500', 'fluid': 'inertia'}, "scene 'x500' uses fluid_sim.thruster, which"),
        ({'scene': 'fly_wing'}, "scene 'fly_wing' has a gait"),
        ({'scene': 'quadrotor', 'duration': 12}, 'a scheduled event at 10 s, before the end'),
        ({'scene': 'water_pendulum', 'fluid': 'inertia'}, "base of 'bob' has no free joint"),
        (
            {'scene': 'quadrotor', 'hold': {'law': 'multirotor', 'target': [0, 0, 1]}},
            'a controller in the loop',
        ),
        ({'scene': 'nowhere'}, "scene 'nowhere' is not known"),
    ],
)
def test_more_than_stock_forces_is_refused_in_one_line(tmp_path, keys, line):
    with pytest.raises(ConfigError, match=line) as caught:
        run_sweep(sweep_of(**keys), tmp_path / 'out', device='cuda:0')
    assert '\n' not in str(caught.value) and not (tmp_path / 'out').exists()


def test_without_the_extra_one_line_says_what_to_type(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, 'warp', None)
    with pytest.raises(MissingExtraError, match=r'--device needs warp.*fluid_sim_ros\[warp\]'):
        run_sweep(sweep_of(), tmp_path, device='cpu')


def test_a_device_and_ray_exclude_each_other(tmp_path):
    with pytest.raises(ConfigError, match='--device cpu and --ray local: choose one'):
        run_sweep(sweep_of(), tmp_path, device='cpu', ray_address='local')


# ---- parts that need no mujoco_warp ------------------------------------------------------------


def test_masses_of_a_world_are_those_of_a_compiled_model():
    factors = {'x500': 1.37}
    scene = Scene.load('quadrotor')
    compiled = Simulation(Scene(**{**vars(scene), 'masses': factors})).model
    scaled = with_masses(Simulation(scene).model, factors)
    for name in ('body_mass', 'body_inertia', 'body_subtreemass', 'dof_invweight0'):
        np.testing.assert_allclose(getattr(scaled, name), getattr(compiled, name), rtol=1e-12)
    with pytest.raises(ConfigError, match='must be above 0'):
        with_masses(compiled, {'x500': math.nan})


def test_the_motion_of_worlds_is_what_the_library_observes():
    simulation = Simulation('quadrotor')
    simulation.set_thrust('x500', [6.0, 5.0, 4.0, 5.0])
    simulation.step(200)
    data = simulation.data
    motion = motion_of(simulation, data.qpos[None], data.qvel[None])[0]
    seen = simulation.observe(forces=False)[:, : nat.ANGULAR_VELOCITY.stop]
    np.testing.assert_allclose(motion, seen, rtol=1e-12, atol=1e-12)


def test_the_comparison_says_by_how_much_and_where():
    sweep = sweep_of(vary={'current.x': {'values': [0, 1, 2]}})
    runner = CaseRunner(sweep)
    rows = runner.rows(0, 3)
    same = against_cpu(runner, as_table(rows))
    assert same['runs'] == 3 and same['largest_relative'] == 0.0
    assert set(same['difference']) == {f'sphere.{column}' for column in COLUMNS}
    rows[1]['sphere.vx_m_s'] += 0.01
    other = against_cpu(runner, as_table(rows))
    assert other['difference']['sphere.vx_m_s'] == pytest.approx(0.01)
    assert other['largest_relative'] == other['relative']['sphere.vx_m_s'] > 0.001
    assert other['relative']['sphere.wx_rad_s'] is None  # a sphere that does not turn


# ---- with mujoco_warp, on the processor --------------------------------------------------------


@with_warp
@pytest.mark.parametrize(
    'keys',
    [
        {'scene': 'sphere', 'vary': {'current.x': {'normal': [0, 1]},
                                     'mass.sphere': {'uniform': [0.8, 1.5]}}},
        {'scene': 'quadrotor', 'vary': {'wind.x': {'normal': [0, 4]},
                                        'mass.x500': {'uniform': [0.8, 1.5]},
                                        'thrust.x500': {'uniform': [0.3, 1]}}},
        {'scene': 'rov', 'fluid': 'ellipsoid',
         'vary': {'current.x': {'normal': [0, 1]}, 'thrust.bluerov2_heavy': {'uniform': [0, 1]},
                  'integrator': {'values': ['Euler', 'RK4', 'implicit', 'implicitfast']}}},
        {'scene': 'falling_card', 'vary': {'wind.x': {'normal': [0, 1]}}},
    ],
    ids=lambda keys: keys['scene'],
)  # fmt: skip
def test_mujoco_warp_agrees_with_the_processor(tmp_path, keys):
    """Single precision: 1e-4 of a value after 0.5 s (measured: 1e-5; see doc/sweep.md)."""
    sweep, result, table = fly_on_cpu(tmp_path, duration=0.5, runs=3, **keys)
    assert set(result['status']) == {'ok'} and result['device'] == 'cpu, float32'
    assert any('no watchdog looks at runs on a device' in line for line in result['warnings'])
    assert table['run'].to_pylist() == list(range(len(table)))
    assert set(table['device'].to_pylist()) == {'cpu, float32'}
    assert not list(set(table.column_names) ^ {*CaseRunner(sweep).row(0), 'device'})
    check = against_cpu(CaseRunner(sweep), table, most=len(table))
    assert check['runs'] == len(table) and check['status_differs'] == 0
    assert check['largest_relative'] < 1e-4


@with_warp
def test_a_world_that_blows_up_is_its_row_alone(tmp_path):
    _, result, table = fly_on_cpu(
        tmp_path, duration=2.0,
        vary={'timestep': {'values': [0.5, 0.002]}, 'current.x': {'values': [1e18, 1.0]}},
    )  # fmt: skip
    status = table['status'].to_pylist()
    assert status[1] == status[3] == 'ok' and 'diverged' in status[::2]
    blown = status.index('diverged')
    assert 'diverged between t =' in table['message'][blown].as_py()
    assert table['time_s'][blown].as_py() < 2.0
    assert np.isfinite(table['sphere.z_m'][3].as_py())
    json.dumps(result, allow_nan=False)


@with_warp
def test_worlds_of_a_killed_sweep_are_kept_and_other_devices_are_not(tmp_path):
    vary = {'current.x': {'normal': [0, 1]}, 'mass.sphere': {'values': [1.0, -1.0]}}
    sweep, whole, table = fly_on_cpu(tmp_path, runs=5, vary=vary)
    assert whole['status'] == {'ok': 5, 'failed': 5}
    # other portions, other numbers of worlds: the same bits
    parts = run_sweep(sweep, tmp_path / 'parts', device='cpu', workers=3)
    assert pq.read_table(parts['table']).equals(table)
    sorted((tmp_path / 'parts/parts').glob('*.parquet'))[1].unlink()
    again = run_sweep(sweep, tmp_path / 'parts', device='cpu', workers=2)
    assert again['runs_kept_from_before'] == 7
    assert pq.read_table(again['table']).equals(table)
    with pytest.raises(ConfigError, match='another sweep or device'):
        run_sweep(sweep, tmp_path / 'parts')


@with_warp
def test_a_device_that_is_not_there_is_one_line(tmp_path):
    path = tmp_path / 'sweep.yaml'
    path.write_text('scene: sphere\nduration: 0.1\nvary: {current.x: {values: [0, 1]}}\n')
    command = [sys.executable, '-m', 'fluid_sim_ros.cli', 'sweep', str(path), '--device', 'gpu7']
    done = subprocess.run(
        [*command, '--out', str(tmp_path / 'out')], capture_output=True, text=True, check=False
    )
    assert done.returncode == 2
    assert done.stderr.startswith("fluid_sim: --device 'gpu7': not here; devices: cpu")
    assert len(done.stderr.splitlines()) == 1 and not done.stdout
