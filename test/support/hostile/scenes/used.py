# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What is done with a drawn scene: steps, sensors, commands, saved states, resets."""

from pathlib import Path

import numpy as np

from fluid_sim_ros.errors import CommandError, DivergedError
from fluid_sim_ros.sensors import SensorSuite
from fluid_sim_ros.simulation import Simulation
from test.support.hostile.models.draw import Draw

STEPS = 12


def used(path: Path, seed: int) -> str:
    """
    Step a scene with its sensors, command it, take it back and step it again.

    Parameters
    ----------
    path
        Its file.
    seed
        Of everything random, and of what is done.

    Returns
    -------
    str
        ``flown``, ``diverged`` (which the simulation has said), or what is wrong.

    """
    simulation = Simulation(path, seed=seed)
    try:
        return _fly(simulation, Draw(f'use {seed}'))
    finally:
        simulation.close()


def _fly(simulation: Simulation, draw: Draw) -> str:
    suites = [SensorSuite(simulation, name) for name in simulation.vehicles]
    try:
        _step(simulation, suites)
        saved = simulation.save_state()
        readings = [suite.save_state() for suite in suites]
        first = _step(simulation, suites)
        simulation.load_state(saved)
        for suite, reading in zip(suites, readings, strict=True):
            suite.load_state(reading)
        if _step(simulation, suites) != first:
            return 'another flight from the same state'
        _command(simulation, draw)
        _step(simulation, suites)
        simulation.reset()
        _step(simulation, suites)
    except DivergedError:
        return 'diverged'
    return 'flown'


def _step(simulation: Simulation, suites: list[SensorSuite]) -> bytes:
    """Step, with readings; return the states, which are finite or the simulation would say so."""
    states = []
    for _ in range(STEPS):
        for suite in suites:
            suite.update()
        simulation.step()
        states.append(simulation.data.qpos.copy())
    simulation.observe(forces=True)
    assert np.isfinite(states).all()
    return np.array(states).tobytes()


def _command(simulation: Simulation, draw: Draw) -> None:
    for set_flow in (simulation.set_wind, simulation.set_current):
        try:
            set_flow([draw.gauss(0, 5), draw.gauss(0, 5), 0.0])
        except CommandError:  # there is no such medium
            continue
    for name, vehicle in simulation.vehicles.items():
        if vehicle.thrusters:
            simulation.set_thrust(name, [draw.gauss(0, 20) for _ in vehicle.thrusters])
        if vehicle.joints:
            simulation.set_joints(name, [draw.gauss(0, 1) for _ in vehicle.joints])
        force, torque = ([draw.gauss(0, 1) for _ in range(3)] for _ in range(2))
        simulation.set_wrench(name, force, torque, draw.choice(('base_link', 'map')))
