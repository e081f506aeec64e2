# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The services of the simulator's node: reset, step, pause, and wind on or off."""

from collections.abc import Callable
from typing import Any

from rclpy.node import Node
from std_srvs.srv import SetBool, Trigger

from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.ros.session import Session
from fluid_sim_ros.ros.standard.answers import OnSession
from fluid_sim_ros.ros.standard.services import create_standard_services


def create_services(node: Node, on_session: OnSession, end: Callable[[], None]) -> None:
    """
    Create the services; their answers carry the simulated time, or why it did not work.

    ``~/reset``, ``~/step`` (std_srvs/Trigger), ``~/pause``, ``~/enable_wind`` (std_srvs/SetBool);
    and those of simulation_interfaces where it is installed.

    Parameters
    ----------
    node
        Their owner.
    on_session
        Has the stepping thread do work on the session. Raises FluidSimError where there is none,
        or the work fails.
    end
        Ends the node.

    """
    create_standard_services(node, on_session, end)

    def serve(response: Any, work: Callable[[Session], str]) -> Any:
        try:
            response.message = on_session(work)
            response.success = True
        except FluidSimError as error:
            response.message = str(error)
            response.success = False
        return response

    node.create_service(
        Trigger, '~/reset', lambda _, response: serve(response, lambda session: session.reset())
    )
    node.create_service(
        Trigger, '~/step', lambda _, response: serve(response, lambda session: session.step())
    )

    def pause(request: Any, response: Any) -> Any:
        return serve(response, lambda session: session.pause(request.data))

    def enable_wind(request: Any, response: Any) -> Any:
        return serve(response, lambda session: session.enable_wind(request.data))

    node.create_service(SetBool, '~/pause', pause)
    node.create_service(SetBool, '~/enable_wind', enable_wind)
