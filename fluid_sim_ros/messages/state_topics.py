# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The state topics of a scene as bytes: which there are, how often, and what stands in them."""

import math
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.messages.commands import JOINT_STATE, TWIST, WRENCH
from fluid_sim_ros.messages.description_topics import description_topic, descriptions
from fluid_sim_ros.messages.joint_numbers import JointNumbers
from fluid_sim_ros.messages.marker_topics import MarkerTopic
from fluid_sim_ros.messages.sensor_topics import sensor_topics
from fluid_sim_ros.messages.templates import Source, StampBytes, Template
from fluid_sim_ros.messages.topic import NEWEST, STATE, MadeNumber, Quality, StateTopic
from fluid_sim_ros.messages.transform_topics import MAP, transform_topics
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.scene.vehicle import Vehicle
from fluid_sim_ros.sensors import SensorSuite
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import Beat

ODOMETRY = 'nav_msgs/msg/Odometry'
CLOCK = 'rosgraph_msgs/msg/Clock'
_EVERY_STEP = Beat(Fraction(1))

#: Rates [Hz] of simulated time, variances and frames, as the node's parameters of the same names.
DEFAULTS: dict[str, Any] = {
    'odom.rate': 100.0,
    'odom.pose_covariance': [0.0] * 6,
    'odom.twist_covariance': [0.0] * 6,
    'wrench.rate': 100.0,
    'medium.rate': 100.0,
    'joint_states.rate': 100.0,
    'clock.rate': 100.0,
    'tf.rate': 50.0,
    'tf.root': MAP,
    'tf.links': True,
    'markers.rate': 20.0,
}


class StateTopics:
    """
    Every state topic of a simulation.

    Parameters
    ----------
    simulation
        Whose state.
    settings
        Rates and variances, by the names of ``DEFAULTS``.

    Attributes
    ----------
    topics
        In the order in which they are published: those that need no forces come first, so that
        a controller can answer the state while the forces are evaluated.
    suites
        The sensors of each vehicle, sampled while their topics are asked for.
    stamp
        Of the state that was taken last.
    notes
        What the robot descriptions cannot say of the vehicles, a line each.

    Raises
    ------
    ConfigError
        If a rate is above the step rate, or a sensor does not fit the model.

    """

    def __init__(self, simulation: Simulation, settings: Mapping[str, Any]) -> None:
        self._simulation = simulation
        self._settings = settings
        self.stamp = StampBytes()
        self._forces_known = False
        self._refused: dict[str, str] = {}
        rows = simulation.observe(forces=True)
        self.topics: list[StateTopic] = []
        self.suites = {name: SensorSuite(simulation, name) for name in simulation.vehicles}
        for index, vehicle in enumerate(simulation.vehicles.values()):
            self._add_vehicle(vehicle, rows[index])
        beat = self._beat('tf.rate')
        self.topics += transform_topics(
            simulation, self.suites, rows, beat, self.stamp.view,
            settings['tf.root'], settings['tf.links'],
        )  # fmt: skip
        described = descriptions(simulation, self.suites)
        self.topics += [description_topic(*each, beat.period) for each in described.items()]
        self.notes = tuple(line for each in described.values() for line in each.notes)
        self._add('/clock', CLOCK, 'clock.rate', {}, {}, quality=NEWEST)
        if self._refused:
            raise ConfigError('; '.join(self._refused.values()))
        self.topics.sort(key=lambda topic: topic.needs_forces)

    def thrusters(self, vehicle: str) -> tuple[str, ...]:
        """
        Return the thrusters of a vehicle, the last entries of its ``joint_states``.

        Parameters
        ----------
        vehicle
            Its name.

        Returns
        -------
        tuple
            Names, in the order of commands.

        """
        return self._simulation.vehicle(vehicle).thrusters

    def restart(self) -> None:
        """Forget every sensor's readings: the simulation was reset."""
        for suite in self.suites.values():
            suite.reset()

    def take_state(self) -> None:
        """Take the present state as the one that ``data`` speaks of."""
        self._simulation.observe(forces=False)
        self.stamp.set(self._simulation.time_ns)
        self._forces_known = False

    def data(self, topic: StateTopic) -> bytes:
        """
        Return a topic's message at the state of the last ``take_state``.

        Forces are evaluated for the first topic that needs them: what was asked for before can be
        on its way already.

        Parameters
        ----------
        topic
            One of ``topics``.

        Returns
        -------
        bytes
            The message (CDR); empty where none is due, or a sensor has no new reading.

        """
        if not self._due(topic):
            return b''
        if topic.needs_forces and not self._forces_known:
            self._simulation.observe(forces=True)
            self._forces_known = True
        return topic.data()

    def ready(self, topic: StateTopic) -> bool:
        """
        Make the numbers of a topic's message; for who has observed the state as it needs it.

        Parameters
        ----------
        topic
            One of ``topics``.

        Returns
        -------
        bool
            Whether there is a message.

        """
        return self._due(topic) and topic.ready()

    def _due(self, topic: StateTopic) -> bool:
        return topic.uneven is None or topic.uneven.due(self._simulation.tick)

    def _add_vehicle(self, vehicle: Vehicle, row: Array) -> None:
        name, settings = vehicle.name, self._settings
        place = _pose(row)
        self._add(
            f'{name}/odom', ODOMETRY, 'odom.rate',
            {
                'header.frame_id': f'{name}/odom',
                'child_frame_id': f'{name}/base_link',
                'pose.covariance': np.diag(settings['odom.pose_covariance']).ravel(),
                'twist.covariance': np.diag(settings['odom.twist_covariance']).ravel(),
            },
            {
                'pose.pose.position': place[0],
                'pose.pose.orientation': place[1],
                'twist.twist': row[nat.LINEAR_VELOCITY.start : nat.ANGULAR_VELOCITY.stop],
            },
        )  # fmt: skip
        columns = {'total': nat.TOTAL, 'thrust': nat.THRUST}
        columns |= {term: nat.term_columns(term) for term in nat.TERMS}
        for term, places in columns.items():
            self._add(
                f'{name}/wrench/{term}', WRENCH, 'wrench.rate',
                {'header.frame_id': f'{name}/base_link'}, {'wrench': row[places]},
                needs_forces=True,
            )  # fmt: skip
        # of the fluid that the base_link origin is in, where a scene has two
        for stream in self._simulation.streams:
            self._add(
                f'{name}/medium/{stream}', TWIST, 'medium.rate',
                {'header.frame_id': 'map'}, {'twist.linear': row[nat.MEDIUM_VELOCITY]},
            )  # fmt: skip
        self._add_joint_states(vehicle)
        # for eyes: a whole number of steps, at most at the rate
        steps = 1.0 / (settings['markers.rate'] * self._simulation.timestep)
        period = max(1, math.ceil(steps * (1.0 - 1e-9)))
        self.topics.append(MarkerTopic(self._simulation, vehicle, row, self.stamp.view, period))
        self.topics += sensor_topics(self._simulation, self.suites[name], name)

    def _add_joint_states(self, vehicle: Vehicle) -> None:
        joints = JointNumbers(self._simulation, vehicle)
        if joints.names:
            rows = dict(zip(('position', 'velocity', 'effort'), joints.numbers, strict=True))
            self._add(
                f'{vehicle.name}/joint_states', JOINT_STATE, 'joint_states.rate',
                {'name': joints.names, **rows}, rows, needs_forces=True, prepare=joints.prepare,
                numbers=joints.made(),
            )  # fmt: skip

    def _add(
        self,
        name: str,
        message: str,
        rate: str,
        constants: Mapping[str, Any],
        sources: Mapping[str, Source],
        needs_forces: bool = False,
        prepare: Callable[[], None] | None = None,
        quality: Quality = STATE,
        numbers: Sequence[MadeNumber] = (),
    ) -> None:
        """Add a topic: what stays in its message, and the arrays that each member follows."""
        beat = self._beat(rate)
        template = Template.of(message, constants, list(sources))
        copies = [(place, self.stamp.view) for place in template.stamps]
        copies += template.copies(list(sources.values()))
        self.topics.append(
            StateTopic(
                name, message, template, beat.period, copies, needs_forces, prepare, quality,
                uneven=None if beat.whole else beat, numbers=numbers,
            )
        )  # fmt: skip

    def _beat(self, rate: str) -> Beat:
        """Return the beat of a rate; what is refused is kept, to name all in one line."""
        try:
            return Beat.at_rate(
                self._settings[rate], self._simulation.timestep, f"parameter '{rate}'"
            )
        except ConfigError as error:
            self._refused.setdefault(rate, str(error))
            return _EVERY_STEP


def _pose(row: Array) -> tuple[Array, tuple[Array, Array]]:
    """Return a row's position and orientation: wxyz inside, xyzw in messages."""
    quat_wxyz = row[nat.QUATERNION]
    return row[nat.POSITION], (quat_wxyz[1:], quat_wxyz[:1])
