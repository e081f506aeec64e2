# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Services on the entities of a simulation: which there are, their states, and setting them."""

import re
from typing import Any

from fluid_sim_ros.errors import CommandError
from fluid_sim_ros.ros.session import Session
from fluid_sim_ros.ros.standard.answers import Services, UnsupportedError
from fluid_sim_ros.simulation.entities import Entities, EntityState

_FRAMES = ('', 'world', 'map')


class EntityServices(Services):
    """Vehicles and other bodies that move freely."""

    def get_entities(self, request: Any, response: Any) -> None:
        """
        List the vehicles and the other bodies that move freely.

        Parameters
        ----------
        request, response
            Of the service.

        """
        response.entities = self._chosen(request.filters)

    def get_entities_states(self, request: Any, response: Any) -> None:
        """
        List them with their states.

        Parameters
        ----------
        request, response
            Of the service.

        """
        response.entities = self._chosen(request.filters)
        for name in response.entities:
            response.states.append(self._messages.EntityState())
            self._fill(response.states[-1], name)

    def get_entity_state(self, request: Any, response: Any) -> None:
        """
        Tell the state of one, in the frame map.

        Parameters
        ----------
        request, response
            Of the service.

        """
        self._fill(response.state, request.entity)

    def set_entity_state(self, request: Any, response: Any) -> None:
        """
        Set pose and twist of one, given in the frame map.

        Parameters
        ----------
        request, response
            Of the service.

        """
        frame = request.state.header.frame_id
        if frame not in _FRAMES:
            raise UnsupportedError(f"frame '{frame}': states are set in the frame map alone")
        place, turn = request.state.pose.position, request.state.pose.orientation
        linear, angular = request.state.twist.linear, request.state.twist.angular
        pose = [place.x, place.y, place.z, turn.w, turn.x, turn.y, turn.z]
        twist = [linear.x, linear.y, linear.z, angular.x, angular.y, angular.z]
        # versions before 2 have no flags, and set both
        changes = {
            'pose': pose if getattr(request, 'set_pose', True) else None,
            'twist': twist if getattr(request, 'set_twist', True) else None,
        }
        self._on_session(lambda session: _place(session, request.entity, **changes))

    def _chosen(self, filters: Any) -> list[str]:
        """Return the names that a filter chooses, in the order of the scene."""
        tags, bounds = getattr(filters, 'tags', None), getattr(filters, 'bounds', None)
        for what, given in (
            ('categories', filters.categories if hasattr(filters, 'categories') else ()),
            ('tags', tags.tags if tags is not None else ()),
            ('bounds', bounds.points if bounds is not None else ()),
        ):
            if len(given):
                raise UnsupportedError(f'filters.{what}: entities are chosen by name alone')
        names: list[str] = []

        def look(session: Session) -> str:
            names.extend(Entities(session.simulation).names)
            return ''

        self._on_session(look)
        try:
            pattern = re.compile(filters.filter)
        except re.error as error:
            raise CommandError(f'filters.filter: no regular expression: {error}') from None
        return [name for name in names if pattern.search(name)]

    def _fill(self, message: Any, name: str) -> None:
        """Fill an EntityState."""
        found: list[tuple[EntityState, int]] = []

        def look(session: Session) -> str:
            simulation = session.simulation
            found.append((Entities(simulation).state(name), simulation.time_ns))
            return ''

        self._on_session(look)
        (state, time_ns), header = found[0], message.header
        header.frame_id = 'map'
        header.stamp.sec, header.stamp.nanosec = divmod(time_ns, 10**9)
        turn, (w, x, y, z) = message.pose.orientation, state.quat_wb_wxyz.tolist()
        turn.w, turn.x, turn.y, turn.z = w, x, y, z
        for vector, numbers in (
            (message.pose.position, state.position_w),
            (message.twist.linear, state.velocity_w),
            (message.twist.angular, state.omega_w),
        ):
            vector.x, vector.y, vector.z = numbers.tolist()


def _place(
    session: Session, entity: str, pose: list[float] | None, twist: list[float] | None
) -> str:
    """Set pose and twist of an entity; the log holds it, so that the flight can be repeated."""
    session.check_alive()
    Entities(session.simulation).place(entity, pose, twist)
    if session.tap is not None:
        session.tap.event(place={'entity': entity, 'pose': pose, 'twist': twist})
    if session.runner.paused or session.runner.stopped:
        session.outputs.repeat(session.simulation)
    return ''
