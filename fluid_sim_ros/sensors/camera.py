# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A camera: pictures and distances of what it sees, drawn only when somebody wants them."""

import math
import time
from typing import Any

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins.drawn_arrow import extent
from fluid_sim_ros.plugins.drawn_waves import add_waves
from fluid_sim_ros.plugins.offscreen import Offscreen, Pinhole
from fluid_sim_ros.schema.sensors import CameraFile
from fluid_sim_ros.sensors.mount import Carrier
from fluid_sim_ros.sensors.reading import CAMERA_INFO, IMAGE, Quantity, Reading
from fluid_sim_ros.sensors.sensor import Sensor

#: The turn from optical axes (z ahead, x right, y down; REP-103) to x ahead, y left, z up.
_OPTICAL = np.array([0.5, -0.5, 0.5, -0.5])
_COLOR = (
    Reading('camera/image_raw', IMAGE, (Quantity('color', '', ()),)),
    Reading('camera/camera_info', CAMERA_INFO, ()),
)
_DEPTH = (
    Reading('camera/depth/image_raw', IMAGE, (Quantity('depth', 'm', ()),)),
    Reading('camera/depth/camera_info', CAMERA_INFO, ()),
)
#: Drawing is judged after so much wall time [s] and so many pictures, and is worth a word from
#: this share on.
_JUDGED_AFTER, _JUDGED_FROM, _SHARE = 3.0, 10, 0.2


class Camera(Sensor, file=CameraFile):
    """
    Pictures of a pinhole camera.

    What it keeps of each reading is where everything was, so that a picture is drawn only when a
    message is made of it, and a reading without one costs a copy of the positions. Drawing works
    on a copy of the model: it never changes what the simulation does.

    Parameters
    ----------
    carrier, config
        See ``Sensor``.

    Attributes
    ----------
    pinhole
        Its geometry.
    color
        Red, green and blue, row by row from the top left, shape (3 width height,).
    depth
        Distances along its axis [m], row by row, shape (width height,), float32; +inf beyond the
        range of depths, -inf nearer than it (REP-117). Water is looked through.
    pictures, drawing_s
        How many were drawn after the first of each kind, and the wall time of them [s].

    """

    config: CameraFile

    def __init__(self, carrier: Carrier, config: CameraFile) -> None:
        super().__init__(carrier, config)
        simulation, vehicle = carrier.simulation, carrier.vehicle
        self.frame = f'{vehicle.name}/{config.frame}'
        mujoco.mju_mulQuat(self.frame_quat_bs, self.mount.quat_bs_wxyz, _OPTICAL)
        self.readings = _COLOR * config.color + _DEPTH * config.depth
        width, height = config.width, config.height
        focal = width / 2 / math.tan(math.radians(config.field_of_view) / 2)
        self.pinhole = Pinhole(width, height, focal)
        self.color = np.zeros(3 * width * height * config.color, dtype=np.uint8)
        self.depth = np.zeros(width * height * config.depth, dtype=np.float32)
        # a reading is the state that is seen: time, positions, and what was moved from outside
        data = simulation.data
        self._parts = (data.qpos, data.mocap_pos.reshape(-1), data.mocap_quat.reshape(-1))
        size = 1 + sum(part.size for part in self._parts)
        self.values = np.zeros(size)
        self._rows = np.zeros((len(self._rows), size))
        self._base = vehicle.body_id
        self._axes_b = self.mount.to_base(np.array([[1.0, 0, 0], [0, 0, 1.0]]))
        self._wave_size = extent(simulation.model, vehicle.body_id)
        self._seen: mujoco.MjData | None = None
        self._posed = False
        self._drawn: set[str] = set()
        self._offscreen: dict[str, Offscreen] = {}
        self._without = ''
        self.pictures, self.drawing_s, self._begun = 0, 0.0, math.inf

    def constants(self, reading: Reading) -> dict[str, Any]:
        """
        Return what stays in a message.

        Parameters
        ----------
        reading
            Its topic.

        Returns
        -------
        dict
            Size and encoding of a picture, or the model of the pinhole as sensor_msgs/CameraInfo
            has it: pixels are counted from the middle of the first one, and nothing is distorted.

        """
        width, height, focal = self.config.width, self.config.height, self.pinhole.focal
        size: dict[str, Any] = {'width': width, 'height': height}
        if reading.message == IMAGE:
            encoding, each = ('rgb8', 3) if reading in _COLOR else ('32FC1', 4)
            data = bytes(each * width * height)
            return {**size, 'encoding': encoding, 'step': each * width, 'data': data}
        x, y = (width - 1) / 2, (height - 1) / 2
        return {
            **size, 'distortion_model': 'plumb_bob', 'd': [0.0] * 5,
            'k': [focal, 0, x, 0, focal, y, 0, 0, 1], 'r': [1, 0, 0, 0, 1, 0, 0, 0, 1],
            'p': [focal, 0, x, 0, 0, focal, y, 0, 0, 0, 1, 0],
        }  # fmt: skip

    def prepare(self, reading: Reading) -> bool:
        """
        Draw the picture of a topic, where it shows one and it has not been drawn.

        Parameters
        ----------
        reading
            The topic.

        Returns
        -------
        bool
            False where nothing can be drawn: that is said once.

        """
        for quantity in reading.quantities:
            if self._without:
                return False
            if quantity.name in self._drawn:
                continue
            before, first = time.monotonic(), quantity.name not in self._offscreen
            try:
                self._draw(quantity.name)
            except ConfigError as error:
                self._without = str(error)
                self._simulation.warnings.add(f'{self._without}; its topics stay silent')
                return False
            self._drawn.add(quantity.name)
            if not first:  # which prepares what the others use
                self._judge(before)
        return True

    def _draw(self, kind: str) -> None:
        """Draw colours or depths of the present reading."""
        if kind not in self._offscreen:
            try:
                made = Offscreen(self._simulation.model, self.pinhole, kind == 'depth')
            except ConfigError as error:
                raise ConfigError(f'{self.where}: {error}') from None
            self._offscreen[kind] = made
        offscreen, data = self._offscreen[kind], self._posed_data()
        place_w, rotation_wb = data.xpos[self._base], data.xmat[self._base].reshape(3, 3)
        place_w = place_w + rotation_wb @ self.mount.position_b
        scene = offscreen.look(data, place_w, self._axes_b @ rotation_wb.T)
        if kind == 'depth':
            distances = offscreen.picture()
            low, high = self.config.depth_range
            distances[distances > high] = np.inf
            distances[distances < low] = -np.inf
            self.depth[:] = distances.reshape(-1)
        else:
            add_waves(scene, self._simulation.model, data, place_w, self._wave_size)
            self.color[:] = offscreen.picture().reshape(-1)

    def _posed_data(self) -> mujoco.MjData:
        """Return data with everything where the present reading saw it."""
        model = self._simulation.model
        if self._seen is None:
            self._seen = mujoco.MjData(model)
        data = self._seen
        if not self._posed:
            self._posed = True
            data.time, at = self.values[0], 1
            for part in (data.qpos, data.mocap_pos.reshape(-1), data.mocap_quat.reshape(-1)):
                part[:] = self.values[at : at + part.size]
                at += part.size
            mujoco.mj_kinematics(model, data)
            mujoco.mj_comPos(model, data)
            mujoco.mj_camlight(model, data)
            mujoco.mj_flex(model, data)
            mujoco.mj_tendon(model, data)
        return data

    def _judge(self, before: float) -> None:
        """Count a picture, and say so where pictures take much of the run's time."""
        now = time.monotonic()
        self._begun = min(self._begun, before)
        self.pictures += 1
        self.drawing_s += now - before
        passed = now - self._begun
        if (
            passed > _JUDGED_AFTER
            and self.pictures >= _JUDGED_FROM
            and self.drawing_s > _SHARE * passed
        ):
            each = 1e3 * self.drawing_s / self.pictures
            self._simulation.warnings.add(
                f'{self.where}: drawing takes {100 * self.drawing_s / passed:.0f} % of the time, '
                f'{each:.0f} ms a picture; fewer pixels or a lower rate would make the run faster',
                key=f'{self.where}: drawing',
            )

    def _measure(self, values: Array) -> bool:
        values[0] = self._simulation.data.time
        np.concatenate(self._parts, out=values[1:])
        return True

    def _convert(self) -> None:
        self._posed = False
        self._drawn.clear()
