# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Check that a built wheel is whole: its files, its tag, and what its library looks for."""

import io
import re
import subprocess
import sys
import zipfile
from pathlib import Path

from elftools.elf.elffile import ELFFile

ROOT = Path(__file__).resolve().parents[1]
LIBRARY = 'fluid_sim_ros/plugins/libfluid_sim.so'
#: The folders of data, which a wheel holds under its own name.
DATA = ('config', 'models', 'launch')
#: Sources of the library: in the source archive, not in a wheel.
SOURCES = 'fluid_sim_ros/plugins/src/'
#: Where the library finds MuJoCo's: beside the package, wherever it is installed.
SEARCH_PATH = '$ORIGIN/../../mujoco'
NAME = re.compile(r'fluid_sim_ros-[\w.]+-py3-none-manylinux_\d+_\d+_\w+\.whl')


def expected() -> set[str]:
    """Return the files that a wheel must hold, by their names in the source tree."""
    listing = subprocess.run(
        ['git', 'ls-files', 'fluid_sim_ros', *DATA],
        cwd=ROOT, capture_output=True, text=True, check=True,
    ).stdout.splitlines()  # fmt: skip
    return {name for name in listing if not name.startswith(SOURCES)} | {LIBRARY}


def faults(wheel: Path, wanted: set[str]) -> list[str]:
    """Return one line for each thing that is wrong with a wheel."""
    found = []
    if not NAME.fullmatch(wheel.name):
        found.append(f'{wheel.name}: the tag is not py3-none-manylinux')
    with zipfile.ZipFile(wheel) as archive:
        names = {re.sub(r'^[^/]+\.data/data/share/fluid_sim_ros/', '', name)
                 for name in archive.namelist()}  # fmt: skip
        found += [f'{name} is missing' for name in sorted(wanted - names)]
        found += [f'{name} does not belong there' for name in sorted(names)
                  if 'libmujoco' in name or name.startswith(SOURCES)]  # fmt: skip
        if LIBRARY in names:
            found += library_faults(archive.read(LIBRARY))
    return found


def library_faults(content: bytes) -> list[str]:
    """Return one line for each thing that ties the library to the machine that built it."""
    tags = list(ELFFile(io.BytesIO(content)).get_section_by_name('.dynamic').iter_tags())
    paths = [tag.runpath for tag in tags if tag.entry.d_tag == 'DT_RUNPATH']
    needed = [tag.needed for tag in tags if tag.entry.d_tag == 'DT_NEEDED']
    found = []
    if paths != [SEARCH_PATH]:
        found.append(f'{LIBRARY} looks for libraries in {paths}, not in {SEARCH_PATH} alone')
    if not any(name.startswith('libmujoco.so') for name in needed):
        found.append(f'{LIBRARY} is not linked with MuJoCo: it needs {needed}')
    return found


def main() -> int:
    """Print what is wrong with the wheels of the command line."""
    wrong = [line for name in sys.argv[1:] for line in faults(Path(name), expected())]
    for line in wrong or [f'wheel: {Path(name).name} is whole' for name in sys.argv[1:]]:
        print(line)
    return bool(wrong)


if __name__ == '__main__':
    sys.exit(main())
