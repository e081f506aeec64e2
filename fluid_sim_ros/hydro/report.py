# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The report on a mesh: a page of Markdown and a picture."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.hydro.coefficients import Coefficients
from fluid_sim_ros.hydro.keys import as_mjcf, body_keys
from fluid_sim_ros.hydro.picture import draw

_AXES = ('x', 'y', 'z', 'roll', 'pitch', 'yaw')


def report_files(folder: Path, name: str, *, overwrite: bool) -> tuple[Path, Path]:
    """
    Return where the report goes.

    Parameters
    ----------
    folder
        Of the report.
    name
        Of the files, without suffix.
    overwrite
        Whether files that exist are replaced.

    Returns
    -------
    page, picture
        Paths.

    Raises
    ------
    ConfigError
        If a file exists.

    """
    page, picture = folder / f'{name}.md', folder / f'{name}.png'
    for path in (page, picture):
        if path.exists() and not overwrite:
            raise ConfigError(f'{path}: exists; give another --report, or --force to replace it')
    return page, picture


def write_report(found: Coefficients, page: Path, picture: Path) -> None:
    """
    Write the report and its picture.

    Parameters
    ----------
    found
        Of a mesh.
    page, picture
        Of `report_files`; the folder is made where it is missing.

    Raises
    ------
    ConfigError
        If a file cannot be written.

    """
    folder = page.parent
    try:
        folder.mkdir(parents=True, exist_ok=True)
        draw(found, picture)
        page.write_text(as_markdown(found, picture.name), encoding='utf-8')
    except OSError as error:
        raise ConfigError(f'{folder}: cannot be written ({error.strerror})') from None


def as_markdown(found: Coefficients, picture: str) -> str:
    """
    Return the page.

    Parameters
    ----------
    found
        Of a mesh.
    picture
        Link to the picture.

    Returns
    -------
    str
        Markdown.

    """
    return '\n\n'.join([
        f'# Hydrodynamic coefficients of {found.file.path.name}',
        f'![Mesh, centre of buoyancy and coefficients]({picture})',
        _body(found), *_righting(found), _added_mass(found), _damping(found),
        '## Keys of fluid_sim.body',
        'Axes and origin of the body are those of the mesh. The body needs `simple="false"`.',
        '```xml\n' + as_mjcf(body_keys(found)) + '\n```',
    ]) + '\n'  # fmt: skip


def _body(found: Coefficients) -> str:
    statics, request = found.statics, found.request
    rows = [
        ('mesh', f'{found.file.triangles} triangles, in {found.file.unit}'),
        ('repaired', '; '.join(found.file.repairs) or 'nothing'),
        ('fluid', f'{request.density:g} kg/m³, {found.viscosity:g} Pa s'),
        ('size', f'{_row(statics.size)} m'),
        (
            'volume',
            f'{statics.volume:.5g} m³, {request.density * statics.volume:.5g} kg displaced',
        ),
        ('centre of buoyancy', f'{_row(statics.center)} m'),
        ('wetted area', f'{statics.wetted_area:.4g} m²'),
    ]
    rows += [
        (plane.name, f'{_row(plane.normal)} · x = {plane.offset:g} m') for plane in request.planes
    ]
    return '## Body\n\n' + table(('', ''), rows)


def _righting(found: Coefficients) -> list[str]:
    righting = found.righting
    if righting is None:
        return []
    heel = ', '.join(
        f'{arm:.3g} m at {angle:g}°'
        for angle, arm in zip(righting.heel, righting.arms, strict=True)
    )
    rows = [
        ('net buoyancy', f'{righting.net_buoyancy:.4g} N upward'),
        ('centre of buoyancy from centre of mass', f'{_row(righting.arm_b)} m'),
        ('attitude at rest', f'roll {righting.roll:.3g}°, pitch {righting.pitch:.3g}°'),
        ('righting arm by heel', heel),
    ]
    return ['## Righting\n\n' + table(('', ''), rows)]


def _added_mass(found: Coefficients) -> str:
    added, mass = found.added_mass, found.request.density * found.statics.volume
    center = added.about(found.statics.center)
    rows = []
    for k, axis in enumerate(_AXES):
        unit, box = ('kg', f'{found.box[k]:.4g}') if k < 3 else ('kg m²', '')
        share = f'{center.matrix[k, k] / mass:.3f}' if k < 3 else ''
        rows.append((
            axis, f'{center.matrix[k, k]:.4g} {unit}', f'± {center.error[k, k]:.2g}', share,
            f'{found.ellipsoid[k]:.4g}', box,
        ))  # fmt: skip
    heads = ('', 'A', 'estimated error', 'A/(ρV)', 'ellipsoid', 'box (DNV)')
    matrix = '\n'.join(' '.join(f'{value:12.5g}' for value in row) for row in added.matrix)
    return (
        '## Added mass\n\n'
        f'Boundary-element method, {added.panels[0]} and {added.panels[1]} panels. About the '
        'centre of buoyancy; beside it what ellipsoid and box of the same size would give:\n\n'
        + table(heads, rows)
        + f'\n\nWhole matrix about {_row(added.point)} m, x y z roll pitch yaw, '
        f'[kg], [kg m], [kg m²]:\n\n```text\n{matrix}\n```'
    )


def _damping(found: Coefficients) -> str:
    damping, thrust = found.damping, found.request.thrust
    rows = []
    speeds = None if thrust is None else damping.top_speeds(thrust)
    for k, axis in enumerate(damping.axes):
        low, high = axis.bounds()
        cells = [
            _AXES[k], axis.shape.name,
            f'{axis.shape.coefficient:.3g} ({axis.shape.low:.2g} to {axis.shape.high:.2g})',
            f'{axis.shadow:.4g}', f'{axis.form:.4g}', f'{axis.rub:.3g}',
            f'**{axis.total:.4g}** ({low:.3g} to {high:.3g})',
        ]  # fmt: skip
        if speeds is None:
            cells.append(f'{axis.total * damping.speed**2:.3g} N')
        else:
            cells.append(f'{speeds[k, 1]:.3g} ({speeds[k, 0]:.3g} to {speeds[k, 2]:.3g}) m/s')
        rows.append(cells)
    last = f'thrust at {damping.speed:g} m/s' if thrust is None else f'top speed at {thrust:g} N'
    heads = ('', 'shape', 'C_d', 'shadow m²', 'form', 'friction', 'N s²/m²', last)
    turning = [
        (
            _AXES[k],
            f'**{damping.quadratic[k]:.3g}** ({damping.low[k]:.3g} to {damping.high[k]:.3g})',
        )
        for k in (3, 4, 5)
    ]
    sources = '\n'.join(f'* {axis}: {where}' for axis, where in _sources(found))
    return (
        '## Damping\n\n' + table(heads, rows)
        + '\n\nAbout the reference point, N m s²:\n\n' + table(('', 'N m s²'), turning)
        + '\n\nSources of the drag coefficients:\n\n' + sources
        + f'\n* friction: ITTC-1957 line at {damping.speed:g} m/s\n'
        '* linear damping: guess, as large as the quadratic one at 0.1 m/s and rad/s\n\n'
        'Published sets for one vehicle differ by factors of 2 to 5: replace these numbers by '
        'measured ones where you can.'
    )  # fmt: skip


def _sources(found: Coefficients) -> list[tuple[str, str]]:
    return [
        (axis, drag.shape.source) for axis, drag in zip(_AXES, found.damping.axes, strict=False)
    ]


def table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """
    Return a table of Markdown.

    Parameters
    ----------
    heads
        Of the columns.
    rows
        Cells.

    Returns
    -------
    str
        Without a line end.

    """
    lines = [f'| {" | ".join(heads)} |', '|' + '---|' * len(heads)]
    return '\n'.join(lines + [f'| {" | ".join(row)} |' for row in rows])


def _row(values: np.ndarray[tuple[int], np.dtype[np.float64]]) -> str:
    return ' '.join(f'{value + 0.0:.4g}' for value in np.round(values, 9))
