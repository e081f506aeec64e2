# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Every shipped scene steps as MuJoCo steps its whole model, to the bit."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros import Simulation, scene_names
from fluid_sim_ros.cli.scene import examine_scene
from fluid_sim_ros.simulation.engine import Engine
from test.support.lean_worlds import Beside
from test.support.volumes import quick

SCENES = [name for name in scene_names() if name != 'fleet_swarm']  # fleet_x500 is of its kind
CHOSEN = ('amphibious', 'wave_buoy', 'x500_ground', 'bluerov2_tether', 'aerosonde', 'fish')


@pytest.mark.parametrize('integrator', ['RK4', 'implicitfast'])
@pytest.mark.parametrize('scene', quick(SCENES, *CHOSEN))
def test_scene(scene, integrator):
    simulation = Simulation(scene, integrator=integrator, seed=3)
    # without the scene's gaits and events, which write into the data of one of the two
    engine = Engine(simulation.model, [])
    mujoco.mj_copyData(engine.data, engine.model, simulation.data)
    beside, rng = Beside(engine), np.random.default_rng(5)
    low, high = np.clip(engine.model.actuator_ctrlrange, -20, 20).T
    for _ in range(25):
        controls = rng.uniform(low, np.maximum(low, high))
        beside.both(lambda data, controls=controls: data.ctrl.__setitem__(slice(None), controls))
        beside.step(int(rng.integers(1, 12)))


def test_doctor_says_what_is_on():
    rows = {row.name: row for row in examine_scene('x500')}
    assert rows['stages'].found == (
        'contacts while geoms are near each other; no other constraints; '
        'places of 0 of 23 geoms at every evaluation; moments of actuators at sites by tree; '
        "MuJoCo's fluid forces by chain"
    )
    rows = {row.name: row for row in examine_scene('kirchhoff')}
    assert rows['stages'].found.startswith('contacts never')
