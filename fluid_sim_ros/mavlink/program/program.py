# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Runs an autopilot's own program as a child: arguments, log, and an end together with ours."""

import os
import signal
import subprocess
import tempfile
import threading
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.loop.autopilot_port import AutopilotOptions
from fluid_sim_ros.mavlink.mapping import AutopilotFile
from fluid_sim_ros.mavlink.program.command_line import command_line
from fluid_sim_ros.mavlink.program.family import Guard, die_with_parent, ended, family_of, kill
from fluid_sim_ros.mavlink.program.parameters import px4_environment

#: Longest line of the log that is shown [bytes]; the rest follows as another.
_LONGEST_LINE = 1000
#: How long a program may take to end when it is asked to [s]; ArduPilot does not listen.
_GRACE = {'px4': 3.0, 'ardupilot': 0.5}
#: How long the reader may take to show what was written before the end [s].
_LAST_LINES = 1.0


class Program:
    """
    An autopilot that runs as a child.

    Parameters
    ----------
    command
        What the user would type, without what the bridge knows better.
    options, file
        Which instance of what.
    home
        Latitude and longitude [deg], altitude [m], heading [deg].
    parameters
        What it is set to: value by name.
    show
        Takes each line that it writes; called in a thread of its own.

    Raises
    ------
    ConfigError
        If it cannot be started.

    """

    def __init__(
        self,
        command: str,
        options: AutopilotOptions,
        file: AutopilotFile,
        home: Sequence[float],
        parameters: Mapping[str, float],
        show: Callable[[str], None],
    ) -> None:
        self._grace = _GRACE[options.protocol]
        self._end: int | None = None
        self._folder = tempfile.TemporaryDirectory(prefix='fluid_sim_autopilot_')
        environment = dict(os.environ)
        if options.protocol == 'px4':
            environment |= {'PX4_SYS_AUTOSTART': file.airframe}
            environment |= px4_environment(parameters, os.environ)
        try:
            arguments = command_line(command, options, parameters, home, Path(self._folder.name))
            self._process = subprocess.Popen(
                arguments, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT, env=environment,
                # a group of its own: Ctrl-C ends the simulation, which ends the program
                start_new_session=True, preexec_fn=die_with_parent,
            )  # fmt: skip
        except (ConfigError, OSError) as error:
            self._folder.cleanup()
            if isinstance(error, OSError):
                raise ConfigError(f'--exec {arguments[0]}: {error.strerror}') from None
            raise
        self._guard = Guard(self._process.pid)
        self._reader = threading.Thread(target=self._read, args=(show,), daemon=True)
        self._reader.start()

    @property
    def exit_code(self) -> int | None:
        """How it ended, minus the number of a signal that ended it, or None while it runs."""
        if self._end is None:
            self._end = ended(self._process.pid, 0.0)
        return self._end

    def _read(self, show: Callable[[str], None]) -> None:
        stream = self._process.stdout
        while stream is not None and (line := stream.readline(_LONGEST_LINE)):
            with suppress(OSError):  # nobody to show it to; read on, or the program would wait
                show(line.decode(errors='replace').rstrip())

    def wait_for_output(self) -> None:
        """Let what it wrote before its end be shown first."""
        self._reader.join(_LAST_LINES)

    def close(self) -> None:
        """End it, and whatever it has started."""
        identity = self._process.pid
        family = family_of(identity)
        if self.exit_code is None:
            os.killpg(identity, signal.SIGTERM)
            self._end = ended(identity, self._grace)
        # not reaped yet, so that its id, that of the group, is still its own
        with suppress(ProcessLookupError):
            os.killpg(identity, signal.SIGKILL)
        kill(family)
        self._process.wait()
        self._end = self._end if self._end is not None else self._process.returncode
        self._guard.dismiss()
        self._reader.join(_LAST_LINES)
        self._folder.cleanup()


def ending(code: int) -> str:
    """
    Return in words how a program has ended.

    Parameters
    ----------
    code
        As ``Program.exit_code``.

    Returns
    -------
    str
        ``ended with code 255``, ``was ended by SIGKILL``.

    """
    if code >= 0:
        return f'ended with code {code}'
    known = {number.value: number.name for number in signal.Signals}
    return f'was ended by {known.get(-code, f"signal {-code}")}'
