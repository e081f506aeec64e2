"""
Falling plates: where fluttering gives way to tumbling, with the plugin and with stock MuJoCo.

The plate of Andersen, Pesavento and Wang (2005), J. Fluid Mech. 541:91, moves in a vertical plane.
Their dimensionless model (physics/falling_plate.py) puts the transition at I* = 1.2191. The
plugin gets its added mass, drag (true area), lift and both rotational damping terms by the
mapping below; stock MuJoCo has the same shape and weight with the default coefficients.
Run: ``python benchmarks/plugin_falling_plate.py [--quick] [--json PATH]``.
"""

from typing import Any

import matplotlib as mpl
import mujoco
import numpy as np
from plugin_common import (
    RESULTS,
    Array,
    arguments,
    body_plugin,
    load,
    text,
    world,
    write,
)
from scipy.integrate import solve_ivp

from fluid_sim_ros.physics.falling_plate import PlateParams, falling_plate_rhs

A, BETA, FLUID, G = 0.05, 0.02, 1000.0, 9.81  # half width [m], b/a [-], [kg/m^3], [m/s^2]
B = BETA * A
SPAN = np.pi * A / 2  # of the plate; then the ellipsoid (a, a, b) has its area 2 a SPAN
DURATION, STEP = 200.0, 0.01  # in units of a/U
START = (0.0, 0.0, 0.3, 0.01, -0.01, 0.01)  # x, y, angle, velocity and spin: the general case


def speed_scale(inertia: float) -> float:
    """Return U = sqrt((rho_s/rho_f - 1) g b) [m/s] for I* = rho_s b/(rho_f a)."""
    return float(np.sqrt((inertia / BETA - 1) * G * B))


def plate(inertia: float, *, plugin: bool) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """
    Return the plate with joints x, z and a hinge about y (its span).

    Per unit span the model has the units pi rho a^2 (mass), pi rho a^4 (inertia). The geom's
    ellipsoid (a, a, b) has volume 4/3 pi a^2 b where the plate has pi a b SPAN, and swept inertia
    8 pi/15 a^5; its two equal long axes keep the slender coefficient out of the angular drag.
    """
    p = PlateParams(inertia)
    mass = np.pi * FLUID * inertia * A**2 * SPAN
    volume_plate, volume_geom = np.pi * A * B * SPAN, 4 / 3 * np.pi * A * A * B
    coefficients = (
        (p.a_drag + p.b_drag) / 2,  # blunt: 2 a SPAN rho C v^2 = rho a SPAN (A + B) v^2
        (p.a_drag - p.b_drag) / 2,  # slender
        p.mu_quadratic * 15 / 8 * SPAN / A,  # angular: pi rho a^4 SPAN mu2 |w| w
        p.c_translation,  # Kutta
        2 * p.c_rotation / (np.pi * BETA) * volume_plate / volume_geom,  # Magnus: 2/beta
    )
    geom = (
        f'<geom type="ellipsoid" size="{A} {A} {B}" fluidshape="ellipsoid" '
        'contype="0" conaffinity="0"'
    )
    heave, pitch = np.pi * FLUID * A**2 * SPAN, np.pi / 8 * FLUID * A**4 * SPAN
    if plugin:
        geom += f' fluidcoef="{text(coefficients)}"/>'
        fluid = body_plugin(
            added_mass=[0, 0, heave, 0, pitch, 0],
            volume=volume_plate,
            drag='ellipsoid',
            drag_area='true',
            rotational_damping=np.pi * A**3 * SPAN * p.mu_linear * speed_scale(inertia),
        )
        gravity = G
    else:
        geom += '/>'
        fluid = ''
        gravity = G * (1 - BETA / inertia)  # stock has no buoyancy: the same net weight
    own = mass * A**2 / 4
    body = (
        '<body name="plate" simple="false"><joint type="slide" axis="1 0 0"/>'
        '<joint type="slide" axis="0 0 1"/><joint axis="0 -1 0"/>'
        f'<inertial pos="0 0 0" mass="{mass:.17g}" '
        f'diaginertia="{own * 1.05:.17g} {own:.17g} {own * 1.05:.17g}"/>{geom}{fluid}</body>'
    )
    if not plugin:
        body = body.replace('simple="false"', '')
    return load(
        world(
            body, gravity=(0, 0, -gravity), timestep=STEP * A / speed_scale(inertia),
            medium={'density': FLUID} if plugin else None,
            option='' if plugin else f'density="{FLUID}"',
        )  # fmt: skip
    )


def fall(inertia: float, *, plugin: bool) -> Array:
    """Return (x, y, angle) in units of a over time, shape (n, 3)."""
    model, data = plate(inertia, plugin=plugin)
    scale = speed_scale(inertia)
    x, y, angle, vx, vy, spin = START
    cosine, sine = np.cos(angle), np.sin(angle)
    data.qpos[:] = [x * A, y * A, angle]
    data.qvel[:] = [
        (vx * cosine - vy * sine) * scale, (vx * sine + vy * cosine) * scale, spin * scale / A
    ]  # fmt: skip
    steps = round(DURATION / STEP)
    path = np.zeros((steps // 5, 3))
    for i in range(len(path)):
        mujoco.mj_step(model, data, 5)
        path[i] = data.qpos[0] / A, data.qpos[1] / A, data.qpos[2]
    return path


def theory(inertia: float) -> Array:
    """Return the same from the dimensionless model."""
    times = np.arange(1, round(DURATION / STEP / 5) + 1) * STEP * 5
    solution = solve_ivp(
        falling_plate_rhs, (0, DURATION), START, t_eval=times, rtol=1e-8, atol=1e-9,
        args=(PlateParams(inertia),),
    )  # fmt: skip
    return solution.y[:3].T


def turns(path: Array) -> float:
    """Return net turns of the plate in the second half of the fall."""
    return float(abs(path[-1, 2] - path[len(path) // 2, 2]) / (2 * np.pi))


def regime(path: Array) -> str:
    """Return ``tumble`` for two net turns or more in the second half, else ``flutter``."""
    return 'tumble' if turns(path) >= 2 else 'flutter'


MODELS = {
    'theory': theory,
    'plugin': lambda inertia: fall(inertia, plugin=True),
    'stock': lambda inertia: fall(inertia, plugin=False),
}


def measure(values: Array) -> dict[str, Any]:
    """Return the regime of each model for each I*, and the bracket of the transition."""
    values = values.round(6)
    result: dict[str, Any] = {'I_star': [float(v) for v in values]}
    for name, run in MODELS.items():
        net = [turns(run(float(value))) for value in values]
        kinds = ['tumble' if n >= 2 else 'flutter' for n in net]
        first = next((i for i, kind in enumerate(kinds) if kind == 'tumble'), None)
        bracket = None if not first else [float(values[first - 1]), float(values[first])]
        result[name] = {'regime': kinds, 'net_turns': net, 'first_transition': bracket}
    return result


def draw(result: dict[str, Any]) -> None:
    """Draw net turns against I*, and two paths of the plugin."""
    mpl.use('Agg')
    from matplotlib import pyplot as plt

    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.2), layout='constrained')
    for name in MODELS:
        left.plot(result['I_star'], result[name]['net_turns'], marker='o', label=name)
    left.axvline(1.2191, color='k', ls='--', lw=1, label='transition, theory 1.2191')
    left.set(xlabel='I* [-]', ylabel='net turns in the second half', title='flutter or tumble')
    left.legend()
    for inertia, color in ((1.1, 'C0'), (1.4, 'C1')):
        path = fall(inertia, plugin=True)[: round(40 / STEP / 5)]
        right.plot(path[:, 0], path[:, 1], color=color, lw=0.8, label=f'I* = {inertia}')
        for x, y, angle in path[::16]:
            right.plot(
                [x - np.cos(angle), x + np.cos(angle)], [y - np.sin(angle), y + np.sin(angle)],
                color=color, lw=1.2,
            )  # fmt: skip
    right.set(xlabel='x / a', ylabel='y / a', title='paths with the plugin', aspect='equal')
    right.legend()
    figure.savefig(RESULTS / 'plugin_falling_plate.png', dpi=80)


def main() -> None:
    """Measure, print, write JSON and picture."""
    options = arguments(__doc__ or '', 'plugin_falling_plate')
    step = 0.1 if options.quick else 0.02
    result = measure(np.arange(1.1, 1.4001, step))
    for name in MODELS:
        marks = ''.join('T' if kind == 'tumble' else 'f' for kind in result[name]['regime'])
        print(f'{name:8} {marks}  transition in {result[name]["first_transition"]}')
    write(options.json, result)
    if not options.quick:
        draw(result)


if __name__ == '__main__':
    main()
