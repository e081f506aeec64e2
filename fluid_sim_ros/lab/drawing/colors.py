# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Colours of the laboratory: distinguishable for colour-blind readers (Okabe and Ito 2008)."""

COLORS = ('#0072B2', '#D55E00', '#009E73', '#CC79A7', '#E69F00', '#56B4E9', '#000000', '#999999')
INTEGRATOR_COLORS = dict(
    zip(('RK4', 'Euler', 'implicitfast', 'implicit', 'discrete'), COLORS, strict=False)
)


def rung_colors(rungs: list[str]) -> dict[str, str]:
    """
    Return a colour for each rung.

    Parameters
    ----------
    rungs
        Names of the rungs, poorest first.

    Returns
    -------
    dict
        Hex colour by rung; the richest one has the first colour.

    """
    return dict(zip(reversed(rungs), COLORS, strict=False))


OUTCOME_COLORS = {
    'stable': '#009E73', 'underdamped': '#B7DDCB', 'energy loss': '#56B4E9',
    'energy gain': '#E69F00', 'blow-up': '#D55E00', 'reset': '#6B1F0B',
}  # fmt: skip
