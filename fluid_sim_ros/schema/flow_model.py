# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What the models of winds and currents share: the keys of fluid_sim.medium that say the same."""

from collections.abc import Iterable
from itertools import pairwise
from typing import Annotated, ClassVar

from pydantic import Field

from fluid_sim_ros.schema.base import Number, Strict

Increasing = Annotated[list[Number], Field(min_length=2)]


class FlowModel(Strict):
    """
    One model of a wind or a current.

    Attributes
    ----------
    model
        Its name in the file.
    one_of
        What only one model of a wind or current may be; '': there may be many.

    """

    model: str
    one_of: ClassVar[str] = ''

    def keys(self, stream: str) -> dict[str, str]:
        """
        Return the keys of fluid_sim.medium; the signals of several models are joined to one key.

        Parameters
        ----------
        stream
            ``wind`` or ``current``.

        Returns
        -------
        dict
            Key -> value as MJCF has it.

        """
        return self._keys(stream)

    def _keys(self, stream: str) -> dict[str, str]:
        raise NotImplementedError

    def packed_grid(self) -> str | None:
        """Return the packed numbers of a grid that the keys refer to as ``<stream>_grid``."""
        return None


class Sheared(FlowModel):
    """
    A flow that changes over the height.

    With ``rotational`` drag and damping see the air turn with half the curl, for large bodies.
    """

    rotational: bool = False

    def _keys(self, stream: str) -> dict[str, str]:
        """Return the key for what is rotational; subclasses add theirs."""
        return {'rotational_gust': 'curl'} if self.rotational else {}


def words(numbers: Iterable[float]) -> str:
    """
    Return numbers with all their digits.

    Parameters
    ----------
    numbers
        Of any unit.

    Returns
    -------
    str
        With a space between two.

    """
    return ' '.join(repr(float(number)) for number in numbers)


def check_rising(values: list[float], key: str) -> None:
    """
    Refuse a list that does not rise.

    Parameters
    ----------
    values
        Of any unit.
    key
        Its name in the file.

    Raises
    ------
    ValueError
        With the first pair that does not rise.

    """
    for before, after in pairwise(values):
        if after <= before:
            raise ValueError(f'{key} must rise strictly (got {after:g} after {before:g})')
