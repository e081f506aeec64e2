# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The process that expands a xacro file: ``python -m ... FILE [PACKAGE FOLDER ...]``.

Memory and time are limited; files are read from the file's folder, its package and the packages.
"""

import resource
import sys
from pathlib import Path
from typing import Any

from fluid_sim_ros.new_vehicle.importing.mesh_paths import package_folder, roots_of
from fluid_sim_ros.schema.limits import limit


def main() -> int:
    """
    Write the URDF to standard output.

    Returns
    -------
    int
        1 where it does not expand: the last line of standard error says why.

    """
    path, packages = Path(sys.argv[1]).resolve(), [Path(word) for word in sys.argv[2:]]
    memory, seconds = limit('xacro_bytes'), limit('xacro_seconds')
    resource.setrlimit(resource.RLIMIT_DATA, (memory, memory))
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    try:
        text = _expanded(path, packages)
    except Exception as error:  # noqa: BLE001  a xacro file raises anything
        words = ' '.join(f'{type(error).__name__}: {error}'.split())
        sys.stderr.write(f'\n{words[:300]}\n')
        return 1
    sys.stdout.write(text)
    return 0


def _expanded(path: Path, packages: list[Path]) -> str:
    import xacro  # type: ignore[import-untyped]
    from xacro import substitution_args

    allowed = roots_of(path, packages)

    def checked(name: str) -> None:
        place = Path(name).resolve()
        if not any(place.is_relative_to(root) for root in allowed):
            raise ValueError(f"'{name}' lies outside of {allowed[0]}; give --package-path")

    def find(name: str) -> str:
        folder = package_folder(name, path, packages)
        if folder is None:
            raise ValueError(f"package '{name}' is not found; give --package-path")
        return str(folder)

    parse = xacro.parse

    def checked_open(name: str, *words: Any, **options: Any) -> Any:
        checked(name)
        return open(name, *words, **options)  # noqa: PTH123  as xacro calls it

    def checked_parse(inp: Any, filename: str | None = None) -> Any:
        if inp is None and filename is not None:
            checked(filename)
        return parse(inp, filename)

    # load_yaml, which expressions have by two names, opens its file by what is open there
    xacro.parse, xacro.open = checked_parse, checked_open
    substitution_args._eval_find = find
    document = xacro.process_file(str(path))
    return str(document.documentElement.toxml())


if __name__ == '__main__':
    sys.exit(main())
