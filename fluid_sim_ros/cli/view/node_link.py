# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The view's end of a running node: its parameters, topics and services."""

import os
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import rclpy
from rcl_interfaces.srv import GetParameters
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from std_srvs.srv import SetBool, Trigger

from fluid_sim_ros.errors import CommandError, ConfigError, listed
from fluid_sim_ros.ros.process.this_host import check_domain

#: A service that is not there, or does not answer, within this time is given up [s].
PATIENCE = 5.0
_LONGEST_SPIN = 0.1
#: Names of parameter types (rcl_interfaces/ParameterType) -> field of the value.
_FIELDS = {1: 'bool_value', 2: 'integer_value', 3: 'double_value', 4: 'string_value'}


class NodeLink:
    """
    A ROS node of the view's own, beside the simulator's node.

    Parameters
    ----------
    target
        Name of the simulator's node, with its namespace: ``/fluid_sim_node``.

    Attributes
    ----------
    node
        In the namespace of the target.

    """

    def __init__(self, target: str) -> None:
        check_domain()
        self.target = target if target.startswith('/') else f'/{target}'
        namespace, _, name = self.target.rpartition('/')
        if not name:
            raise ConfigError(f"--node '{target}': a node's name, such as /fluid_sim_node")
        self._context = Context()
        rclpy.init(args=[], context=self._context, signal_handler_options=SignalHandlerOptions.NO)
        self.node: Node = rclpy.create_node(
            f'fluid_sim_view_{os.getpid()}', namespace=namespace or '/', context=self._context
        )
        self._ended = threading.Event()
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self.node)
        self._thread = threading.Thread(target=self._spin, name='view executor')
        self._thread.start()
        self._services = {
            name: self.node.create_client(kind, f'{self.target}/{name}')
            for name, kind in (
                ('pause', SetBool), ('step', Trigger), ('reset', Trigger),
                ('get_parameters', GetParameters),
            )
        }  # fmt: skip

    def _spin(self) -> None:
        while not self._ended.is_set():
            self._executor.spin_once(_LONGEST_SPIN)

    def parameters(self, names: Sequence[str]) -> dict[str, Any]:
        """
        Return parameters of the node.

        Parameters
        ----------
        names
            Of the parameters.

        Returns
        -------
        dict
            Name -> value.

        Raises
        ------
        ConfigError
            If there is no such node, or it is none of ours.

        """
        client = self._services['get_parameters']
        if not client.wait_for_service(PATIENCE):
            names_here = [f'{space.rstrip("/")}/{n}' for n, space in self._others()]
            raise ConfigError(
                f'--node {self.target}: no such node within {PATIENCE:g} s; there are: '
                f'{listed(names_here)} (ROS_DOMAIN_ID {os.environ.get("ROS_DOMAIN_ID", "0")})'
            )
        answer = self._call('get_parameters', GetParameters.Request(names=list(names)))
        if len(answer.values) != len(names) or not all(v.type in _FIELDS for v in answer.values):
            raise ConfigError(
                f'--node {self.target}: it has no parameter {names[0]!r}: it is no fluid_sim_node'
            )
        return {
            name: getattr(value, _FIELDS[value.type])
            for name, value in zip(names, answer.values, strict=True)
        }

    def _others(self) -> list[tuple[str, str]]:
        found: list[tuple[str, str]] = self.node.get_node_names_and_namespaces()
        return [pair for pair in found if not pair[0].startswith(('fluid_sim_view', '_'))]

    def ask(self, service: str, value: bool | None = None) -> str:
        """
        Call a service.

        Parameters
        ----------
        service
            ``pause``, ``step`` or ``reset``.
        value
            For ``pause``.

        Returns
        -------
        str
            What it answered.

        Raises
        ------
        CommandError
            If it refuses, or does not answer.

        """
        request = Trigger.Request() if value is None else SetBool.Request(data=value)
        answer = self._call(service, request)
        if not answer.success:
            raise CommandError(f'{self.target}: {service}: {answer.message}')
        return str(answer.message)

    def _call(self, service: str, request: Any) -> Any:
        client = self._services[service]
        if client.service_is_ready():
            future, end = client.call_async(request), time.monotonic() + PATIENCE
            while not future.done() and time.monotonic() < end:
                time.sleep(0.002)
            if future.done():
                return future.result()
        raise CommandError(f'{self.target}: {service} was not answered: the node is gone or busy')

    def close(self) -> None:
        """Leave the ROS graph."""
        self._ended.set()
        self._thread.join()
        self._executor.shutdown()
        self.node.destroy_node()
        rclpy.shutdown(context=self._context)


@contextmanager
def linked(target: str) -> Iterator[NodeLink]:
    """
    Give a link to a node, closed behind the block.

    Parameters
    ----------
    target
        Name of the node.

    Returns
    -------
    context manager
        Gives the link.

    """
    link = NodeLink(target)
    try:
        yield link
    finally:
        link.close()
