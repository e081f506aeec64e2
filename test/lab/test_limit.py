# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``fails at`` of an advice is a limit of stability, found by bisection."""

from dataclasses import replace

import numpy as np
import pytest

from fluid_sim_ros import Scene
from fluid_sim_ros.lab.advisor.advise import LADDER, advise
from fluid_sim_ros.lab.problems.bodies import Body
from fluid_sim_ros.lab.problems.from_scene import of_scene
from fluid_sim_ros.lab.problems.problem import run_rung
from fluid_sim_ros.lab.retimed import largest_timestep, run_retimed

#: A light sphere in a strong current, drag by MuJoCo: Euler fails from x = 2 on.
LIGHT = Body(blunt=0.5, speed=5.0, density_ratio=0.05, duration=2.0)


def test_fails_at_is_the_limit_that_theory_predicts():
    scene = replace(LIGHT.scene(), duration=1.0)
    found = advise(scene, 0.05, metric_name='velocity')
    euler = [row for row in found['candidates'] if row['integrator'] == 'Euler']
    assert euler
    limit = euler[0]['fails_at_s']
    assert limit not in LADDER
    # Euler's step makes the velocity grow from x = 2 on
    assert LIGHT.drag_number(limit) == pytest.approx(2.0, rel=0.05)
    assert euler[0]['margin'] == pytest.approx(limit / euler[0]['timestep'])
    assert not euler[0]['margin_is_a_bound']


def test_a_run_at_a_timestep_that_divides_all_is_the_usual_run():
    """Events, gaits and samples take place at the same steps: the same bits."""
    for name, timestep in (('rov', 0.01), ('fish', 0.001), ('bluerov2_waves', 0.005)):
        case = of_scene(name, 1.0)
        rung = case.rungs['scene']
        most = largest_timestep(case, rung)
        assert most >= timestep
        usual = run_rung(case, rung, 'implicitfast', timestep)
        other = run_retimed(case, rung, 'implicitfast', timestep, most)
        np.testing.assert_allclose(other.states, usual.states, rtol=0, atol=1e-12)


def test_a_run_at_any_timestep_is_near_the_usual_one():
    scene = Scene.load('rov')
    case = of_scene(scene, 2.0)
    rung = case.rungs['scene']
    usual = run_rung(case, rung, 'RK4', 0.002)
    other = run_retimed(case, rung, 'RK4', 0.00217, largest_timestep(case, rung))
    apart = np.linalg.norm(other.states[..., :3] - usual.states[..., :3], axis=-1).max()
    assert 0 < apart < 0.002 * np.linalg.norm(usual.states[..., 7:10], axis=-1).max() + 1e-4
