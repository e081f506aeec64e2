# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
How the scene fish swims: speed, tail beat, thrust, Strouhal number, efficiency by frequency.

Beside what is published of fish: Strouhal numbers 0.2 to 0.4 (Taylor et al. 2003, Nature 425:707)
and U/L = 0.75 f - 1 above 5 Hz (Bainbridge 1958, J. Exp. Biol. 35:109), a stride of 0.55 to 0.7
body lengths a beat at 5 to 20 Hz.
Run: ``python -m benchmarks.vehicles.fish [--quick] [--json PATH]``.
"""

from dataclasses import replace
from typing import Any

import matplotlib as mpl
import mujoco
import numpy as np

from benchmarks.common import ROOT, arguments, write
from fluid_sim_ros import Scene, Simulation
from test.support.plugin_models import Array

IMAGE = ROOT / 'doc' / 'img' / 'fish_validation.png'
LENGTH = 0.405  # [m] of models/fish.xml, nose to the end of the caudal fin
FREQUENCIES = (1.0, 1.5, 2.0, 2.5, 3.0)  # [Hz]
STROUHAL, STRIDE = (0.2, 0.4), (0.55, 0.7)  # published


def swim(frequency: float, seconds: float = 14.0, beats: int = 3) -> dict[str, Any]:
    """Return what the last beats have: rows over time, and their means."""
    scene = Scene.load('fish')
    gait = replace_frequency(scene, frequency)
    simulation = Simulation(gait)
    model, data = simulation.model, simulation.data
    tip = model.site('tip').id
    count = round(beats / frequency / simulation.timestep)
    simulation.step(round(seconds / simulation.timestep) - count)
    rows = []
    for _ in range(count):
        before = data.qpos[7:].copy(), data.qvel[6:].copy()
        simulation.step()
        # a servo works against its held command: mean of both ends of the step
        power = np.mean([work_rate(model, data.ctrl, *before),
                         work_rate(model, data.ctrl, data.qpos[7:], data.qvel[6:])])  # fmt: skip
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        rotation = data.xmat[1].reshape(3, 3)
        foil = rotation @ simulation.wrench('fish')['foil'][0]
        rows.append([simulation.time, *data.subtree_com[1], *data.site_xpos[tip], *foil, power])
    return measured(np.array(rows), frequency)


def work_rate(model: mujoco.MjModel, command: Array, angle: Array, rate: Array) -> float:
    """Return the power [W] of the servos."""
    kp, kv = model.actuator_gainprm[:, 0], -model.actuator_biasprm[:, 2]
    low, high = model.actuator_forcerange.T
    return float(np.clip(kp * (command - angle) - kv * rate, low, high) @ rate)


def replace_frequency(scene: Scene, frequency: float) -> Scene:
    """Return the scene with its gait at another frequency."""
    (gait,) = scene.gait.values()
    return replace(scene, gait={'fish': gait.model_copy(update={'frequency': frequency})})


def measured(rows: Array, frequency: float) -> dict[str, Any]:
    """Return speed, amplitude, thrust, power and the numbers of the literature."""
    time, center, tip, foil, power = (
        rows[:, 0], rows[:, 1:4], rows[:, 4:7], rows[:, 7:10], rows[:, 10],
    )  # fmt: skip
    velocity = (center[-1] - center[0]) / (time[-1] - time[0])
    speed = float(np.linalg.norm(velocity[:2]))
    ahead = velocity / np.linalg.norm(velocity)
    aside = np.array([-ahead[1], ahead[0], 0.0])
    sway = (tip - center[0] - np.outer(time - time[0], velocity)) @ aside
    amplitude, thrust = float(np.ptp(sway)), float((foil @ ahead).mean())
    return {
        'frequency': frequency, 'speed': speed, 'climb': float(velocity[2]),
        'lengths_per_s': speed / LENGTH, 'stride': speed / LENGTH / frequency,
        'amplitude': amplitude, 'amplitude_over_length': amplitude / LENGTH,
        'strouhal': frequency * amplitude / speed, 'thrust': thrust,
        'power': float(power.mean()), 'efficiency': thrust * speed / float(power.mean()),
        'beat': {'time': time, 'thrust': foil @ ahead, 'sway': sway},
    }  # fmt: skip


def draw(runs: list[dict[str, Any]], shown: dict[str, Any]) -> None:
    """Draw speed, Strouhal number, and thrust over the beats of one run."""
    from matplotlib import pyplot as plt

    figure, (first, second, third) = plt.subplots(1, 3, figsize=(12, 3.8), layout='constrained')
    frequency = np.array([run['frequency'] for run in runs])
    grid = np.linspace(0, 1.05 * frequency.max(), 50)
    first.fill_between(grid, STRIDE[0] * grid, STRIDE[1] * grid, color='0.88', label='Bainbridge')
    first.plot(frequency, [run['lengths_per_s'] for run in runs], 'o-', label='simulation')
    first.set(xlabel='tail beats [Hz]', ylabel='speed [body lengths/s]', title='speed')
    second.axhspan(*STROUHAL, color='0.88', label='Taylor et al.')
    second.plot(frequency, [run['strouhal'] for run in runs], 'o-', label='simulation')
    second.set(xlabel='tail beats [Hz]', ylabel='St = f A/U [-]', ylim=(0, 0.5))
    second.set_title('Strouhal number')
    beat = shown['beat']
    third.plot(beat['time'] - beat['time'][0], beat['thrust'], label='thrust of the fin')
    third.axhline(shown['thrust'], color='0.6', lw=1, label='mean')
    third.set(xlabel='t [s]', ylabel='thrust [N]', title=f'{shown["frequency"]:g} Hz')
    third.margins(y=0.4)
    for axis in (first, second, third):
        axis.legend(fontsize=8, loc='upper left')
    figure.suptitle('fish')
    figure.savefig(IMAGE, dpi=80)
    plt.close(figure)


def main() -> None:
    """Measure, print, write JSON and picture."""
    options = arguments(__doc__ or '', 'fish')
    mpl.use('Agg')
    runs = [swim(frequency) for frequency in (FREQUENCIES[2:3] if options.quick else FREQUENCIES)]
    for run in runs:
        print(
            f'{run["frequency"]} Hz: {run["speed"]:.3f} m/s, {run["lengths_per_s"]:.2f} L/s, '
            f'stride {run["stride"]:.2f} L, A {run["amplitude_over_length"]:.3f} L, '
            f'St {run["strouhal"]:.3f}, thrust {run["thrust"]:.3f} N, {run["power"]:.3f} W, '
            f'efficiency {run["efficiency"]:.2f}'
        )
    if not options.quick:
        draw(runs, next(run for run in runs if run['frequency'] == 2.0))
    for run in runs:
        del run['beat']
    write(options.json, {'length': LENGTH, 'runs': runs})


if __name__ == '__main__':
    main()
