"""Runs an autopilot's own program as a child: arguments, log, and an end together with ours."""

import ctypes
import os
import shlex
import signal
import subprocess
import tempfile
import threading
from collections.abc import Callable
from pathlib import Path

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.loop.autopilot_port import AutopilotOptions
from fluid_sim_ros.mavlink.mapping import AutopilotFile
from fluid_sim_ros.schema.scene import Home

#: Longest line of the log that is shown [bytes]; the rest follows as another.
_LONGEST_LINE = 1000
#: How long the program may take to end [s].
_GRACE = 3.0
#: So fast that ArduPilot never waits for its own clock: the bridge sets the pace.
_SPEEDUP = 100
_HEADING_EAST = 90  # [deg]: the identity attitude
_PR_SET_PDEATHSIG = 1  # prctl(2)
_LIBC = ctypes.CDLL(None)  # found before the fork: between fork and exec only calls are safe


class Program:
    """
    An autopilot that runs as a child.

    Parameters
    ----------
    command
        What the user would type, without what the bridge knows better.
    options, file, home
        Which instance of what, and where.
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
        home: Home,
        show: Callable[[str], None],
    ) -> None:
        self._folder = tempfile.TemporaryDirectory(prefix='fluid_sim_autopilot_')
        arguments = command_line(command, options, file, home, Path(self._folder.name))
        airframe = {'PX4_SYS_AUTOSTART': file.airframe} if options.protocol == 'px4' else {}
        try:
            self._process = subprocess.Popen(
                arguments, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT, env={**os.environ, **airframe},
                # a group of its own: Ctrl-C ends the simulation, which ends the program
                start_new_session=True, preexec_fn=_die_with_parent,
            )  # fmt: skip
        except OSError as error:
            self._folder.cleanup()
            raise ConfigError(f'--exec {arguments[0]}: {error.strerror}') from None
        self._reader = threading.Thread(target=self._read, args=(show,), daemon=True)
        self._reader.start()

    @property
    def exit_code(self) -> int | None:
        """How it ended, or None while it runs."""
        return self._process.poll()

    def _read(self, show: Callable[[str], None]) -> None:
        stream = self._process.stdout
        while stream is not None and (line := stream.readline(_LONGEST_LINE)):
            show(line.decode(errors='replace').rstrip())

    def close(self) -> None:
        """End it, and whatever it has started."""
        for number in (signal.SIGTERM, signal.SIGKILL):
            if self._process.poll() is None:
                os.killpg(self._process.pid, number)
                try:
                    self._process.wait(_GRACE)
                except subprocess.TimeoutExpired:
                    continue
        self._reader.join(_GRACE)
        self._folder.cleanup()


def command_line(
    command: str, options: AutopilotOptions, file: AutopilotFile, home: Home, folder: Path
) -> list[str]:
    """
    Return the arguments that start an autopilot; its parameters become a file in ``folder``.

    Parameters
    ----------
    command
        What the user would type, as one line.
    options
        Protocol, instance and address.
    file
        The mapping, which holds ArduPilot's parameters.
    home
        Where the vehicle starts [deg], [deg], [m].
    folder
        Where the file of parameters is written.

    Returns
    -------
    arguments
        The program and its arguments.

    Raises
    ------
    ConfigError
        If the command cannot be read.

    """
    try:
        arguments = shlex.split(command)
    except ValueError as error:
        raise ConfigError(f'--exec {command}: {error}') from None
    if not arguments:
        raise ConfigError('--exec: names no program')
    arguments[0] = str(Path(arguments[0]).expanduser())
    if options.protocol == 'px4':
        return [*arguments, '-d', '-i', str(options.instance)]
    place = f'{home.latitude},{home.longitude},{home.altitude},{_HEADING_EAST}'
    added = ['--model', f'JSON:{options.address}', '--home', place,
             '--speedup', str(_SPEEDUP), '-I', str(options.instance)]  # fmt: skip
    if file.parameters and '--defaults' not in arguments:
        path = folder / 'parameters.parm'
        path.write_text(''.join(f'{key} {value:g}\n' for key, value in file.parameters.items()))
        added += ['--defaults', str(path)]
    return [*arguments, *added]


def _die_with_parent() -> None:
    """Ask the kernel to end this process when the one that started it ends."""
    _LIBC.prctl(_PR_SET_PDEATHSIG, signal.SIGTERM)
