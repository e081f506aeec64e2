# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Runs of a sweep: rows like those of a simulation, whatever goes wrong."""

from pathlib import Path

import pyarrow.parquet as pq
import pytest

from fluid_sim_ros import Scene, Simulation
from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.sweep.case_runs import CaseRunner
from fluid_sim_ros.sweep.results import as_table
from fluid_sim_ros.sweep.run_sweep import run_sweep
from test.support.sweeps import sweep_of

ROOT = Path(__file__).resolve().parents[2]


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
            "gain 'charm' is not known; allowed: position",
        ),
    ],
)  # fmt: skip
def test_what_the_scene_lacks_is_said_before_anything_flies(tmp_path, keys, line):
    with pytest.raises(FluidSimError, match=line):
        run_sweep(sweep_of(**keys), tmp_path)


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
