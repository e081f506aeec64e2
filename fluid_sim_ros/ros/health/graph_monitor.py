# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Watches the ROS graph for what must not be there."""

from collections.abc import Callable

from rclpy.node import Node

from fluid_sim_ros.ros.health.connections import Connections, node_name


class GraphMonitor:
    """
    Watches the ROS graph for peers that must not exist; runs in the executor's thread.

    Parameters
    ----------
    node
        The node that looks.
    report
        Takes (key, line): a fault to log.

    Attributes
    ----------
    faults
        What is wrong with the graph now, one line each.
    connections
        Watch over topics whose qualities of service do not fit.

    """

    def __init__(self, node: Node, report: Callable[[str, str], None]) -> None:
        self._node = node
        self._report = report
        self.faults: tuple[str, ...] = ()
        self.connections = Connections(node, node.get_logger().warning)
        self._timer = node.create_timer(1.0, self.read_graph)

    def read_graph(self) -> None:
        """Read the graph and keep what is wrong with it."""
        node = self._node
        faults = []
        clocks = node.get_publishers_info_by_topic('/clock')
        if len(clocks) > 1:
            # this node has one publisher; the others are named
            names = sorted({node_name(c) for c in clocks})
            faults.append(f'{len(clocks)} publishers of /clock: {", ".join(names)}')
        own = (node.get_name(), node.get_namespace())
        if node.get_node_names_and_namespaces().count(own) > 1:
            faults.append(f'another node is called {node.get_fully_qualified_name()}')
        for fault in faults:
            self._report(fault, fault)
        self.faults = tuple(faults)
