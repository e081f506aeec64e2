# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""One check of the doctor, and what checks share."""

import os
import subprocess
import sys
from dataclasses import asdict, dataclass
from importlib import metadata
from typing import Literal

State = Literal['ok', 'absent', 'broken']
_PROBE_TIMEOUT = 30.0  # [s] of wall time


@dataclass(frozen=True)
class Row:
    """
    One check.

    Attributes
    ----------
    name
        What was looked at.
    state
        ``ok``; ``absent``: not there, needed by some tasks only; ``broken``: must be mended.
    found
        What is there.
    remedy
        What to do or type, empty when nothing is wrong.

    """

    name: str
    state: State
    found: str
    remedy: str = ''

    def as_dict(self) -> dict[str, str]:
        """Return the row for JSON."""
        return asdict(self)


def version(distribution: str) -> str:
    """
    Return an installed distribution's version, or nothing.

    Parameters
    ----------
    distribution
        As pip names it.

    """
    try:
        return metadata.version(distribution)
    except metadata.PackageNotFoundError:
        return ''


def probe(script: str, **environment: str) -> tuple[str, str]:
    """
    Run a script in a Python of its own.

    Parameters
    ----------
    script
        Python source text.
    **environment
        Variables that are set for it.

    Returns
    -------
    output, fault
        What it printed; and in one line why it failed, empty if it did not.

    """
    try:
        done = subprocess.run(
            [sys.executable, '-c', script], env={**os.environ, **environment},
            capture_output=True, text=True, timeout=_PROBE_TIMEOUT, check=False,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return '', f'no answer in {_PROBE_TIMEOUT:g} s'
    if done.returncode:
        lines = done.stderr.strip().splitlines() or [f'the process ended with {done.returncode}']
        return '', ' '.join(lines[-1].split())[:200]
    return done.stdout.strip(), ''
