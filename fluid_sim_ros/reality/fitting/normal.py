# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Normal equations of a fit: the states of windows taken out, one window by one."""

import numpy as np

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.reality.fitting.shooting import Linear


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


def sandwich(linear: list[Linear], scales: Array) -> tuple[Array, Array, int]:
    """
    Return curvature and the scatter of the windows' scores, in scales; and their number.

    Parameters
    ----------
    linear
        At the least squares.
    scales
        Of the parameters, shape (p,).

    """
    count = len(scales)
    curved, score, windows = np.zeros((count, count)), np.zeros((count, count)), 0
    for each in linear:
        jp, r, _, _ = _reduced(each, scales)
        curved += np.einsum('wnp,wnq->pq', jp, jp)
        each_score = np.einsum('wnp,wn->wp', jp, r)
        score += each_score.T @ each_score
        windows += len(r)
    return curved, score, windows
