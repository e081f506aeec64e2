# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Waves of the medium against closed forms: spectrum, exact period, orbits, forces; their cost.

Energy and significant height of JONSWAP seas over one repeat, from the surface that the plugin
gives; orbits of neutral spheres against a e^kz and the path of the water; the force on a held
sphere against 3/2 rho V Du/Dt; a floating box on long waves; cost per step over the number of
components, as ratios to still water within one run. Draws the pictures of doc/waves.md.
Run: ``python -m benchmarks.weather.waves [--quick] [--json PATH]``.
"""

from benchmarks.common import RESULTS, arguments, write
from benchmarks.pictures.wave_pictures import draw
from benchmarks.weather.wave_measures import (
    cost,
    dispersion,
    floating_box,
    held_sphere,
    orbits,
    spectrum,
)


def main() -> None:
    """Measure, print, write JSON and pictures."""
    options = arguments(__doc__ or '', 'waves')
    result = {
        'dispersion_error': dispersion(),
        'spectrum': spectrum(2 if options.quick else 16),
        'orbits': orbits(),
        'held_sphere_force_error': held_sphere(),
        'floating_box': floating_box(),
        'cost': cost(10 if options.quick else 200),
    }
    for name, value in result.items():
        print(f'{name}: {value}')
    write(options.json, result)
    if not options.quick and options.json.parent == RESULTS:
        draw()


if __name__ == '__main__':
    main()
