"""Foils beside bodies with added mass, and no heap allocation of thrusters and foils."""

import ctypes
import os
import subprocess
import sys
from pathlib import Path

import mujoco
import numpy as np
from foil_common import AEROSONDE, foil_world
from plugin_common import body_plugin, load

BODY = {'added_mass': [1, 2, 3, 0.1, 0.2, 0.3], 'quadratic_damping': [5, 6, 7, 1, 1, 1]}


def vehicle(*, foil, body):
    """Return a hull with or without a foil and with or without added mass."""
    inside = body_plugin(**BODY) if body else ''
    xml = foil_world({'span': 0.5, 'chord': 0.1}, inside=inside, medium={'density': 1000})
    xml = xml.replace('<body name="hull">', '<body name="hull" simple="false">')
    if body:
        xml = xml.replace('<extension>', '<extension><plugin plugin="fluid_sim.body"/>')
    if not foil:
        first = xml.index('<plugin plugin="fluid_sim.foil">')
        xml = xml[:first] + xml[xml.index('</extension>') :]
    model, data = load(xml)
    data.qvel[:] = [2, 0.1, -0.2, 0.3, 0.2, 0.1]
    mujoco.mj_forward(model, data)
    return model, data


def test_forces_of_foil_and_body_add_up_and_the_inertia_is_the_bodys():
    model, both = vehicle(foil=True, body=True)
    _, foil = vehicle(foil=True, body=False)
    _, body = vehicle(foil=False, body=True)
    np.testing.assert_allclose(
        both.qfrc_passive, foil.qfrc_passive + body.qfrc_passive, rtol=1e-13
    )
    np.testing.assert_array_equal(both.M, body.M)
    mass = np.zeros((6, 6))
    mujoco.mj_fullM(model, both, mass)
    np.testing.assert_allclose(mass @ both.qacc, both.qfrc_passive - both.qfrc_bias, atol=1e-9)


COUNTER = r"""
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


def count_allocations():
    """Print, for each model, how many allocations one step and a thousand more make."""
    import foil_common
    import thruster_common

    from fluid_sim_ros.plugins.native import native

    allocations = ctypes.CDLL(None).allocations
    allocations.restype = ctypes.c_long
    polynomial = {
        'curve': 'polynomial', 'polynomial_forward': [1e-3, 1e-6], 'rad_s_max': 900,
        'rotor_drag': 1e-5, 'ground_effect': 'cheeseman_bennett', 'diameter': 0.3,
    }  # fmt: skip
    wing = {'span': 0.5, 'chord': 0.1, 'panels': 4}
    sea = {'surface': 0.0, 'density': 1000, 'density_above': 1.2}
    for xml in (
        foil_common.foil_world(wing, medium=sea), foil_common.foil_world(AEROSONDE),
        thruster_common.rotor_world(thruster_common.T200),
        thruster_common.rotor_world(polynomial, medium=sea),
    ):  # fmt: skip
        model, data = load(xml)
        data.qvel[:3], data.ctrl[:] = [1, 0.2, 0.1], 0.5
        report = np.zeros(2)
        arguments = model._address, data._address
        native().step(*arguments, 1, report.ctypes.data)
        before = allocations()
        native().step(*arguments, 1, report.ctypes.data)
        one = allocations() - before
        before = allocations()
        native().step(*arguments, 1000, report.ctypes.data)
        print(one, allocations() - before)
    before = allocations()
    ctypes.create_string_buffer(1 << 20)
    print('control', allocations() - before)


def test_no_heap_allocation_in_a_step(tmp_path):
    source, library = tmp_path / 'counter.cc', tmp_path / 'counter.so'
    source.write_text(COUNTER)
    command = ['g++', '-O1', '-shared', '-fPIC', str(source), '-o', str(library)]
    subprocess.run(command, check=True)
    here = Path(__file__)
    root = here.parents[2]
    path = os.pathsep.join(map(str, (root, root / 'benchmarks', here.parent)))
    done = subprocess.run(
        [sys.executable, '-c', f'import {here.stem}; {here.stem}.count_allocations()'],
        env=dict(os.environ, LD_PRELOAD=str(library), PYTHONPATH=path),
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    *rows, control = [line.split() for line in done.stdout.splitlines()]
    assert len(rows) == 4
    for one, thousand in rows:
        assert int(thousand) == int(one)  # the call itself, not the steps
    assert int(control[1]) >= 1
