# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Run the tests of the compiled parts on a library built with AddressSanitizer and UBSan.

Builds plugins/src into a copy of the package in a temporary folder and runs there the tests of
plugins, lean stepping, instruments, exchanges with autopilots and ticks; any report of a
sanitizer aborts the run. Needs g++ with libasan and libubsan.
Run: ``python -m benchmarks.plugins.plugin_sanitize [--quick] [--json PATH]``.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import mujoco

from benchmarks.common import ROOT, arguments, write

# GCC leaves float-cast-overflow out of undefined; the assertions are those of the C++ library.
FLAGS = (
    '-fsanitize=address,undefined,float-cast-overflow', '-fno-sanitize-recover=all',
    '-fno-omit-frame-pointer', '-D_GLIBCXX_ASSERTIONS',
)  # fmt: skip
# With this macro MuJoCo's headers call stack functions that only a sanitized MuJoCo has.
PLAIN_MUJOCO = '-U__SANITIZE_ADDRESS__'
TESTS = (
    'plugins', 'simulation/lean', 'sensors', 'mavlink/test_compiled.py',
    'mavlink/test_usual_exchange.py', 'messages/test_compiled_tick.py',
)  # fmt: skip
QUICK_TESTS = ('plugins/test_same_bits.py', 'plugins/test_load_checks.py')
# The allocation counter preloads its own malloc, which a sanitizer does not allow.
LEFT_OUT = ('plugins/test_no_allocation.py',)


def build(package: Path) -> None:
    """Compile the sanitized library into a copy of the package."""
    wheel = Path(mujoco.__file__).parent
    library = wheel / f'libmujoco.so.{mujoco.__version__}'
    include = (f'-I{wheel / "include"}', f'-I{package / "plugins/src"}')
    sources = sorted(str(path) for path in (package / 'plugins/src').rglob('*.cc'))
    command = [
        'g++', '-std=c++17', '-O1', '-g', '-fPIC', '-shared', '-fvisibility=hidden',
        '-ffp-contract=off', *FLAGS, PLAIN_MUJOCO, *include, *sources, str(library),
        f'-Wl,-rpath,{wheel}', '-o', str(package / 'plugins/libfluid_sim.so'),
    ]  # fmt: skip
    subprocess.run(command, check=True)


def runtime(name: str) -> str:
    """Return the path of a sanitizer's runtime library."""
    done = subprocess.run(
        ['g++', f'-print-file-name={name}'], capture_output=True, text=True, check=True
    )
    return done.stdout.strip()


def sanitized_copy(folder: Path) -> dict[str, str]:
    """Copy the package and its tests, build the library there; return the environment for it."""
    for name in ('fluid_sim_ros', 'benchmarks', 'test', 'models', 'config', 'doc'):
        shutil.copytree(
            ROOT / name, folder / name, ignore=shutil.ignore_patterns('__pycache__', '*.so')
        )
    shutil.copy(ROOT / 'pyproject.toml', folder)  # the settings of pytest
    build(folder / 'fluid_sim_ros')
    return dict(
        os.environ,
        LD_PRELOAD=f'{runtime("libasan.so")}:{runtime("libubsan.so")}',
        PYTHONPATH=str(folder),
        PYTHONMALLOC='malloc',
        ASAN_OPTIONS='detect_leaks=0:abort_on_error=1',  # the interpreter leaks at exit
        UBSAN_OPTIONS='print_stacktrace=1:halt_on_error=1',
    )


def reports(output: str) -> list[str]:
    """Return the lines in which a sanitizer or the C++ library reports something."""
    return re.findall(r'.*(?:runtime error|ERROR: AddressSanitizer|Assertion .* failed).*', output)


def run(folder: Path, quick: bool) -> dict[str, Any]:
    """Copy, build and test; return what happened."""
    environment = sanitized_copy(folder)
    command = [
        sys.executable, '-m', 'pytest', '-q', '-x', '-p', 'no:cacheprovider', '-o', 'timeout=0',
        '--rootdir', str(folder), *(f'--ignore={folder / "test" / name}' for name in LEFT_OUT),
        *(str(folder / 'test' / name) for name in (QUICK_TESTS if quick else TESTS)),
    ]  # fmt: skip
    done = subprocess.run(
        command, env=environment, cwd=folder, capture_output=True, text=True, check=False
    )
    output = done.stdout + done.stderr
    passed = re.search(r'(\d+) passed', output)
    reported = reports(output)
    if done.returncode:
        print(output[-6000:])
    return {
        'clean': done.returncode == 0 and not reported,
        'tests_passed': int(passed[1]) if passed else 0,
        'reports': reported,
        'flags': FLAGS,
    }


def main() -> None:
    """Run, print and write JSON; fail when anything was reported."""
    options = arguments(__doc__ or '', 'plugin_sanitize')
    options.json = options.json.resolve()
    with TemporaryDirectory() as folder:
        result = run(Path(folder), options.quick)
    print(f'clean: {result["clean"]}, {result["tests_passed"]} tests passed')
    write(options.json, result)
    sys.exit(0 if result['clean'] else 1)


if __name__ == '__main__':
    main()
