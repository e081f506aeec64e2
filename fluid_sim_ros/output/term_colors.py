# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""One colour for each term of the fluid forces: the same in plots, films and the live view."""

#: Distinguishable for colour-blind readers (Okabe and Ito 2008).
COLORS = ('#0072B2', '#D55E00', '#009E73', '#CC79A7', '#E69F00', '#56B4E9', '#000000', '#999999')
#: Term -> colour. Yellow and brown (Okabe and Ito's eighth; ColorBrewer BrBG) are for two terms
#: that are rarely seen beside each other.
TERM_COLORS = {
    'total': '#000000', 'buoyancy': '#0072B2', 'drag': '#D55E00', 'damping': '#009E73',
    'added_mass': '#CC79A7', 'viscous': '#56B4E9', 'foil': '#8C510A', 'kutta': '#F0E442',
    'magnus': '#999999', 'thrust': '#E69F00', 'weight': '#777777',
}  # fmt: skip
#: Of what has no colour of its own.
OTHER = '#999999'


def term_color(term: str) -> str:
    """
    Return the colour of a term.

    Parameters
    ----------
    term
        Of the fluid forces, or ``total``, ``thrust``, ``weight``.

    Returns
    -------
    str
        ``#RRGGBB``.

    """
    return TERM_COLORS.get(term, OTHER)


def rgb(color: str) -> tuple[int, int, int]:
    """
    Return a colour as numbers.

    Parameters
    ----------
    color
        ``#RRGGBB``.

    Returns
    -------
    tuple
        Red, green and blue, 0 to 255.

    """
    return int(color[1:3], 16), int(color[3:5], 16), int(color[5:7], 16)
