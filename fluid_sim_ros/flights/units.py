# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Units and axes of other software, turned into ours."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.physics.environment.atmosphere import GRAVITY

if TYPE_CHECKING:  # SciPy's rotations take 29 MiB, which most logs of our own do not need
    from scipy.spatial.transform import Rotation

#: SI unit -> allowed unit -> factor.
UNITS: dict[str, dict[str, float]] = {
    'm': {'m': 1.0, 'cm': 0.01, 'mm': 0.001, 'ft': 0.3048},
    'm/s': {
        'm/s': 1.0, 'cm/s': 0.01, 'mm/s': 0.001, 'km/h': 1 / 3.6, 'kn': 1852 / 3600,
        'ft/s': 0.3048,
    },
    'rad/s': {
        'rad/s': 1.0, 'deg/s': np.pi / 180, 'mrad/s': 1e-3, 'rpm': np.pi / 30,
        'Hz': 2 * np.pi,
    },
    'm/s^2': {'m/s^2': 1.0, 'g': GRAVITY, 'mg': GRAVITY * 1e-3},
    's': {'s': 1.0, 'ms': 1e-3, 'us': 1e-6, 'ns': 1e-9},
    'N': {'N': 1.0, 'mN': 1e-3, 'gf': GRAVITY * 1e-3},
    'us': {'us': 1.0, 's': 1e6},
    'V': {'V': 1.0, 'mV': 1e-3},
    '-': {'-': 1.0, '%': 0.01, 'uint16': 1 / 65535},
    'rad': {'rad': 1.0, 'deg': np.pi / 180},
}  # fmt: skip
WORLD, BODY = ('enu', 'ned'), ('flu', 'frd')
ATTITUDES = ('enu_flu', 'ned_frd')
ORDERS = ('wxyz', 'xyzw', 'rpy')
#: NED from ENU and back; FRD from FLU and back: each is its own inverse.
_WORLD_TURN = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
_BODY_TURN = np.diag([1.0, -1.0, -1.0])


def to_enu(vectors: Array, axes: str) -> Array:
    """
    Return world vectors in ENU.

    Parameters
    ----------
    vectors
        Any unit, shape (n, 3).
    axes
        ``enu`` or ``ned``.

    """
    return vectors if axes == 'enu' else vectors @ _WORLD_TURN.T


def to_flu(vectors: Array, axes: str) -> Array:
    """
    Return body vectors in FLU.

    Parameters
    ----------
    vectors
        Any unit, shape (n, 3).
    axes
        ``flu`` or ``frd``.

    """
    return vectors if axes == 'flu' else vectors @ _BODY_TURN.T


def to_quaternions(numbers: Array, order: str, axes: str) -> Array:
    """
    Return attitudes as unit quaternions w x y z, ENU from FLU, without jumps of sign.

    Parameters
    ----------
    numbers
        Quaternions (n, 4), or roll, pitch, yaw about x, y, z of the body axes [rad] (n, 3).
    order
        ``wxyz``, ``xyzw`` or ``rpy``.
    axes
        ``enu_flu`` or ``ned_frd``.

    """
    from scipy.spatial.transform import Rotation

    if order == 'rpy':
        xyzw = Rotation.from_euler('ZYX', numbers[:, ::-1]).as_quat()
        wxyz = np.roll(xyzw, 1, axis=1)
    else:
        wxyz = np.roll(numbers, 1, axis=1) if order == 'xyzw' else numbers
    length = np.linalg.norm(wxyz, axis=1, keepdims=True)
    wxyz = wxyz / np.where(length > 0, length, 1.0)
    if axes == 'ned_frd':  # q_enu_flu = q_enu_ned * q * q_frd_flu
        turned = _WORLD_TURN @ rotations(wxyz).as_matrix() @ _BODY_TURN
        wxyz = np.roll(Rotation.from_matrix(turned).as_quat(), 1, axis=1)
    return continuous(wxyz)


def continuous(wxyz: Array) -> Array:
    """
    Return quaternions whose sign never jumps.

    Parameters
    ----------
    wxyz
        Shape (n, 4).

    """
    if len(wxyz) < 2:
        return wxyz
    along = np.einsum('ij,ij->i', wxyz[1:], wxyz[:-1])
    signs = np.concatenate([[1.0], np.cumprod(np.where(along < 0, -1.0, 1.0))])
    turned: Array = wxyz * signs[:, None]
    return turned


def rotations(wxyz: Array) -> 'Rotation':
    """
    Return SciPy's rotations of quaternions.

    Parameters
    ----------
    wxyz
        Unit quaternions, shape (n, 4) or (4,).

    """
    from scipy.spatial.transform import Rotation

    return Rotation.from_quat(np.roll(wxyz, -1, axis=-1))


def columns_of(names: Sequence[str]) -> str:
    """
    Return column names in short.

    Parameters
    ----------
    names
        Such as ``acc.x``, ``acc.y``, ``acc.z``.

    """
    return names[0] if len(names) == 1 else f'{names[0]} .. {names[-1]}'
