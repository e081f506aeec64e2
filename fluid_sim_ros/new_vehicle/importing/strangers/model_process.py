# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The process that compiles a stranger's MJCF model for a trial: ``python -m ... FILE BYTES``.

MuJoCo compiles what a model asks for: 1e8 replicas, a texture of 1e10 pixels. Memory and time are
limited here by the limits of models, and for what its files allow.
"""

import math
import os
import resource
import sys
from pathlib import Path

import mujoco

from fluid_sim_ros.plugins import load_plugins
from fluid_sim_ros.schema.limits import limit

#: What the files of a model allow for, beyond the limits.
BYTES_PER_BYTE, SECONDS_PER_BYTE = 100, 2e-6
#: Exit codes: MuJoCo refuses the model, or has no memory for it.
REFUSED, MEMORY = 3, 4
#: What MuJoCo says where memory is refused; the second is all that its bindings say of bad_alloc.
_OF_MEMORY = ('allocate memory', 'unknown exception', 'bad_alloc')


def main() -> int:
    """
    Compile the model of the command line.

    Returns
    -------
    int
        0, or ``REFUSED`` or ``MEMORY``: the last line of standard error says why.

    """
    path, size = sys.argv[1], int(sys.argv[2])
    load_plugins()
    used = resource.getrusage(resource.RUSAGE_SELF)
    pages = Path('/proc/self/statm').read_text(encoding='ascii').split()[5]
    memory = int(pages) * resource.getpagesize()
    memory += limit('model_bytes') + BYTES_PER_BYTE * size
    seconds = limit('model_seconds') + SECONDS_PER_BYTE * size + used.ru_utime + used.ru_stime
    resource.setrlimit(resource.RLIMIT_DATA, (memory, memory))
    resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(seconds), math.ceil(seconds) + 1))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    try:
        mujoco.MjSpec.from_file(path).compile()
    except MemoryError:
        return MEMORY
    except Exception as error:  # noqa: BLE001  whatever a stranger's model makes it raise
        words = ' '.join(str(error).split())
        if any(word in words for word in _OF_MEMORY):
            return MEMORY
        sys.stderr.write(f'\n{words[:500]}\n')
        return REFUSED
    return 0


if __name__ == '__main__':
    code = main()
    sys.stderr.flush()
    os._exit(code)  # without freeing what may be damaged
