# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Renders the animated pictures of README: the quadrotor in the gust, the BlueROV2 in waves."""

import os

os.environ.setdefault('MUJOCO_GL', 'egl')  # before MuJoCo is imported: no display is needed

import tempfile
from dataclasses import replace
from pathlib import Path

from PIL import Image, ImageSequence

from benchmarks.common import ROOT
from fluid_sim_ros.cli.run import run_scene
from fluid_sim_ros.recording.pictures.render import FilmOptions, render
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.scene import Scene

#: Short waves, which fit into the picture: height [m], period [s].
WAVES = {'height': 0.4, 'period': 2.6}
#: Scene -> simulated time [s], simulated seconds per second, where it is seen from, name.
FILMS = {
    'quadrotor': (14.0, 2.0, (130.0, -15.0, 3.6), 'quadrotor_gust'),
    'bluerov2_waves': (7.8, 1.0, (115.0, 8.0, 5.5), 'bluerov2_waves'),
}
#: Drawn at this size, shown at the other: MuJoCo's letters have one size [pixels].
DRAWN, SHOWN = (800, 480), (480, 288)
RATE, COLOURS = 6, 128


def main() -> None:
    """Fly, render and shrink each film."""
    for title, (seconds, speed, viewpoint, name) in FILMS.items():
        scene = Scene.load(title)
        if scene.waves is not None:
            scene = replace(scene, waves=scene.waves.model_copy(update=WAVES))
        with tempfile.TemporaryDirectory() as folder:
            log, film = Path(folder) / 'flight.mcap', Path(folder) / 'film.gif'
            run_scene(scene, duration=seconds, hold=True, record=log)
            options = FilmOptions(*DRAWN, RATE, speed, viewpoint=viewpoint)
            render(open_log(log), film, options, lambda done: None)
            with Image.open(film) as pictures:
                small = [
                    picture.convert('RGB').resize(SHOWN, Image.Resampling.LANCZOS)
                    for picture in ImageSequence.Iterator(pictures)
                ]
        frames = [picture.quantize(COLOURS, dither=Image.Dither.NONE) for picture in small]
        out = ROOT / 'doc' / 'img' / f'{name}.gif'
        frames[0].save(out, save_all=True, append_images=frames[1:], duration=1000 // RATE, loop=0)
        print(f'{out.name}: {len(frames)} pictures, {out.stat().st_size / 1e6:.2f} MB')


if __name__ == '__main__':
    main()
