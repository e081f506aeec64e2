# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Steers the vehicles of a node: velocities on ``<vehicle>/cmd_vel`` for their controllers."""

import struct
from collections.abc import Sequence

from fluid_sim_ros.cli.view.node_link import NodeLink
from fluid_sim_ros.errors import CommandError, FluidSimError
from fluid_sim_ros.loop.helms import Move, helm_of
from fluid_sim_ros.loop.hold import state_of
from fluid_sim_ros.messages.topic import NEWEST
from fluid_sim_ros.ros.raw import RawPublisher
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.simulation.plant import plant_of
from fluid_sim_ros.view.orders import Steer

_TWIST = 'geometry_msgs/msg/Twist'
_CDR = b'\x00\x01\x00\x00'


class NodeSteering:
    """
    Publishes what keys and gamepads ask for.

    Parameters
    ----------
    link
        To the node.
    simulation
        Of its scene, which is not stepped: vehicles and what they weigh.

    """

    def __init__(self, link: NodeLink, simulation: Simulation) -> None:
        self._fastest: dict[str, Move] = {}
        self._without: dict[str, str] = {}
        self._publishers: dict[str, RawPublisher] = {}
        self._moving: dict[str, bytes] = {}
        rows = simulation.observe(forces=False)
        for row, (name, vehicle) in zip(rows, simulation.vehicles.items(), strict=True):
            try:
                if not vehicle.thrusters:
                    raise CommandError('it has no thrusters')
                plant, _ = plant_of(simulation.scene, name)
                helm = helm_of(plant, vehicle, state_of(simulation, row))
            except FluidSimError as error:
                self._without[name] = str(error)
                continue
            self._fastest[name] = helm.fastest
            # made now, so that who follows it is known when a key is pressed
            self._publishers[name] = RawPublisher(link.node, _TWIST, f'{name}/cmd_vel', NEWEST)

    def steer(self, order: Steer) -> None:
        """
        Ask a vehicle's controller for a velocity, until the next order; zeros hold.

        Parameters
        ----------
        order
            Shares of the fastest.

        Raises
        ------
        CommandError
            If no law fits the vehicle, or nobody follows its topic.

        """
        name = order.vehicle
        if name in self._without:
            raise CommandError(f"vehicle '{name}' cannot be steered: {self._without[name]}")
        shares = (order.forward, order.left, order.up, order.turn)
        pairs = zip(shares, self._fastest[name], strict=True)
        data = _twist([share * fastest for share, fastest in pairs])
        publisher = self._publishers[name]
        if not publisher.subscription_count():
            self._moving.pop(name, None)
            raise CommandError(
                f'nobody follows {publisher.topic}: start the controller of the vehicle '
                '(quad_controller, rov_controller, auv_controller or plane_controller), or '
                'use the sliders'
            )
        publisher.publish(data)
        if any(shares):
            self._moving[name] = data
        else:
            self._moving.pop(name, None)

    def repeat(self) -> None:
        """Send what still moves again: controllers drop velocities that are stale."""
        for name, data in list(self._moving.items()):
            self._publishers[name].publish(data)


def _twist(velocity: Sequence[float]) -> bytes:
    """Return a geometry_msgs/Twist of forward, left and up [m/s], and turn [rad/s]."""
    forward, left, up, turn = velocity
    return _CDR + struct.pack('<6d', forward, left, up, 0.0, 0.0, turn)
