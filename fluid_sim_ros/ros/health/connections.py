# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Topics that two nodes cannot talk on because their qualities of service do not fit.

The middleware then delivers nothing, and neither side hears of it: a best-effort publisher of
``<v>/cmd/thrust`` commands a vehicle that never moves.
"""

from collections.abc import Callable, Iterable
from typing import Any

from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.node import Node
from rclpy.qos import (
    DurabilityPolicy,
    QoSCompatibility,
    QoSProfile,
    ReliabilityPolicy,
    qos_check_compatible,
)

from fluid_sim_ros.ros.raw import Endpoint, PolledSubscription

#: Policies of which each value gives what those before it give, and more.
_LADDERS: tuple[tuple[str, tuple[Any, ...]], ...] = (
    ('reliability', (ReliabilityPolicy.BEST_EFFORT, ReliabilityPolicy.RELIABLE)),
    ('durability', (DurabilityPolicy.VOLATILE, DurabilityPolicy.TRANSIENT_LOCAL)),
)
#: What the user of a node can override by parameters (rclpy's default choice).
_OVERRIDABLE = ('reliability',)


class Connections:
    """
    Watches the topics of a node for peers with which no message can pass.

    The middleware tells of such a peer once and without its name; from then on the graph is asked
    once per second of wall time, in the executor's thread. A publisher of another type on a topic
    that the node subscribes to is found in the graph alone.

    Parameters
    ----------
    node
        Owner of the topics.
    warn
        Takes the line of a mismatch that is new.

    Attributes
    ----------
    mismatches
        One line for each that there is now.

    """

    def __init__(self, node: Node, warn: Callable[[str], None]) -> None:
        self._node = node
        self._warn = warn
        self._endpoints: list[Endpoint] = []
        self.mismatches: tuple[str, ...] = ()
        node.create_timer(1.0, self._read_graph, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def watch(self, endpoints: Iterable[Endpoint | None]) -> None:
        """
        Watch topics.

        Parameters
        ----------
        endpoints
            Publishers and subscriptions; None for what was not created.

        """
        self._endpoints += [endpoint for endpoint in endpoints if endpoint is not None]

    def forget(self) -> None:
        """Forget all topics: they are destroyed."""
        self._endpoints = []
        self.mismatches = ()

    def _read_graph(self) -> None:
        lines = [line for endpoint in self._endpoints for line in self._lines(endpoint)]
        for line in lines:
            if line not in self.mismatches:
                self._warn(line)
        self.mismatches = tuple(lines)

    def _lines(self, endpoint: Endpoint) -> list[str]:
        listens = isinstance(endpoint, PolledSubscription)
        if listens:
            peers = self._node.get_publishers_info_by_topic(endpoint.topic)
        elif endpoint.incompatible:
            peers = self._node.get_subscriptions_info_by_topic(endpoint.topic)
        else:
            return []
        lines = []
        for peer in peers:
            pair = (peer.qos_profile, endpoint.quality_of_service)
            offered, asked = pair if listens else pair[::-1]
            if peer.topic_type != endpoint.type:
                lines.append(_type_line(endpoint, peer, listens))
            elif endpoint.incompatible and not _fits(offered, asked):
                lines.append(_line(endpoint, peer, offered, asked, listens))
        return lines


def _fits(offered: QoSProfile, asked: QoSProfile) -> bool:
    return bool(qos_check_compatible(offered, asked)[0] != QoSCompatibility.ERROR)


def _type_line(endpoint: Endpoint, peer: Any, listens: bool) -> str:
    does = 'publishes' if listens else 'subscribes to'
    return (
        f'{node_name(peer)} {does} {endpoint.topic} as {peer.topic_type}, which is '
        f'{endpoint.type} here: no message passes'
    )


def _line(
    endpoint: Endpoint, peer: Any, offered: QoSProfile, asked: QoSProfile, listens: bool
) -> str:
    """Return which peer, what does not fit, and what to do about it."""
    policies = _differences(offered, asked)
    words = ', '.join(f'{low} but {high} is asked for' for _, low, high in policies)
    words = words or qos_check_compatible(offered, asked)[1].strip(' ;')
    who = node_name(peer)
    if listens:
        text = f'{who} publishes {endpoint.topic} with a quality that does not fit: {words}; '
        text += 'nothing of it arrives'
        fit = [f'publish with {policy} {high}' for policy, _, high in policies]
        side = 'subscription'
    else:
        text = f'{who} subscribes to {endpoint.topic} with a quality that does not fit: {words}; '
        text += 'it receives nothing'
        fit = [f'subscribe with {policy} {low}' for policy, low, _ in policies]
        side = 'publisher'
    for policy, low, high in policies:
        if policy in _OVERRIDABLE:
            value = low if listens else high
            fit.append(
                f'start this node with -p qos_overrides.{endpoint.topic}.{side}.{policy}:={value}'
            )
    return f'{text}. Remedy: {", or ".join(fit)}' if fit else text


def _differences(offered: QoSProfile, asked: QoSProfile) -> list[tuple[str, str, str]]:
    """Return policy, offered value and asked value where less is offered than is asked for."""
    found = []
    for policy, ladder in _LADDERS:
        low, high = getattr(offered, policy), getattr(asked, policy)
        known = low in ladder and high in ladder
        if known and ladder.index(low) < ladder.index(high):
            found.append((policy, low.name.lower(), high.name.lower()))
    return found


def node_name(endpoint: Any) -> str:
    """
    Return the full name of the node of a topic's endpoint.

    Parameters
    ----------
    endpoint
        As rclpy's ``get_publishers_info_by_topic`` returns it.

    Returns
    -------
    str
        ``/namespace/name``, or words where discovery has the topic, but not yet its node.

    """
    if 'UNKNOWN' in endpoint.node_name:
        return '(a node that is still being discovered)'
    return f'{endpoint.node_namespace.rstrip("/")}/{endpoint.node_name}'
