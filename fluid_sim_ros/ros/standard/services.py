# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Creates the services of simulation_interfaces where that package is installed."""

from collections.abc import Callable
from importlib import import_module

from rclpy.node import Node

from fluid_sim_ros.ros.standard.answers import OnSession
from fluid_sim_ros.ros.standard.entities import EntityServices
from fluid_sim_ros.ros.standard.running import SimulationServices

_PACKAGE = 'simulation_interfaces'
#: Name of each service, which is that of its method, and its type.
SERVICES = {
    SimulationServices: {
        'get_simulator_features': 'GetSimulatorFeatures',
        'reset_simulation': 'ResetSimulation',
        'step_simulation': 'StepSimulation',
        'set_simulation_state': 'SetSimulationState',
        'get_simulation_state': 'GetSimulationState',
    },
    EntityServices: {
        'get_entities': 'GetEntities',
        'get_entities_states': 'GetEntitiesStates',
        'get_entity_state': 'GetEntityState',
        'set_entity_state': 'SetEntityState',
    },
}


def create_standard_services(node: Node, on_session: OnSession, end: Callable[[], None]) -> bool:
    """
    Create the services, with names relative to the node's namespace.

    Parameters
    ----------
    node
        Their owner.
    on_session, end
        As of ``Services``.

    Returns
    -------
    bool
        False where the package is not installed.

    """
    try:
        messages, services = (import_module(f'{_PACKAGE}.{part}') for part in ('msg', 'srv'))
    except ModuleNotFoundError:
        return False
    for kind, table in SERVICES.items():
        served = kind(messages, services, on_session, end)
        for name, message in table.items():
            answer = served.answering(getattr(served, name))
            node.create_service(getattr(services, message), name, answer)
    return True
