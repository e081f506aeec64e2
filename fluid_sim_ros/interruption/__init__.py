# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
SIGINT and SIGTERM end a process in good order, at whatever moment they come.

A process is in one of these states; the first signal does what the state says:

* loading: nothing is there that has to be ended, so the process ends at once;
* working: ``Interrupted`` is raised, which ends what is under way through its ``finally`` clauses;
  behind an import, or at once where nothing was made yet that has to be ended (``owns``);
* in ``held``: it is raised when the block ends;
* in ``stopped_by_signals``: a loop ends at its next boundary, and its result counts;
* settled: the result is out, so nothing happens.

A second signal within 2 s is the same wish; a later one ends the process at once. So does an end
that takes longer than 8 s after the first, or after the last ``held`` block: also one for which a
library in the main thread would have to return. Only the main thread gets signals.
"""

from fluid_sim_ros.interruption.handler import (
    NUMBERS,
    SAME_WISH,
    Interrupted,
    end_at_once,
    end_late,
    exit_code,
)
from fluid_sim_ros.interruption.late_end import LateEnd
from fluid_sim_ros.interruption.program import (
    begin,
    begun,
    held,
    interrupted_by,
    leave,
    owns,
    settle,
    stopped_by_signals,
)

__all__ = [
    'NUMBERS', 'SAME_WISH', 'Interrupted', 'LateEnd', 'begin', 'begun', 'end_at_once', 'end_late',
    'exit_code', 'held', 'interrupted_by', 'leave', 'owns', 'settle', 'stopped_by_signals',
]  # fmt: skip
