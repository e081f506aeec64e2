"""Renders the animated pictures of README: the quadrotor in the gust, the BlueROV2 in waves."""

import os

os.environ.setdefault('MUJOCO_GL', 'egl')  # before MuJoCo is imported: no display is needed

import tempfile
from pathlib import Path

from PIL import Image, ImageSequence

from benchmarks.common import ROOT
from fluid_sim_ros.cli.run import run_scene
from fluid_sim_ros.recording.pictures.render import FilmOptions, render
from fluid_sim_ros.recording.reader import open_log

#: Scene -> simulated time [s], simulated seconds per second, name of the picture.
FILMS = {
    'quadrotor': (14.0, 2.0, 'quadrotor_gust'),
    'bluerov2_waves': (10.0, 1.0, 'bluerov2_waves'),
}
#: Drawn at this size, shown at the other: MuJoCo's letters have one size [pixels].
DRAWN, SHOWN = (800, 480), (480, 288)
RATE, COLOURS = 6, 128


def main() -> None:
    """Fly, render and shrink each film."""
    for scene, (seconds, speed, name) in FILMS.items():
        with tempfile.TemporaryDirectory() as folder:
            log, film = Path(folder) / 'flight.mcap', Path(folder) / 'film.gif'
            run_scene(scene, duration=seconds, hold=True, record=log)
            render(open_log(log), film, FilmOptions(*DRAWN, RATE, speed), lambda done: None)
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
