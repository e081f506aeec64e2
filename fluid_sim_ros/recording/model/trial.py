# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Loads the model in a log for a trial, in a process that may not take much memory or time.

MuJoCo compiles what a log's model asks for: 1e8 replicas, a texture of 1e10 pixels, a mesh that is
damaged in a way that it does not notice. The trial meets that first. It ends at the limits
``model_bytes`` and ``model_seconds``, and if it crashes, this process does not.
"""

import json
import os
import resource
import signal
import subprocess
import sys
from pathlib import Path

from fluid_sim_ros.errors import FluidSimError, printable
from fluid_sim_ros.recording.damage import LogError
from fluid_sim_ros.schema.limits import beyond, limit

#: What the files of the model allow for, beyond the limits.
_BYTES_PER_BYTE, _SECONDS_PER_BYTE = 100, 2e-6
#: Each thread in which MuJoCo compiles [bytes]: its stack and its part of the heap.
_THREAD = 16 << 20
#: Wall time beyond that of the processor, on a busy machine [s].
_PATIENCE = 20.0
_CANNOT, _MEMORY = 3, 4
#: What MuJoCo says where memory is refused; the second is all that its bindings say of bad_alloc.
_OF_MEMORY = ('allocate memory', 'Caught an unknown exception')

#: Files whose models have passed, as they were, and under which limits.
_passed: set[tuple[int, ...]] = set()


def try_model(path: Path) -> None:
    """
    Load a log's model in a process of its own and take one step; once as long as nothing changes.

    Parameters
    ----------
    path
        The log, which holds a run.

    Raises
    ------
    LogError
        If the model has a fault, goes beyond a limit, or ends the process.

    """
    # -P: modules that lie in the working folder are not imported
    command = [sys.executable, '-P', '-m', 'fluid_sim_ros.recording.model.trial', os.fspath(path)]
    file = path.stat()
    size = file.st_size
    key = (
        file.st_dev, file.st_ino, size, file.st_mtime_ns, file.st_ctime_ns,
        limit('model_bytes'), limit('model_seconds'),
    )  # fmt: skip
    if key in _passed:
        return
    patience = limit('model_seconds') + _SECONDS_PER_BYTE * size + _PATIENCE
    environment = os.environ | {'MALLOC_ARENA_MAX': '2'}
    try:
        done = subprocess.run(
            command, capture_output=True, timeout=patience, check=False, env=environment
        )
    except subprocess.TimeoutExpired:
        raise _too_long(path) from None
    if not done.returncode:
        _passed.add(key)
        return
    if done.returncode == _CANNOT:
        raise LogError(json.loads(done.stdout.splitlines()[-1]))
    if done.returncode == _MEMORY or b'bad_alloc' in done.stderr:
        raise _too_large(path)
    if -done.returncode in (signal.SIGXCPU, signal.SIGKILL):
        raise _too_long(path)
    said = printable(' '.join(done.stderr.decode(errors='replace').split())[-300:], 300)
    raise LogError(
        f'{path}: MuJoCo cannot load its model: the trial ended with code {done.returncode}'
        + (f' ({said})' if said else '')
    )


def _too_large(path: Path) -> LogError:
    most = limit('model_bytes')
    return LogError(f'{path}: {beyond("model_bytes", most, "the memory for its model")}')


def _too_long(path: Path) -> LogError:
    most = limit('model_seconds')
    return LogError(f'{path}: {beyond("model_seconds", most, "the time to load its model")}')


def _load(path: Path) -> None:
    from fluid_sim_ros.recording.reader import open_log
    from fluid_sim_ros.recording.replay.repetition import Repetition

    log = open_log(path)
    description = log.description()
    size = sum(map(len, description.files.values()))
    _hold_back(size)
    repetition = Repetition(description, {})
    repetition.simulation.step()
    repetition.simulation.observe(forces=True)


def _hold_back(size: int) -> None:
    """Allow this process what the limits allow for a model whose files have a size [bytes]."""
    used = resource.getrusage(resource.RUSAGE_SELF)
    seconds = int(
        used.ru_utime + used.ru_stime + limit('model_seconds') + _SECONDS_PER_BYTE * size + 1
    )
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    numbers = Path('/proc/self/statm')
    if not numbers.exists():  # not Linux: only time is limited
        return
    now = int(numbers.read_text(encoding='ascii').split()[5]) * resource.getpagesize()
    threads = (os.cpu_count() or 1) * _THREAD
    most = now + limit('model_bytes') + _BYTES_PER_BYTE * size + threads
    resource.setrlimit(resource.RLIMIT_DATA, (most, most))


def _main(path: Path) -> int:
    from fluid_sim_ros.recording.damage import reading

    try:
        with reading(path):
            _load(path)
    except FluidSimError as error:
        if isinstance(error.__cause__, MemoryError) or any(w in str(error) for w in _OF_MEMORY):
            return _MEMORY
        sys.stdout.write(json.dumps(str(error)) + '\n')
        return _CANNOT
    return 0


if __name__ == '__main__':
    code = _main(Path(sys.argv[1]))
    sys.stdout.flush()
    os._exit(code)  # without freeing what may be damaged
