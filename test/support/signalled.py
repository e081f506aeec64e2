# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Programs that signal themselves, each in a process of its own."""

import subprocess
import sys
import textwrap

PROGRAM = """
    import os, signal, sys, time
    from fluid_sim_ros.interruption import *
    from fluid_sim_ros.interruption import handler, late_end, program
    def kill(number=signal.SIGTERM):
        os.kill(os.getpid(), number)
    begin('x')
    begun()
"""


def run_code(code):
    """Run the text of a program; return what became of it."""
    return subprocess.run(
        [sys.executable, '-c', textwrap.dedent(code)], capture_output=True, text=True, timeout=60,
        check=False,
    )  # fmt: skip


def program(code):
    """Run what follows ``PROGRAM``; return what became of it."""
    return run_code(textwrap.dedent(PROGRAM) + textwrap.dedent(code))
