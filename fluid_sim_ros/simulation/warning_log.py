# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What a run has to say to its user: found at load, or by a watchdog on the way."""

from collections.abc import Iterable


class WarningLog:
    """
    Warnings in the order in which they came up, each once.

    Every front end shows the lines: as they come, in its result, in diagnostics and in the log.

    Parameters
    ----------
    lines
        What was found at load.

    Attributes
    ----------
    lines
        One sentence or two each.

    """

    def __init__(self, lines: Iterable[str] = ()) -> None:
        self.lines: list[str] = []
        self._keys: set[str] = set()
        for line in lines:
            self.add(line)

    def add(self, line: str, key: str = '') -> bool:
        """
        Keep a line, unless the same was said before.

        Parameters
        ----------
        line
            What to say.
        key
            What it is about, for lines that say the same with other numbers; default: the line.

        Returns
        -------
        bool
            Whether it is new.

        """
        if (key or line) in self._keys:
            return False
        self._keys.add(key or line)
        self.lines.append(line)
        return True
