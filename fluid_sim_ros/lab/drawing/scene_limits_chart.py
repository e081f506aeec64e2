# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The limits of a scene as a picture: error over timestep for each integrator."""

import textwrap
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt

from fluid_sim_ros.lab.drawing.colors import INTEGRATOR_COLORS
from fluid_sim_ros.lab.drawing.style import MARKERS, STYLE, save_figure

#: Smaller and larger errors say nothing more [-].
_LEAST, _MOST = 1e-12, 1e3


def draw_limits(result: dict[str, Any], path: Path) -> Path:
    """
    Draw the error of a scene over the timestep, with the largest timesteps that last.

    Parameters
    ----------
    result
        As ``scene_limits`` returns it.
    path
        PNG file to write.

    Returns
    -------
    Path
        The file.

    """
    with plt.rc_context(STYLE):
        figure, axes = plt.subplots(figsize=(8.5, 5.4), layout='constrained')
        limits = {row['integrator']: row['largest_s'] for row in result['largest_steps']}
        for name in result['integrators']:
            color = INTEGRATOR_COLORS[name]
            rows = [row for row in result['map'] if row['integrator'] == name]
            drawn = [row for row in rows if row['error'] is not None]
            limit = limits[name]
            label = f'{name}: {limit_words(limit, rows)}'
            axes.loglog(
                [row['timestep_s'] for row in drawn],
                [min(max(row['error'], _LEAST), _MOST) for row in drawn],
                color=color, marker=MARKERS[name], ms=4, lw=1.1, mfc='none', label=label,
            )  # fmt: skip
            lost = [row['timestep_s'] for row in rows if row['outcome'] == 'lost']
            axes.plot(
                lost, [0.985] * len(lost), 'x', color=color, ms=5,
                transform=axes.get_xaxis_transform(), clip_on=False,
            )  # fmt: skip
            if limit is not None and any(row['outcome'] != 'stable' for row in rows):
                axes.axvline(limit, color=color, lw=1.0, ls='--')
        axes.set_xlabel('timestep [s] (crosses: the run is lost; dashed: largest that lasts)')
        axes.set_ylabel(f'{result["metric"]} error, largest over the run [-]')
        title = f'{result["title"]} ({result["duration_s"]:g} s)'
        figure.suptitle('\n'.join(textwrap.wrap(title, 90)), fontweight='bold')
        if result['note']:
            note = '\n'.join(textwrap.wrap(f'{result["note"]}.', 110))
            figure.supxlabel(note, fontsize=8, color='#555555')
        axes.legend(fontsize=8)
        return save_figure(figure, path)


def limit_words(limit: float | None, rows: Sequence[Mapping[str, Any]]) -> str:
    """
    Return in words up to which timestep an integrator lasts.

    Parameters
    ----------
    limit
        Of ``largest_steps`` [s].
    rows
        Of the map, for this integrator.

    Returns
    -------
    str
        A few words, with milliseconds.

    """
    if limit is None:
        return 'fails at every timestep'
    bound = all(row['outcome'] == 'stable' for row in rows)
    return f'{"at least " if bound else "up to "}{limit * 1e3:.3g} ms'
