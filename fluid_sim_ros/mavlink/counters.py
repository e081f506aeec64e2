# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What a bridge counts, and how quickly its exchanges follow each other."""

import time
from dataclasses import asdict, dataclass, field
from typing import Any


@dataclass
class Counters:
    """
    Since the bridge was opened.

    Attributes
    ----------
    connections, disconnections
        How often an autopilot came, and (PX4) closed its connection.
    restarts
        How often another process took over, for which the vehicle was put back to its start.
    sent, answered
        States sent, and those that were answered in time.
    repeated
        PX4: answers to a state that was answered before. ArduPilot: packets asked for again.
    late
        Answers to an earlier state than the one just sent.
    missed
        States without an answer in time.
    malformed
        Messages or packets that could not be read, or made no sense.
    strangers
        ArduPilot: packets of another sender than the autopilot, where the system let them pass.
    gone
        How often an autopilot that had answered fell silent.

    """

    connections: int = 0
    disconnections: int = 0
    restarts: int = 0
    sent: int = 0
    answered: int = 0
    repeated: int = 0
    late: int = 0
    missed: int = 0
    malformed: int = 0
    strangers: int = 0
    gone: int = 0
    last_fault: str = ''
    _since: float = field(default=0.0, repr=False)
    _answered_then: int = field(default=0, repr=False)

    def fault(self, line: str) -> None:
        """
        Count something malformed and keep what it was.

        Parameters
        ----------
        line
            What was wrong, in one line.

        """
        self.malformed += 1
        self.last_fault = line

    def values(self) -> dict[str, Any]:
        """Return the counts, and the rate of answers since the last call [Hz of wall time]."""
        now = time.monotonic()
        rate = (self.answered - self._answered_then) / (now - self._since) if self._since else 0.0
        self._since, self._answered_then = now, self.answered
        counts = {key: value for key, value in asdict(self).items() if key[0] != '_'}
        return counts | {'answers_per_s': round(rate, 1)}
