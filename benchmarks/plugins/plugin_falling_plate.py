# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Falling plates: where fluttering gives way to tumbling, with the plugin and with stock MuJoCo.

The plate of Andersen, Pesavento and Wang (2005), J. Fluid Mech. 541:91, moves in a vertical plane.
Their dimensionless model (physics/falling_plate.py) puts the transition at I* = 1.2191. The
plugin gets its added mass, drag (true area), lift and both rotational damping terms by the
mapping of lab/problems/plates.py; stock MuJoCo has the same shape and weight with the default
coefficients.

The mapping is exact but for the drag between edge-on and broadside: A - B cos 2a in the paper,
that is (A - B) + 2 B sin^2 a, and (A - B) + 2 B |sin a| by the area of the shadow. The paper's
equations with that drag (`theory_by_shadow`) say what the plugin must give; the rest is due to
the thickness, which the paper neglects, and vanishes with it.
Run: ``python -m benchmarks.plugins.plugin_falling_plate [--quick] [--json PATH]``.
"""

from collections.abc import Callable
from typing import Any

import matplotlib as mpl
import mujoco
import numpy as np
from scipy.integrate import solve_ivp

from benchmarks.common import RESULTS, arguments, write
from fluid_sim_ros.lab.problems.plates import BETA, START, A, plate_mjcf, speed_scale, start_state
from fluid_sim_ros.physics.falling_plate import PlateParams, falling_plate_rhs
from test.support.plugin_models import Array, load

DURATION, STEP, KEPT = 200.0, 0.01, 5  # in units of a/U twice; every fifth step is kept
PUBLISHED, BOUNDS = 1.2191, (1.2, 1.3)  # transition [-]: in the paper; where the plugin's lies
TUMBLES = 2.0  # net turns in the second half of a fall, from which on a plate tumbles


def fall(inertia: float, *, plugin: bool, beta: float = BETA) -> Array:
    """Return (x, y, angle) in units of a over time, shape (n, 3)."""
    timestep = STEP * A / speed_scale(inertia, beta)
    model, data = load(plate_mjcf(inertia, plugin=plugin, beta=beta, timestep=timestep))
    data.qpos[:], data.qvel[:] = start_state(inertia, beta)
    path = np.zeros((round(DURATION / STEP / KEPT), 3))
    for row in path:
        mujoco.mj_step(model, data, KEPT)
        row[:] = data.qpos[0] / A, data.qpos[1] / A, data.qpos[2]
    return path


def shadow_rhs(time: float, state: Array, params: PlateParams, beta: float) -> Array:
    """
    Return the paper's right-hand side with the drag that follows the area of the shadow.

    (A - B) + 2 B sqrt(beta^2 cos^2 a + sin^2 a) in place of A - B cos 2a; the area is that of an
    ellipse of aspect beta seen at the angle of attack a.
    """
    vx, vy = state[3], state[4]
    square = vx * vx + vy * vy
    if square > 0:
        shadow = np.sqrt((beta * beta * vx * vx + vy * vy) / square)
        change = params.b_drag * ((vx * vx - vy * vy) / square - (1 - 2 * shadow))
        params = params._replace(a_drag=params.a_drag + change)
    return falling_plate_rhs(time, state, params)


def solved(rhs: Callable[..., Array], *args: Any) -> Array:
    """Return (x, y, angle) of a dimensionless model at the times of `fall`."""
    times = np.arange(1, round(DURATION / STEP / KEPT) + 1) * STEP * KEPT
    solution = solve_ivp(rhs, (0, DURATION), START, t_eval=times, rtol=1e-8, atol=1e-9, args=args)
    return solution.y[:3].T


def theory(inertia: float) -> Array:
    """Return the fall by the paper's equations."""
    return solved(falling_plate_rhs, PlateParams(inertia))


def theory_by_shadow(inertia: float, beta: float = BETA) -> Array:
    """Return the fall by the paper's equations with the drag of the shadow's area."""
    return solved(shadow_rhs, PlateParams(inertia), beta)


def turns(path: Array) -> float:
    """Return net turns of the plate in the second half of the fall."""
    return float(abs(path[-1, 2] - path[len(path) // 2, 2]) / (2 * np.pi))


def regime(path: Array) -> str:
    """Return ``tumble`` or ``flutter``."""
    return 'tumble' if turns(path) >= TUMBLES else 'flutter'


def transition(
    run: Callable[[float], Array], low: float = 1.15, high: float = 1.45, width: float = 2e-3
) -> float:
    """Return I* of the transition by bisection; refuse an interval that does not hold it."""
    if (regime(run(low)), regime(run(high))) != ('flutter', 'tumble'):
        raise RuntimeError(f'no transition from flutter to tumbling between {low} and {high}')
    while high - low > width:
        middle = (low + high) / 2
        low, high = (low, middle) if regime(run(middle)) == 'tumble' else (middle, high)
    return (low + high) / 2


MODELS: dict[str, Callable[[float], Array]] = {
    'theory': theory,
    'theory_by_shadow': theory_by_shadow,
    'plugin': lambda inertia: fall(inertia, plugin=True),
    'stock': lambda inertia: fall(inertia, plugin=False),
}


def measure(values: Array, thicknesses: tuple[float, ...], width: float) -> dict[str, Any]:
    """Return net turns of each model over I*, and transitions, also over the thickness b/a."""
    result: dict[str, Any] = {'I_star': [float(v) for v in values.round(6)]}
    for name, run in MODELS.items():
        net = [turns(run(value)) for value in result['I_star']]
        result[name] = {
            'regime': ['tumble' if n >= TUMBLES else 'flutter' for n in net],
            'net_turns': net,
            'transition': transition(run, width=width) if max(net) >= TUMBLES else None,
        }
    wide = (0.5, 2.0, 8.0)
    result['stock_far_off'] = {f'{v:g}': turns(fall(v, plugin=False)) for v in wide}
    result['transition_over_thickness'] = {
        f'{beta:g}': {
            'plugin': transition(lambda v, b=beta: fall(v, plugin=True, beta=b), width=width),
            'theory_by_shadow': transition(lambda v, b=beta: theory_by_shadow(v, b), width=width),
        }
        for beta in thicknesses
    }
    return result


def draw_path(axis: Any, path: Array, color: str, label: str) -> None:
    """Draw the track of a plate, and the plate itself now and then."""
    axis.plot(path[:, 0], path[:, 1], color=color, lw=0.8, label=label)
    for x, y, angle in path[::16]:
        cosine, sine = np.cos(angle), np.sin(angle)
        axis.plot([x - cosine, x + cosine], [y - sine, y + sine], color=color, lw=1.2)


def draw(result: dict[str, Any]) -> None:
    """Draw net turns against I*, and the paths of two plates by three models."""
    mpl.use('Agg')
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(
        1, 4, figsize=(13, 4.2), width_ratios=(1.6, 1, 1, 1), layout='constrained'
    )
    labels = ('theory', "theory with the shadow's drag", 'fluid_sim', 'stock MuJoCo, defaults')
    for name, label, style in zip(MODELS, labels, ('ko-', 'k:', 'C0o-', 'C3o-'), strict=True):
        axes[0].plot(result['I_star'], result[name]['net_turns'], style, ms=4, label=label)
    axes[0].axvline(PUBLISHED, color='k', lw=0.7, ls='--')
    axes[0].text(PUBLISHED, 5.3, f'{PUBLISHED} ', ha='right')
    axes[0].axvspan(*BOUNDS, alpha=0.1)
    axes[0].set(xlabel='I* [-]', ylabel='net turns in 100 a/U', title='Flutter or tumble')
    axes[0].legend(fontsize=8, loc='upper left')
    axes[0].grid(alpha=0.3)
    for axis, name, title in zip(
        axes[1:], ('theory', 'plugin', 'stock'), ('Theory', 'fluid_sim', 'Stock'), strict=True
    ):
        for inertia, color in ((1.1, 'C0'), (1.4, 'C1')):
            path = MODELS[name](inertia)[: round(40 / STEP / KEPT)]
            draw_path(axis, path, color, f'I* = {inertia}')
        axis.set(title=title, xlabel='x / a', aspect='equal', xlim=(-24, 24), ylim=(-45, 3))
    axes[1].set_ylabel('y / a')
    axes[1].legend(fontsize=8)
    figure.savefig(RESULTS / 'plugin_falling_plate.png', dpi=80)


def main() -> None:
    """Measure, print, write JSON and picture."""
    options = arguments(__doc__, 'plugin_falling_plate')
    if options.quick:
        result = measure(np.array([1.1, 1.2, 1.3, 1.4]), (), 0.02)
    else:
        result = measure(np.arange(1.1, 1.4001, 0.02), (0.001, 0.005, BETA, 0.05), 2e-3)
    for name in MODELS:
        marks = ''.join('T' if kind == 'tumble' else 'f' for kind in result[name]['regime'])
        print(f'{name:16} {marks}  transition at I* = {result[name]["transition"]}')
    print('stock, turns at other I*:', result['stock_far_off'])
    for beta, values in result['transition_over_thickness'].items():
        print(f'b/a = {beta}: {values}')
    write(options.json, result)
    if not options.quick:
        draw(result)


if __name__ == '__main__':
    main()
