# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Opens the bridge of a protocol; see ``fluid_sim_ros.loop.autopilot_port``."""

from dataclasses import replace

from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.loop.autopilot_port import (
    PROTOCOLS,
    AutopilotOptions,
    Bridge,
    Surroundings,
)
from fluid_sim_ros.mavlink.actuator_map import ActuatorMap
from fluid_sim_ros.mavlink.ardupilot.bridge import ArduPilotBridge
from fluid_sim_ros.mavlink.mapping import load_mapping
from fluid_sim_ros.mavlink.program.parameters import needed_parameters, parameters_line
from fluid_sim_ros.simulation import Simulation


def open_bridge(
    simulation: Simulation, options: AutopilotOptions, surroundings: Surroundings
) -> Bridge:
    """
    Listen for an autopilot.

    Parameters
    ----------
    simulation
        What the vehicle is in.
    options
        Protocol, vehicle, mapping, address and port; an empty vehicle means the only one.
    surroundings
        Where faults are reported, and what resets and logs.

    Returns
    -------
    Bridge
        Of the protocol, listening.

    Raises
    ------
    ConfigError
        If the protocol, the vehicle or the mapping is wrong, or the port is in use.

    """
    if options.protocol not in PROTOCOLS:
        raise ConfigError(
            f"autopilot protocol '{options.protocol}' is not known; allowed: {listed(PROTOCOLS)}"
        )
    if not options.vehicle:
        if len(simulation.vehicles) != 1:
            names = listed(simulation.vehicles)
            raise ConfigError(f'autopilot: name the vehicle that it flies, one of: {names}')
        options = replace(options, vehicle=next(iter(simulation.vehicles)))
    vehicle = simulation.vehicle(options.vehicle)
    file, path = load_mapping(options.protocol, vehicle.kind, options.mapping)
    actuators = ActuatorMap(file, path, vehicle)
    if not options.program and (parameters := needed_parameters(file, options.parameters)):
        line = f'{path.stem}: the autopilot needs {parameters_line(parameters)}'
        surroundings.inform(line)
    if options.protocol == 'px4':
        # only this protocol needs pymavlink
        from fluid_sim_ros.mavlink.px4.bridge import Px4Bridge

        return Px4Bridge(simulation, options, surroundings, actuators, file)
    return ArduPilotBridge(simulation, options, surroundings, actuators, file)
