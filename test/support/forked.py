# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Processes of our programs for tests that are not about how one starts.

Importing takes most of the processor time of a short one; here it is done once
(``fork_server``), and each process is a fork of that: with its own id, signals, environment,
output and exit code, as one that was started afresh.
"""

import atexit
import functools
import json
import os
import signal
import socket
import subprocess
import sys
from pathlib import Path

from test.support.paths import ROOT


@functools.cache
def _server():
    """Start the server of this test process; it ends with it."""
    # a fork has no threads, so that none may be started before it, as numpy's libraries would
    environment = {**os.environ, 'OPENBLAS_NUM_THREADS': '1'}
    ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    with theirs:
        server = subprocess.Popen(
            [sys.executable, '-m', 'test.support.fork_server', str(theirs.fileno())],
            pass_fds=[theirs.fileno()], cwd=ROOT, stdin=subprocess.DEVNULL,
            start_new_session=True, env=environment,
        )  # fmt: skip

    def end():
        ours.close()
        server.wait()

    atexit.register(end)
    return ours


class Fork:
    """
    A forked process, with that part of ``subprocess.Popen`` which tests use.

    Parameters
    ----------
    module
        What it runs, as ``python -m`` would.
    arguments
        Of its command line.

    Attributes
    ----------
    stdout
        Text that it writes, to either stream.
    pid
        Its number.

    """

    def __init__(self, module, *arguments):
        request = {
            'module': module, 'arguments': arguments, 'environment': dict(os.environ),
            'folder': str(Path.cwd()),
        }  # fmt: skip
        read, write = os.pipe()
        self._told, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with theirs:
            text = json.dumps(request).encode()
            socket.send_fds(_server(), [text], [write, theirs.fileno()])
        os.close(write)
        self.stdout = os.fdopen(read, encoding='utf-8', errors='replace')
        self.pid = int(self._told.recv(32))
        self.returncode = None

    def wait(self, timeout=None):
        """Return the exit code, negative for a signal, as ``subprocess.Popen.wait``."""
        if self.returncode is None:
            self._told.settimeout(timeout)
            try:
                said = self._told.recv(32)
            except (TimeoutError, BlockingIOError):
                raise subprocess.TimeoutExpired('a forked process', timeout or 0) from None
            self.returncode = int(said)
            self._told.close()
        return self.returncode

    def poll(self):
        """Return the exit code, or None while it runs."""
        try:
            return self.wait(0)
        except subprocess.TimeoutExpired:
            return None

    def send_signal(self, number):
        """Send a signal unless it has ended."""
        if self.poll() is None:
            os.kill(self.pid, number)

    def kill(self):
        self.send_signal(signal.SIGKILL)
