# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""One picture of a flight in numbers, as every source of the view gives it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import native as nat


@dataclass(frozen=True)
class Frame:
    """
    A flight at one moment; its arrays are copies.

    Attributes
    ----------
    time
        Simulated time [s].
    qpos
        Of the model, shape (nq,).
    rows
        One per vehicle, with the columns of ``plugins.native``; nan where the source does not
        know a number, shape (n, columns).
    control, force
        Command and force of each actuator of the model, in its unit, shape (nu,); nan where the
        source does not know it.
    flows
        What was commanded: ``wind`` or ``current`` -> velocity [m/s], world axes, shape (3,).
    paused
        Whether simulated time stands still.
    steered
        Vehicles that are held by a law, and follow the keys.
    note
        What went wrong for good, such as a divergence; or empty.
    weather
        State of the plugins, of which the flow around the vehicles follows, shape
        (npluginstate,); None where the source does not know it.
    ghost
        Another pose of the model to draw beside it, pale, shape (nq,); None: there is none.

    """

    time: float
    qpos: Array
    rows: Array
    control: Array
    force: Array
    flows: Mapping[str, Array] = field(default_factory=dict)
    paused: bool = False
    steered: tuple[str, ...] = ()
    note: str = ''
    weather: Array | None = None
    ghost: Array | None = None

    def forces(self, vehicle: int, terms: Sequence[str]) -> dict[str, Array]:
        """
        Return the forces on a vehicle.

        Parameters
        ----------
        vehicle
            Number of its row.
        terms
            Of the fluid, that are wanted.

        Returns
        -------
        dict
            Term, ``total`` or ``thrust`` -> [N], base_link axes, shape (3,); what is nan is left
            out.

        """
        row = self.rows[vehicle]
        columns = {term: nat.term_columns(term) for term in terms}
        columns |= {'total': nat.TOTAL, 'thrust': nat.THRUST}
        found = {name: row[where][:3] for name, where in columns.items()}
        return {name: force for name, force in found.items() if np.isfinite(force).all()}
