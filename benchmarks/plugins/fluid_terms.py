# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Compare each term of physics/ with stock MuJoCo's ``qfrc_fluid`` over random bodies.

Each case is a fresh model: a free body of random size at the origin, random attitude, velocity,
spin, wind, density, viscosity and coefficients. A term is isolated by switching the others off
(coefficients, density, viscosity, virtual masses), never by subtraction, so that the error is
relative to the term itself.
Run: ``python -m benchmarks.plugins.fluid_terms [--quick] [--json PATH]``.
"""

from collections import defaultdict
from collections.abc import Callable, Iterator
from typing import NamedTuple

import mujoco
import numpy as np

from benchmarks.common import arguments, write
from fluid_sim_ros.physics import added_mass, drag, inertia_box, kappa, lift, projection
from fluid_sim_ros.physics.arrays import Array
from test.support import printed_formulas

CASES = 2000
QUICK_CASES = 200
# Relative to the term; the engine integrates kappa by a 15-point rule, hence the wider bound.
LIMITS = defaultdict(
    lambda: 1e-12,
    {
        'added_mass_force': 1e-5,
        'added_mass_torque': 1e-5,
        # A_max - A cancels in the engine when the flow meets nearly the largest area, so the small
        # result carries the rounding of A_max; `slender_drag` is relative to that operand.
        'slender_drag_to_result': 1e-10,
    },
)

ELLIPSOID = """
<mujoco><option gravity="0 0 0"/><worldbody><body><freejoint/>
<geom type="ellipsoid" size="{size}" fluidshape="ellipsoid" contype="0" conaffinity="0"/>
</body></worldbody></mujoco>"""
BOX = """
<mujoco><option gravity="0 0 0"/><worldbody><body><freejoint/>
<inertial pos="0 0 0" mass="{mass}" diaginertia="{inertia}"/>
<geom type="sphere" size=".1" contype="0" conaffinity="0"/>
</body></worldbody></mujoco>"""


class Motion(NamedTuple):
    """State of one random case; velocities along the body axes."""

    quat_wb_wxyz: Array
    v_rel_b: Array
    omega_b: Array
    density: float
    viscosity: float


def text(values: Array) -> str:
    """Return numbers with all their digits, as MJCF wants them."""
    return ' '.join(f'{value:.17g}' for value in np.atleast_1d(values))


def place(model: mujoco.MjModel, data: mujoco.MjData, rng: np.random.Generator) -> Motion:
    """Give the body a random attitude and motion in a random wind and medium."""
    quat = rng.normal(size=4)
    quat /= np.linalg.norm(quat)
    rotation = np.zeros(9)
    mujoco.mju_quat2Mat(rotation, quat)
    rotation = rotation.reshape(3, 3)
    wind_w, v_w, omega_b = rng.normal(size=(3, 3)) * [[3.0], [2.0], [4.0]]
    model.opt.wind = wind_w
    data.qpos[:] = np.r_[0.0, 0.0, 0.0, quat]
    data.qvel[:] = np.r_[v_w, omega_b]
    density, viscosity = 10 ** rng.uniform(0, 3), 10 ** rng.uniform(-5, 0)
    return Motion(quat, rotation.T @ (v_w - wind_w), omega_b, density, viscosity)


def engine(
    model: mujoco.MjModel, data: mujoco.MjData, density: float, viscosity: float
) -> tuple[Array, Array]:
    """Return MuJoCo's fluid force and torque on the free body, body axes."""
    model.opt.density, model.opt.viscosity = density, viscosity
    mujoco.mj_fwdPosition(model, data)
    mujoco.mj_fwdVelocity(model, data)
    rotation = data.xmat[1].reshape(3, 3)
    return rotation.T @ data.qfrc_fluid[:3], data.qfrc_fluid[3:].copy()


def error(value: Array, reference: Array) -> float:
    """Return |value - reference| / |reference|."""
    return float(np.linalg.norm(value - reference) / np.linalg.norm(reference))


def ellipsoid_case(rng: np.random.Generator) -> Iterator[tuple[str, float]]:
    """Yield (term, relative error) of every ellipsoid term for one random body."""
    axes = 10 ** rng.uniform(-2, -1) * 10 ** rng.uniform(0, 1, size=3)  # aspect ratio up to 10
    model = mujoco.MjModel.from_xml_string(ELLIPSOID.format(size=text(axes)))
    data = mujoco.MjData(model)
    motion = place(model, data, rng)
    c_blunt, c_slender, c_angular, c_kutta, c_magnus = rng.uniform(0.1, 2, size=5)
    v, omega, rho, beta = motion.v_rel_b, motion.omega_b, motion.density, motion.viscosity

    model.geom_fluid[0, 1:6] = 0
    force, torque = engine(model, data, rho, 0.0)
    ours = added_mass.ellipsoid_added_mass_wrench(*kappa.ellipsoid_added_mass(axes, rho), v, omega)
    yield 'added_mass_force', error(ours[0], force)
    yield 'added_mass_torque', error(ours[1], torque)

    model.geom_fluid[0, 6:12] = 0  # from here on no virtual mass

    def only(*coef: float) -> tuple[Array, Array]:
        model.geom_fluid[0, 1:6] = coef
        return engine(model, data, rho, 0.0)

    def linear(blunt: float, slender: float) -> Array:
        return drag.blunt_slender_drag(axes, v, density=rho, c_blunt=blunt, c_slender=slender)

    def angular(coef: float, slender: float) -> Array:
        return drag.angular_drag(axes, omega, density=rho, c_angular=coef, c_slender=slender)

    yield 'blunt_drag', error(linear(c_blunt, 0.0), only(c_blunt, 0, 0, 0, 0)[0])
    slender = only(0, c_slender, 0, 0, 0)[0]
    operand = c_slender * rho * projection.max_projected_area(axes) * (v @ v)
    difference = np.linalg.norm(linear(0.0, c_slender) - slender)
    yield 'slender_drag', float(difference / operand)
    yield 'slender_drag_to_result', float(difference / np.linalg.norm(slender))
    yield 'angular_drag', error(angular(c_angular, 0.0), only(0, 0, c_angular, 0, 0)[1])
    both = only(c_blunt, c_slender, c_angular, 0, 0)
    yield 'drag_force', error(linear(c_blunt, c_slender), both[0])
    yield 'drag_torque', error(angular(c_angular, c_slender), both[1])
    kutta = lift.kutta_force(axes, v, density=rho, c_kutta=c_kutta)
    yield 'kutta', error(kutta, only(0, 0, 0, c_kutta, 0)[0])
    magnus = lift.magnus_force(axes, v, omega, density=rho, c_magnus=c_magnus)
    yield 'magnus', error(magnus, only(0, 0, 0, 0, c_magnus)[0])

    force, torque = engine(model, data, 0.0, beta)
    ours = drag.viscous_resistance(axes, v, omega, beta)
    yield 'viscous_force', error(ours[0], force)
    yield 'viscous_torque', error(ours[1], torque)


def printed_case(rng: np.random.Generator) -> Iterator[tuple[str, float]]:
    """Yield how far the formulas as printed are from the engine, one body."""
    axes = 10 ** rng.uniform(-2, -1) * 10 ** rng.uniform(0, 1, size=3)
    model = mujoco.MjModel.from_xml_string(ELLIPSOID.format(size=text(axes)))
    data = mujoco.MjData(model)
    motion = place(model, data, rng)
    v, omega = motion.v_rel_b, motion.omega_b
    inertia_a = kappa.ellipsoid_added_mass(axes, 1.0)

    data.qvel[:3] = model.opt.wind  # no flow: the gyroscopic torque alone
    model.geom_fluid[0, 1:6] = 0
    torque = engine(model, data, 1.0, 0.0)[1]
    printed = printed_formulas.added_mass_coriolis_as_printed(*inertia_a, np.zeros(3), omega)[1]
    yield 'added_mass_torque_general_form', error(printed, torque)

    data.qvel[:3] = data.xmat[1].reshape(3, 3) @ v + model.opt.wind
    model.geom_fluid[0, 1:] = [0.5, 0.25, 1.5, 0, 0, *np.zeros(6)]
    force, torque = engine(model, data, 1.0, 0.0)
    printed = printed_formulas.blunt_slender_drag_as_printed(
        axes, v, density=1.0, c_blunt=0.5, c_slender=0.25
    )
    yield 'drag_maximal_area', error(printed, force)
    printed = printed_formulas.angular_drag_as_printed(
        axes, omega, density=1.0, c_angular=1.5, c_slender=0.25
    )
    yield 'angular_drag_dot_product', error(printed, torque)
    yield 'angular_drag_power_is_positive', float(printed @ omega > 0)

    # Read as kinematic, beta would be multiplied by the density to give Pa s.
    model.geom_fluid[0, 1:] = 0
    force = engine(model, data, motion.density, motion.viscosity)[0]
    printed = motion.density * drag.viscous_resistance(axes, v, omega, motion.viscosity)[0]
    yield 'viscosity_kinematic_factor', float(np.linalg.norm(printed) / np.linalg.norm(force))


def inertia_case(rng: np.random.Generator) -> Iterator[tuple[str, float]]:
    """Yield (term, relative error) of every inertia-model term for one random body."""
    half, mass = 10 ** rng.uniform(-2, 0, size=3), 10 ** rng.uniform(-1, 2)
    inertia = mass / 3 * ((half**2).sum() - half**2)
    model = mujoco.MjModel.from_xml_string(BOX.format(mass=text(mass), inertia=text(inertia)))
    # The compiler sorts the axes of diaginertia; without this the inertial frame is turned.
    model.body_inertia[1], model.body_iquat[1] = inertia, [1, 0, 0, 0]
    data = mujoco.MjData(model)
    motion = place(model, data, rng)
    v, omega = motion.v_rel_b, motion.omega_b
    box = inertia_box.equivalent_inertia_box(mass, inertia)
    force, torque = engine(model, data, motion.density, 0.0)
    ours = inertia_box.inertia_box_drag(box, v, omega, motion.density)
    yield 'inertia_drag_force', error(ours[0], force)
    yield 'inertia_drag_torque', error(ours[1], torque)
    force, torque = engine(model, data, 0.0, motion.viscosity)
    ours = inertia_box.inertia_box_viscous(box, v, omega, motion.viscosity)
    yield 'inertia_viscous_force', error(ours[0], force)
    yield 'inertia_viscous_torque', error(ours[1], torque)


Case = Callable[[np.random.Generator], Iterator[tuple[str, float]]]
ENGINE_CASES: tuple[Case, ...] = (ellipsoid_case, inertia_case)


def measure(
    cases: int, makes: tuple[Case, ...] = ENGINE_CASES, seed: int = 20260101
) -> dict[str, Array]:
    """Return term -> relative errors, shape (cases,), for a fixed seed."""
    rng = np.random.default_rng(seed)
    errors: dict[str, list[float]] = defaultdict(list)
    for _ in range(cases):
        for make in makes:
            for term, value in make(rng):
                errors[term].append(value)
    return {term: np.array(values) for term, values in errors.items()}


def main() -> None:
    """Measure, print a table and write the JSON."""
    options = arguments(__doc__, 'fluid_terms')
    cases = QUICK_CASES if options.quick else CASES
    errors = measure(cases)
    terms = {
        term: {
            'median': float(np.median(values)),
            'max': float(values.max()),
            'limit': LIMITS[term],
            'passed': bool(values.max() <= LIMITS[term]),
        }
        for term, values in errors.items()
    }
    printed = measure(cases, (printed_case,))
    result = {
        'what': 'relative error of physics/ against qfrc_fluid, per term',
        'numpy': np.__version__,
        'cases_per_term': cases,
        'terms': terms,
        'printed_against_engine': {
            name: {'mean': float(values.mean()), 'median': float(np.median(values))}
            for name, values in printed.items()
        },
    }
    write(options.json, result)
    for term, row in terms.items():
        verdict = 'ok' if row['passed'] else 'ABOVE LIMIT'
        print(f'{term:24} median {row["median"]:.1e}  max {row["max"]:.1e}  {verdict}')
    for name, values in printed.items():
        print(f'seed text, {name:32} mean {values.mean():.3g}  median {np.median(values):.3g}')
    if not all(row['passed'] for row in terms.values()):
        raise SystemExit('a term is above its limit')


if __name__ == '__main__':
    main()
