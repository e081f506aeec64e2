"""
Falling plates: where fluttering gives way to tumbling, with the plugin and with stock MuJoCo.

The plate of Andersen, Pesavento and Wang (2005), J. Fluid Mech. 541:91, moves in a vertical plane.
Their dimensionless model (physics/falling_plate.py) puts the transition at I* = 1.2191. The
plugin gets its added mass, drag (true area), lift and both rotational damping terms by the
mapping of `plate`; stock MuJoCo has the same shape and weight with the default coefficients.

The mapping is exact but for the drag between edge-on and broadside: A - B cos 2a in the paper,
that is (A - B) + 2 B sin^2 a, and (A - B) + 2 B |sin a| by the area of the shadow. The paper's
equations with that drag (`theory_by_shadow`) say what the plugin must give; the rest is due to
the thickness, which the paper neglects, and vanishes with it.
Run: ``python benchmarks/plugin_falling_plate.py [--quick] [--json PATH]``.
"""

from collections.abc import Callable
from typing import Any

import matplotlib as mpl
import mujoco
import numpy as np
from common import RESULTS, arguments, write
from plugin_common import Array, body_plugin, load, text, world
from scipy.integrate import solve_ivp

from fluid_sim_ros.physics.falling_plate import PlateParams, falling_plate_rhs

A, BETA, FLUID, G = 0.05, 0.02, 1000.0, 9.81  # half width [m], b/a [-], [kg/m^3], [m/s^2]
SPAN = np.pi * A / 2  # of the plate; then the ellipsoid (a, a, b) has its area 2 a SPAN
DURATION, STEP, KEPT = 200.0, 0.01, 5  # in units of a/U twice; every fifth step is kept
START = (0.0, 0.0, 0.3, 0.01, -0.01, 0.01)  # x, y, angle, velocity and spin: the general case
PUBLISHED, BOUNDS = 1.2191, (1.2, 1.3)  # transition [-]: in the paper; where the plugin's lies
TUMBLES = 2.0  # net turns in the second half of a fall, from which on a plate tumbles


def speed_scale(inertia: float, beta: float = BETA) -> float:
    """Return U = sqrt((rho_s/rho_f - 1) g b) [m/s] for I* = rho_s b/(rho_f a)."""
    return float(np.sqrt((inertia / beta - 1) * G * beta * A))


def coefficients(inertia: float, beta: float) -> tuple[float, ...]:
    """
    Return blunt, slender, angular, Kutta and Magnus coefficient of the ellipsoid (a, a, b).

    Its volume is 4/3 pi a^2 b where the plate has pi a b SPAN, its swept inertia 8 pi/15 a^5; the
    two equal long axes keep the slender coefficient out of the angular drag.
    """
    p = PlateParams(inertia)
    volume_ratio = np.pi * A * SPAN / (4 / 3 * np.pi * A * A)
    return (
        (p.a_drag + p.b_drag) / 2,  # 2 a SPAN rho C v^2 = rho a SPAN (A + B) v^2
        (p.a_drag - p.b_drag) / 2,
        p.mu_quadratic * 15 / 8 * SPAN / A,  # pi rho a^4 SPAN mu2 |w| w
        p.c_translation,
        2 * p.c_rotation / (np.pi * beta) * volume_ratio,  # 2/beta for the plate's volume
    )


def plate(
    inertia: float, *, plugin: bool, beta: float = BETA
) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """
    Return the plate with joints x, z and a hinge about y (its span).

    Per unit span the model has the units pi rho a^2 (mass), pi rho a^4 (inertia), a U (circulation
    over pi) and so on: added mass 1 across the plate, none along it, added inertia 1/8.
    """
    scale = speed_scale(inertia, beta)
    mass = np.pi * FLUID * inertia * A**2 * SPAN
    heave, pitch = np.pi * FLUID * A**2 * SPAN, np.pi / 8 * FLUID * A**4 * SPAN
    if plugin:
        coef = f'fluidcoef="{text(coefficients(inertia, beta))}"'
        gravity, fluid = G, body_plugin(
            added_mass=[0, 0, heave, 0, pitch, 0],
            volume=np.pi * A * (beta * A) * SPAN,
            drag='ellipsoid',
            drag_area='true',
            rotational_damping=np.pi * A**3 * SPAN * PlateParams(inertia).mu_linear * scale,
        )  # fmt: skip
    else:
        # stock has no buoyancy: the same net weight
        coef, fluid, gravity = '', '', G * (1 - beta / inertia)
    own = mass * A**2 / 4
    body = (
        '<body name="plate" simple="false"><joint type="slide" axis="1 0 0"/>'
        '<joint type="slide" axis="0 0 1"/><joint axis="0 -1 0"/>'
        f'<inertial pos="0 0 0" mass="{mass:.17g}" '
        f'diaginertia="{own * 1.05:.17g} {own:.17g} {own * 1.05:.17g}"/>'
        f'<geom type="ellipsoid" size="{A} {A} {beta * A}" fluidshape="ellipsoid" {coef} '
        f'contype="0" conaffinity="0"/>{fluid}</body>'
    )
    return load(
        world(
            body, gravity=(0, 0, -gravity), timestep=STEP * A / scale,
            medium={'density': FLUID} if plugin else None,
            option='' if plugin else f'density="{FLUID}"',
        )
    )  # fmt: skip


def fall(inertia: float, *, plugin: bool, beta: float = BETA) -> Array:
    """Return (x, y, angle) in units of a over time, shape (n, 3)."""
    model, data = plate(inertia, plugin=plugin, beta=beta)
    scale = speed_scale(inertia, beta)
    x, y, angle, vx, vy, spin = START
    cosine, sine = np.cos(angle), np.sin(angle)
    data.qpos[:] = [x * A, y * A, angle]
    data.qvel[:] = [
        (vx * cosine - vy * sine) * scale, (vx * sine + vy * cosine) * scale, spin * scale / A
    ]  # fmt: skip
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
