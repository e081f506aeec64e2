# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Where the mesh files of a URDF are, within its own folder, its package and the ones allowed."""

import re
from pathlib import Path

from fluid_sim_ros.errors import ConfigError, listed

#: So many folders above a file are looked at for its package.
_LEVELS = 6
#: A file:// path, a package:// path.
_URI = re.compile(r'^(\w+)://(.*)$')


def roots_of(path: Path, packages: list[Path]) -> list[Path]:
    """
    Return the folders that a file may name files in: its own, its package's, and those given.

    Parameters
    ----------
    path
        The file.
    packages
        Given with ``--package-path``.

    Returns
    -------
    list
        Folders, resolved.

    """
    own = path.resolve().parent
    roots = [own]
    for folder in [own, *own.parents][:_LEVELS]:
        if (folder / 'package.xml').is_file():
            roots.append(folder)
            break
    return [*roots, *(folder.resolve() for folder in packages)]


def package_folder(name: str, path: Path, packages: list[Path]) -> Path | None:
    """
    Return the folder of a ROS package.

    Parameters
    ----------
    name
        Of the package.
    path
        The file that names it: the package may be one that it lies in.
    packages
        Folders that are the package, or hold it.

    Returns
    -------
    Path
        Or None.

    """
    if not re.fullmatch(r'[A-Za-z0-9_.\-]+', name) or name in ('.', '..'):
        return None
    for folder in (folder.resolve() for folder in packages):
        if folder.name == name or _package_name(folder) == name:
            return folder
        for held in (folder / name, folder / name / 'share' / name, folder / 'share' / name):
            if held.is_dir():
                return held
    own = path.resolve().parent
    for folder in [own, *own.parents][:_LEVELS]:
        if folder.name == name or _package_name(folder) == name:
            return folder
    return None


def mesh_file(reference: str, path: Path, packages: list[Path]) -> Path:
    """
    Return the file that a URDF names as a mesh.

    Parameters
    ----------
    reference
        As the URDF has it: ``package://``, ``file://`` or a path relative to the URDF.
    path
        Of the URDF.
    packages
        Given with ``--package-path``.

    Returns
    -------
    Path
        A file that exists.

    Raises
    ------
    ConfigError
        If it is not there, or not where a URDF may name files.

    """
    roots = roots_of(path, packages)
    found = _URI.match(reference)
    scheme, rest = (found[1], found[2]) if found else ('', reference)
    if scheme == 'package':
        name, _, inside = rest.partition('/')
        folder = package_folder(name, path, packages)
        if folder is None:
            raise ConfigError(
                f"{path}: mesh '{reference}': the package '{name}' is not found; give "
                '--package-path with the folder that is it or holds it'
            )
        roots.append(folder)
        place = folder / inside
    elif scheme in ('', 'file'):
        place = path.resolve().parent / rest
    else:
        raise ConfigError(
            f"{path}: mesh '{reference}': {scheme}:// is not read; allowed: package://, file:// "
            'or a relative path'
        )
    place = place.resolve()
    if not any(place.is_relative_to(root) for root in roots):
        raise ConfigError(
            f"{path}: mesh '{reference}' lies outside of {listed(map(str, roots))}; "
            '--package-path allows another folder'
        )
    if not place.is_file():
        raise ConfigError(f"{path}: mesh '{reference}': no such file ({place})")
    return place


def _package_name(folder: Path) -> str | None:
    file = folder / 'package.xml'
    if not file.is_file() or file.stat().st_size > 2**20:
        return None
    found = re.search(r'<name>\s*([\w.\-]+)\s*</name>', file.read_text(errors='replace'))
    return found[1] if found else None
