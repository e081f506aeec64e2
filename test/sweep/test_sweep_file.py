# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The file of a sweep: what is varied, and what is refused."""

from pathlib import Path

import numpy as np
import pytest

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.sweep.case_runs import CaseRunner
from fluid_sim_ros.sweep.sweep_file import Cases, read_sweep
from test.support.sweeps import sweep_of

ROOT = Path(__file__).resolve().parents[2]


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
        (
            'scene: sphere\nruns: 1000000000000\nvary: {seed: {values: [1]}}',
            'limit sweep_runs = 10000000',
        ),
        (
            'scene: sphere\nvary: {wind.x: {linspace: [0, 1, 1000000000]}}',
            'limit sweep_runs = 10000000',
        ),
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
        ('scene: sphere\nintegrator: RK5', "key 'integrator': 'RK5' is not known"),
        ('scene: sphere\nduration: .nan\nvary: {seed: {values: [1]}}', "key 'duration'"),
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
