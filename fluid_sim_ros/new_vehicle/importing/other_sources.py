# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""An MJCF model or a mesh as the thing that is imported."""

from pathlib import Path

import mujoco

from fluid_sim_ros.errors import ConfigError, did_you_mean, listed
from fluid_sim_ros.hydro.meshes.reading import FORMATS, read_triangles
from fluid_sim_ros.new_vehicle.importing.mesh_paths import roots_of
from fluid_sim_ros.new_vehicle.importing.source import Source, fit_for_topics, stl_bytes
from fluid_sim_ros.new_vehicle.importing.strangers.model_trial import check_files, try_model
from fluid_sim_ros.new_vehicle.importing.strangers.xml_source import expand_xacro, read_xml
from fluid_sim_ros.new_vehicle.importing.urdf import read_urdf
from fluid_sim_ros.scene.named_files import check_named_files

_KINDS = 'a URDF (.urdf, .xacro), an MJCF model (.xml) or a mesh'


def read_source(
    path: Path, packages: list[Path], unit: str | None, body: str | None, up: str | None = None
) -> Source:
    """
    Return a file that is imported, by its kind.

    Parameters
    ----------
    path
        URDF, xacro, MJCF or mesh.
    packages
        Given with ``--package-path``.
    unit
        Of mesh files' numbers; None: metres.
    body
        Base body of an MJCF model with several; None: the only one.
    up
        Of a mesh: the axis that becomes z, one of ``up_axis.UPS``; None: as the file states it.

    Returns
    -------
    Source
        As MuJoCo's reader has it.

    Raises
    ------
    ConfigError
        If it is none of these, or has a fault.

    """
    missing = [folder for folder in packages if not folder.is_dir()]
    if missing:
        raise ConfigError(f'--package-path {missing[0]}: no such folder')
    kind = path.suffix.lower().lstrip('.')
    if kind in FORMATS:
        return read_mesh_source(path, unit, up)
    if kind not in ('urdf', 'xacro', 'xml'):
        raise ConfigError(
            f"{path}: '{path.suffix}' is not imported; allowed: {_KINDS} ({listed(FORMATS)})"
        )
    root = expand_xacro(path, packages) if kind == 'xacro' else read_xml(path)
    if root.tag == 'robot':
        if any('xacro' in element.tag for element in root.iter()):
            root = expand_xacro(path, packages)
        return read_urdf(path, root, packages, unit)
    if root.tag == 'mujoco':
        return read_mjcf(path, packages, body)
    raise ConfigError(f'{path}: <{root.tag}> is neither <robot> (URDF) nor <mujoco> (MJCF)')


def read_mesh_source(path: Path, unit: str | None, up: str | None = None) -> Source:
    """
    Return a mesh as a vehicle of one body, with its origin and its axes, turned so that z is up.

    Parameters
    ----------
    path
        Of the mesh.
    unit
        Of its numbers; None: metres.
    up
        As of `read_source`.

    Returns
    -------
    Source
        Without mass.

    Raises
    ------
    ConfigError
        If it is no mesh.

    """
    name, file = fit_for_topics(path.stem), f'{fit_for_topics(path.stem)}.stl'
    spec = mujoco.MjSpec()
    spec.compiler.inertiafromgeom = mujoco.mjtInertiaFromGeom.mjINERTIAFROMGEOM_FALSE
    spec.add_mesh(name='hull_mesh', file=file)
    spec.worldbody.add_body(name=name).add_geom(
        name='hull', type=mujoco.mjtGeom.mjGEOM_MESH, meshname='hull_mesh',
        rgba=[0.3, 0.45, 0.7, 1],
    )  # fmt: skip
    assets = {file: stl_bytes(read_triangles(path, unit, up or 'file'))}
    spec.assets = assets
    return Source(path, name, spec, name, assets, hull=path)


def read_mjcf(path: Path, packages: list[Path], body: str | None) -> Source:
    """
    Return an MJCF model.

    Parameters
    ----------
    path
        Of the model.
    packages
        Folders beside its own that it may name files in.
    body
        Base body; None: the only one at the top.

    Returns
    -------
    Source
        With the files that it names.

    Raises
    ------
    ConfigError
        If MuJoCo refuses it, it names files elsewhere, or its base is not clear.

    """
    root = read_xml(path)
    check_named_files(path, path.read_text('utf-8', 'replace'))
    try_model(path, check_files(path, root, packages))
    try:
        spec = mujoco.MjSpec.from_file(str(path))
    except (ValueError, mujoco.FatalError) as error:
        raise ConfigError(f'{path}: MuJoCo does not read it: {error}') from None
    tops = [top.name for top in spec.bodies if top.parent == spec.worldbody]
    if body is not None and body not in tops:
        raise ConfigError(
            f"--body '{body}' is no body at the top of the model"
            f'{did_you_mean(body, tops)} it has: {listed(tops)}'
        )
    if body is None and len(tops) != 1:
        raise ConfigError(
            f'{path}: which body is the vehicle? give --body; it has: {listed(tops)}'
        )
    base = body or tops[0]
    if not base:
        raise ConfigError(f'{path}: the body of the vehicle has no name; give it one')
    said = []
    assets = _assets(path, spec, packages)
    if assets:
        said.append(f'{len(assets)} files copied: {listed(assets)}')
    return Source(path, fit_for_topics(base), spec, base, assets, said=said)


def _assets(path: Path, spec: mujoco.MjSpec, packages: list[Path]) -> dict[str, bytes]:
    """Return the files that a model names, under names without folders, which it then has."""
    roots = roots_of(path, packages)
    assets: dict[str, bytes] = {}
    for folder, elements in (
        (spec.compiler.meshdir, [*spec.meshes, *spec.skins]),
        (spec.compiler.texturedir, spec.textures), (spec.compiler.meshdir, spec.hfields),
    ):  # fmt: skip
        for element in elements:
            if not element.file:
                continue
            place = (path.resolve().parent / folder / element.file).resolve()
            if not any(place.is_relative_to(root) for root in roots):
                raise ConfigError(
                    f"{path}: file '{element.file}' lies outside of {roots[0]}; --package-path "
                    'allows another folder'
                )
            if not place.is_file():
                raise ConfigError(f"{path}: file '{element.file}': no such file ({place})")
            if not element.name:
                element.name = place.stem
            element.file = place.name
            content = place.read_bytes()
            if assets.setdefault(place.name, content) != content:
                raise ConfigError(f"{path}: two files have the name '{place.name}'; rename one")
    spec.compiler.meshdir = spec.compiler.texturedir = ''
    spec.assets = dict(assets)
    return assets
