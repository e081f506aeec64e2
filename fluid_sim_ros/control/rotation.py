# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Rotations as nine floats: a control step has no time for array objects.

A rotation matrix R_wb (columns: body axes in world axes) is the tuple
``(r00, r01, r02, r10, r11, r12, r20, r21, r22)``.
"""

import math
from collections.abc import Sequence

Rotation = tuple[float, float, float, float, float, float, float, float, float]
Vector3 = tuple[float, float, float]


def from_quaternion(quat_wb_wxyz: Sequence[float]) -> Rotation:
    """
    Return R_wb of a quaternion; its norm is divided out.

    Parameters
    ----------
    quat_wb_wxyz
        Body to world, scalar first, of any norm above 0, shape (4,).

    Returns
    -------
    tuple
        R_wb, nine numbers row by row.

    """
    w, x, y, z = quat_wb_wxyz
    s = 2.0 / (w * w + x * x + y * y + z * z)
    xs, ys, zs = x * s, y * s, z * s
    wx, wy, wz = w * xs, w * ys, w * zs
    xx, xy, xz = x * xs, x * ys, x * zs
    yy, yz, zz = y * ys, y * zs, z * zs
    return (
        1.0 - yy - zz, xy - wz, xz + wy,
        xy + wz, 1.0 - xx - zz, yz - wx,
        xz - wy, yz + wx, 1.0 - xx - yy,
    )  # fmt: skip


def from_yaw(yaw: float) -> Rotation:
    """
    Return R_wb of a level body.

    Parameters
    ----------
    yaw
        Heading [rad], counter-clockwise from east (ENU).

    Returns
    -------
    tuple
        R_wb, nine numbers row by row.

    """
    c, s = math.cos(yaw), math.sin(yaw)
    return (c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0)


def from_thrust_axis(axis_w: Vector3, yaw: float) -> Rotation:
    """
    Return the attitude whose z axis is ``axis_w`` and whose y axis is normal to the heading.

    Mellinger and Kumar (2011), ICRA, eq. 7: z_b = axis, y_b = z_b x x_c / |.|, x_b = y_b x z_b.

    Parameters
    ----------
    axis_w
        Direction of the body's z axis, world axes, unit length, within 90 deg of up.
    yaw
        Heading [rad], counter-clockwise from east.

    Returns
    -------
    tuple
        R_wb, nine numbers row by row.

    """
    c, s = math.cos(yaw), math.sin(yaw)
    ax, ay, az = axis_w
    # axis x (c, s, 0); its length is at least az, which is above 0
    yx, yy, yz = -az * s, az * c, ax * s - ay * c
    inverse = 1.0 / math.sqrt(yx * yx + yy * yy + yz * yz)
    yx, yy, yz = yx * inverse, yy * inverse, yz * inverse
    return (
        yy * az - yz * ay, yx, ax,
        yz * ax - yx * az, yy, ay,
        yx * ay - yy * ax, yz, az,
    )  # fmt: skip


def error(desired: Rotation, actual: Rotation) -> Vector3:
    """
    Return the rotation vector that turns the actual attitude into the desired one, body axes.

    The logarithm of R^T R_d [rad]; its length is the angle, up to pi. At a half turn, where the
    axis is not unique, the result keeps the length of the largest error short of it.

    Parameters
    ----------
    desired, actual
        R_wb that is wanted, and that there is.

    Returns
    -------
    tuple
        [rad], body axes of the actual attitude, shape (3,).

    """
    # names, as places in a tuple take longer to look up than the arithmetic
    a00, a01, a02, a10, a11, a12, a20, a21, a22 = actual
    b00, b01, b02, b10, b11, b12, b20, b21, b22 = desired
    # E = R^T R_d; of its antisymmetric part sin(angle) axis, of its trace 1 + 2 cos(angle)
    e21 = a02 * b01 + a12 * b11 + a22 * b21
    e12 = a01 * b02 + a11 * b12 + a21 * b22
    e02 = a00 * b02 + a10 * b12 + a20 * b22
    e20 = a02 * b00 + a12 * b10 + a22 * b20
    e10 = a01 * b00 + a11 * b10 + a21 * b20
    e01 = a00 * b01 + a10 * b11 + a20 * b21
    e00 = a00 * b00 + a10 * b10 + a20 * b20
    e11 = a01 * b01 + a11 * b11 + a21 * b21
    e22 = a02 * b02 + a12 * b12 + a22 * b22
    x, y, z = 0.5 * (e21 - e12), 0.5 * (e02 - e20), 0.5 * (e10 - e01)
    sine = math.sqrt(x * x + y * y + z * z)
    cosine = 0.5 * (e00 + e11 + e22 - 1.0)
    if sine > 1e-9:
        scale = math.atan2(sine, cosine) / sine
        return (x * scale, y * scale, z * scale)
    if cosine > 0.0:
        return (x, y, z)
    # half turn: E = 2 u u^T - 1, so the largest diagonal entry gives the axis
    if e00 >= e11 and e00 >= e22:
        return (math.pi, 0.0, 0.0)
    return (0.0, math.pi, 0.0) if e11 >= e22 else (0.0, 0.0, math.pi)


def to_body(rotation_wb: Rotation, vector_w: Sequence[float]) -> Vector3:
    """
    Return R_wb^T v: world axes to body axes.

    Parameters
    ----------
    rotation_wb
        R_wb.
    vector_w
        Of any unit, world axes, shape (3,).

    Returns
    -------
    tuple
        The same vector in body axes.

    """
    (r00, r01, r02, r10, r11, r12, r20, r21, r22), (x, y, z) = rotation_wb, vector_w
    return (
        r00 * x + r10 * y + r20 * z,
        r01 * x + r11 * y + r21 * z,
        r02 * x + r12 * y + r22 * z,
    )


def to_world(rotation_wb: Rotation, vector_b: Sequence[float]) -> Vector3:
    """
    Return R_wb v: body axes to world axes.

    Parameters
    ----------
    rotation_wb
        R_wb.
    vector_b
        Of any unit, body axes, shape (3,).

    Returns
    -------
    tuple
        The same vector in world axes.

    """
    (r00, r01, r02, r10, r11, r12, r20, r21, r22), (x, y, z) = rotation_wb, vector_b
    return (
        r00 * x + r01 * y + r02 * z,
        r10 * x + r11 * y + r12 * z,
        r20 * x + r21 * y + r22 * z,
    )


def yaw_of(rotation_wb: Rotation) -> float:
    """
    Return the heading of the body's x axis [rad], counter-clockwise from east.

    Parameters
    ----------
    rotation_wb
        R_wb.

    """
    return math.atan2(rotation_wb[3], rotation_wb[0])


def roll_of(rotation_wb: Rotation) -> float:
    """
    Return the roll about the body's x axis [rad], right side down; 0 when level.

    Parameters
    ----------
    rotation_wb
        R_wb.

    """
    return math.atan2(rotation_wb[7], rotation_wb[8])


def elevation_of(rotation_wb: Rotation) -> float:
    """
    Return the angle of the body's x axis above the horizon [rad]: pitch, nose up.

    Parameters
    ----------
    rotation_wb
        R_wb.

    """
    return math.asin(min(max(rotation_wb[6], -1.0), 1.0))


def wrap(angle: float) -> float:
    """
    Return the same angle in [-pi, pi].

    Parameters
    ----------
    angle
        [rad].

    """
    return math.remainder(angle, math.tau)
