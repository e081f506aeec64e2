# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The trials of the models in hostile logs: their memory is known, and most start at once."""

import json
import os
import select
import signal
import subprocess
import sys
import traceback
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from fluid_sim_ros.recording.model import trial
from test.support.hostile import judge
from test.support.paths import ROOT

#: Wall time for each second that the product waits for a trial: the machine may be busy, and the
#: trial's own limit of processor time ends it all the same.
_PATIENCE = 10
#: Starts a command from a small process: what Linux counts as the peak of a child begins with the
#: memory of whoever started it. Ends as the command does.
_SMALL = """\
import os, sys
child = os.posix_spawn(sys.argv[2], sys.argv[2:], os.environ)
_, status, used = os.wait4(child, 0)
with open(sys.argv[1], 'a') as peaks:
    peaks.write(f'{used.ru_maxrss}\\n')
code = os.waitstatus_to_exitcode(status)
if code < 0:
    os.kill(os.getpid(), -code)
os._exit(code)
"""


class Trials:
    """
    Starts the trials of this process.

    Parameters
    ----------
    folder
        For numbers and what trials say.

    Attributes
    ----------
    real
        The next trials are the processes that the product starts, at a second of imports each;
        else forks of one that has imported what a trial does, and runs the same function.
    peak
        The largest resident memory of a trial so far [bytes].

    """

    TimeoutExpired = subprocess.TimeoutExpired

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._parent: subprocess.Popen[str] | None = None
        self.real = True
        self.peak = 0
        trial.subprocess = self  # type: ignore[assignment]  # it uses run and TimeoutExpired

    def run(
        self, command: Sequence[str], *, timeout: float, env: Mapping[str, str], **_: Any
    ) -> subprocess.CompletedProcess[bytes]:
        """Run the command of a trial as ``subprocess.run`` does, with its output."""
        run = self._run if self.real else self._run_fork
        return run(command, _PATIENCE * timeout, env)

    def _run(
        self, command: Sequence[str], timeout: float, env: Mapping[str, str]
    ) -> subprocess.CompletedProcess[bytes]:
        path = self._folder / 'peaks'
        start = [sys.executable, '-S', '-c', _SMALL, str(path)]
        process = subprocess.Popen(
            [*start, *command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=env,
            start_new_session=True,
        )  # fmt: skip
        try:
            said = process.communicate(timeout=timeout)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)  # the trial with its small parent
            process.communicate()
            raise
        if path.exists():
            self.peak = max(self.peak, int(path.read_text().split()[-1]) << 10)
        return subprocess.CompletedProcess(command, process.returncode, *said)

    def _run_fork(
        self, command: Sequence[str], timeout: float, env: Mapping[str, str]
    ) -> subprocess.CompletedProcess[bytes]:
        if self._parent is None:
            self._parent = subprocess.Popen(
                [sys.executable, '-m', __spec__.name], cwd=ROOT, text=True,
                env={**env, 'PYTHONPATH': str(ROOT)}, stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
            )  # fmt: skip
        assert self._parent.stdin and self._parent.stdout  # they are pipes
        said = [self._folder / name for name in ('out', 'err')]
        asked = {
            'path': command[-1], 'cwd': str(Path.cwd()), 'env': dict(env), 'timeout': timeout,
            'said': [str(path) for path in said],
        }  # fmt: skip
        print(json.dumps(asked), file=self._parent.stdin, flush=True)
        told = json.loads(self._parent.stdout.readline())
        self.peak = max(self.peak, told['peak'])
        judge.elsewhere.append(told['seconds'])
        if told['code'] is None:
            raise subprocess.TimeoutExpired(command, timeout)
        out, err = (path.read_bytes() for path in said)
        return subprocess.CompletedProcess(command, told['code'], out, err)

    def close(self) -> None:
        """End the process that trials are forks of."""
        if self._parent:
            self._parent.communicate()


def _serve() -> None:
    """Run the trials that standard input asks for, each in a fork of this process."""
    from fluid_sim_ros.plugins.native import native
    from fluid_sim_ros.recording.reader import open_log
    from fluid_sim_ros.recording.replay.repetition import Repetition

    native()
    assert open_log and Repetition  # what a trial imports
    with os.fdopen(os.dup(1), 'w', encoding='utf-8') as told:
        for line in sys.stdin:
            asked = json.loads(line)
            child = os.fork()
            if not child:
                _be_trial(asked)
            handle = os.pidfd_open(child)
            ended, _, _ = select.select([handle], [], [], asked['timeout'])
            os.close(handle)
            if not ended:
                os.kill(child, signal.SIGKILL)
            _, status, used = os.wait4(child, 0)
            answer = {
                'code': os.waitstatus_to_exitcode(status) if ended else None,
                'peak': used.ru_maxrss << 10, 'seconds': used.ru_utime + used.ru_stime,
            }  # fmt: skip
            print(json.dumps(answer), file=told, flush=True)


def _be_trial(asked: dict[str, Any]) -> None:
    """Run a trial in this process, and end it as the trial ends its own."""
    code = 1
    try:
        for descriptor, path in enumerate(asked['said'], start=1):
            os.dup2(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC), descriptor)
        os.environ.clear()
        os.environ.update(asked['env'])
        os.chdir(asked['cwd'])
        code = trial._main(Path(asked['path']))
    except BaseException:  # noqa: BLE001  as the interpreter does
        traceback.print_exc()
    sys.stdout.flush()
    os._exit(code)


if __name__ == '__main__':
    _serve()
