# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Gains as dataclass fields that carry their unit and meaning along."""

import math
from dataclasses import Field, dataclass, field, fields
from typing import Any

from fluid_sim_ros.errors import ConfigError


def gain(
    default: float, unit: str, meaning: str, *, positive: bool = False, acute: bool = False
) -> Any:
    """
    Return a dataclass field of a gain or limit with its unit and meaning.

    ``positive``: it must not be 0. ``acute``: an angle below pi/2.

    Parameters
    ----------
    default
        Its value where none is given, in ``unit``.
    unit, meaning
        What describes it to people; see ``describe``.
    positive
        Whether it must not be 0.
    acute
        Whether it is an angle below pi/2.

    """
    metadata = {'unit': unit, 'meaning': meaning, 'positive': positive, 'acute': acute}
    return field(default=default, metadata=metadata)


def describe(entry: 'Field[Any]') -> str:
    """
    Return ``[unit] meaning`` of a field made by `gain`.

    Parameters
    ----------
    entry
        Of a ``Gains`` class.

    """
    return f'[{entry.metadata["unit"]}] {entry.metadata["meaning"]}'


@dataclass(frozen=True)
class Gains:
    """Base of gain sets: every value is finite, at least 0, and as its field asks."""

    def __post_init__(self) -> None:
        for entry in fields(self):
            value = getattr(self, entry.name)
            if not (math.isfinite(value) and value >= 0):
                raise ConfigError(f"gain '{entry.name}': {value}; must be finite and at least 0")
            if entry.metadata['positive'] and value == 0:
                raise ConfigError(f"gain '{entry.name}': {value}; must be above 0")
            if entry.metadata['acute'] and value >= math.pi / 2:
                raise ConfigError(f"gain '{entry.name}': {value}; must be below pi/2 rad")
