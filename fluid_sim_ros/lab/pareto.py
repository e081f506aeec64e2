"""Which settings are worth their time: the Pareto front of processor time and error."""

from collections.abc import Sequence
from typing import Any

#: Times closer than this are equal: the clock cannot tell them apart.
SAME_TIME = 1.25
#: Errors closer than this share are equal: integrators that do the same to a motion.
_SAME_ERROR = 1e-3


def judged(point: dict[str, Any], by: str) -> float | None:
    """Return the error that a point is judged by, None where the run failed."""
    error = point['error']
    return None if error is None else float(error[by])


def mark_front(points: Sequence[dict[str, Any]], by: str) -> None:
    """
    Set ``pareto`` of every point.

    A point is off the front when another one is at least as accurate and clearly faster (by
    SAME_TIME), or more accurate and as fast within that factor. Of points that are equal in both
    the first one stays.
    """
    for place, point in enumerate(points):
        point['pareto'] = judged(point, by) is not None and not any(
            _beats(other, point, by, earlier=number < place)
            for number, other in enumerate(points)
            if number != place
        )


def _beats(other: dict[str, Any], point: dict[str, Any], by: str, earlier: bool) -> bool:
    theirs, own = judged(other, by), judged(point, by)
    if theirs is None or own is None:
        return False
    same = abs(theirs - own) <= _SAME_ERROR * own
    if theirs > own and not same:
        return False
    ratio = point['cpu_us_per_s'] / other['cpu_us_per_s']
    return bool(ratio > SAME_TIME or ((earlier or not same) and ratio > 1 / SAME_TIME))
