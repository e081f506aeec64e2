# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The scene of the page: vehicles, ground, water, force arrows, flow, trail, camera."""

from collections import deque
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import mujoco
import numpy as np
import viser

from fluid_sim_ros.output.term_colors import rgb, term_color
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.view.drawn_geoms import colors, welded
from fluid_sim_ros.view.frame import Frame
from fluid_sim_ros.view.stage import Arrow, Stage
from fluid_sim_ros.view.web.flow import FlowField, show_arrows
from fluid_sim_ros.view.web.looks import Looks
from fluid_sim_ros.view.web.shapes import triangles
from fluid_sim_ros.view.web.surroundings import Surroundings

#: A trail has this many points, this far apart [extents].
_TRAIL, _APART = 500, 0.15
#: Arrows of one vehicle start this far from each other [extents], so that none hides another.
_BESIDE = 0.1
#: Opacity of another flight beside the one that is shown.
_PALE = 0.3
#: Terms whose arrows keep the scale of the weight.
_NOT_FLUID = ('thrust', 'weight')
#: Seen from the camera that follows: back, left and up [extents].
_VIEW = np.array([-3.2, 2.6, 1.5])


class Scene:
    """
    Draws frames into viser's scene.

    Parameters
    ----------
    server
        Whose scene is drawn into; cleared first.
    stage
        Poses the model.
    looks
        What is wanted.

    """

    def __init__(self, server: viser.ViserServer, stage: Stage, looks: Looks) -> None:
        self._server, self._stage, self._looks = server, stage, looks
        self._api = server.scene
        self._api.reset()
        self._api.set_up_direction('+z')
        self._world = self._api.add_frame('/world', show_axes=False)
        mujoco.mj_forward(stage.model, stage.data)
        none = np.zeros((1, 2, 3))
        extent = self._extent = stage.extents[looks.vehicle]
        self._around = Surroundings(server, stage, extent)
        self._bodies = self._add_bodies('body', 1.0)
        self._ghosts: dict[int, Any] = {}
        self._arrows = self._api.add_arrows(
            '/world/forces', none, (0, 0, 0), shaft_radius=0.025 * extent,
            head_radius=0.07 * extent, head_length=0.16 * extent, visible=False,
        )  # fmt: skip
        self._flow = FlowField(server, stage, looks)
        self._labels: dict[str, Any] = {}
        self._trail = self._api.add_line_segments(
            '/world/trail', none, (230, 80, 60), thickness=2.0, thickness_units='screen'
        )
        self._passed: deque[Array] = deque(maxlen=_TRAIL)
        self._trail_of, self._trail_time = '', 0.0
        self._set_camera()

    def draw(self, frame: Frame) -> None:
        """
        Draw a frame, which the stage was posed to.

        Parameters
        ----------
        frame
            To draw.

        """
        looks, stage = self._looks, self._stage
        data = stage.data
        base = stage.vehicles[looks.vehicle].body_id
        place = data.xpos[base].copy()
        with self._server.atomic():
            self._move_world(base, place)
            for body, handle in self._bodies.items():
                handle.position, handle.wxyz = data.xpos[body], data.xquat[body]
            self._draw_ghost(frame)
            self._draw_forces(frame, place)
            self._flow.draw(frame, place)
            self._draw_trail(frame, place)
            self._around.draw(place, self._eye(place))

    # ---- what stands still -----------------------------------------------------------------

    def _add_bodies(self, kind: str, opacity: float) -> dict[int, Any]:
        """Add the bodies; those that stand still only where nothing of it is see-through."""
        model, data, handles = self._stage.model, self._stage.data, {}
        for root, geoms in welded(model).items():
            if root == 0 and opacity < 1.0:
                continue
            parts = [
                (color, found)
                for color, ids in colors(model, geoms).items()
                # see-through scenery stands for the water, which is drawn here as it moves
                if not (root == 0 and color[3] < 1.0 and self._around.has_surface)
                and (found := triangles(model, data, root, ids)) is not None
            ]
            if not parts:
                continue
            name = f'/world/{kind}_{root}'
            handle = self._api.add_frame(name, show_axes=False)
            handle.position, handle.wxyz = data.xpos[root], data.xquat[root]
            for number, (color, (vertices, faces)) in enumerate(parts):
                self._api.add_mesh_simple(
                    f'{name}/part_{number}', vertices, faces, color=color[:3],
                    opacity=None if color[3] * opacity > 0.99 else color[3] * opacity,
                )  # fmt: skip
            if root != 0:
                handles[root] = handle
        return handles

    def _set_camera(self) -> None:
        camera = self._server.initial_camera
        places = [self._stage.data.xpos[v.body_id] for v in self._stage.vehicles.values()]
        base = self._stage.vehicles[self._looks.vehicle].body_id
        spread = max(float(np.linalg.norm(p - self._stage.data.xpos[base])) for p in places)
        reach = max(self._extent, 0.35 * min(spread, 20.0 * self._extent))
        camera.position = tuple(_VIEW * reach)
        camera.look_at = (0.0, 0.0, 0.0)
        camera.near, camera.far = 0.02 * self._extent, 2000.0

    # ---- what moves ------------------------------------------------------------------------

    def _move_world(self, base: int, place: Array) -> None:
        """Move the world against the vehicle: every browser keeps its own angle of view."""
        if self._looks.camera == 'free':
            self._world.position, self._world.wxyz = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)
        elif self._looks.camera == 'follow':
            self._world.position, self._world.wxyz = -place, (1.0, 0.0, 0.0, 0.0)
        else:
            inverse, moved = np.zeros(4), np.zeros(3)
            mujoco.mju_negQuat(inverse, self._stage.data.xquat[base])
            mujoco.mju_rotVecQuat(moved, -place, inverse)
            self._world.position, self._world.wxyz = moved, inverse

    def _draw_ghost(self, frame: Frame) -> None:
        if frame.ghost is None:
            return
        self._ghosts = self._ghosts or self._add_bodies('ghost', _PALE)
        ghost = self._stage.ghost
        for body, handle in self._ghosts.items():
            handle.position, handle.wxyz = ghost.xpos[body], ghost.xquat[body]

    def _eye(self, place: Array) -> Array:
        """Return where the first browser's camera is in the world [m]."""
        for client in self._server.get_clients().values():
            inverse, seen = np.zeros(4), np.zeros(3)
            mujoco.mju_negQuat(inverse, np.asarray(self._world.wxyz, dtype=float))
            offset = client.camera.position - np.asarray(self._world.position)
            mujoco.mju_rotVecQuat(seen, offset, inverse)
            return seen
        return place

    def _draw_forces(self, frame: Frame, place: Array) -> None:
        looks, arrows, tips = self._looks, [], []
        for name in self._stage.vehicles:
            found = [
                arrow if arrow.term in _NOT_FLUID
                else replace(arrow, along=arrow.along * looks.fluid_scale)
                for arrow in self._stage.arrows(frame, name, sorted(looks.terms), looks.scale)
            ]  # fmt: skip
            each = []
            if 'thrust' in looks.terms and looks.each_thruster:
                each = self._stage.thrusters(frame, name, looks.scale)
                if each:
                    found = [arrow for arrow in found if arrow.term != 'thrust']
            found = self._side_by_side(found)
            arrows += [*found, *each]
            if name == looks.vehicle:
                tips = [*found, *self._named(each)]
        # from the vehicle: a browser that is late with new arrows still has them there
        self._arrows.position = place
        show_arrows(
            self._arrows,
            [np.stack([a.start, a.start + a.along]) - place for a in arrows],
            [rgb(term_color(arrow.term)) for arrow in arrows],
        )
        self._draw_labels(tips)

    def _side_by_side(self, arrows: Sequence[Arrow]) -> list[Arrow]:
        """Return arrows that start beside each other, across the line of sight."""
        across = np.array([_VIEW[1], -_VIEW[0], 0.0]) / np.hypot(_VIEW[0], _VIEW[1])
        step = _BESIDE * self._extent
        return [
            replace(arrow, start=arrow.start + across * step * (i - (len(arrows) - 1) / 2))
            for i, arrow in enumerate(arrows)
        ]

    @staticmethod
    def _named(thrusters: Sequence[Arrow]) -> list[Arrow]:
        """Return one arrow to write the sum of all thrusts at."""
        if not thrusters:
            return []
        largest = max(thrusters, key=lambda arrow: arrow.newtons)
        whole = sum(arrow.newtons for arrow in thrusters)
        return [Arrow('thrust', largest.start, largest.along, whole)]

    def _draw_labels(self, tips: Sequence[Arrow]) -> None:
        shown = {arrow.term: arrow for arrow in tips} if self._looks.labels else {}
        for term in {*shown, *self._labels}:
            if term not in self._labels:
                self._labels[term] = self._api.add_label(
                    f'/world/label_{term}', term, anchor='bottom-center', font_screen_scale=0.9
                )
            label, arrow = self._labels[term], shown.get(term)
            label.visible = arrow is not None
            if arrow is not None:
                label.position = arrow.start + 1.06 * arrow.along
                longer = '' if term in _NOT_FLUID else self._longer()
                label.text = f'{term.replace("_", " ")} {_newtons(arrow.newtons)}{longer}'

    def _longer(self) -> str:
        scale = self._looks.fluid_scale
        return f' (drawn {scale:g} x)' if scale != 1.0 else ''

    def _draw_trail(self, frame: Frame, place: Array) -> None:
        passed = self._passed
        if self._trail_of != self._looks.vehicle or frame.time < self._trail_time:
            passed.clear()
        self._trail_of, self._trail_time = self._looks.vehicle, frame.time
        self._trail.visible = self._looks.trail and len(passed) > 1
        if passed and np.linalg.norm(place - passed[-1]) < _APART * self._extent:
            return
        passed.append(place)
        if len(passed) > 1:
            line = np.asarray(passed, dtype=np.float32)
            self._trail.points = np.stack([line[:-1], line[1:]], axis=1)


def _newtons(force: float) -> str:
    return f'{force:.0f} N' if force >= 100.0 else f'{force:.3g} N'
