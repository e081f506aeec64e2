# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A wind that varies slowly is found knot by knot, and what cannot be told is refused."""

from types import SimpleNamespace

import mujoco
import numpy as np
import pytest

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.flights.reader import read_flight
from fluid_sim_ros.reality.driven import comparable_scene, without_air
from fluid_sim_ros.reality.fit import fit
from fluid_sim_ros.reality.fitting import solver
from fluid_sim_ros.reality.fitting.disturbance import (
    Knot,
    touched_by,
    walks,
    with_flow,
    with_knots,
)
from fluid_sim_ros.reality.fitting.solver import Task
from fluid_sim_ros.reality.parameters import find_parameters
from fluid_sim_ros.schema.settings import RunSettings
from test.support.flight_logs import csv_text
from test.support.flown import x500_table

NOISE = {'position': 0.002, 'attitude': 0.001, 'velocity': 0.01, 'rates': 0.005}
DRAG = 8.06428e-5


def wind(time):
    """Return a wind that bends and turns [m/s]."""
    return (2 + 1.5 * np.sin(2 * np.pi * time / 20), 0.0, 0.0)


@pytest.fixture(scope='module')
def flight(tmp_path_factory):
    path = tmp_path_factory.mktemp('flown') / 'windy.csv'
    path.write_text(csv_text(x500_table(seconds=4.0, noise=NOISE, wind=wind)))
    return read_flight(path)


def test_knots_follow_a_wind_within_three_errors(flight):
    found = fit([flight], Task('x500', ('slow_wind.x', 'rotor_drag'), knots=1.0, walk=0.5))

    knots = [p for p in found.parameters if isinstance(p, Knot)]
    true = np.array([wind(knot.time)[0] for knot in knots])
    assert np.ptp(true) > 0.8
    assert len(knots) == 5
    assert knots[0].name == 'slow_wind.x.1@0s'
    assert (np.abs(found.values[:-1] - true) < 3 * found.errors[:-1]).all()
    assert (found.errors[:-1] < 0.2).all()
    assert abs(found.values[-1] - DRAG) < 3 * found.errors[-1]
    assert any('slow_wind.x.1 (windy.csv): 5 knots' in line for line in found.lines)


def test_a_knot_flies_only_windows_that_it_touches_with_the_same_result(flight, monkeypatch):
    task = Task('x500', ('slow_wind.x', 'rotor_drag'), knots=1.0, walk=0.5)
    flown = []

    def looked(chosen, place, flight, windows):
        found = touched_by(chosen, place, flight, windows)
        flown.append(1.0 if found is None else found.mean())
        return found

    monkeypatch.setattr(solver, 'touched_by', looked)
    few = fit([flight], task)
    assert min(flown) < 0.5
    monkeypatch.setattr(solver, 'touched_by', lambda *_: None)
    every = fit([flight], task)

    assert few.values.tolist() == every.values.tolist()
    assert few.errors.tolist() == every.errors.tolist()


@pytest.mark.full
def test_without_it_the_drag_is_off(tmp_path):
    path = tmp_path / 'windy.csv'
    path.write_text(csv_text(x500_table(seconds=8.0, noise=NOISE, wind=wind)))

    found = fit([read_flight(path)], Task('x500', ('rotor_drag',)))

    assert abs(found.values[0] - DRAG) > max(3 * found.errors[0], 0.1 * DRAG)


def test_a_strong_prior_is_a_constant(flight):
    found = fit([flight], Task('x500', ('slow_wind.x',), knots=4.0, walk=1e-5))

    assert np.ptp(found.values) < 1e-3
    assert 2.0 < found.values.mean() < 3.5


def test_a_model_without_drag_is_refused(flight, tmp_path):
    spec = comparable_scene('x500').read_model()
    without_air(spec)
    for geom in spec.geoms:
        geom.fluid_ellipsoid = 0
    spec.option.density = 0.0
    spec.compile()
    model = tmp_path / 'still.xml'
    model.write_text(spec.to_xml())

    with pytest.raises(ConfigError, match=r"'slow_wind.y': 1 m/s .* has no drag that feels it"):
        fit([flight], Task(str(model), ('slow_wind.y',)))
    with pytest.raises(
        ConfigError, match=r"'slow_wind.y': 1 m/s of it moves what is compared by 0 of"
    ):
        fit([flight], Task('x500', ('slow_wind.y',), settings=RunSettings(fluid='none')))


@pytest.mark.parametrize(('names', 'line'), [
    (('slow_wind.x', 'wind.x'), "'slow_wind.x' and 'wind.x': the knots hold the constant"),
    (('slow_current.x',), "'slow_current.x' is not one of x500; it has: .*, slow_wind.x,"),
])  # fmt: skip
def test_what_cannot_be_is_one_line(flight, names, line):
    with pytest.raises(ConfigError, match=line):
        fit([flight], Task('x500', names))


def test_each_flight_has_knots_of_its_own_that_walk(flight):
    chosen = find_parameters(comparable_scene('x500'), ['slow_wind.x', 'mass'])
    parts = [
        SimpleNamespace(flight=each, begins=np.array([1.0, 4.0]), length=1.0)
        for each in (flight, SimpleNamespace())
    ]

    found = with_knots(chosen, parts, 2.0)

    assert [p.name.removeprefix('slow_wind.x.') for p in found] == [
        '1@1s', '1@3s', '1@5s', '2@1s', '2@3s', '2@5s', 'mass',
    ]  # fmt: skip
    steps = walks(found, 0.1) @ [0.0, 0.1, 0.3, 5.0, 5.0, 5.0, 9.0]
    assert steps == pytest.approx([1 / np.sqrt(2), 2 / np.sqrt(2), 0.0, 0.0])


def test_knots_add_to_what_moves_already(flight):
    knots = [
        Knot('k', 'm/s', 0, -1, 1, 1, lambda *_: None, 'slow_wind.y', flight, time)
        for time in (0.0, 4.0)
    ]
    spec = comparable_scene('x500').read_model()
    spec.option.wind = (1.0, 0.0, 0.5)

    def recorded(spec: mujoco.MjSpec) -> None:
        spec.activate_plugin('fluid_sim.medium')
        plugin = spec.add_plugin(name='m', plugin_name='fluid_sim.medium', active=True)
        plugin.config = {'wind_series': '1 0 1 0 3 2 3 0'}

    with_flow(recorded, flight, knots, np.array([1.0, 2.0]))(spec)

    (plugin,) = (p for p in spec.plugins if p.plugin_name == 'fluid_sim.medium')
    rows = np.reshape([float(w) for w in plugin.config['wind_series'].split()], (-1, 4))
    assert rows[[0, -1]].tolist() == [[0, 0, 2, 0], [4, 2, 5, 0]]
    at = rows[:, 0].tolist().index(2.0)
    assert rows[at].tolist() == [2, 1, 3.5, 0]
