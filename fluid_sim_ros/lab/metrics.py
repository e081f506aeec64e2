# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Relative errors of a motion: the quantities that a tolerance of 1 % refers to."""

from collections.abc import Callable

import numpy as np

from fluid_sim_ros.errors import ConfigError, did_you_mean, listed
from fluid_sim_ros.lab.motion_errors import angles, distances, regime, regime_error
from fluid_sim_ros.lab.problems.body_watch import VELOCITY
from fluid_sim_ros.lab.problems.problem import Problem, Rung
from fluid_sim_ros.physics.arrays import Array

Metric = Callable[[Array, Array], float]  # of states and reference states, shape (n, bodies, 13)

METRICS = ('pose', 'position', 'attitude', 'velocity', 'regime')
#: A turn below this is not measured against its own size [rad].
_LEAST_TURN = 0.1
#: A speed below this is not measured against its own size [m/s].
_LEAST_SPEED = 1e-3


def check_metric(name: str) -> None:
    """
    Refuse a metric that there is not.

    Parameters
    ----------
    name
        Of the metric.

    Raises
    ------
    ConfigError
        If it is none of METRICS.

    """
    if name not in METRICS:
        hint = did_you_mean(name, METRICS)
        raise ConfigError(f"metric '{name}' is not known{hint} allowed: {listed(METRICS)}")


def vehicle_size(rung: Rung) -> float:
    """
    Return the largest extent of a vehicle from its base, over all its shapes.

    Parameters
    ----------
    rung
        The model.

    Returns
    -------
    float
        [m]; 0.1 m for vehicles without shapes.

    """
    compiled = rung.scene.compile()
    model = compiled.model
    sizes = [
        float(np.linalg.norm(model.geom_pos[geom]) + model.geom_rbound[geom])
        for vehicle in compiled.vehicles.values()
        for geom in range(model.ngeom)
        if model.geom_bodyid[geom] == vehicle.body_id
    ]
    return max(sizes, default=0.1)


def metric(name: str, problem: Problem, reference: Array) -> Metric:
    """
    Return a metric by name; each is the largest over time and over all bodies of all vehicles.

    A body is measured against its own motion. position: over its largest distance from the start,
    at least the vehicle's size; attitude: over its largest turn from the start, at least 0.1 rad;
    pose: the larger of both; velocity: over its largest speed; regime: of the first vehicle's mean
    descent and frequency.

    Parameters
    ----------
    name
        One of METRICS.
    problem
        Whose motion is judged.
    reference
        The converged motion that sets the scales, shape (n, bodies, 13).

    Returns
    -------
    Metric
        Function of states and reference states, shape (n, bodies, 13) each; returns the relative
        error [-].

    """
    start = reference[:1]
    size = vehicle_size(problem.rungs[problem.richest])
    length = np.maximum(distances(reference, start).max(axis=0), size)
    turn = np.maximum(angles(reference, start).max(axis=0), _LEAST_TURN)
    speeds = np.linalg.norm(reference[..., VELOCITY], axis=-1)
    speed = np.maximum(speeds.max(axis=0), _LEAST_SPEED)

    def position(states: Array, wanted: Array) -> float:
        return float((distances(states, wanted) / length).max())

    def attitude(states: Array, wanted: Array) -> float:
        return float((angles(states, wanted) / turn).max())

    def velocity(states: Array, wanted: Array) -> float:
        apart = np.linalg.norm(states[..., VELOCITY] - wanted[..., VELOCITY], axis=-1)
        return float((apart / speed).max())

    def same_regime(states: Array, wanted: Array) -> float:
        return regime_error(regime(problem.times, states), regime(problem.times, wanted))

    return {
        'position': position,
        'attitude': attitude,
        'velocity': velocity,
        'pose': lambda states, wanted: max(position(states, wanted), attitude(states, wanted)),
        'regime': same_regime,
    }[name]
