# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A running node as a source of the view: states from topics, orders to topics and services."""

import struct
import threading
import time
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np

from fluid_sim_ros.cli.view.node_link import NodeLink
from fluid_sim_ros.cli.view.node_steering import NodeSteering
from fluid_sim_ros.errors import CommandError
from fluid_sim_ros.messages.cdr import (
    read_float64_multi_array,
    read_joint_state,
    read_stamped_pair,
)
from fluid_sim_ros.messages.commands import JOINT_STATE, MULTI_ARRAY, TWIST, WRENCH
from fluid_sim_ros.messages.state_topics import ODOMETRY
from fluid_sim_ros.messages.templates import Template
from fluid_sim_ros.messages.topic import NEWEST, STATE
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.ros.controllers.states import read_odometry
from fluid_sim_ros.ros.raw import PolledSubscription, RawPublisher
from fluid_sim_ros.scene.vehicle import Vehicle
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.view import orders
from fluid_sim_ros.view.frame import Frame
from fluid_sim_ros.view.source import Source

#: Commands of the sliders are sent again so often, since a node drops stale ones [s].
_AGAIN = 0.1
#: Without odometry for this long the node is said to be silent [s of wall time].
_SILENT = 2.0
_ASKED = ('scene', 'fluid', 'thrust.unit', 'pacing')


class NodeSource(Source):
    """
    Shows what a node publishes; see ``view.source.Source``.

    The scene is loaded here, too, for its shapes and names: its files must be on this machine.

    Parameters
    ----------
    link
        To the node.
    scene
        Takes the place of the one that the node names; empty: that one.
    say
        Takes lines for the user.

    """

    rungs: Sequence[str] = ()
    span = (0.0, 0.0)
    generation = 0
    pace = 1.0

    def __init__(
        self, link: NodeLink, scene: str = '', say: Callable[[str], None] = lambda line: None
    ) -> None:
        self._link = link
        asked = link.parameters(_ASKED)
        simulation = Simulation(scene or asked['scene'], fluid=asked['fluid'] or None)
        self.title = f'{link.target}: {simulation.scene.name}'
        self.model, self.vehicles = simulation.model, simulation.vehicles
        self.terms, self.streams = simulation.terms, simulation.streams
        kinds = {
            orders.Pause, orders.Step, orders.Reset, orders.Joint, orders.Flow, orders.Steer,
        }  # fmt: skip
        self._steering = NodeSteering(link, simulation)
        if asked['thrust.unit'] == 'newton':
            kinds.add(orders.Thrust)
        else:
            say(f'no sliders for thrusters: thrust.unit is {asked["thrust.unit"]} there')
        if asked['pacing'] == 'lockstep':
            say('the node is in lockstep: it waits for its controller whatever the sliders send')
        self.takes = frozenset(kinds)
        self._qpos = simulation.data.qpos.copy()
        self._rows = np.full((len(self.vehicles), nat.ROW_WIDTH), np.nan)
        self._control = np.full(self.model.nu, np.nan)
        self._force = np.full(self.model.nu, np.nan)
        self._flows: dict[str, Array] = {}
        self._time, self._heard, self._paused = 0.0, time.monotonic(), False
        self._lock = threading.Lock()
        self._ended = threading.Event()
        self._inputs: list[tuple[PolledSubscription, Callable[[bytes], None]]] = []
        self._outputs: dict[str, RawPublisher] = {}
        self._sent_again: dict[str, bytes] = {}
        for number, vehicle in enumerate(self.vehicles.values()):
            self._listen(number, vehicle)

    # ---- topics ----------------------------------------------------------------------------

    def _listen(self, number: int, vehicle: Vehicle) -> None:
        name, row = vehicle.name, self._rows[number]

        def add(message: str, topic: str, take: Callable[[bytes], None]) -> None:
            subscription = PolledSubscription(self._link.node, message, f'{name}/{topic}', STATE)
            self._inputs.append((subscription, take))

        def odometry(data: bytes) -> None:
            stamp_ns, state = read_odometry(data)
            self._time, self._heard = stamp_ns * 1e-9, time.monotonic()
            row[nat.POSITION], row[nat.QUATERNION] = state.position_w, state.quat_wb_wxyz
            row[nat.LINEAR_VELOCITY], row[nat.ANGULAR_VELOCITY] = state.velocity_b, state.omega_b
            at = vehicle.qpos_address
            if at >= 0:
                self._qpos[at : at + 3] = state.position_w
                self._qpos[at + 3 : at + 7] = state.quat_wb_wxyz

        def wrench(where: slice, data: bytes) -> None:
            pair = read_stamped_pair(data)
            row[where] = np.concatenate([pair.first, pair.second])

        def joints(data: bytes) -> None:
            self._take_joints(vehicle, data)

        def medium(data: bytes) -> None:
            velocity = read_stamped_pair(data).first
            if velocity.any() or not np.isfinite(row[nat.MEDIUM_VELOCITY]).all():
                row[nat.MEDIUM_VELOCITY] = velocity

        def thrust(data: bytes) -> None:
            values = read_float64_multi_array(data)
            if len(values) == len(vehicle.thruster_ids):
                self._control[vehicle.thruster_ids] = values / vehicle.thrust_scale

        add(ODOMETRY, 'odom', odometry)
        columns = {'total': nat.TOTAL, 'thrust': nat.THRUST}
        columns |= {term: nat.term_columns(term) for term in self.terms[name]}
        for term, where in columns.items():
            add(WRENCH, f'wrench/{term}', partial(wrench, where))
        add(JOINT_STATE, 'joint_states', joints)
        for stream in self.streams:
            add(TWIST, f'medium/{stream}', medium)
        if vehicle.thrusters:
            add(MULTI_ARRAY, 'cmd/thrust', thrust)

    def _take_joints(self, vehicle: Vehicle, data: bytes) -> None:
        state = read_joint_state(data)
        efforts = dict(zip(vehicle.thrusters, vehicle.thruster_ids, strict=True))
        for i, name in enumerate(state.names):
            if name in efforts and len(state.effort) > i:
                scale = vehicle.effort_scale[vehicle.thrusters.index(name)]
                self._force[efforts[name]] = state.effort[i] / scale
            elif len(state.position) > i:
                self._set_joint(f'{vehicle.prefix}{name}', state.position[i])

    def _set_joint(self, name: str, position: float) -> None:
        try:
            address = int(self.model.joint(name).qposadr[0])
        except KeyError:
            return  # an actuator that moves no single joint
        self._qpos[address] = position

    def _publish(self, message: str, topic: str, data: bytes, again: bool) -> None:
        if topic not in self._outputs:
            self._outputs[topic] = RawPublisher(self._link.node, message, topic, NEWEST)
        self._outputs[topic].publish(data)
        if again:
            self._sent_again[topic] = data

    # ---- the source's side -----------------------------------------------------------------

    def frame(self) -> Frame:
        """Take what has arrived, and return it."""
        with self._lock:
            for subscription, take in self._inputs:
                while data := subscription.take():
                    try:
                        take(data)
                    except CommandError:
                        continue  # malformed: the node's diagnostics tell of its own messages
            silent = time.monotonic() - self._heard
            note = ''
            if silent > _SILENT and not self._paused:
                note = f'nothing heard of {self._link.target} for {silent:.0f} s'
            return Frame(
                self._time, self._qpos.copy(), self._rows.copy(), self._control.copy(),
                self._force.copy(), dict(self._flows), self._paused, note=note,
            )  # fmt: skip

    def take(self, order: orders.Order) -> None:
        """
        Hand an order on to the node.

        Parameters
        ----------
        order
            Of a kind that ``takes`` holds.

        Raises
        ------
        FluidSimError
            If the node refuses, or does not answer.

        """
        if type(order) not in self.takes:
            raise CommandError(f'a node takes no order {type(order).__name__}')
        match order:
            case orders.Pause(paused):
                self._link.ask('pause', paused)
                self._paused = paused
            case orders.Step():
                self._link.ask('pause', True)
                self._paused = True
                self._link.ask('step')
            case orders.Reset():
                self._link.ask('reset')
                self._sent_again.clear()
            case orders.Thrust(vehicle, values):
                self._publish(MULTI_ARRAY, f'{vehicle}/cmd/thrust', _array(values), True)
            case orders.Joint(vehicle, joint, value):
                data = _filled(JOINT_STATE, {'name': [joint], 'position': [0.0]}, [value])
                self._publish(JOINT_STATE, f'{vehicle}/cmd/joints', data, False)
            case orders.Steer():
                self._steering.steer(order)
            case orders.Flow(stream, velocity):
                if stream not in self.streams:
                    raise CommandError(f"'{stream}' is not in the scene")
                self._publish(TWIST, stream, _twist(velocity), False)
                self._flows[stream] = np.array(velocity, dtype=float)

    def run(self) -> None:
        """Repeat the thrusts of the sliders, and the velocities of the keys, until ``stop``."""
        while not self._ended.wait(_AGAIN):
            self._steering.repeat()
            for topic, data in list(self._sent_again.items()):
                self._outputs[topic].publish(data)

    def stop(self) -> None:
        """End ``run``."""
        self._ended.set()


def _filled(message: str, constants: dict[str, Any], values: Sequence[float]) -> bytes:
    template = Template.of(message, constants, ['position'])
    struct.pack_into(f'<{len(values)}d', template.blocks[0], 0, *values)
    return template.bytes()


def _array(values: Sequence[float]) -> bytes:
    template = Template.of(MULTI_ARRAY, {'data': [0.0] * len(values)}, ['data'])
    struct.pack_into(f'<{len(values)}d', template.blocks[0], 0, *values)
    return template.bytes()


def _twist(velocity: Sequence[float]) -> bytes:
    """Return a TwistStamped that holds from now on (stamp 0)."""
    template = Template.of(TWIST, {'header.frame_id': 'map'}, ['twist.linear'])
    struct.pack_into('<3d', template.blocks[0], 0, *velocity)
    return template.bytes()
