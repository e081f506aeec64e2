# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Render what ``fluid_sim new-vehicle`` makes, for doc/new_vehicle.md: a preset in air and in water.

Needs EGL. Run: ``python -m benchmarks.pictures.render_new_vehicle``.
"""

import os
import tempfile
from pathlib import Path

os.environ.setdefault('MUJOCO_GL', 'egl')

import mujoco
import numpy as np
from PIL import Image

from fluid_sim_ros import Simulation
from fluid_sim_ros.new_vehicle.files import design_vehicle, write_vehicle
from test.support.paths import DOC

OUT = DOC / 'img' / 'new_vehicle.png'
WIDTH, HEIGHT = 480, 360
VEHICLES = (
    design_vehicle('bee', 'air', 1.6, (0.35, 0.35, 0.1), 'hexa'),
    design_vehicle('crab', 'water', 12.0, (0.45, 0.4, 0.25), 'vectored8', max_thrust=30.0),
)


def main() -> None:
    pictures = []
    for design in VEHICLES:
        with tempfile.TemporaryDirectory() as folder:
            simulation = Simulation(write_vehicle(design, Path(folder)).scene)
        model, data = simulation.model, simulation.data
        mujoco.mj_forward(model, data)
        option = mujoco.MjvOption()
        option.geomgroup[:] = [1, 1, 1, 0, 0, 0]  # bodies, not collision or fluid shapes
        with mujoco.Renderer(model, 2 * HEIGHT, 2 * WIDTH) as renderer:
            renderer.update_scene(data, 'track', option)
            pictures.append(renderer.render())
    picture = Image.fromarray(np.hstack(pictures)).resize(
        (2 * WIDTH, HEIGHT), Image.Resampling.LANCZOS
    )
    picture.quantize(255, Image.Quantize.MAXCOVERAGE).save(OUT, optimize=True)
    print(f'{OUT}: {OUT.stat().st_size / 1000:.0f} kB')


if __name__ == '__main__':
    main()
