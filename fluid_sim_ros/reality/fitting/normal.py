# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Normal equations of a fit: the states of windows taken out, one window by one."""

import numpy as np

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.reality.fitting.shooting import Linear

#: Curvature below this share of the largest is none: the flights do not touch it.
_TOUCHED = 1e-12
#: Least share of the curvature that other windows are taken to have: a knot may have one window.
_LEAST_REST = 0.25


def _reduced(each: Linear, scales: Array) -> tuple[Array, Array, Array, Array]:
    """Return derivatives with the states taken out, by window, and what the states need."""
    jx, jp = each.by_state, each.by_parameter * scales
    inner = np.einsum('wni,wnj->wij', jx, jx) + 1e-9 * np.eye(jx.shape[2])
    cross = np.linalg.solve(inner, np.einsum('wni,wnp->wip', jx, jp))
    rest = np.linalg.solve(inner, np.einsum('wni,wn->wi', jx, each.residual)[..., None])[..., 0]
    jp_free = jp - np.einsum('wni,wip->wnp', jx, cross)
    r_free = each.residual - np.einsum('wni,wi->wn', jx, rest)
    return jp_free, r_free, cross, rest


def step_of(
    linear: list[Linear], scales: Array, damping: float, walks: Array, steps: Array
) -> tuple[Array, list[Array]]:
    """
    Return the step of the parameters, and of each flight's states.

    Parameters
    ----------
    linear
        Of each flight.
    scales
        Of the parameters, shape (p,).
    damping
        Added to the curvature, as a share of it.
    walks, steps
        Residuals besides: their derivatives, shape (s, p), and they, shape (s,).

    """
    parts = [_reduced(each, scales) for each in linear]
    curved = sum(np.einsum('wnp,wnq->pq', jp, jp) for jp, _, _, _ in parts)
    slope = sum(np.einsum('wnp,wn->p', jp, r) for jp, r, _, _ in parts)
    walked = walks * scales
    curved, slope = curved + walked.T @ walked, slope + walked.T @ steps
    ridge = damping * np.diag(np.maximum(np.diag(curved), 1e-12 * np.diag(curved).max()))
    step = -np.linalg.lstsq(curved + ridge, slope, rcond=1e-13)[0]
    moves = [-rest - np.einsum('wip,p->wi', cross, step) for _, _, cross, rest in parts]
    return step * scales, moves


def sandwich(
    linear: list[Linear], scales: Array, walked: Array
) -> tuple[Array, Array, int]:  # fmt: skip
    """
    Return curvature and the scatter of the windows' scores, in scales; and their number.

    The fit bends towards each window, whose residuals are too small by that. Without the window
    its score s would be (I - G A^-1)^-1 s, with its own part G of the curvature A (the jackknife
    by clusters, CR3: Bell and McCaffrey 2002).

    Parameters
    ----------
    linear
        At the least squares.
    scales
        Of the parameters, shape (p,).
    walked
        Curvature, and scatter, that the steps of knots add, in scales, shape (p, p).

    """
    parts, scores = [], []
    for each in linear:
        jp, r, _, _ = _reduced(each, scales)
        parts.append(np.einsum('wnp,wnq->wpq', jp, jp))
        scores.append(np.einsum('wnp,wn->wp', jp, r))
    own, score = np.concatenate(parts), np.concatenate(scores)
    curved: Array = own.sum(axis=0) + walked
    values, vectors = np.linalg.eigh(curved)
    felt = values > _TOUCHED * max(values.max(), 0.0)
    root = vectors[:, felt] / np.sqrt(values[felt])  # root' A root = 1 where anything is felt
    back = vectors[:, felt] * np.sqrt(values[felt])
    share, turn = np.linalg.eigh(np.einsum('pi,wpq,qj->wij', root, own, root))
    alone = np.einsum('wij,wi->wj', turn, score @ root) / np.maximum(1.0 - share, _LEAST_REST)
    without = np.einsum('wij,wj->wi', turn, alone) @ back.T
    number = len(own)
    scatter: Array = without.T @ without * (number - 1) / max(1, number) + walked
    return curved, scatter, number
