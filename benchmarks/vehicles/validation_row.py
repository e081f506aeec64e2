# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""One line of the validation: what was measured on the real thing, and what the model gives."""

from dataclasses import asdict, dataclass
from typing import Any

#: Where a number comes from that could not be looked up again.
MEMORY = 'from memory'


@dataclass(frozen=True)
class Row:
    """
    A quantity of a vehicle or a body.

    Attributes
    ----------
    subject
        Vehicle or body.
    quantity, unit
        What, and in which unit.
    measured
        On the real one; None where no number was found.
    source
        Of the measured number; ends in ``MEMORY`` where it could not be looked up.
    model
        What the shipped model gives.
    why
        Where it is off: the reason, in a line.
    mended
        What the model gives with an option that is off by default; None without one.
    option
        That option.

    """

    subject: str
    quantity: str
    unit: str
    measured: float | None
    source: str
    model: float
    why: str = ''
    mended: float | None = None
    option: str = ''

    @property
    def difference(self) -> float | None:
        """Of the model from the measurement [-]."""
        return None if self.measured is None else self.model / self.measured - 1

    @property
    def difference_mended(self) -> float | None:
        """The same with the option [-]."""
        if self.measured is None or self.mended is None:
            return None
        return self.mended / self.measured - 1

    def as_json(self) -> dict[str, Any]:
        """Return all of it for the result."""
        return {
            **asdict(self), 'difference': self.difference,
            'difference_mended': self.difference_mended,
        }  # fmt: skip
