# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""An excitation keeps within its limits, is repeated by its schedule, and tells the parameters."""

import json

import numpy as np
import pytest

from benchmarks.reality.excitation import LIMITS, PARAMETERS, coverage, judged, noisy, truth
from fluid_sim_ros.cli import main
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.flights.reader import read_flight
from fluid_sim_ros.reality.compare import Part, compare
from fluid_sim_ros.reality.exciting.excitation import Limits, multisine
from fluid_sim_ros.reality.exciting.excited_flight import excite
from fluid_sim_ros.reality.fit import fit
from fluid_sim_ros.reality.fitting.solver import Task


def test_a_multisine_is_seeded_and_as_large_as_asked():
    times = np.arange(0, 10, 0.01)
    first, again, other = (
        multisine(np.random.default_rng(seed), times, (0.3, 5.0, 12)) for seed in (1, 1, 2)
    )

    assert np.array_equal(first, again)
    assert not np.allclose(first, other)
    assert np.abs(first).max() == pytest.approx(1.0)


@pytest.mark.parametrize('model', ['x500', 'bluerov2_heavy'])
def test_it_keeps_within_space_and_limits(model):
    limits = Limits(space=3.0, speed=1.0, tilt=0.4)

    found = excite(model, 5.0, 0, limits)

    assert found.seen['distance_m'] <= 1.5
    assert found.seen['speed_m_s'] <= 1.0
    assert found.seen['tilt_rad'] <= 0.4
    assert not found.seen['touched']
    assert np.ptp(found.thrusts, axis=0).min() > 0.5
    assert bool(found.plan.free.any()) == (model == 'bluerov2_heavy')
    assert np.array_equal(excite(model, 5.0, 0, limits).thrusts, found.thrusts)


def test_the_schedule_flies_the_same_and_a_fit_of_its_log_begins_at_the_truth(tmp_path, capsys):
    out = tmp_path / 'ex'
    names = ['thrust_coefficient', 'time_constant', 'zero_thrust_advance']
    code = main(['excite', 'x500', '--duration', '5', '--out', str(out), '--parameters', *names,
                 '--json', str(tmp_path / 'ex.json')])  # fmt: skip

    assert code == 0
    result = json.loads((tmp_path / 'ex.json').read_text())
    assert result['parameters']['thrust_coefficient']['told']
    assert result['parameters']['zero_thrust_advance']['standard_error'] is None
    assert 'not told: zero_thrust_advance' in capsys.readouterr().out
    head = (out / 'x500_excited.csv').read_text().splitlines()[1]
    assert head.startswith('time,target_forward,target_left,target_up,target_turn,free,thrust_m1')
    assert main(['run', str(out / 'x500_excited.yaml'), '--record', str(out / 'log')]) == 0
    flight = read_flight(next((out / 'log').glob('*.mcap')))
    found = compare(flight, 'x500', part=Part(horizons=(0.5,)))
    assert found.errors['position_m'].max() < 1e-11


@pytest.fixture(scope='module')
def flown():
    return excite('x500', 6.0, 0, LIMITS['x500'])


def test_without_noise_the_truth_is_found_from_an_excited_flight(flown):
    wrong = {'thrust_coefficient': 8e-6, 'rotor_drag': 7e-5, 'time_constant': 0.015}

    found = fit([flown.flight], Task('x500', tuple(wrong), values=wrong))

    assert max(row['share'] for row in judged(found).values()) < 0.01


@pytest.mark.full
def test_with_noise_the_truth_is_within_three_standard_errors(flown):
    found = fit([noisy(flown.flight, 4)], Task('x500', ('thrust_coefficient', 'rotor_drag')))

    assert max(row['standard_errors'] for row in judged(found).values()) < 3


@pytest.mark.parametrize('model', [
    pytest.param(name, marks=pytest.mark.full) for name in PARAMETERS
])  # fmt: skip
def test_all_parameters_from_sixty_seconds(model):
    found = truth(model, 60.0)

    assert found['clean']['worst_share'] < 0.01
    assert found['noisy']['worst_standard_errors'] < 3


@pytest.mark.full
def test_the_intervals_cover_as_often_as_they_say():
    found = coverage(100)

    assert found['within']['1'] == pytest.approx(0.683, abs=0.07)
    assert found['within']['2'] == pytest.approx(0.954, abs=0.035)
    assert found['within']['3'] > 0.985


@pytest.mark.parametrize(('limits', 'words'), [
    (Limits(space=0.01), '--space: 0.01 is not within 0.2 to 1000'),
    (Limits(tilt=2.0), r'--tilt: 114.592 is not within 1 to 80'),
    (Limits(share=2.0), r'--share: 2 is not within 0.001 to 1'),
])  # fmt: skip
def test_limits_that_are_none_are_one_line(limits, words):
    with pytest.raises(ConfigError, match=words):
        excite('x500', 8.0, 0, limits)


@pytest.mark.parametrize(('scene', 'words'), [
    ('sphere', 'no single vehicle with thrusters'), ('aerosonde', 'steered by joints'),
])  # fmt: skip
def test_what_cannot_be_excited_is_one_line(scene, words):
    with pytest.raises(ConfigError, match=words):
        excite(scene, 8.0, 0, Limits())
