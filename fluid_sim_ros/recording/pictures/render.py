# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A log as a film: MuJoCo's renderer on the recorded poses, with force arrows."""

from collections.abc import Callable, Generator
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError, listed
from fluid_sim_ros.output.new_file import new_file
from fluid_sim_ros.output.term_colors import rgb, term_color
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins.drawn_arrow import add_arrow, extent
from fluid_sim_ros.plugins.renderer import bound_buffers, new_renderer
from fluid_sim_ros.recording.damage import LogError, reading
from fluid_sim_ros.recording.log import Log
from fluid_sim_ros.recording.pictures.caption import captioned, pixels_per_metre
from fluid_sim_ros.recording.pictures.film_file import KINDS, Picture, film_file
from fluid_sim_ros.recording.pictures.poses import LogPoses, latest
from fluid_sim_ros.recording.pictures.scenery import Scenery
from fluid_sim_ros.recording.pictures.tracks import Track
from fluid_sim_ros.scene.vehicle import weight_in_air
from fluid_sim_ros.schema.limits import check_limit

#: Fluid forces are drawn longer by so much where there is no buoyancy: they are small in air.
_IN_AIR = 5.0
#: Arrows start this far from each other, so that none hides another [extents].
_BESIDE = 0.12
#: Arrows shorter than this have no name beside them [extents].
_NAMED = 0.12
#: Forces below this share of the weight are not drawn.
_LEAST = 2e-3
#: A force equal to the weight is drawn this long, in extents of the vehicle.
_LENGTH = 1.0
_WIDTH = 0.04
#: Of the camera that follows: azimuth and elevation [deg], and distance [extents].
_VIEWPOINT = (120.0, -20.0, 4.0)
#: Most pixels of a side of the shadow map, of 4 bytes each, and most samples of a pixel. MuJoCo's
#: own are 4096, which is 64 MiB, and 4.
_SHADOWS, _SAMPLES = 2048, 4


@dataclass(frozen=True)
class FilmOptions:
    """
    How to render.

    Attributes
    ----------
    width, height
        [pixels].
    rate, speed
        Pictures per second of the film, and simulated seconds per second of it.
    vehicle, camera
        That is followed, and a camera of the model; empty: chosen.
    at
        Simulated time of a still [s]; None: the end.
    viewpoint
        Of a camera that follows: azimuth and elevation [deg], and distance in sizes of the
        vehicle; None: the model's own camera, or one of ours.

    """

    width: int = 640
    height: int = 480
    rate: float = 30.0
    speed: float = 1.0
    vehicle: str = ''
    camera: str = ''
    at: float | None = None
    viewpoint: tuple[float, float, float] | None = None

    def __post_init__(self) -> None:
        if not (self.rate > 0 and self.speed > 0 and self.width > 0 and self.height > 0):
            raise ConfigError('render: size, frames per second and speed must be above 0')
        if self.viewpoint is not None and self.camera:
            raise ConfigError('render: --from and --camera: give one of them')
        if self.viewpoint is not None and not self.viewpoint[2] > 0:
            raise ConfigError('render: --from: the distance must be above 0')


def render(log: Log, out: Path, options: FilmOptions, progress: Callable[[float], None]) -> int:
    """
    Render a log to .mp4, .gif, or its last picture to .png.

    Parameters
    ----------
    log, out, options
        What, where to, and how.
    progress
        Called with the share that is done.

    Returns
    -------
    int
        Number of pictures.

    Raises
    ------
    ConfigError, LogError
        For another kind of file, or a log without odometry; a ``MachineError`` where nothing can
        be drawn, or written.

    """
    if out.suffix not in KINDS:
        raise ConfigError(f"render: '{out.suffix}' is not known; allowed: {listed(KINDS)}")
    count = 0
    with new_file(out) as temporary, closing(_drawn(log, options, out.suffix == '.png')) as drawn:
        file = film_file(temporary, options.width, options.height, options.rate)
        try:
            for share, picture in drawn:
                file.add(picture)
                progress(share)
                count += 1
        finally:
            file.close()
    return count


def _drawn(
    log: Log, options: FilmOptions, still: bool
) -> Generator[tuple[float, Picture], None, None]:
    """Yield the pictures, each with the share that is done."""
    with reading(log.path):
        stage = _Stage(log, options)
        try:
            times = stage.frame_times()
            if still:
                times = times[-1:] if options.at is None else stage.time_of_still(options.at)
            for number, time in enumerate(times, 1):
                yield number / len(times), stage.picture(time)
        finally:
            stage.close()


class _Stage:
    """The model, posed as the log has it."""

    def __init__(self, log: Log, options: FilmOptions) -> None:
        self._options = options
        self._poses = LogPoses(log)
        self._simulation = self._poses.simulation
        self._data = self._simulation.data
        self._model = model = self._simulation.model
        width, height = options.width, options.height
        bound_buffers(model, width, height, shadows=_SHADOWS, samples=_SAMPLES)
        self._tracks = self._poses.tracks
        name = self._poses.check_vehicle(options.vehicle, log.path)
        self._name, self._followed = name, self._simulation.vehicles[name].body_id
        self._extent = extent(model, self._followed)
        self._camera = self._choose_camera()
        self._scenery = Scenery(model, self._data, self._extent)
        self._renderer = new_renderer(model, width, height)

    def frame_times(self) -> Array:
        """Return the simulated times of the pictures [s]."""
        times = self._poses.times
        step = self._options.speed / self._options.rate
        if not times[-1] >= times[0]:
            raise LogError('the times of its odometry do not rise')
        check_limit('film_pictures', (times[-1] - times[0]) / step, 'pictures of the film')
        return np.arange(times[0], times[-1] + step / 2, step)

    def time_of_still(self, time: float) -> Array:
        """Return the time of a still [s], which must be one of the log's."""
        times = self._poses.times
        if not times[0] <= time <= times[-1]:
            raise ConfigError(
                f'render: {time:g} s is not in the log, which has {times[0]:g} to {times[-1]:g} s'
            )
        return np.array([time])

    def picture(self, time: float) -> Picture:
        """Return the picture at a simulated time [s]."""
        self._data.qpos[:] = self._poses.qpos(time)
        self._data.time = time
        mujoco.mj_kinematics(self._model, self._data)
        mujoco.mj_comPos(self._model, self._data)
        mujoco.mj_camlight(self._model, self._data)
        self._renderer.update_scene(self._data, self._camera)
        for name, track in self._tracks.items():
            self._add_arrows(name, track, time)
        center = self._data.xpos[self._followed]
        self._scenery.dress(self._renderer.scene, center)
        scale = pixels_per_metre(self._model, self._renderer.scene, center, self._options.height)
        track = self._tracks[self._name]
        speed = float(np.linalg.norm(track.velocity_b[latest(track.times, time)]))
        words = f't = {time:.1f} s   {speed:.2f} m/s'
        picture: Picture = captioned(self._renderer.render(), words, scale)
        return picture

    def close(self) -> None:
        self._renderer.close()

    def _choose_camera(self) -> Any:
        """Return the camera asked for, the model's own that tracks the vehicle, or one of ours."""
        model = self._model
        names = [model.camera(i).name for i in range(model.ncam)]
        if self._options.camera:
            if self._options.camera not in names:
                raise ConfigError(
                    f"render: camera '{self._options.camera}' is not in the model; it has: "
                    f'{", ".join(names) or "(none)"}'
                )
            return self._options.camera
        for i in range(model.ncam if self._options.viewpoint is None else 0):
            tracking = (
                mujoco.mjtCamLight.mjCAMLIGHT_TRACK,
                mujoco.mjtCamLight.mjCAMLIGHT_TRACKCOM,
            )
            if model.cam_mode[i] in tracking and model.cam_bodyid[i] == self._followed:
                return names[i] or i
        camera = mujoco.MjvCamera()
        camera.type = mujoco.mjtCamera.mjCAMERA_TRACKING
        camera.trackbodyid = self._followed
        camera.azimuth, camera.elevation, distance = self._options.viewpoint or _VIEWPOINT
        camera.distance = distance * self._extent
        return camera

    def _add_arrows(self, name: str, track: Track, time: float) -> None:
        """Add an arrow, with its name and size, for each force that is worth one."""
        body = self._simulation.vehicles[name].body_id
        weight = weight_in_air(self._model, body)
        forces_b = {
            term: rows[latest(rows[:, 0], time), 1:4]
            for term, rows in track.wrenches.items() if term != 'total'
        }  # fmt: skip
        sizes = {term: float(np.linalg.norm(force)) for term, force in forces_b.items()}
        shown = sorted(term for term, size in sizes.items() if size > _LEAST * weight)
        scene, rotation = self._renderer.scene, self._data.xmat[body].reshape(3, 3)
        across = np.cross(scene.camera[0].forward, scene.camera[0].up)
        for number, term in enumerate(shown):
            longer = 1.0 if term == 'thrust' or 'buoyancy' in shown else _IN_AIR
            along = rotation @ forces_b[term] / weight * _LENGTH * self._extent * longer
            beside = _BESIDE * self._extent * (number - (len(shown) - 1) / 2)
            words = f'{term.replace("_", " ")} {sizes[term]:.3g} N'
            if longer != 1.0:
                words = f'{words} (drawn {longer:g} x)'
            if np.linalg.norm(along) < _NAMED * self._extent:
                words = ''  # names of small forces would cover each other
            colour = np.array([*(part / 255 for part in rgb(term_color(term))), 1.0])
            add_arrow(
                scene, self._data.xpos[body] + across * beside, along, _WIDTH * self._extent,
                colour, words,
            )  # fmt: skip
