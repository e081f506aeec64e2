# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Commands whose standard error is a terminal, as when a person types them."""

import os
import pty
import subprocess


def shown_in_a_terminal(command):
    """Run a command that must succeed; return what the terminal got of its standard error."""
    master, slave = pty.openpty()
    process = subprocess.Popen(
        command, stdout=subprocess.DEVNULL, stderr=slave, env={**os.environ, 'TERM': 'xterm'}
    )
    os.close(slave)
    seen = b''
    while True:
        try:
            seen += os.read(master, 4096)
        except OSError:  # the other end is closed
            break
    os.close(master)
    assert process.wait() == 0
    return seen
