# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Problems of one rigid body whose equations SciPy solves: ideal fluid, vehicle, gliding wing."""

from typing import Any, NamedTuple

import numpy as np

from fluid_sim_ros.lab.problems.closed_forms import (
    WATER,
    G,
    ellipsoid_rungs,
    keyframe,
    scene_of,
)
from fluid_sim_ros.lab.problems.mjcf import body_plugin, config, free_body, text, world
from fluid_sim_ros.lab.problems.problem import Problem, Rung
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.physics.foil import WingParams, wing_wrench
from fluid_sim_ros.physics.fossen import damping_wrench
from fluid_sim_ros.physics.kappa import ellipsoid_added_mass, ellipsoid_volume
from fluid_sim_ros.physics.kirchhoff import (
    BodyWrench,
    impulses,
    kinetic_energy,
    kirchhoff_motion,
    rigid_body_matrix,
    rotation_wb,
)


def _start(nu: Any) -> Array:
    """Return the state of a level body at the origin with velocity and angular velocity."""
    start: Array = np.r_[np.zeros(3), 1, 0, 0, 0, np.asarray(nu, dtype=float)]
    return start


def kirchhoff() -> Problem:
    """Return a triaxial ellipsoid that tumbles in an ideal fluid."""
    axes, nu = np.array([0.5, 0.2, 0.1]), (1.0, 0.5, 0.3, 1.0, 2.0, 1.5)  # [m]; [m/s], [rad/s]
    mass = WATER * float(ellipsoid_volume(axes))
    mass_a, inertia_a = ellipsoid_added_mass(axes, WATER)
    inertia = mass / 5 * ((axes**2).sum() - axes**2)
    matrix = rigid_body_matrix(mass, inertia, np.zeros(3)) + np.diag(np.r_[mass_a, inertia_a])

    def reference(times: Array) -> Array:
        return kirchhoff_motion(_start(nu), times, matrix)[:, None]

    def invariants(times: Array, states: Array) -> dict[str, Array]:
        rows = list(zip(times, states[:, 0], strict=True))
        both = [impulses(time, state, matrix) for time, state in rows]
        return {
            'energy': np.array([kinetic_energy(state, matrix) for _, state in rows]),
            'linear_impulse': np.array([linear for linear, _ in both]),
            'angular_impulse': np.array([angular for _, angular in both]),
        }

    return Problem(
        name='kirchhoff', title='Neutral 5:2:1 ellipsoid tumbles in an ideal fluid',
        stands_for="Kirchhoff's equations (Lamb 1932, ch. 6): a body in a fluid without drag",
        duration=5.0, reference=reference, reference_kind='ODE (DOP853)', invariants=invariants,
        rungs=ellipsoid_rungs(
            'kirchhoff', axes, WATER, gravity=0, qvel=nu,
            rungs=('none', 'inertia', 'ellipsoid', '+ added inertia'),
        ),
    )  # fmt: skip


class Vehicle(NamedTuple):
    """An underwater vehicle by Fossen's model; 6 numbers: surge, sway, heave, roll, pitch, yaw."""

    mass: float  # [kg]
    inertia: tuple[float, ...]  # [kg m^2]
    added: tuple[float, ...]  # [kg], [kg m^2]
    linear: tuple[float, ...]  # [N s/m], [N m s]
    quadratic: tuple[float, ...]  # [N s^2/m^2], [N m s^2]
    volume: float  # displaced [m^3]
    height: float  # of the centre of buoyancy above that of mass [m]
    size: tuple[float, ...]  # semi-axes of an ellipsoid of that volume, for the stock models [m]


#: BlueROV2 Heavy, von Benzon et al. (2022), J. Mar. Sci. Eng. 10:1898, Table A1; centre of
#: buoyancy raised from .01 m so that it rolls and pitches visibly.
ROV = Vehicle(
    13.5, (0.26, 0.23, 0.37), (6.36, 7.12, 18.68, 0.189, 0.135, 0.222),
    (13.7, 0, 33, 0, 0.8, 0), (141, 217, 190, 1.19, 0.47, 1.5), 0.0134, 0.05,
    (0.1662, 0.2092, 0.0924),
)  # fmt: skip


def _vehicle_motion(vehicle: Vehicle, nu: Any, times: Array, flow_w: Any, thrust_b: Any) -> Array:
    """Return Fossen's motion in a uniform current, constant thrust wrench in body axes."""
    matrix = rigid_body_matrix(vehicle.mass, vehicle.inertia, np.zeros(3))
    matrix += np.diag(vehicle.added)
    d_linear, d_quadratic = np.diag(vehicle.linear), np.diag(vehicle.quadratic)
    weight, lift = vehicle.mass * G, WATER * vehicle.volume * G

    def wrench(_time: float, state: Array) -> Array:
        to_body = rotation_wb(state[3:7]).T
        nu_rel = np.r_[state[7:10] - to_body @ flow_w, state[10:13]]
        up = to_body[:, 2]
        restoring = np.r_[(lift - weight) * up, np.cross([0, 0, vehicle.height], lift * up)]
        return np.asarray(damping_wrench(d_linear, d_quadratic, nu_rel) + restoring + thrust_b)

    force: BodyWrench = wrench
    return kirchhoff_motion(_start(nu), times, matrix, flow_w, force)[:, None]


def _vehicle_rungs(
    name: str, vehicle: Vehicle, nu: Any, flow_w: Any = (0, 0, 0), thrust_b: Any = (0,) * 6
) -> dict[str, Rung]:
    """Return the rungs of a vehicle: stock ones are trimmed by gravcomp, as a user would."""
    own = {
        'volume': vehicle.volume, 'center_of_buoyancy': [0, 0, vehicle.height], 'drag': 'none',
        'linear_damping': vehicle.linear, 'quadratic_damping': vehicle.quadratic,
    }  # fmt: skip
    plugins: dict[str, dict[str, Any]] = {
        '+ buoyancy and damping': own,
        '+ added inertia': own | {'added_mass': vehicle.added},
    }
    # Cd 1.8 on the ellipsoid's own shadow holds the surge drag of the set
    shape = f'<geom type="ellipsoid" size="{text(vehicle.size)}" mass="0" contype="0" '
    coef = 'fluidshape="ellipsoid" fluidcoef="1.74 .74 2.2 0 0"'
    inertial = (
        f'<inertial pos="0 0 0" mass="{vehicle.mass}" diaginertia="{text(vehicle.inertia)}"/>'
    )
    ctrl = f'ctrl="{text(thrust_b)}"' if np.any(thrust_b) else ''
    gears = ''.join(f'<motor site="base" gear="{text(np.eye(6)[i])}"/>' for i in range(6) if ctrl)
    start = keyframe((0, 0, 0, 1, 0, 0, 0), nu, ctrl)
    out = {}
    for rung in ('none', 'inertia', 'ellipsoid', *plugins):
        inside = f'{inertial}{shape}{coef if rung == "ellipsoid" else ""}/><site name="base"/>'
        medium, option = None, f'density="{WATER}" wind="{text(flow_w)}"'
        body = free_body(inside)
        if rung in plugins:
            medium, option = {'density': WATER, 'current': flow_w}, ''
            body = free_body(inside + body_plugin(**plugins[rung]))
        else:
            trim = WATER * vehicle.volume / vehicle.mass
            body = body.replace('name="hull"', f'name="hull" gravcomp="{trim:.17g}"')
        if rung == 'none':
            option = ''
        extra = start + (f'<actuator>{gears}</actuator>' if ctrl else '')
        mjcf = world(body, gravity=(0, 0, -G), option=option, medium=medium, extra=extra)
        out[rung] = Rung(scene_of(name, mjcf))
    return out


def vehicle_in_current() -> Problem:
    """Return an underwater vehicle that is carried off by a current while it turns."""
    nu, flow = (0.5, 0.2, 0.0, 0.0, 0.0, 0.6), (0.3, -0.2, 0.0)  # [m/s], [rad/s]; [m/s]
    return Problem(
        name='vehicle_in_current', title='Underwater vehicle turns in a current',
        stands_for="Fossen's (2021) model with a uniform current; drift test of a BlueROV2 Heavy",
        duration=5.0, reference_kind='ODE (DOP853)',
        reference=lambda times: _vehicle_motion(ROV, nu, times, flow, np.zeros(6)),
        rungs=_vehicle_rungs('vehicle_in_current', ROV, nu, flow),
    )  # fmt: skip


def rov_step() -> Problem:
    """Return an underwater vehicle at rest whose thrust is switched on."""
    nu, thrust = np.zeros(6), np.array([40.0, 15.0, 0.0, 0.0, 0.0, 0.5])  # [N], [N m]
    return Problem(
        name='rov_step', title='Underwater vehicle answers a step of thrust',
        stands_for='step response in a tank; surge, sway and yaw of a BlueROV2 Heavy',
        duration=5.0, reference_kind='ODE (DOP853)',
        reference=lambda times: _vehicle_motion(ROV, nu, times, np.zeros(3), thrust),
        rungs=_vehicle_rungs('rov_step', ROV, nu, thrust_b=thrust),
    )  # fmt: skip


def foil_glide() -> Problem:
    """Return a small glider, wing and tailplane, that pulls out of a dive into its phugoid."""
    mass, inertia = 1.0, (0.05, 0.08, 0.12)  # [kg], [kg m^2]
    air = 1.225  # [kg/m^3], ISA at sea level
    wing: dict[str, Any] = {'span': 2.0, 'chord': 0.2, 'drag_0': 0.02, 'lift_0': 0.3}  # [m]
    tail: dict[str, Any] = {'span': 0.6, 'chord': 0.12, 'drag_0': 0.02}
    places = {'wing': np.array([0.01, 0.0, 0.0]), 'tail': np.array([-0.7, 0.0, 0.0])}  # [m]
    nu = (12.0, 0.0, 0.0, 0.0, 0.0, 0.0)  # [m/s]
    foils = {
        name: WingParams(area=values['span'] * values['chord'], **values)
        for name, values in (('wing', wing), ('tail', tail))
    }

    def wrench(_time: float, state: Array) -> Array:
        total: Array = np.r_[rotation_wb(state[3:7]).T @ [0, 0, -mass * G], np.zeros(3)]
        for name, foil in foils.items():
            velocity = state[7:10] + np.cross(state[10:13], places[name])
            force, torque = wing_wrench(foil, velocity, state[10:13], density=air)
            total += np.r_[force, torque + np.cross(places[name], force)]
        return total

    def reference(times: Array) -> Array:
        matrix = rigid_body_matrix(mass, inertia, np.zeros(3))
        return kirchhoff_motion(_start(nu), times, matrix, wrench=wrench)[:, None]

    inside = f'<inertial pos="0 0 0" mass="{mass}" diaginertia="{text(inertia)}"/>' + ''.join(
        f'<site name="{name}" pos="{text(place)}"/>' for name, place in places.items()
    )
    instances = ''.join(
        f'<instance name="{name}">{config({"site": name, **values})}</instance>'
        for name, values in (('wing', wing), ('tail', tail))
    )
    plain = world(free_body(inside), gravity=(0, 0, -G), extra=keyframe((0, 0, 0, 1, 0, 0, 0), nu))
    medium = f'<instance name="air">{config({"density": air})}</instance>'
    foiled = plain.replace(
        '</extension>',
        f'<plugin plugin="fluid_sim.medium">{medium}</plugin>'
        f'<plugin plugin="fluid_sim.foil">{instances}</plugin></extension>',
    )
    stock = plain.replace('timestep=', f'density="{air}" timestep=')
    return Problem(
        name='foil_glide', title='Glider pulls out into its phugoid',
        stands_for='glide of a model sailplane; wing and tail by Helmbold (1942), phugoid of '
        'Lanchester (1908)',
        duration=4.0, reference=reference, reference_kind='ODE (DOP853)',
        rungs={
            'none': Rung(scene_of('foil_glide', plain)),
            'inertia': Rung(scene_of('foil_glide', stock)),
            '+ foils': Rung(scene_of('foil_glide', foiled)),
        },
    )  # fmt: skip
