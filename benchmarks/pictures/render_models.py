# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Render a still of each model for the documentation.

Each scene runs for a moment, with its gait if it has one; things that fall or coast are drawn at
several times. Needs EGL (Debian/Ubuntu: libegl1, libgl1-mesa-dri). Run:
``python -m benchmarks.pictures.render_models [--quick] [--out DIR] [--json PATH]``.
"""

import argparse
import json
import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

os.environ.setdefault('MUJOCO_GL', 'egl')

import mujoco
import numpy as np
from PIL import Image

from fluid_sim_ros import Scene, Simulation
from fluid_sim_ros.control.gait import JointWave, travelling_wave, wing_beat
from fluid_sim_ros.recording.pictures.scenery import Scenery
from test.support.paths import DOC

OUT = DOC / 'img'
WIDTH, HEIGHT = 640, 480
#: Colours per picture; keeps each file below 100 kB.
COLORS = 256

Gait = Callable[[float], list[float]]
SWIM: JointWave = travelling_wave(5, amplitude=0.5, frequency=1.0, lag=1.0)
BEAT: JointWave = wing_beat(stroke=1.1, pitch=0.8, frequency=26.0)


@dataclass(frozen=True)
class Shot:
    """
    How to take the picture of a scene.

    Attributes
    ----------
    time
        Simulated time of the picture [s].
    gait
        Vehicle and what drives its joints.
    strobe
        Geom that is drawn at several times: name, interval [s], count; the camera then looks at
        the middle of them from ``distance`` [m] and ``azimuth``, ``elevation`` [deg]; without it
        and with a distance, at the middle of all vehicles.

    """

    time: float
    gait: tuple[str, Gait] | None = None
    strobe: tuple[str, float, int] | None = None
    distance: float = 0.0
    azimuth: float = 90.0
    elevation: float = -14.0


SHOTS = {
    'sphere': Shot(0.36, strobe=('sphere', 0.04, 10), distance=0.45),
    'ellipsoid': Shot(4.8, strobe=('hull', 1.2, 5), distance=4.2),
    'falling_card': Shot(
        2.6, strobe=('card', 0.06, 11), distance=1.35, azimuth=35.0, elevation=-30.0
    ),
    'swimmer': Shot(3.3, gait=('swimmer', SWIM.angles)),
    'fish': Shot(3.3),
    'fly_wing': Shot(0.301, gait=('fly', BEAT.angles)),
    'quadrotor': Shot(0.0),
    'rov': Shot(0.0),
    'bluerov2': Shot(0.0),
    'bluerov2_heavy': Shot(0.0),
    'x500': Shot(0.0),
    'crazyflie': Shot(0.0),
    'amphibious': Shot(0.0),
    'aerosonde': Shot(0.0),
    'wave_buoy': Shot(13.0),
    'remus100': Shot(0.0),
    'bluerov2_tether': Shot(0.0),
    'x500_slung_load': Shot(0.0),
}


def still(name: str) -> Image.Image:
    """Return the picture of one scene."""
    shot = SHOTS[name]
    simulation = Simulation(replace(Scene.load(name), schedule=()))
    places = list(run(simulation, shot))
    model, data = simulation.model, simulation.data
    mujoco.mj_forward(model, data)
    if shot.distance and not shot.strobe:
        bases = [vehicle.body_id for vehicle in simulation.vehicles.values()]
        places = [(data.xpos[base], data.xmat[base]) for base in bases]
    option = mujoco.MjvOption()
    option.geomgroup[:] = [1, 1, 1, 0, 0, 0]  # bodies, not collision or fluid shapes
    # drawn at twice the size, for smooth edges
    model.vis.global_.offwidth, model.vis.global_.offheight = 2 * WIDTH, 2 * HEIGHT
    scenery = Scenery(model, data, 1.0)
    with mujoco.Renderer(model, 2 * HEIGHT, 2 * WIDTH) as renderer:
        renderer.update_scene(data, camera(shot, places), option)
        if shot.strobe:
            for position, rotation in places:
                add_copy(renderer.scene, model, shot.strobe[0], position, rotation)
        scenery.dress(renderer.scene, data.xpos[1])
        pixels = renderer.render()
    picture = Image.fromarray(np.asarray(pixels)).resize((WIDTH, HEIGHT), Image.Resampling.LANCZOS)
    # by octree: small parts keep their colours before a large sky
    colors = picture.quantize(COLORS, Image.Quantize.FASTOCTREE)
    return picture.quantize(palette=colors, dither=Image.Dither.FLOYDSTEINBERG)


def run(simulation: Simulation, shot: Shot) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Run to the time of the picture; yield the poses of the strobed geom on the way."""
    end = round(shot.time / simulation.timestep)
    due: list[int] = []
    if shot.strobe:
        name, interval, count = shot.strobe
        geom = simulation.data.geom(name)
        every = round(interval / simulation.timestep)
        due = [end - every * i for i in range(count)]
    while True:
        if simulation.step_count in due:
            mujoco.mj_kinematics(simulation.model, simulation.data)
            yield geom.xpos.copy(), geom.xmat.copy()
        if simulation.step_count >= end:
            return
        if shot.gait:
            vehicle, gait = shot.gait
            simulation.set_joints(vehicle, gait(simulation.time))
        simulation.step()


def camera(shot: Shot, places: list[tuple[np.ndarray, np.ndarray]]) -> str | mujoco.MjvCamera:
    """Return the model's tracking camera, or one that sees all the strobed places."""
    if not places:
        return 'track'
    positions = np.array([position for position, _ in places])
    view = mujoco.MjvCamera()
    view.lookat[:] = 0.5 * (positions.min(axis=0) + positions.max(axis=0))
    view.distance, view.azimuth, view.elevation = shot.distance, shot.azimuth, shot.elevation
    return view


def add_copy(
    scene: mujoco.MjvScene,
    model: mujoco.MjModel,
    name: str,
    position: np.ndarray,
    rotation: np.ndarray,
) -> None:
    """Add a copy of a geom to a scene that is about to be drawn, at another pose."""
    source = next(
        g for g in scene.geoms[: scene.ngeom]
        if g.objtype == mujoco.mjtObj.mjOBJ_GEOM and g.objid == model.geom(name).id
    )  # fmt: skip
    copy = scene.geoms[scene.ngeom]
    size = np.asarray(source.size, dtype=float)
    mujoco.mjv_initGeom(copy, source.type, size, position, rotation, source.rgba)
    for field in ('matid', 'texcoord', 'specular', 'shininess', 'emission', 'reflectance'):
        setattr(copy, field, getattr(source, field))
    scene.ngeom += 1


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or '').strip().split('\n')[0])
    parser.add_argument('--out', type=Path, default=OUT, help='folder of the pictures')
    parser.add_argument('--json', type=Path, help='also write name and size of each file')
    parser.add_argument('--only', nargs='+', choices=SHOTS, metavar='SCENE', help='these scenes')
    parser.add_argument('--quick', action='store_true', help='only the first scene')
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    sizes = {}
    for name in options.only or list(SHOTS)[: 1 if options.quick else None]:
        path = options.out / f'{name}.png'
        still(name).save(path, optimize=True)
        sizes[name] = path.stat().st_size
        print(f'{path}: {sizes[name] / 1000:.0f} kB')
    if options.json:
        options.json.write_text(json.dumps({'bytes': sizes}, indent=2) + '\n')


if __name__ == '__main__':
    main()
