# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The panel of the forces: their sizes, which arrows are drawn, and how."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import viser

from fluid_sim_ros.output.term_colors import term_color
from fluid_sim_ros.view.frame import Frame
from fluid_sim_ros.view.source import Source
from fluid_sim_ros.view.web.events import boxed, checked, html, on_user
from fluid_sim_ros.view.web.looks import Looks

#: Arrows that are not drawn until they are asked for.
_OFF = ('total',)
#: Arrows of fluid forces are drawn longer by so much where there is no buoyancy.
_IN_AIR = 5.0


class ForcesPanel:
    """
    Puts its controls into the present container.

    Parameters
    ----------
    server
        Of the page.
    source
        What is shown.
    looks
        What is drawn; changed.
    say
        Takes a line for the user.

    """

    def __init__(
        self,
        server: viser.ViserServer,
        source: Source,
        looks: Looks,
        say: Callable[[str], None],
    ) -> None:
        gui = server.gui
        self._looks, self._source = looks, source
        self._table = gui.add_html('')

        def set_scale(value: Any) -> None:
            looks.scale = float(np.clip(checked(value), 0.05, 20.0))

        on_user(
            gui.add_slider('length of arrows', 0.05, 20.0, 0.05, looks.scale,
                           hint='1: the weight is two lengths of the vehicle'),
            set_scale, say,
        )  # fmt: skip

        def set_fluid_scale(value: Any) -> None:
            looks.fluid_scale = float(np.clip(checked(value), 1.0, 100.0))

        if not looks.terms and 'buoyancy' not in source.terms[looks.vehicle]:
            looks.fluid_scale = _IN_AIR
        on_user(
            gui.add_slider('fluid forces longer by', 1.0, 100.0, 1.0, looks.fluid_scale,
                           hint='than weight and thrust; in air they are small'),
            set_fluid_scale, say,
        )  # fmt: skip

        def set_flow_scale(value: Any) -> None:
            looks.flow_scale = float(np.clip(checked(value), 0.1, 10.0))

        on_user(
            gui.add_slider('length of wind and current', 0.1, 10.0, 0.1, looks.flow_scale,
                           hint='1: one length of the vehicle for 5 m/s of wind, 0.5 of current'),
            set_flow_scale, say,
        )  # fmt: skip
        terms = (*self._source.terms[looks.vehicle], 'thrust', 'weight', 'total')
        if not looks.terms:
            looks.terms = {term for term in terms if term not in _OFF}
        for term in terms:
            on_user(
                gui.add_checkbox(term.replace('_', ' '), term in looks.terms),
                partial(self._show_term, term), say,
            )  # fmt: skip
        for name, key in (
            ('names at the arrows', 'labels'), ('wind and current', 'flow'), ('trail', 'trail'),
            ('each thruster apart', 'each_thruster'),
        ):  # fmt: skip
            on_user(
                gui.add_checkbox(name, getattr(looks, key)),
                partial(self._set_look, key), say,
            )  # fmt: skip

    def _show_term(self, term: str, value: Any) -> None:
        (self._looks.terms.add if value else self._looks.terms.discard)(term)

    def _set_look(self, key: str, value: Any) -> None:
        setattr(self._looks, key, bool(value))

    def show(self, frame: Frame) -> None:
        """
        Show the numbers of a frame.

        Parameters
        ----------
        frame
            The newest.

        """
        name = self._looks.vehicle
        terms = self._source.terms[name]
        forces = frame.forces(list(self._source.vehicles).index(name), terms)
        rows = ''.join(
            f'<tr><td><span style="color:{term_color(term)}">&#9632;</span> '
            f'{html(term.replace("_", " "))}</td>'
            f'<td style="text-align:right">{np.linalg.norm(force):.4g} N</td></tr>'
            for term, force in forces.items()
        )
        self._table.content = boxed(f'<table style="width:100%">{rows}</table>')
