# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Whether a vehicle moves as if its thrusters were in another order than the log's columns."""

import itertools

import numpy as np

from fluid_sim_ros.flights.flight import Flight
from fluid_sim_ros.reality.flying import Flyer
from fluid_sim_ros.reality.residual.residuals import Residuals, averaged, driving, responses

#: Orders of more thrusters than this are not tried: their number is the factorial.
_MOST = 8
#: The order as it is leaves more than this of the motion unexplained, another one at most so
#: much of that [-].
_WRONG, _BETTER = 0.05, 0.3
#: An axis along which thrusters do less of what they do along the others says nothing [-].
_ACTS = 0.01


def likely_order(found: Residuals, flyer: Flyer, flight: Flight) -> list[str]:
    """
    Return the thrusters in the order of the log's columns that explains the motion far better.

    What a thruster does is taken to be linear in its control, or in its rotor's speed squared.
    With these responses of the model, each order of the columns is tried on the measured angular
    acceleration and specific force.

    Parameters
    ----------
    found
        Accelerations along the flight.
    flyer, flight
        They are of.

    Returns
    -------
    list
        Names, the thruster of the log's first used column first; empty where the order as it is
        explains the motion, or no other does so clearly better.

    """
    driven = flyer.driven
    count = found.controls.shape[1]
    slopes = responses(found, flyer, flight) if 1 < count <= _MOST else None
    if slopes is None:
        return []
    lagging = found.speeds is not None
    runs = found.controls if found.speeds is None else found.speeds
    given = averaged(found.times, driving(runs, lagging or driven.kind == 'rotor_speed'))
    off = found.turn - found.turn_model
    if len(found.force):
        off = np.hstack([off, found.force - found.force_model])
    slopes = slopes[:, : off.shape[1]]
    # as large on each axis: what all thrusters together do there
    sizes = (given - given.mean(axis=0)).std(axis=0) @ np.abs(slopes)
    used = sizes > _ACTS * sizes.max(initial=0.0)
    off, slopes = off[:, used] / sizes[used], slopes[:, used] / sizes[used]
    # the centre of mass explains what is constant
    off, given = off - off.mean(axis=0), given - given.mean(axis=0)
    # |off + (given - given[:, order]) slopes|^2 by products that no order makes anew
    whole = off + given @ slopes
    total = float((whole**2).sum())
    together, alone, work = given.T @ given, given.T @ whole, slopes @ slopes.T

    def left(order: tuple[int, ...]) -> float:
        places = list(order)
        both = float((slopes * alone[places]).sum())
        own = float((work * together[np.ix_(places, places)]).sum())
        return (total - 2 * both + own) / total if total > 0 else 0.0

    plain = tuple(range(count))
    if left(plain) < _WRONG:
        return []
    best = min(itertools.permutations(plain), key=lambda order: (left(order), _changes(order)))
    if left(best) > _BETTER * left(plain):
        return []
    # thruster k takes what stands in the column of thruster best[k]
    columns = [driven.columns[place] for place in best]
    return [driven.vehicle.thrusters[k] for k in np.argsort(columns)]


def _changes(order: tuple[int, ...]) -> int:
    return sum(i != place for i, place in enumerate(order))
