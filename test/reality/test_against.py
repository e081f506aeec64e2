# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``chart --against``: the rungs of a model against a flight, and what is refused."""

import json

import pytest

from fluid_sim_ros.cli import main
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.flights.reader import read_flight
from fluid_sim_ros.reality.charting.against import Chosen, chart_against
from fluid_sim_ros.reality.charting.rungs import ladder
from fluid_sim_ros.reality.driven import comparable_scene
from test.support.flown import write_x500


@pytest.fixture(scope='module')
def log(tmp_path_factory):
    return write_x500(tmp_path_factory.mktemp('flown') / 'x500.csv', seconds=3.0, every=1)


@pytest.mark.parametrize(('scene', 'rungs'), [
    ('x500', ['none', 'lag', 'rotor drag', 'airframe drag']),
    ('bluerov2_heavy', ['none', 'lag', 'damping', 'added inertia']),
    ('crazyflie_37g', ['none', 'lag', 'ground effect', 'damping']),
])  # fmt: skip
def test_rungs_are_those_that_the_model_has_and_each_compiles(scene, rungs):
    loaded = comparable_scene(scene)

    found = ladder(loaded)

    assert set(rungs) <= set(found)
    assert next(iter(found)) == 'none'
    for _, edit in found.values():
        loaded.compile(edit=edit)


@pytest.mark.full
def test_the_richest_rung_is_the_flights_own_and_the_discretisation_is_seen(log):
    chosen = Chosen(integrators=('implicitfast', 'RK4'), timesteps=(0.01, 0.002))

    found = chart_against(read_flight(log), 'x500', chosen=chosen)

    rungs = list(found['rungs'])
    assert 'lag' not in rungs  # measured speeds drive it
    assert found['rungs'][rungs[-1]]['position_m'] < 0.2 * found['rungs']['none']['position_m']
    points = {(p['rung'], p['integrator'], p['timestep_s']): p for p in found['points']}
    assert len(points) == len(rungs) * 4
    last = rungs[-1]
    # at its own integrator and timestep the log is repeated
    assert points[last, 'implicitfast', 0.002]['position_m'] < 1e-9
    coarse, fine = (points[last, 'RK4', h]['discretisation']['position_m'] for h in (0.01, 0.002))
    assert fine < coarse
    assert all(p['cpu_us_per_s'] > 0 for p in points.values())
    assert any(line.startswith('rotor drag: +') and 'worth it' in line for line in found['words'])


def test_the_command_writes_json_and_a_picture(log, tmp_path):
    code = main([
        'chart', '--against', str(log), '--model', 'x500', '--timesteps', '.01', '--integrators',
        'Euler', '--out', str(tmp_path / 'out'), '--json', str(tmp_path / 'chart.json'),
    ])  # fmt: skip

    assert code == 0
    result = json.loads((tmp_path / 'chart.json').read_text())
    assert {p['integrator'] for p in result['points']} == {'Euler'}
    assert (tmp_path / 'out' / 'x500_against_x500.png').stat().st_size > 10_000


@pytest.mark.parametrize(('options', 'words'), [
    ([], '--against LOG: needs --model NAME'),
    (['--model', 'x500', '--timesteps', '.003'], 'do not divide the horizon of 0.5 s'),
    (['--model', 'x500', '--integrators', 'discrete'], 'discrete is not known here'),
])  # fmt: skip
def test_what_cannot_be_charted_is_one_line(log, capsys, options, words):
    assert main(['chart', '--against', str(log), *options]) == 2

    (line,) = capsys.readouterr().err.strip().splitlines()
    assert words in line


def test_a_horizon_that_is_none_is_one_line(log):
    with pytest.raises(ConfigError, match=r'--horizon: 0\.001 is not within'):
        chart_against(read_flight(log), 'x500', chosen=Chosen(horizon=0.001))
