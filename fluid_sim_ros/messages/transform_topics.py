# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The frames of every vehicle as transforms: what moves on ``/tf``, what stays on ``/tf_static``.

The tree is that of REP-105, with each vehicle's name before its frames: ``map``, ``<v>/odom``,
``<v>/base_link``, then its links and sensors. The simulator knows where a vehicle is, so that the
odometry does not drift, and ``map`` and ``<v>/odom`` are the same.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np

from fluid_sim_ros.messages.templates import Source, Template
from fluid_sim_ros.messages.topic import LATCHED, StateTopic
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.scene.robot.links import BASE_LINK, ODOM, Link, link_pose, vehicle_links
from fluid_sim_ros.scene.robot.urdf import Frame
from fluid_sim_ros.scene.vehicle import Vehicle
from fluid_sim_ros.sensors import SensorSuite
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import Beat

TRANSFORMS = 'tf2_msgs/msg/TFMessage'
#: Frames that the tree of transforms may begin with.
MAP = 'map'
ROOTS = (MAP, ODOM, BASE_LINK)


def transform_topics(
    simulation: Simulation,
    suites: Mapping[str, SensorSuite],
    rows: Array,
    beat: Beat,
    stamp: memoryview,
    root: str,
    links: bool = True,
) -> list[StateTopic]:
    """
    Return ``/tf`` and ``/tf_static``, each where it has transforms.

    Parameters
    ----------
    simulation
        Whose vehicles.
    suites
        The sensors of each vehicle.
    rows
        Of ``Simulation.observe``, one per vehicle.
    beat
        When ``/tf`` is due.
    stamp
        View of the present stamp.
    root
        Where the tree begins: one of ``ROOTS``. ``odom`` leaves ``map`` to a node that localises,
        ``base_link`` leaves ``<v>/odom`` to one that estimates, too.
    links
        Whether what is below ``base_link`` is there; a robot_state_publisher has it, too.

    Returns
    -------
    list of StateTopic
        ``/tf_static`` first.

    """
    fixed: list[dict[str, Any]] = []
    moving: list[dict[str, Any]] = []
    sources: dict[str, Source] = {}
    joints: list[tuple[Link, Array]] = []
    model = simulation.model

    def follow(pose: Array) -> None:
        """Let the transform that was added last follow a pose: position, then quaternion wxyz."""
        place = f'transforms[{len(moving) - 1}].transform'
        sources[f'{place}.translation'] = pose[:3]
        sources[f'{place}.rotation'] = (pose[4:7], pose[3:4])

    for (name, vehicle), row in zip(simulation.vehicles.items(), rows, strict=True):
        if root == MAP:
            fixed.append(_transform(MAP, f'{name}/{ODOM}'))
        if root != BASE_LINK:
            moving.append(_transform(f'{name}/{ODOM}', f'{name}/{BASE_LINK}'))
            follow(row[nat.POSITION.start : nat.QUATERNION.stop])
        frames_b = sensor_frames(vehicle, suites[name])
        found = vehicle_links(model, vehicle, [frame.name for frame in frames_b])
        if not links:
            continue
        for link in found[1:]:
            frames = (f'{name}/{link.parent}', f'{name}/{link.name}')
            if link.joint_id < 0:
                fixed.append(_transform(*frames, link.position_p, link.quat_pl_wxyz))
                continue
            moving.append(_transform(*frames))
            joints.append((link, np.zeros(7)))
            follow(joints[-1][1])
        for frame in frames_b:
            frames = (f'{name}/{BASE_LINK}', f'{name}/{frame.name}')
            fixed.append(_transform(*frames, frame.position_b, frame.quat_bf_wxyz))

    def prepare() -> None:
        qpos = simulation.data.qpos  # `observed` is of the last state with forces
        for link, pose in joints:
            pose[:3], pose[3:] = link_pose(model, link, qpos)

    topics: list[StateTopic] = []
    if fixed:
        template = Template.of(TRANSFORMS, {'transforms': fixed})
        topics.append(
            StateTopic(
                '/tf_static', TRANSFORMS, template, beat.period, [], quality=LATCHED, once=True
            )
        )
    if moving:
        template = Template.of(TRANSFORMS, {'transforms': moving}, list(sources))
        copies = [(place, stamp) for place in template.stamps]
        copies += template.copies(list(sources.values()))
        uneven = None if beat.whole else beat
        topics.append(
            StateTopic(
                '/tf', TRANSFORMS, template, beat.period, copies,
                prepare=prepare if joints else None, uneven=uneven,
            )
        )  # fmt: skip
    return topics


def sensor_frames(vehicle: Vehicle, suite: SensorSuite) -> list[Frame]:
    """
    Return the frames of a vehicle's sensors.

    Parameters
    ----------
    vehicle, suite
        The vehicle and its sensors.

    Returns
    -------
    list of Frame
        On base_link.

    """
    return [
        Frame(
            sensor.frame.removeprefix(f'{vehicle.name}/'),
            sensor.mount.position_b,
            sensor.frame_quat_bs,
        )
        for sensor in suite.sensors
    ]


def _transform(
    parent: str, child: str, place: Array | None = None, turn: Array | None = None
) -> dict[str, Any]:
    """Return a geometry_msgs/TransformStamped; without more, both frames are the same."""
    made: dict[str, Any] = {'header.frame_id': parent, 'child_frame_id': child}
    if place is not None and turn is not None:
        made['transform.translation'] = dict(zip('xyz', place, strict=True))
        made['transform.rotation'] = dict(zip('wxyz', turn, strict=True))
    return made
