# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The subcommand of ``fluid_sim`` that computes coefficients from a mesh."""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fluid_sim_ros.cli import completion
from fluid_sim_ros.cli.shared import Show, add_command

if TYPE_CHECKING:
    from rich.table import Table

    from fluid_sim_ros.hydro.coefficients import Coefficients
    from fluid_sim_ros.hydro.planes import Plane


def add_parser(commands: Any, show: Show) -> None:
    """
    Add ``hydro`` to the parser of ``fluid_sim``.

    Parameters
    ----------
    commands
        Subparsers of ``fluid_sim``.
    show
        Shows table and JSON.

    """
    text = 'added mass, buoyancy and damping of a body from its mesh'
    hydro = add_command(commands, 'hydro', text, _hydro, show)
    mesh = hydro.add_argument(
        'mesh', metavar='MESH', type=Path, help='STL, OBJ, PLY, GLB, DAE or OFF'
    )
    completion.completed_by(mesh, completion.files('off', *completion.MESHES))
    hydro.add_argument(
        '--density', type=float, required=True, metavar='RHO', help='of the fluid [kg/m^3]'
    )
    hydro.add_argument(
        '--viscosity', type=float, metavar='MU', help='[Pa s] (default: by density)'
    )
    hydro.add_argument(
        '--unit', metavar='UNIT', help='of the mesh: m, cm, mm, in, ft (default m, asked if odd)'
    )
    hydro.add_argument(
        '--up', choices=('keep', 'file', 'x', 'y', 'z'), default='keep',
        help='axis that becomes z; file: as a GLB or DAE file states it (default: kept as it is)',
    )  # fmt: skip
    point = ('X', 'Y', 'Z')
    hydro.add_argument(
        '--about', type=float, nargs=3, metavar=point,
        help='reference point [m], mesh axes (default: the centre of buoyancy)',
    )  # fmt: skip
    hydro.add_argument('--mass', type=float, metavar='KG', help='for righting arms')
    hydro.add_argument(
        '--center-of-mass', type=float, nargs=3, metavar=point, help='[m] (default: the origin)'
    )
    hydro.add_argument('--thrust', type=float, metavar='N', help='along each axis, for top speeds')
    hydro.add_argument(
        '--speed', type=float, default=1.0, metavar='V', help='at which friction is taken [m/s]'
    )
    hydro.add_argument(
        '--drag', type=float, nargs=3, metavar=point, help='drag coefficients (default: by shape)'
    )
    hydro.add_argument(
        '--surface', type=float, metavar='Z', help='height of a free surface, mesh axes [m]'
    )
    hydro.add_argument(
        '--bed', type=float, metavar='Z', help='height of a flat bed, mesh axes [m]'
    )
    hydro.add_argument(
        '--wall', type=float, nargs=4, metavar=('NX', 'NY', 'NZ', 'D'),
        help='rigid wall N.x = D, mesh axes [m]',
    )  # fmt: skip
    hydro.add_argument('--panels', type=int, metavar='N', help='of the coarser mesh, at most')
    hydro.add_argument('--report', type=Path, metavar='FOLDER', help='write a page and a picture')
    hydro.add_argument('--force', action='store_true', help='replace files that exist')


def _hydro(arguments: argparse.Namespace, show: Show) -> int:
    from fluid_sim_ros.hydro.coefficients import Request, coefficients_of
    from fluid_sim_ros.hydro.panels import COARSE
    from fluid_sim_ros.hydro.report import report_files, write_report
    from fluid_sim_ros.hydro.result import as_json

    request = Request(
        arguments.mesh, arguments.density, arguments.viscosity, arguments.unit,
        _three(arguments.about), arguments.mass, _three(arguments.center_of_mass),
        arguments.thrust, arguments.speed, _three(arguments.drag), _planes(arguments),
        COARSE if arguments.panels is None else arguments.panels, arguments.up,
    )  # fmt: skip
    files = None
    if arguments.report is not None:
        name = arguments.mesh.stem
        files = report_files(arguments.report, name, overwrite=arguments.force)
    found = coefficients_of(request, _progress)
    result = as_json(found)
    if files is not None:
        write_report(found, *files)
        result['files'] = [str(path) for path in files]
    show(arguments.json, _table(found, result), result)
    return 0


def _progress(line: str) -> None:
    if sys.stderr.isatty():
        sys.stderr.write(f'{line} ...\n')


def _three(values: list[float] | None) -> tuple[float, float, float] | None:
    return None if values is None else (values[0], values[1], values[2])


def _planes(arguments: argparse.Namespace) -> list['Plane']:
    import numpy as np

    from fluid_sim_ros.hydro.planes import Plane, plane_of

    upward = np.array([0.0, 0.0, 1.0])
    planes = []
    if arguments.surface is not None:
        planes.append(Plane('--surface', upward, arguments.surface, free=True))
    if arguments.bed is not None:
        planes.append(Plane('--bed', upward, arguments.bed))
    if arguments.wall is not None:
        planes.append(plane_of('--wall', arguments.wall[:3], arguments.wall[3]))
    return planes


def _table(found: 'Coefficients', result: dict[str, Any]) -> 'Table':
    import numpy as np
    from rich.markup import escape

    from fluid_sim_ros.cli.tables import table_of

    added, damping, statics = found.added_mass, found.damping, found.statics
    rows = []
    for k, axis in enumerate(('x', 'y', 'z', 'roll', 'pitch', 'yaw')):
        rows.append((
            axis, f'{added.matrix[k, k]:.4g} {"kg" if k < 3 else "kg m^2"}',
            f'{added.error[k, k]:.2g}', f'{found.ellipsoid[k]:.3g}', f'{damping.quadratic[k]:.4g}',
            f'{damping.low[k]:.3g} to {damping.high[k]:.3g}',
            damping.axes[k].shape.name if k < 3 else '',
        ))  # fmt: skip
    center = ' '.join(f'{x + 0.0:.4g}' for x in np.round(statics.center, 9))
    title = f'{found.file.path.name}: {statics.volume:.5g} m^3, centre of buoyancy {center} m'
    return table_of(
        ('', 'added mass', 'error', 'ellipsoid', 'drag v|v|', 'range', 'shape'), rows,
        title=escape(title), caption=escape(_caption(found, result)), caption_justify='left',
    )  # fmt: skip


def _caption(found: 'Coefficients', result: dict[str, Any]) -> str:
    lines = [f'repaired: {words}' for words in found.file.repairs]
    point = ' '.join(f'{x + 0.0:.4g}' for x in found.added_mass.point.round(9))
    lines.append(f'about {point} m; {result["panels"][1]} panels, {result["seconds"]:.1f} s')
    if found.request.thrust is not None:
        speeds = result['damping']['top_speed']
        words = ', '.join(
            f'{axis} {row[1]:.3g} ({row[0]:.3g} to {row[2]:.3g})'
            for axis, row in zip('xyz', speeds, strict=True)
        )
        lines.append(f'top speed at {found.request.thrust:g} N: {words} m/s')
    if found.righting is not None:
        righting = found.righting
        lines.append(
            f'net buoyancy {righting.net_buoyancy:.4g} N; hangs at roll {righting.roll:.3g}, '
            f'pitch {righting.pitch:.3g} deg'
        )
    lines += [str(path) for path in result.get('files', [])]
    return '\n'.join(lines)
