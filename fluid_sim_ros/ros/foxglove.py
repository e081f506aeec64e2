# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Live viewers of a node: the services and parameters that they may use."""

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from rclpy.node import Node

from fluid_sim_ros.loop.foxglove_port import LiveControl, LivePort, open_foxglove

if TYPE_CHECKING:
    from fluid_sim_ros.ros.session import Session

#: A viewer's wish that is not granted within this time is given up [s].
_PATIENCE = 5.0
#: What a viewer may change, as others may by ROS.
CHANGEABLE = ('enable_wind', 'pacing', 'realtime.factor')


def start_foxglove(node: Node, session: 'Session', settings: Mapping[str, Any]) -> LivePort | None:
    """
    Begin to serve live viewers, where the parameters ask for it.

    Parameters
    ----------
    node
        The simulator's node.
    session
        That viewers may reset, pause and step.
    settings
        Values of the node's parameters.

    Returns
    -------
    LivePort or None
        A sink for the runner; None where the parameters ask for nothing.

    Raises
    ------
    ConfigError, MissingExtraError
        If the port is in use, or the extra is missing.

    """
    port = settings['foxglove.port']
    if not port:
        return None

    def act(name: str, value: bool) -> str:
        work: dict[str, Callable[[], str]] = {
            'reset': session.reset,
            'step': session.step,
            'pause': lambda: session.pause(value),
        }
        return session.requests.call(work[name], _PATIENCE)

    def parameters() -> dict[str, Any]:
        return {name: _plain(value) for name, value in settings.items()}

    def change(values: Mapping[str, Any]) -> None:
        session.requests.call(lambda: session.change(dict(values)), _PATIENCE)

    control = LiveControl(act, parameters, change, CHANGEABLE)
    known = {**settings, 'namespace': node.get_namespace()}
    live = open_foxglove(session.simulation, known, port, control)
    node.get_logger().info(f'Foxglove, Lichtblick: connect to ws://127.0.0.1:{live.port}')
    return live


def _plain(value: Any) -> Any:
    return value if isinstance(value, str | int | float) else list(value)
