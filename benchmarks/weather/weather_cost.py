# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Cost of weather per step of the x500, and over the number of vehicles with local turbulence.

Ratios within one run: blocks of 0.2 s from the same start, all cases in turn, the fastest block of
each. The rotors idle and there is no gravity, so that nothing touches the ground.
Run: ``python -m benchmarks.weather.weather_cost [--quick] [--json PATH]``.
"""

import time
from collections.abc import Mapping
from typing import Any

import mujoco

from benchmarks.common import ROOT, arguments, write
from fluid_sim_ros import load_plugins
from test.support.plugin_models import body_plugin, ellipsoid, free_body, load, world

X500 = ROOT / 'models' / 'x500.xml'
BLOCK = 100  # steps that are timed at once: less than a scheduler's slice
COUNTS = (1, 2, 5, 10, 25, 50)
WIND = '6 1 -1'  # oblique: a body that turns about all axes costs MuJoCo itself 5 % more
DRYDEN = {
    'wind': WIND, 'turbulence': 'dryden', 'turbulence_wind_6m': '5.6', 'turbulence_height': '10',
    'turbulence_airspeed': '6',
}  # fmt: skip
#: Keys of fluid_sim.medium; None: the wind in opt.wind.
CASES: dict[str, dict[str, str] | None] = {
    'opt.wind': None,
    'local steady wind': {'wind': WIND},
    'dryden': DRYDEN,
    'von_karman': DRYDEN | {'turbulence': 'von_karman'},
    'von_karman with p, q, r': DRYDEN | {'turbulence': 'von_karman', 'turbulence_span': '0.5'},
    'dryden that follows': DRYDEN | {'turbulence_follow': 'vehicle'},
}


def x500(keys: Mapping[str, str] | None) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Return an x500 with its wind by one of the roads."""
    spec = mujoco.MjSpec.from_file(str(X500))
    spec.option.gravity = [0, 0, 0]
    spec.option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT)
    if keys is None:
        spec.option.wind = [float(word) for word in WIND.split()]
    else:
        spec.activate_plugin('fluid_sim.medium')
        plugin = spec.add_plugin(name='weather', plugin_name='fluid_sim.medium', active=True)
        plugin.config = dict(keys)
    model = spec.compile()
    return model, mujoco.MjData(model)


def swarm(count: int, turbulent: bool) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Return neutral bodies in a wind, each with turbulence of its own or all without."""
    inside = ellipsoid([0.3, 0.2, 0.1], 1.2) + body_plugin(
        added_mass='auto', volume='auto', linear_damping=[0.1] * 3 + [0.01] * 3
    )
    bodies = ''.join(
        free_body(inside, name=f'kite{i}', position=(0, 3 * i, 10)) for i in range(count)
    )
    keys = {'density': '1.2', **(DRYDEN if turbulent else {'wind': WIND})}
    return load(world(bodies, medium=keys, timestep=0.002, integrator='implicitfast'))


def begin(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """Go to the start, so that all cases move alike, and take the steps that fill the caches."""
    mujoco.mj_resetDataKeyframe(model, data, 0 if model.nkey else -1)
    data.ctrl[:] = 0.01
    mujoco.mj_step(model, data, 10)


def fastest(
    runs: Mapping[Any, tuple[mujoco.MjModel, mujoco.MjData]], rounds: int, block: int
) -> dict[Any, float]:
    """Return seconds per step of each, the fastest of interleaved blocks."""
    best = dict.fromkeys(runs, float('inf'))
    for _ in range(rounds):
        for name, (model, data) in runs.items():
            begin(model, data)
            start = time.perf_counter()
            mujoco.mj_step(model, data, block)
            best[name] = min(best[name], (time.perf_counter() - start) / block)
    return best


def main() -> None:
    """Measure and write the result."""
    args = arguments(__doc__, 'weather_cost')
    load_plugins()
    rounds = 60 if args.quick else 600
    step = fastest({name: x500(keys) for name, keys in CASES.items()}, rounds, BLOCK)
    steady, option = step['local steady wind'], step['opt.wind']
    rows = {
        name: {
            'step_us': round(1e6 * seconds, 3),
            'over_opt_wind': round(seconds / option, 4),
            'over_local_steady_wind': round(seconds / steady, 4),
        }
        for name, seconds in step.items()
    }
    for name, row in rows.items():
        print(f'{name:24} {row}')
    counts = COUNTS[:3] if args.quick else COUNTS
    runs = {(n, turbulent): swarm(n, turbulent) for n in counts for turbulent in (False, True)}
    each = fastest(runs, max(10, rounds // 6), 20)
    vehicles = [
        {
            'vehicles': n,
            'step_us': round(1e6 * each[n, True], 2),
            'turbulence_us_per_vehicle': round(1e6 * (each[n, True] - each[n, False]) / n, 3),
            'step_us_per_vehicle': round(1e6 * each[n, True] / n, 3),
        }
        for n in counts
    ]
    for line in vehicles:
        print(line)
    write(args.json, {'timestep_s': 0.002, 'tick_s': 0.01, 'x500': rows, 'vehicles': vehicles})


if __name__ == '__main__':
    main()
