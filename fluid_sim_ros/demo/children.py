# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Child processes with a log file each, and a clear word when one of them dies."""

import os
import signal
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.mavlink.program.family import die_with_parent

#: How long a child may take to end after SIGINT, and again after SIGTERM [s].
_GRACE = 5.0
#: Lines of a dead child's log that are shown.
_TAIL = 8


class Child:
    """
    A Python module of this package that runs as a process, and no longer than this one.

    Parameters
    ----------
    name
        What to call it.
    module
        Module to run with ``-m``.
    arguments
        Its arguments.
    environment
        Variables set on top of this process's own.
    log
        File that takes its output.

    """

    def __init__(
        self,
        name: str,
        module: str,
        arguments: Sequence[str],
        environment: dict[str, str],
        log: Path,
    ) -> None:
        self.name = name
        self._log = log
        with log.open('wb') as output:
            self.process = subprocess.Popen(
                [sys.executable, '-m', module, *arguments],
                stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT,
                env={**os.environ, 'PYTHONUNBUFFERED': '1', **environment},
                preexec_fn=die_with_parent,
            )  # fmt: skip

    @property
    def running(self) -> bool:
        """True while the process runs."""
        return self.process.poll() is None

    def check(self) -> None:
        """
        Check that the process runs, or ended well.

        Raises
        ------
        FluidSimError
            If it died, with the last lines that it wrote.

        """
        code = self.process.poll()
        if code not in (None, 0):
            raise FluidSimError(f'{self.name} ended with exit code {code}; {self.last_words()}')

    def last_words(self) -> str:
        """Return the end of its log and where the whole of it lies."""
        lines = self._log.read_text(encoding='utf-8', errors='replace').strip().splitlines()
        if not lines:
            return f'it wrote nothing to {self._log}'
        return f'its last lines (all in {self._log}):\n  ' + '\n  '.join(lines[-_TAIL:])

    def stop(self) -> int:
        """
        End the process, kindly at first; return its exit code.

        Returns
        -------
        int
            As of the shell: negative where a signal has ended it.

        """
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
            if not self.running:
                break
            self.process.send_signal(number)
            try:
                self.process.wait(_GRACE)
            except subprocess.TimeoutExpired:
                continue
        return self.process.wait()
