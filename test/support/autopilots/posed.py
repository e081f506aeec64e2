# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A vehicle that is put into drawn states, for messages that are compared with their twins."""

import math

import numpy as np

from fluid_sim_ros import Simulation
from fluid_sim_ros.mavlink.mapping import load_mapping
from fluid_sim_ros.plugins import native as nat


class Posed:
    """A simulation whose observed row is set by hand; ``step`` counts only."""

    def __init__(self, scene, **options):
        self.simulation = simulation = Simulation(scene, **options)
        (self.vehicle,) = simulation.vehicles.values()
        self.row = simulation.observe(forces=True)[0]
        rows, self._random = simulation.observe(forces=True), np.random.default_rng(5)
        simulation.observe = lambda forces, wrenches=True: rows
        simulation._engine_step = lambda n, step: n

    def pose(self):
        """Go a step on, to a state from slow to far out."""
        row, drawn = self.row, self._random
        scale = 10.0 ** drawn.uniform(-6, 3)
        row[:] = scale * drawn.standard_normal(len(row))
        row[nat.QUATERNION] = drawn.standard_normal(4)
        row[nat.QUATERNION] /= np.linalg.norm(row[nat.QUATERNION])
        if drawn.random() < 0.1:  # numbers that print as few digits, zeros among them
            row[: nat.QUATERNION.start] = np.round(row[: nat.QUATERNION.start], 1)
            row[nat.LINEAR_VELOCITY.start :] = np.round(row[nat.LINEAR_VELOCITY.start :])
        if drawn.random() < 0.05:  # the nose straight up or down
            row[nat.QUATERNION] = [math.sqrt(0.5), 0, drawn.choice([-1, 1]) * math.sqrt(0.5), 0]

    def mapping(self, protocol):
        return load_mapping(protocol, self.vehicle.kind, '')[0]
