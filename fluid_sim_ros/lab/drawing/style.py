# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""How the laboratory's pictures look."""

from pathlib import Path
from typing import Any

import matplotlib as mpl

mpl.use('Agg')
import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from fluid_sim_ros.output.new_file import new_file

STYLE: Any = {
    'font.size': 9, 'axes.grid': True, 'grid.alpha': 0.25, 'axes.spines.top': False,
    'axes.spines.right': False, 'figure.dpi': 100, 'legend.frameon': False,
    'axes.titlesize': 10, 'axes.titleweight': 'bold', 'axes.titlelocation': 'left',
}  # fmt: skip
MARKERS = {'Euler': 'o', 'RK4': 's', 'implicit': '^', 'implicitfast': 'v', 'discrete': 'D'}


def save_figure(figure: Figure, path: Path) -> Path:
    """
    Write a picture and free it.

    Parameters
    ----------
    figure
        The picture.
    path
        File to write; its folder is made where it is not there.

    Returns
    -------
    Path
        The file.

    """
    path.parent.mkdir(parents=True, exist_ok=True)
    with new_file(path) as file:
        figure.savefig(file)
    plt.close(figure)
    return path
