# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The flow around a vehicle, as the view draws it: what the vehicle would meet there."""

from dataclasses import replace

import numpy as np
import pytest

from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.view import orders
from fluid_sim_ros.view.simulated import SimulatedSource
from fluid_sim_ros.view.stage import Stage


def seen(scene, seconds, *given):
    """Return the simulation of a source, its frame after some time, and a stage posed to it."""
    source = SimulatedSource(scene)
    for order in given:
        source._do(order)
    source.simulation.step(round(seconds / source.simulation.timestep))
    source._sample()
    frame = source.frame()
    stage = Stage(source.model, source.vehicles)
    stage.pose(frame)
    return source.simulation, frame, stage


@pytest.mark.parametrize(
    ('scene', 'stream', 'velocity'),
    [('bluerov2_waves', 'current', [0.2, -0.1, 0.0]), ('x500_turbulence', 'wind', [4.0, 1.0, 0])],
)
def test_at_the_vehicle_it_is_what_the_vehicle_meets(scene, stream, velocity):
    simulation, frame, stage = seen(scene, 2.0, orders.Flow(stream, velocity))
    name, vehicle = next(iter(simulation.vehicles.items()))
    place = simulation.data.xpos[vehicle.body_id]
    flows, liquid = stage.flow(frame, name, np.array([frame.rows[0][nat.POSITION]]))
    assert np.linalg.norm(flows) > 0.05
    assert flows[0] == pytest.approx(frame.rows[0][nat.MEDIUM_VELOCITY], abs=1e-12)
    assert bool(liquid[0]) == (stream == 'current')
    assert np.abs(place - frame.rows[0][nat.POSITION]).max() < 0.1


def test_the_orbits_of_waves_decay_with_depth_and_turn_round_with_the_phase():
    simulation, frame, stage = seen('bluerov2_waves', 2.0)
    name = next(iter(simulation.vehicles))
    depths = np.array([[0.0, 0.0, z] for z in (-1.0, -3.0, -6.0)])
    flows, liquid = stage.flow(frame, name, depths)
    speeds = np.linalg.norm(flows, axis=1)
    assert liquid.all() and speeds[0] > speeds[1] > speeds[2]
    along = np.array([[x, 0.0, -1.5] for x in np.linspace(0.0, 60.0, 61)])
    up = stage.flow(frame, name, along)[0][:, 2]
    assert up.max() > 0.05 and up.min() < -0.05


def test_where_only_the_flow_at_the_vehicle_is_known_waves_ride_on_it():
    """A log, and a node."""
    simulation, frame, stage = seen('bluerov2_waves', 2.0)
    name = next(iter(simulation.vehicles))
    points = frame.rows[0][nat.POSITION] + np.array([[0.0, 0, 0], [1.0, 0, -0.5], [4.0, 2, -1]])
    whole, _ = stage.flow(frame, name, points)
    known = replace(frame, weather=None)
    again = Stage(simulation.model, simulation.vehicles)
    again.pose(known)
    flows, _ = again.flow(known, name, points)
    assert flows == pytest.approx(whole, abs=1e-9)
    frame.rows[0][nat.MEDIUM_VELOCITY] += (0.5, 0.0, 0.0)
    moved, _ = again.flow(known, name, points)
    assert moved - whole == pytest.approx(np.tile([0.5, 0, 0], (3, 1)), abs=1e-9)
