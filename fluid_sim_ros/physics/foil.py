# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Wings and fins: section and wing coefficients at every angle, and the forces of the local flow.

The twin of ``fluid_sim.foil`` with kind wing. Foil axes: x towards the leading edge, y along the
span to the left, z up. Angles of attack are positive when the flow comes from below, in
-pi..pi; beyond 90 deg the flow comes from the trailing edge.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.physics.arrays import Array, Wrench, not_negative, positive, vectors


def helmbold_slope(aspect_ratio: ArrayLike, section_slope: ArrayLike = 2 * np.pi) -> Array:
    """
    Return the lift slope of a straight wing [1/rad].

    a = a0/(sqrt(1 + k^2) + k), k = a0/(pi AR); Helmbold (1942). Right at both ends: a0 for a long
    wing, pi AR/2 for a short one (Jones 1946). Unswept wings in incompressible flow.

    Parameters
    ----------
    aspect_ratio
        AR = span^2/area [-], shape (...).
    section_slope
        a0 [1/rad]; 2 pi for a thin section.

    """
    slope = not_negative(section_slope, 'section_slope [1/rad]')
    k = slope / (np.pi * positive(aspect_ratio, 'aspect_ratio'))
    wing: Array = slope / (np.sqrt(1 + k * k) + k)
    return wing


def attached_share(alpha: ArrayLike, stall_angle: ArrayLike, sharpness: ArrayLike) -> Array:
    """
    Return the share of attached flow, 1 between the stall angles and 0 beyond.

    1/((1 + e^(M(a - a0))) (1 + e^(-M(a + a0)))), which is 1 - sigma of Beard and McLain (2012),
    eq. 4.10, written so that nothing overflows. Even in alpha.

    Parameters
    ----------
    alpha, stall_angle
        [rad], shape (...).
    sharpness
        M [1/rad].

    """
    a, m = np.asarray(alpha, dtype=np.float64), np.asarray(sharpness, dtype=np.float64)
    stall = np.asarray(stall_angle, dtype=np.float64)
    share: Array = 1 / ((1 + np.exp(m * (a - stall))) * (1 + np.exp(-m * (a + stall))))
    return share


def plate_coefficients(
    alpha: ArrayLike, normal: ArrayLike = 2.0, power: int = 2
) -> tuple[Array, Array]:
    """
    Return lift and drag coefficient of a stalled plate.

    Its force is normal to it, C_N = Cn sgn(sin a) |sin a|^p: C_L = C_N cos a, C_D = C_N sin a.
    p = 2 is Newton's plate (Beard and McLain 2012, eq. 4.9, Cn = 2); p = 1 fits thin plates whose
    leading-edge vortex stays (Dickinson et al. 1999). C_L is odd, C_D even and never negative.

    Parameters
    ----------
    alpha
        [rad], any, shape (...).
    normal
        Cn, normal force coefficient at 90 deg [-].
    power
        p, 1 or 2.

    """
    if power not in (1, 2):
        raise ConfigError(f'power: {power}; allowed: 1, 2')
    sine = np.sin(alpha)
    force = np.asarray(normal) * np.sign(sine) * np.abs(sine) ** power
    return force * np.cos(alpha), force * sine


@dataclass(frozen=True)
class WingParams:
    """Constants of a wing; names, units and defaults are those of ``fluid_sim.foil``."""

    area: float  # [m^2]
    span: float  # [m]
    chord: float  # [m]
    aspect_ratio: float | None = None  # span^2/area
    lift_slope: float | None = None  # [1/rad], None: Helmbold of a thin section
    lift_0: float = 0.0
    drag_0: float = 0.0
    pitch_0: float = 0.0
    efficiency: float = 1.0
    reverse: float = 1.0
    stall_angle: float = 0.26  # [rad]
    stall_sharpness: float = 50.0  # [1/rad]
    plate_normal: float = 2.0
    plate_power: int = 2
    lift_delta: float = 0.0  # [1/rad]
    drag_delta: float = 0.0
    pitch_delta: float = 0.0
    moving_center: bool = False
    velocity_point: float = 0.0  # [chords]
    panels: int = 1

    @property
    def ratio(self) -> float:
        """Aspect ratio [-]."""
        return self.aspect_ratio or self.span**2 / self.area

    @property
    def slope(self) -> float:
        """Lift slope of the attached flow [1/rad]."""
        return float(helmbold_slope(self.ratio)) if self.lift_slope is None else self.lift_slope


class WingCoefficients(NamedTuple):
    """Lift, drag, pitching moment (nose up) [-], centre of pressure [chords behind the site]."""

    lift: Array
    drag: Array
    pitch: Array
    center: Array


def wing_coefficients(
    wing: WingParams, alpha: ArrayLike, deflection: ArrayLike = 0.0
) -> WingCoefficients:
    """
    Return the coefficients at any angle of attack.

    Attached (share s): C_L = lift_0 + lift_slope a + lift_delta d, C_D = C_L^2/(pi e AR), and in
    flow from behind C_L = reverse (lift_slope a' - lift_0) with a' counted from the trailing edge
    (a flap there is at the wrong end and does little). Stalled (1 - s): `plate_coefficients`. In
    both: drag_0 + drag_delta |d|, stalled times cos^2 a, for friction acts along the chord.

    A moving centre of pressure goes from the site (quarter chord) to half a chord when stalled,
    to three quarters in attached flow from behind.

    Parameters
    ----------
    wing
        Constants.
    alpha
        [rad], -pi..pi, shape (...).
    deflection
        d, trailing edge down [rad], shape (...).

    """
    a, d = np.broadcast_arrays(
        np.asarray(alpha, dtype=np.float64), np.asarray(deflection, dtype=np.float64)
    )
    reversed_flow = np.abs(a) > np.pi / 2
    angle = np.where(reversed_flow, a - np.copysign(np.pi, a), a)
    share = attached_share(angle, wing.stall_angle, wing.stall_sharpness)
    ahead = wing.lift_0 + wing.slope * angle + wing.lift_delta * d
    linear = np.where(reversed_flow, wing.reverse * (wing.slope * angle - wing.lift_0), ahead)
    plate_lift, plate_drag = plate_coefficients(a, wing.plate_normal, wing.plate_power)
    induced = linear**2 / (np.pi * wing.efficiency * wing.ratio)
    friction = (wing.drag_0 + wing.drag_delta * np.abs(d)) * (share + (1 - share) * np.cos(a) ** 2)
    drag = friction + share * induced + (1 - share) * plate_drag
    moment = np.where(
        reversed_flow, -wing.reverse * wing.pitch_0, wing.pitch_0 + wing.pitch_delta * d
    )
    center = share * np.where(reversed_flow, 0.5, 0.0) + 0.25 * (1 - share)
    return WingCoefficients(
        share * linear + (1 - share) * plate_lift, drag, share * moment,
        center * (1.0 if wing.moving_center else 0.0),
    )  # fmt: skip


def wing_wrench(
    wing: WingParams,
    v_rel_b: ArrayLike,
    omega_b: ArrayLike = (0.0, 0.0, 0.0),
    *,
    density: float,
    deflection: float = 0.0,
) -> Wrench:
    """
    Return force and torque about the site.

    Per panel, f = rho/2 S |v| (C_L (-v_z, v_x) - C_D (v_x, v_z)) in the section's plane, v the
    velocity of the panel's point relative to the fluid without its part along the span
    (independence principle). Zero at rest without a division. Dissipates through C_D only.

    Parameters
    ----------
    wing
        Constants.
    v_rel_b, omega_b
        Velocity of the site relative to the fluid [m/s] and angular velocity [rad/s], foil axes,
        shape (3,).
    density
        [kg/m^3].
    deflection
        [rad].

    Returns
    -------
    force_b, torque_b
        [N], [N m], foil axes, shape (3,) each.

    """
    force, torque = np.zeros(3), np.zeros(3)
    v_site, omega = vectors(v_rel_b, 'v_rel_b'), vectors(omega_b, 'omega_b')
    width = wing.span / wing.panels
    for y in (np.arange(wing.panels) + 0.5) * width - wing.span / 2:
        v = v_site + np.cross(omega, [-wing.velocity_point * wing.chord, y, 0.0])
        c = wing_coefficients(wing, np.arctan2(-v[2], v[0]), deflection)
        speed = np.hypot(v[0], v[2])
        scale = 0.5 * density * wing.area / wing.panels * speed
        part = scale * np.array([
            -c.lift * v[2] - c.drag * v[0], 0.0, c.lift * v[0] - c.drag * v[2]
        ])  # fmt: skip
        force += part
        torque += np.cross([-float(c.center) * wing.chord, y, 0.0], part)
        torque[1] -= scale * speed * wing.chord * c.pitch
    return force, torque
