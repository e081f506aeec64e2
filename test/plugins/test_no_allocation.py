"""No heap allocation while the plugins evaluate, counted by a preloaded malloc."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

COUNTER = r"""
#include <dlfcn.h>
#include <cstddef>
static thread_local long count = 0;
extern "C" long allocations() { return count; }
extern "C" void* __libc_malloc(size_t);
extern "C" void* __libc_calloc(size_t, size_t);
extern "C" void* __libc_realloc(void*, size_t);
extern "C" void* malloc(size_t n) { ++count; return __libc_malloc(n); }
extern "C" void* calloc(size_t a, size_t b) { ++count; return __libc_calloc(a, b); }
extern "C" void* realloc(void* p, size_t n) { ++count; return __libc_realloc(p, n); }
"""

PROGRAM = r"""
import ctypes, sys
import numpy as np
sys.path[:0] = sys.argv[1:3]
from plugin_common import load, set_medium
from fluid_sim_ros.plugins.native import native
from test_same_bits import sea_xml, start
step = native().step
allocations = ctypes.CDLL(None).allocations
allocations.restype = ctypes.c_long
report = np.zeros(2)
for integrator in ('RK4', 'implicitfast', 'discrete'):
    model, data = load(sea_xml(integrator=integrator))
    start(model, data)
    m, d, r = model._address, data._address, report.ctypes.data
    step(m, d, 1, r)
    before = allocations()
    step(m, d, 1, r)
    one = allocations() - before
    before = allocations()
    assert step(m, d, 1000, r) == 1000
    print(integrator, one, allocations() - before)
assert np.zeros(1 << 16) is not None
before = allocations()
copy = ctypes.create_string_buffer(1 << 20)
print('control', 0, allocations() - before)
"""


@pytest.fixture(scope='module')
def counts(tmp_path_factory):
    folder = tmp_path_factory.mktemp('counter')
    source, library = folder / 'counter.cc', folder / 'counter.so'
    source.write_text(COUNTER)
    command = ['g++', '-O1', '-shared', '-fPIC', str(source), '-o', str(library)]
    subprocess.run(command, check=True)
    root = Path(__file__).parents[2]
    environment = dict(os.environ, LD_PRELOAD=str(library), PYTHONPATH=str(root))
    done = subprocess.run(
        [sys.executable, '-c', PROGRAM, str(root / 'benchmarks'), str(Path(__file__).parent)],
        env=environment, capture_output=True, text=True, check=False, cwd=folder,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    rows = [line.split() for line in done.stdout.splitlines()]
    return {name: (int(one), int(many)) for name, one, many in rows}


def test_the_counter_counts(counts):
    assert counts['control'][1] > 0


@pytest.mark.parametrize('integrator', ['RK4', 'implicitfast', 'discrete'])
def test_a_thousand_steps_allocate_no_more_than_one_call(counts, integrator):
    one, many = counts[integrator]  # what the foreign call itself takes
    assert many == one
