# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""No heap allocation while the plugins evaluate, counted by a preloaded malloc."""

import ctypes
import os
import subprocess
import sys

import numpy as np
import pytest

from benchmarks.vehicles.validation_bodies import settling_world
from fluid_sim_ros.plugins.native import native
from test.support.foil_models import AEROSONDE, foil_world
from test.support.paths import ROOT
from test.support.plugin_models import load
from test.support.sea_models import sea_xml, start
from test.support.thruster_models import T200, rotor_world

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

SEA = {'surface': 0.0, 'density': 1000, 'density_above': 1.2}
POLYNOMIAL = {
    'curve': 'polynomial', 'polynomial_forward': [1e-3, 1e-6], 'rad_s_max': 900,
    'rotor_drag': 1e-5, 'ground_effect': 'cheeseman_bennett', 'diameter': 0.3,
}  # fmt: skip
WORLDS = {
    'wing': foil_world({'span': 0.5, 'chord': 0.1, 'panels': 4}, medium=SEA),
    'aircraft': foil_world(AEROSONDE),
    'T200': rotor_world(T200),
    'polynomial': rotor_world(POLYNOMIAL, medium=SEA),
    'history': settling_world(1e-3, 2.56, history='dorgan_loth'),
}
INTEGRATORS = ('RK4', 'implicitfast', 'discrete')


def moving():
    """Yield each model in motion, with its name."""
    for integrator in INTEGRATORS:
        model, data = load(sea_xml(integrator=integrator))
        start(model, data)
        yield integrator, model, data
    for name, xml in WORLDS.items():
        model, data = load(xml)
        data.qvel[:3], data.ctrl[:] = [1, 0.2, 0.1], 0.5
        yield name, model, data


def count_allocations():
    """Print, for each model, how many allocations one step and a thousand more make."""
    allocations = ctypes.CDLL(None).allocations
    allocations.restype = ctypes.c_long
    step, report = native().step, np.zeros(2)
    for name, model, data in moving():
        arguments = model._address, data._address
        step(*arguments, 1, report.ctypes.data)
        before = allocations()
        step(*arguments, 1, report.ctypes.data)
        one = allocations() - before
        before = allocations()
        assert step(*arguments, 1000, report.ctypes.data) == 1000
        print(name, one, allocations() - before)
    before = allocations()
    ctypes.create_string_buffer(1 << 20)
    print('control', 0, allocations() - before)


@pytest.fixture(scope='module')
def counts(tmp_path_factory):
    folder = tmp_path_factory.mktemp('counter')
    source, library = folder / 'counter.cc', folder / 'counter.so'
    source.write_text(COUNTER)
    command = ['g++', '-O1', '-shared', '-fPIC', str(source), '-o', str(library)]
    subprocess.run(command, check=True)
    program = 'from test.plugins.test_no_allocation import count_allocations as c; c()'
    done = subprocess.run(
        [sys.executable, '-c', program],
        env=dict(os.environ, LD_PRELOAD=str(library), PYTHONPATH=str(ROOT)),
        capture_output=True, text=True, check=False, cwd=folder,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    rows = [line.split() for line in done.stdout.splitlines()]
    return {name: (int(one), int(many)) for name, one, many in rows}


def test_the_counter_counts(counts):
    assert counts['control'][1] > 0


@pytest.mark.parametrize('name', [*INTEGRATORS, *WORLDS])
def test_a_thousand_steps_allocate_no_more_than_one_call(counts, name):
    one, many = counts[name]  # what the foreign call itself takes
    assert many == one
