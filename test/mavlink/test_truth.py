# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The true state of a vehicle in the axes of autopilots."""

import numpy as np
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.mavlink.vehicle_truth import TruthReader


@pytest.mark.parametrize('scene', ['x500', 'bluerov2_heavy', 'aerosonde'])
def test_true_acceleration_is_the_derivative_of_velocity(scene):
    simulation = Simulation(scene, timestep=1e-4)
    (vehicle,) = simulation.vehicles.values()
    low, high = vehicle.thrust_range.T
    share = np.linspace(0.3, 0.6, len(low))
    simulation.set_thrust(vehicle.name, (high * share).tolist())
    simulation.step(2000)
    reader, truths = TruthReader(simulation, vehicle.name), []
    for _ in range(3):
        truths.append(reader.read(forces=True))
        simulation.step()
    slope = np.subtract(truths[2].velocity_ned, truths[0].velocity_ned) / 2e-4
    assert np.linalg.norm(slope) > 0.5
    error = np.subtract(truths[1].acceleration_ned, slope)
    assert np.linalg.norm(error) < 0.01 * np.linalg.norm(slope)


def test_at_rest_there_is_no_acceleration():
    simulation = Simulation('x500_ground')
    simulation.step(500)
    assert TruthReader(simulation, 'x500').read(forces=True).acceleration_ned == pytest.approx(
        [0, 0, 0], abs=0.01
    )
