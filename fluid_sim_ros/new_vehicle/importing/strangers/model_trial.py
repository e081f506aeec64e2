# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A stranger's MJCF model: what it includes lies beside it, and compiling it is tried apart."""

import os
import signal
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.new_vehicle.importing.mesh_paths import roots_of
from fluid_sim_ros.new_vehicle.importing.strangers import model_process
from fluid_sim_ros.new_vehicle.importing.strangers.xml_source import read_xml
from fluid_sim_ros.schema.limits import beyond, check_limit, limit

#: Wall time beyond that of the processor, on a busy machine [s].
_PATIENCE = 30.0


def check_files(path: Path, root: ElementTree.Element, packages: list[Path]) -> int:
    """
    Refuse a model that names files elsewhere, also by what it includes, at any level.

    Parameters
    ----------
    path
        Of the model.
    root
        Its element ``mujoco``.
    packages
        Folders beside its own that it may name files in.

    Returns
    -------
    int
        Size of all files that it names and that are there [bytes].

    Raises
    ------
    ConfigError
        If a file that it names lies elsewhere, or a model is no XML.

    """
    roots, seen = roots_of(path, packages), {path.resolve()}
    waiting, size = [root], path.stat().st_size
    while waiting:
        owner = waiting.pop()
        own = path.resolve().parent
        folders = [own] + [
            own / settings.get(key, '')
            for settings in owner.iter('compiler')
            for key in ('assetdir', 'meshdir', 'texturedir')
        ]
        for element in owner.iter():
            named = element.get('file', '')
            places = {(folder / named).resolve() for folder in folders} if named else set()
            # which of the folders counts depends on the element: none may lead outside
            there = {place for place in places if place.exists()} or places
            if not all(any(place.is_relative_to(root) for root in roots) for place in there):
                kind = element.tag if element.tag in ('include', 'model') else 'file'
                raise ConfigError(
                    f"{path}: {kind} '{named}' lies outside of {roots[0]}; --package-path allows "
                    'another folder'
                )
            for place in places - seen:
                seen.add(place)
                check_limit('xml_files', len(seen), f'{path}: files that it names')
                if not place.is_file():
                    continue
                size += place.stat().st_size
                if element.tag in ('include', 'model'):
                    waiting.append(read_xml(place))
    return size


def try_model(path: Path, size: int) -> None:
    """
    Compile a model in a process of its own, which may not take much memory or time.

    Parameters
    ----------
    path
        Of the model.
    size
        Of its files [bytes].

    Raises
    ------
    ConfigError
        If MuJoCo refuses it, ends, or goes beyond a limit.

    """
    command = [sys.executable, '-P', '-m', model_process.__name__, os.fspath(path), str(size)]
    seconds = limit('model_seconds') + model_process.SECONDS_PER_BYTE * size
    try:
        done = subprocess.run(
            command, capture_output=True, check=False, stdin=subprocess.DEVNULL,
            timeout=seconds + _PATIENCE, env=os.environ | {'MALLOC_ARENA_MAX': '2'},
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        raise _too_long(path) from None
    if not done.returncode:
        return
    if done.returncode == model_process.MEMORY or b'bad_alloc' in done.stderr:
        most = limit('model_bytes')
        raise beyond('model_bytes', most, f'{path}: the memory to compile it')
    if -done.returncode in (signal.SIGXCPU, signal.SIGKILL):
        raise _too_long(path)
    words = done.stderr.decode(errors='replace').strip().splitlines() or ['']
    if done.returncode == model_process.REFUSED:
        raise ConfigError(f'{path}: MuJoCo does not read it: {words[-1]}')
    raise ConfigError(
        f'{path}: MuJoCo ended with code {done.returncode} when it compiled it ({words[-1][:200]})'
    )


def _too_long(path: Path) -> ConfigError:
    return beyond('model_seconds', limit('model_seconds'), f'{path}: the time to compile it')
