# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Which settings are worth their time: the Pareto front of processor time and error.

Times are measured, so two of them may be too close to be told apart. The tie factor says how
close: it is not fixed, but the middle of the widest gap that the ratios in question leave within a
range, so that no decision hangs on a ratio that the clock might give otherwise the next time.
"""

import math
from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

#: The tie factor of a front lies in this range; neighbouring timesteps are 2 or 2.5 apart.
FRONT_RANGE = (1.1, 2.0)
#: A factor is kept from one measurement of a chart to the next while no ratio is so near it.
KEPT_CLEAR = 1.03
#: Errors closer than this share are equal: integrators that do the same to a motion.
_SAME_ERROR = 1e-3


class Tie(NamedTuple):
    """Costs within ``factor`` are equal; no ratio in question is within ``clear`` of it."""

    factor: float
    clear: float  # half the gap, as a factor


def tie(ratios: Iterable[float], limits: tuple[float, float]) -> Tie:
    """
    Return the middle (geometric) of the widest gap between ratios within limits.

    Parameters
    ----------
    ratios
        Ratios of costs on which a decision hangs [-].
    limits
        Lowest and highest factor.

    Returns
    -------
    Tie
        The factor, and how far the nearest ratio is.

    """
    low, high = limits
    marks = [low, *sorted(ratio for ratio in ratios if low < ratio < high), high]
    below, above = max(pairwise(marks), key=lambda pair: pair[1] / pair[0])
    return Tie(math.sqrt(below * above), math.sqrt(above / below))


def kept(factor: float, ratios: Iterable[float]) -> Tie | None:
    """
    Return a factor of an earlier measurement, None where a ratio has come near it.

    Parameters
    ----------
    factor
        Of the earlier measurement [-].
    ratios
        Ratios of costs on which a decision hangs now [-].

    Returns
    -------
    Tie or None
        The factor, and how far the nearest ratio is.

    """
    known = [ratio for ratio in ratios if 0 < ratio < math.inf]
    clear = min((max(ratio / factor, factor / ratio) for ratio in known), default=2.0)
    return Tie(factor, clear) if clear >= KEPT_CLEAR else None


def judged(point: dict[str, Any], by: str) -> float | None:
    """
    Return the error that a point is judged by.

    Parameters
    ----------
    point
        Of a chart.
    by
        Name of the error: the chart's ``judged_by``.

    Returns
    -------
    float or None
        In the unit of the error; None where the run failed.

    """
    error = point['error']
    return None if error is None else float(error[by])


def mark_front(points: Sequence[dict[str, Any]], by: str, before: float | None = None) -> Tie:
    """
    Set ``pareto`` of every point; return the tie factor, that of ``before`` while it is clear.

    A point is on the front where every more accurate one costs more than the tie factor times as
    much. Of points with equal errors the first one stays (the poorest model: points are in the
    order of the ladder), unless a later one is cheaper by more than the factor.

    Parameters
    ----------
    points
        Of a chart, in the order of the ladder, with costs; each gets ``pareto``.
    by
        Name of the error that counts.
    before
        Tie factor of an earlier measurement of the same chart.

    Returns
    -------
    Tie
        The factor within which costs are equal.

    """
    rows = [(judged(point, by), float(point['cpu_us_per_s'])) for point in points]
    dearer = [_price_of_more(rows, place) for place in range(len(rows))]
    saved = [_saved_by_equal(rows, place) for place in range(len(rows))]
    # if a more accurate point costs hardly more, this one is off the front for any factor
    asked = [
        ratio
        for price, saving in zip(dearer, saved, strict=True)
        if price > FRONT_RANGE[0]
        for ratio in (price, saving)
    ]
    found = (kept(before, asked) if before else None) or tie(asked, FRONT_RANGE)
    for point, price, saving in zip(points, dearer, saved, strict=True):
        point['pareto'] = price > found.factor >= saving
    return found


def _price_of_more(rows: Sequence[tuple[float | None, float]], place: int) -> float:
    """Return the least cost of a more accurate point, or an equal earlier one, over one's own."""
    error, cost = rows[place]
    if error is None:
        return 0.0
    return min(
        (
            theirs / cost
            for other, (their_error, theirs) in enumerate(rows)
            if their_error is not None
            and (other < place if _equal(their_error, error) else their_error < error)
        ),
        default=math.inf,
    )


def _saved_by_equal(rows: Sequence[tuple[float | None, float]], place: int) -> float:
    """Return one's own cost over the least cost of a later point with an equal error."""
    error, cost = rows[place]
    if error is None:
        return 0.0
    return max(
        (
            cost / theirs
            for their_error, theirs in rows[place + 1 :]
            if their_error is not None and _equal(their_error, error)
        ),
        default=0.0,
    )


def _equal(one: float, other: float) -> bool:
    return abs(one - other) <= _SAME_ERROR * max(one, other)
