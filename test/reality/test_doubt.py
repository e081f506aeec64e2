# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Values that fit their windows and nothing else are told of."""

import numpy as np
import pytest

from fluid_sim_ros.flights.reader import read_flight
from fluid_sim_ros.reality.driven import comparable_scene
from fluid_sim_ros.reality.fit import cut_shots, fit
from fluid_sim_ros.reality.fitting.doubt import doubts
from fluid_sim_ros.reality.fitting.solver import Task
from fluid_sim_ros.reality.parameters import find_parameters
from test.support.flown import write_x500


@pytest.fixture(scope='module')
def flight(tmp_path_factory):
    path = tmp_path_factory.mktemp('flown') / 'x500.csv'
    return read_flight(write_x500(path, seconds=3.0, every=1))


def said(flight, factor):
    task = Task('x500', ('thrust_coefficient',))
    chosen = find_parameters(comparable_scene('x500'), task.parameters)
    shots, _ = cut_shots([flight], task)
    values = np.array([factor * chosen[0].value])
    return doubts([flight], [each.windows for each in shots], task, chosen, values)


def test_values_that_make_the_specific_force_worse_are_told_of(flight):
    (line,) = said(flight, 0.3)
    assert 'the specific force along z is 74 % of g off, with those before 0 %' in line
    assert '--window' in line


def test_values_that_make_it_better_or_as_good_need_no_word(flight):
    assert said(flight, 1.0) == []
    assert said(flight, 1.02) == []


def test_a_fit_of_the_right_model_has_no_such_doubt(flight):
    found = fit([flight], Task('x500', ('thrust_coefficient',)))
    assert not any('specific force' in line for line in found.lines)
