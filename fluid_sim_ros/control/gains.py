"""Gains as dataclass fields that carry their unit and meaning along."""

import math
from dataclasses import Field, dataclass, field, fields
from typing import Any

from fluid_sim_ros.errors import ConfigError


def gain(default: float, unit: str, meaning: str) -> Any:
    """Return a dataclass field of a gain or limit with its unit and meaning."""
    return field(default=default, metadata={'unit': unit, 'meaning': meaning})


def describe(entry: 'Field[Any]') -> str:
    """Return ``[unit] meaning`` of a field made by `gain`."""
    return f'[{entry.metadata["unit"]}] {entry.metadata["meaning"]}'


@dataclass(frozen=True)
class Gains:
    """Base of gain sets: every value is finite and at least 0."""

    def __post_init__(self) -> None:
        for entry in fields(self):
            value = getattr(self, entry.name)
            if not (math.isfinite(value) and value >= 0):
                raise ConfigError(f"gain '{entry.name}': {value}; must be finite and at least 0")
