# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Bodies in waves of fluid_sim.medium, and the same seas in numpy."""

import numpy as np

from fluid_sim_ros.physics.environment.wave_spectrum import jonswap_waves
from fluid_sim_ros.physics.environment.waves import Sea, regular_waves
from test.support.plugin_models import (
    body_plugin,
    ellipsoid,
    free_body,
    load,
    world,
)

G = 9.81
LEVEL = 1.5  # of the surface, world z [m]
MEAN = np.array([0.0, 0.0, LEVEL])
BASE = {'density': 1000, 'surface': LEVEL}
PULL = [0, 0, -G]
CASES: dict[str, tuple[dict, Sea]] = {
    'deep': (
        {'waves': 'regular 1.2 5', 'wave_direction': [3, 4]},
        regular_waves(1.2, 5.0, [3.0, 4.0], gravity=G),
    ),
    'shallow': (
        {'waves': 'regular .4 4', 'wave_direction': [1, -2], 'water_depth': 3},
        regular_waves(0.4, 4.0, [1.0, -2.0], depth=3.0, gravity=G),
    ),
    'sea': (
        {'waves': 'jonswap 1 6', 'wave_seed': 7},
        jonswap_waves(1.0, 6.0, seed=7, gravity=G),
    ),
    'short-crested': (
        {
            'waves': 'jonswap 2 8 5', 'wave_spreading': 12, 'wave_seed': 2**53,
            'wave_components': 40, 'wave_repeat': 1200, 'wave_cutoff': 3, 'water_depth': 20,
            'wave_direction': [-1, 0.3],
        },
        jonswap_waves(
            2.0, 8.0, gamma=5.0, spreading=12, seed=2**53, components=40, repeat=1200.0,
            cutoff=3.0, depth=20.0, direction=[-1, 0.3], gravity=G,
        ),
    ),
}  # fmt: skip
VOLUME = 4 / 3 * np.pi * 0.1**3


def sea_model(bodies, waves, *, weight=True, **options):
    """Return a model in waves; without weight only the flow acts."""
    flag = '' if weight else 'gravity="disable"'
    medium = BASE | waves | options.pop('medium', {})
    return load(world(bodies, medium=medium, gravity=PULL, flag=flag, **options))


def sphere(density=1000, radius=0.1, **plugin):
    return free_body(ellipsoid([radius] * 3, density) + body_plugin(**plugin))
