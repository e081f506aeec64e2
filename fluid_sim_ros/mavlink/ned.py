# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Between the axes of this package (ENU, FLU) and those of autopilots (NED, FRD).

World: north = y, east = x, down = -z. Body: forward = x, right = -y, down = -z. Both changes are
rotations that are their own inverse. Plain floats: these run at every exchange.
"""

import math
from collections.abc import Sequence

Vector3 = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]

_HALF = math.sqrt(0.5)
#: Sine of the pitch beyond which the nose counts as straight up or down (0.0001 degrees off).
_STRAIGHT = 1.0 - 1e-12


def enu_to_ned(vector: Sequence[float]) -> Vector3:
    """
    Return a world vector in NED axes (the same rule leads back).

    Parameters
    ----------
    vector
        ENU axes, three numbers of any unit.

    Returns
    -------
    vector_ned
        NED axes, the same unit.

    """
    return (vector[1], vector[0], -vector[2])


def flu_to_frd(vector: Sequence[float]) -> Vector3:
    """
    Return a body vector in FRD axes (the same rule leads back).

    Parameters
    ----------
    vector
        FLU axes, three numbers of any unit.

    Returns
    -------
    vector_frd
        FRD axes, the same unit.

    """
    return (vector[0], -vector[1], -vector[2])


def attitude_to_ned(quat_wb_wxyz: Sequence[float]) -> Quaternion:
    """
    Return the rotation FRD to NED of a rotation FLU to ENU, both scalar first.

    q_ned_frd = q_ned_enu q_enu_flu q_flu_frd, with half turns about (1, 1, 0)/sqrt 2 and about x.
    A vehicle that heads east, the identity here, has a yaw of +90 degrees there.

    Parameters
    ----------
    quat_wb_wxyz
        Rotation of body (FLU) to world (ENU) vectors, scalar first, four numbers.

    Returns
    -------
    quaternion
        Rotation of FRD to NED vectors, scalar first.

    """
    w, x, y, z = quat_wb_wxyz
    return (_HALF * (w + z), _HALF * (x + y), _HALF * (x - y), _HALF * (w - z))


def euler(quat_wxyz: Sequence[float]) -> Vector3:
    """
    Return roll, pitch and yaw [rad] (about z, then y, then x) of a unit quaternion.

    With the nose straight up or down, where roll and yaw are one angle, roll is 0.

    Parameters
    ----------
    quat_wxyz
        Unit quaternion, scalar first, four numbers.

    Returns
    -------
    roll, pitch, yaw
        [rad]; pitch from -pi/2 to pi/2, the others from -pi to pi.

    """
    w, x, y, z = quat_wxyz
    sine = 2.0 * (w * y - z * x)
    if abs(sine) > _STRAIGHT:
        yaw = math.remainder(-2.0 * math.copysign(1.0, sine) * math.atan2(x, w), math.tau)
        return (0.0, math.copysign(math.pi / 2.0, sine), yaw)
    return (
        math.atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y)),
        math.asin(sine),
        math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z)),
    )
