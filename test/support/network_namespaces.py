# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Two network namespaces with a cable between them: this host, and one beside it."""

import os
import shutil
import subprocess
from contextlib import contextmanager

import pytest

#: Addresses of the two ends (RFC 5737, TEST-NET-2: of nobody).
HERE, THERE = '198.51.100.1', '198.51.100.2'


def _ip(*words, check=True):
    return subprocess.run(
        ['ip', *map(str, words)], capture_output=True, text=True, check=check, timeout=20
    )


@contextmanager
def two_hosts():
    """Yield what to put before a command to run it here, and there; skips where that cannot be."""
    if os.geteuid() or not shutil.which('ip'):
        pytest.skip('network namespaces need root and the command ip')
    here, there = (f'fluid_sim_{os.getpid()}_{side}' for side in 'ab')
    ends = f'fsa{os.getpid()}', f'fsb{os.getpid()}'
    made = _ip('netns', 'add', here, check=False)
    if made.returncode:
        pytest.skip(f'no network namespace can be made here: {made.stderr.strip()}')
    try:
        _ip('netns', 'add', there)
        _ip('link', 'add', ends[0], 'netns', here, 'type', 'veth', 'peer', 'name', ends[1],
            'netns', there)  # fmt: skip
        for space, end, address in zip((here, there), ends, (HERE, THERE), strict=True):
            _ip('-n', space, 'addr', 'add', f'{address}/24', 'dev', end)
            _ip('-n', space, 'link', 'set', end, 'up')
            _ip('-n', space, 'link', 'set', 'lo', 'up')
        # Linux says of few closed ports per second that they are closed, unless it is told to
        _ip('netns', 'exec', here, 'sh', '-c', 'echo 0 >/proc/sys/net/ipv4/icmp_ratelimit')
        yield [['ip', 'netns', 'exec', space] for space in (here, there)]
    finally:
        for space in (here, there):
            _ip('netns', 'del', space, check=False)
