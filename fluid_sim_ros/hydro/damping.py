# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Damping of a body from its mesh: form drag, skin friction, and both of a turning body.

Form drag along an axis is rho/2 C_d A v^2 with the area A of the shadow. Friction follows the
ITTC line of 1957, C_f = 0.075/(log10 Re - 2)^2, over the wetted area. A turning body is cut into
strips: each piece of the surface that moves outward by v_n = n . (omega x r) feels
rho/2 C(n) v_n^2, and C(n) = sum n_k^2 C_k is such that motion along axis k gives the form drag of
that axis. A box then has rho/2 C_d s a^4/32 for each face, and a body of revolution none about
its axis.
"""

from dataclasses import dataclass

import numpy as np

from fluid_sim_ros.hydro.drag_classes import (
    CLASSES,
    FACING,
    DragClass,
    class_of,
    given_class,
    slender_class,
)
from fluid_sim_ros.hydro.meshes.surface import area_vectors
from fluid_sim_ros.hydro.statics import Statics
from fluid_sim_ros.physics.arrays import Array

#: Guess: speed [m/s] and rate [rad/s] at which linear and quadratic damping are equal.
LINEAR_BELOW = 0.1
#: Below this Reynolds number the ITTC line is not used (log10 Re - 2 grows small).
_LOWEST_REYNOLDS = 1e4
_POINTS = np.array([[2 / 3, 1 / 6, 1 / 6], [1 / 6, 2 / 3, 1 / 6], [1 / 6, 1 / 6, 2 / 3]])


@dataclass(frozen=True)
class AxisDrag:
    """
    Drag along one axis.

    Attributes
    ----------
    shape
        Class of the shape, with C_d, its range and its source.
    shadow
        Area of the shadow [m^2].
    rubbed
        Area that friction acts on, the wetted one times the share along the flow [m^2].
    reynolds
        At the reference speed [-].
    friction
        C_f [-].
    form, rub
        Coefficients of v^2 [N s^2/m^2].

    """

    shape: DragClass
    shadow: float
    rubbed: float
    reynolds: float
    friction: float
    form: float
    rub: float

    @property
    def total(self) -> float:
        """Form drag and friction [N s^2/m^2]."""
        return self.form + self.rub

    def bounds(self) -> tuple[float, float]:
        """
        Return the range of the total that the published coefficients leave.

        Returns
        -------
        low, high
            [N s^2/m^2].

        """
        scale = self.form / self.shape.coefficient
        return scale * self.shape.low + self.rub, scale * self.shape.high + self.rub


@dataclass(frozen=True)
class Damping:
    """
    Damping of a body, diagonal, about a point.

    Attributes
    ----------
    axes
        Drag along x, y and z.
    speed
        Reference speed of the friction [m/s].
    quadratic, low, high
        Coefficients of v abs(v), and their range: [N s^2/m^2] x 3, [N m s^2] x 3; shape (6,).
    linear
        Coefficients of v, a guess: [N s/m] x 3, [N m s] x 3; shape (6,).

    """

    axes: tuple[AxisDrag, AxisDrag, AxisDrag]
    speed: float
    quadratic: Array
    low: Array
    high: Array
    linear: Array

    def top_speeds(self, thrust: float) -> Array:
        """
        Return the steady speed along each axis under a thrust.

        Parameters
        ----------
        thrust
            [N].

        Returns
        -------
        With the highest, the taken and the lowest drag [m/s], shape (3, 3), a row per axis.

        """
        drag = np.stack([self.high[:3], self.quadratic[:3], self.low[:3]], axis=1)
        speeds: Array = np.sqrt(thrust / drag)
        return speeds


def ittc_friction(reynolds: float) -> float:
    """
    Return the friction coefficient of the ITTC-1957 line.

    Parameters
    ----------
    reynolds
        [-]; below 1e4 the value at 1e4 is returned.

    Returns
    -------
    C_f = 0.075/(log10 Re - 2)^2 [-], by the wetted area.

    """
    return float(0.075 / (np.log10(max(reynolds, _LOWEST_REYNOLDS)) - 2) ** 2)


def damping_of(
    triangles: Array,
    statics: Statics,
    shadows: Array,
    point: Array,
    density: float,
    viscosity: float,
    *,
    speed: float = 1.0,
    coefficients: Array | None = None,
) -> Damping:
    """
    Return the damping of a body.

    Parameters
    ----------
    triangles
        Fine enough for the strips, faces outward, mesh axes [m], shape (m, 3, 3).
    statics
        Of the body.
    shadows
        Projected areas along the axes [m^2], shape (3,).
    point
        About which it turns, mesh axes [m], shape (3,).
    density, viscosity
        Of the fluid [kg/m^3], [Pa s].
    speed
        At which friction is taken [m/s].
    coefficients
        C_d along x, y, z by the shadow [-], shape (3,); None: by the shape.

    Returns
    -------
    Damping
        In mesh axes.

    """
    vectors = area_vectors(triangles)
    area = np.linalg.norm(vectors, axis=1)
    normals = vectors / np.maximum(area, 1e-300)[:, None]
    axes = tuple(
        _axis_drag(k, normals, area, statics, shadows, density, viscosity, speed,
                   None if coefficients is None else float(coefficients[k]))
        for k in range(3)
    )  # fmt: skip
    form = np.array([axis.form for axis in axes])
    turning, rubbing = _turning(triangles, normals, area, point, form, axes, density)
    quadratic = np.r_[[axis.total for axis in axes], turning + rubbing]
    bounds = np.array([axis.bounds() for axis in axes])
    ranges = [
        np.r_[bounds[:, side], _turning(triangles, normals, area, point,
              bounds[:, side] - [axis.rub for axis in axes], axes, density)[0] + rubbing]
        for side in (0, 1)
    ]  # fmt: skip
    return Damping(
        (axes[0], axes[1], axes[2]), speed, quadratic, ranges[0], ranges[1],
        LINEAR_BELOW * quadratic,
    )  # fmt: skip


def _axis_drag(
    axis: int,
    normals: Array,
    area: Array,
    statics: Statics,
    shadows: Array,
    density: float,
    viscosity: float,
    speed: float,
    coefficient: float | None,
) -> AxisDrag:
    across = np.abs(normals[:, axis])
    facing = float((across * area)[across > FACING].sum() / (across * area).sum())
    shadow = float(shadows[axis])
    reynolds = density * speed * float(statics.size[axis]) / viscosity
    friction = ittc_friction(reynolds)
    if coefficient is not None:
        shape = given_class(coefficient)
    else:
        name = class_of(facing, shadow, statics.size, axis)
        slenderness = float(statics.size[axis] / np.sqrt(4 * shadow / np.pi))
        shape = (
            slender_class(slenderness, friction, statics.wetted_area / shadow)
            if name == 'slender'
            else CLASSES[name]
        )
    rubbed = float(((1 - across**2) * area).sum())
    half = 0.5 * density
    return AxisDrag(
        shape, shadow, rubbed, reynolds, friction, half * shape.coefficient * shadow,
        half * friction * rubbed,
    )  # fmt: skip


def _turning(
    triangles: Array,
    normals: Array,
    area: Array,
    point: Array,
    form: Array,
    axes: tuple[AxisDrag, ...],
    density: float,
) -> tuple[Array, Array]:
    """Return the quadratic moments of form drag and of friction about x, y, z [N m s^2]."""
    # both ends of an axis alike: half of |n|^3 over the whole surface
    straight = 0.5 * density * 0.5 * (np.abs(normals) ** 3 * area[:, None]).sum(axis=0)
    per_axis = form / np.maximum(straight, 1e-300)
    local = 0.5 * density * (normals**2 @ per_axis) * area
    friction = 0.5 * density * (normals**2 @ [axis.friction for axis in axes]) * area
    pressure, rub = np.zeros(3), np.zeros(3)
    for weights in _POINTS:
        arms = np.einsum('k,fkd->fd', weights, triangles) - point
        for k in range(3):
            velocity = np.cross(np.eye(3)[k], arms)
            outwards = np.maximum(np.einsum('ij,ij->i', normals, velocity), 0)
            pressure[k] += (local * outwards**3).sum() / len(_POINTS)
            along = velocity - np.einsum('ij,ij->i', normals, velocity)[:, None] * normals
            rub[k] += (friction * np.linalg.norm(along, axis=1) ** 3).sum() / len(_POINTS)
    return pressure, rub
