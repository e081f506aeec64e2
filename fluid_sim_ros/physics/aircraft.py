# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Whole aircraft by stability and control derivatives: the set of Beard and McLain.

The twin of ``fluid_sim.foil`` with kind aircraft. Body axes x forward, y left, z up (FLU); the
derivatives keep their usual signs for axes forward, right, down.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.physics.arrays import Wrench, vectors
from fluid_sim_ros.physics.foil import attached_share, plate_coefficients

Four = tuple[float, float, float, float]
Six = tuple[float, float, float, float, float, float]
_NONE4: Four = (0.0, 0.0, 0.0, 0.0)
_NONE6: Six = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True)
class AircraftParams:
    """Derivatives [-] or [1/rad]: static, alpha or beta, rate(s), deflection(s)."""

    area: float  # [m^2]
    span: float  # [m]
    chord: float  # [m]
    efficiency: float | None = None  # None: no induced drag
    lift: Four = _NONE4  # 0, alpha, q, elevator
    drag: Four = _NONE4
    pitch: Four = _NONE4
    side: Six = _NONE6  # 0, beta, p, r, aileron, rudder
    roll: Six = _NONE6
    yaw: Six = _NONE6
    stall_angle: float = 0.26  # [rad]
    stall_sharpness: float = 50.0  # [1/rad]


def aircraft_wrench(
    aircraft: AircraftParams,
    v_rel_b: ArrayLike,
    omega_b: ArrayLike = (0.0, 0.0, 0.0),
    *,
    density: float,
    deflection: ArrayLike = (0.0, 0.0, 0.0),
) -> Wrench:
    """
    Return force and torque about the reference point of a coefficient set.

    Beard and McLain (2012), Small Unmanned Aircraft, ch. 4: lift, drag and pitching moment linear
    in alpha, q and the elevator, lift blended to a plate beyond the stall; side force, roll and
    yaw linear in beta, p, r, aileron, rudder. Drag is drag_0 + drag_alpha alpha, with
    ``efficiency`` also (lift_0 + lift_alpha alpha)^2/(pi e AR); give one of the two.

    Beyond the book, where its lines would run away: past the stall, drag is blended to the
    plate's, alpha in the pitching moment to sin alpha, and controls and q in lift and drag fade
    out as the flow comes from behind. Below the stall angle the difference is that of the share of
    attached flow from 1 (1e-6 at 0.27 rad below it for M = 50). Zero at rest without a division.

    Parameters
    ----------
    aircraft
        Constants.
    v_rel_b, omega_b
        Velocity of the reference point relative to the fluid [m/s] and angular velocity [rad/s],
        FLU axes, shape (3,).
    density
        [kg/m^3].
    deflection
        Aileron, elevator, rudder [rad], signs of the set, shape (3,).

    Returns
    -------
    force_b, torque_b
        [N], [N m], FLU axes, shape (3,) each.

    """
    flip = np.array([1.0, -1.0, -1.0])
    u, v, w = flip * vectors(v_rel_b, 'v_rel_b')
    p, q, r = flip * vectors(omega_b, 'omega_b')
    speed = np.sqrt(u * u + v * v + w * w)
    alpha, beta = np.arctan2(w, u), np.arctan2(v, np.hypot(u, w))
    share = attached_share(alpha, aircraft.stall_angle, aircraft.stall_sharpness)
    sine, cosine = np.sin(alpha), np.cos(alpha)
    ahead = share + (1 - share) * max(cosine, 0.0)
    aileron, elevator, rudder = ahead * vectors(deflection, 'deflection')
    plate_lift, plate_drag = plate_coefficients(alpha)

    linear = aircraft.lift[0] + aircraft.lift[1] * alpha
    c_lift = share * linear + (1 - share) * plate_lift + aircraft.lift[3] * elevator
    c_drag = aircraft.drag[0] + share * aircraft.drag[1] * alpha + (1 - share) * plate_drag
    c_drag += aircraft.drag[3] * elevator
    if aircraft.efficiency is not None:
        ratio = aircraft.span**2 / aircraft.area
        c_drag += share * linear**2 / (np.pi * aircraft.efficiency * ratio)
    c_pitch = aircraft.pitch[0] + aircraft.pitch[3] * elevator
    c_pitch += aircraft.pitch[1] * (share * alpha + (1 - share) * sine)

    half = 0.5 * density * aircraft.area * speed
    pitching, rolling, yawing = (
        length * rate / 2
        for length, rate in ((aircraft.chord, q), (aircraft.span, p), (aircraft.span, r))
    )
    lift = half * (speed * c_lift + ahead * aircraft.lift[2] * pitching)
    drag = half * (speed * c_drag + ahead * aircraft.drag[2] * pitching)
    pitch = half * aircraft.chord * (speed * c_pitch + aircraft.pitch[2] * pitching)
    side, roll, yaw = (
        half * (speed * (c[0] + c[1] * beta + c[4] * aileron + c[5] * rudder)
                + c[2] * rolling + c[3] * yawing)
        for c in (aircraft.side, aircraft.roll, aircraft.yaw)
    )  # fmt: skip
    force = np.array([lift * sine - drag * cosine, side, -drag * sine - lift * cosine])
    torque = np.array([aircraft.span * roll, pitch, aircraft.span * yaw])
    return flip * force, flip * torque
