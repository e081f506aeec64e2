# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Added mass of a body of revolution from ring sources: a reference that shares nothing with hydro.

The direct boundary-integral equation, its azimuth integrated in closed form: a ring source of
order m (cos m theta) has the potential Q_{m-1/2}(chi) / (2 pi sqrt(r r')) with
chi = (r^2 + r'^2 + (z - z')^2)/(2 r r'), Legendre functions of the second kind that complete
elliptic integrals give (Abramowitz and Stegun 8.13; Cohl and Tohline 1999, ApJ 527). Constant
elements on the generating line, narrow towards its corners; Gauss rules that gather at the
collocation point.
"""

from itertools import pairwise

import numpy as np
from scipy.special import ellipe, ellipkm1

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(10)


def added_mass(corners, count=160, power=3.0):
    """
    Return the coefficients of a body of revolution about the z axis through its centre.

    Parameters
    ----------
    corners
        Corners (r, z) of the generating line from the lower to the upper end of the axis, or a
        function of 0..1 for a smooth one.
    count
        Elements per piece of the line.
    power
        Of the distances from a corner: 1 even, 3 narrow.

    Returns
    -------
    axial, transverse, pitch
        A_z/(rho V), A_x/(rho V), A_pitch/(rho V) [length^2].
    """
    points = _points(corners, count, power)
    start, end = points[:-1], points[1:]
    middle, length = 0.5 * (start + end), np.linalg.norm(end - start, axis=1)
    tangent = (end - start) / length[:, None]
    normal = np.c_[tangent[:, 1], -tangent[:, 0]]  # (r, z), outward
    r, z = middle.T
    volume = np.pi * np.sum(r**2 * (end[:, 1] - start[:, 1]))
    motions = {0: [normal[:, 1]], 1: [normal[:, 0], z * normal[:, 0] - r * normal[:, 1]]}
    result = {}
    for order, velocities in motions.items():
        single, double = _matrices(order, middle, start, end, normal)
        # outside of the body: phi/2 = oint (phi dG/dn - G dphi/dn)
        potentials = np.linalg.solve(
            0.5 * np.eye(len(r)) - double, -single @ np.array(velocities).T
        )
        share = 2 * np.pi if order == 0 else np.pi
        for k, velocity in enumerate(velocities):
            result[order, k] = -share * np.sum(potentials[:, k] * velocity * r * length) / volume
    return result[0, 0], result[1, 0], result[1, 1]


def _points(corners, count, power):
    if callable(corners):
        return np.array([corners(s) for s in np.linspace(0, 1, count + 1)])
    even = np.linspace(0, 1, count + 1)
    pieces = []
    for k, (a, b) in enumerate(pairwise(corners)):
        low, high = k > 0, k < len(corners) - 2  # which ends are corners of the body
        if low and high:
            share = np.where(even < 0.5, (2 * even) ** power / 2, 1 - (2 - 2 * even) ** power / 2)
        else:
            share = even**power if low else 1 - (1 - even) ** power
        pieces.append(np.array(a) + share[:, None] * (np.array(b) - np.array(a)))
    return np.concatenate([pieces[0], *(piece[1:] for piece in pieces[1:])])


def _matrices(order, at, start, end, normal):
    """Return single and double layer of ring elements at the middle of each."""
    count = len(at)
    single, double = np.zeros((count, count)), np.zeros((count, count))
    length = np.linalg.norm(end - start, axis=1)
    for i in range(count):
        # pieces of each element, halved towards the collocation point where it is near
        for j in range(count):
            gap = np.linalg.norm(0.5 * (start[j] + end[j]) - at[i])
            if gap > 3 * length[j]:
                continue
            for low, high in _pieces(at[i], start[j], end[j]):
                s, d = _rule(order, at[i], start[j], end[j], normal[j], low, high)
                single[i, j] += s
                double[i, j] += d
        far = np.linalg.norm(0.5 * (start + end) - at[i], axis=1) > 3 * length
        share = 0.5 * (_NODES + 1)
        places = start[far, None] + share[:, None] * (end - start)[far, None]
        s, d = _kernels(order, at[i], places, normal[far, None])
        weight = 0.5 * _WEIGHTS * length[far, None]
        single[i, far] = (s * weight).sum(axis=1)
        double[i, far] = (d * weight).sum(axis=1)
    return single, double


def _pieces(point, start, end):
    along = end - start
    foot = float(np.clip((point - start) @ along / (along @ along), 0, 1))
    steps = 0.25 ** np.arange(12)
    cuts = np.unique(np.clip(np.r_[0, 1, foot, foot + steps, foot - steps], 0, 1))
    return list(pairwise(cuts))


def _rule(order, point, start, end, normal, low, high):
    share = low + (high - low) * 0.5 * (_NODES + 1)
    places = start + share[:, None] * (end - start)
    s, d = _kernels(order, point, places, normal)
    weight = 0.5 * (high - low) * _WEIGHTS * np.linalg.norm(end - start)
    return (s * weight).sum(), (d * weight).sum()


def _kernels(order, point, places, normal):
    """Return G_m and its derivative along the normal at the places, both times their radius."""
    (r, z), (q, y) = point, np.moveaxis(places, -1, 0)
    rise = ((r - q) ** 2 + (z - y) ** 2) / (2 * r * q)  # chi - 1, without cancellation
    chi = 1 + rise
    k2 = 2 / (chi + 1)
    # 1 - k^2 = (chi - 1)/(chi + 1)
    first = ellipkm1(rise / (chi + 1))
    second = ellipe(k2)
    zero = np.sqrt(k2) * first
    one = chi * np.sqrt(k2) * first - np.sqrt(2 * (chi + 1)) * second
    bottom = rise * (chi + 1)
    slope = -0.5 * (chi * zero - one) / bottom if order == 0 else 0.5 * (chi * one - zero) / bottom
    value = zero if order == 0 else one
    root = 2 * np.pi * np.sqrt(r * q)
    chi_q = 1 / r - chi / q
    chi_y = (y - z) / (r * q)
    along = normal[..., 0] * (slope * chi_q - value / (2 * q)) + normal[..., 1] * slope * chi_y
    return value / root * q, along / root * q
