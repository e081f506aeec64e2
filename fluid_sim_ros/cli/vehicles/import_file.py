# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The subcommand of ``fluid_sim`` that makes a vehicle of a URDF, an MJCF model or a mesh."""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fluid_sim_ros.cli import completion
from fluid_sim_ros.cli.parser import WRONG_INPUT
from fluid_sim_ros.cli.shared import Show, add_command

if TYPE_CHECKING:
    from fluid_sim_ros.new_vehicle.importing.vehicle import Imported
    from fluid_sim_ros.new_vehicle.importing.writing import Written

_POINT = ('X', 'Y', 'Z')
_ANSWERS = (
    'name', 'medium', 'body', 'mass', 'center_of_mass', 'inertia', 'body_density', 'even', 'unit',
    'up', 'hull', 'fluid_density', 'buoyancy', 'thrusters', 'max_thrust', 'fixed', 'sensors',
    'panels',
)  # fmt: skip


def add_parser(commands: Any, show: Show) -> None:
    """
    Add ``import`` to the parser of ``fluid_sim``.

    Parameters
    ----------
    commands
        Subparsers of ``fluid_sim``.
    show
        Shows table and JSON.

    """
    text = 'write model, vehicle file and scene of a vehicle from its URDF, MJCF model or mesh'
    parser = add_command(commands, 'import', text, _import, show)
    file = parser.add_argument(
        'file', metavar='FILE', type=Path,
        help='URDF (.urdf, .xacro), MJCF (.xml), or STL, OBJ, PLY, GLB, DAE',
    )  # fmt: skip
    completion.completed_by(file, completion.files('urdf', 'xacro', 'xml', *completion.MESHES))
    parser.add_argument(
        '--answers', type=Path, metavar='YAML', help='what the file does not say: doc/import.md'
    )
    parser.add_argument('--medium', choices=('air', 'water'))
    parser.add_argument('--name', help='letters, digits and _ (default: as in the file)')
    parser.add_argument('--body', metavar='NAME', help='base body of an MJCF model with several')
    parser.add_argument('--mass', type=float, metavar='KG', help='of the base')
    parser.add_argument('--center-of-mass', type=float, nargs=3, metavar=_POINT, help='[m]')
    parser.add_argument(
        '--inertia', type=float, nargs=3, metavar=('IX', 'IY', 'IZ'),
        help='about the centre of mass [kg m^2]',
    )  # fmt: skip
    parser.add_argument(
        '--body-density', type=float, metavar='RHO', help='of an even body [kg/m^3]'
    )
    parser.add_argument('--even', action='store_true', help='the mass is even over the hull')
    parser.add_argument('--unit', metavar='UNIT', help='of meshes: m, cm, mm, in, ft (default m)')
    parser.add_argument(
        '--up', choices=('file', 'x', 'y', 'z'),
        help='axis of a mesh that becomes z (default: as a GLB or DAE file states it)',
    )  # fmt: skip
    parser.add_argument('--hull', metavar='WHICH', help='collision, visual, or a mesh file')
    parser.add_argument('--fluid-density', type=float, metavar='RHO', help='[kg/m^3]')
    parser.add_argument(
        '--buoyancy', metavar='N', help='hull, or the net force upward under water [N]'
    )
    parser.add_argument(
        '--panels', type=int, metavar='N', help='for the added mass, of the coarser mesh'
    )
    parser.add_argument('--thrusters', metavar='LAYOUT', help='a preset of new-vehicle, or a YAML')
    parser.add_argument('--max-thrust', type=float, metavar='N', help='of each of a preset')
    parser.add_argument('--fixed', nargs='+', metavar='JOINT', help='joints that do not move')
    parser.add_argument('--sensors', nargs='+', metavar='KIND', help='imu, gnss, dvl, ...')
    parser.add_argument(
        '--package-path', type=Path, action='append', default=[], metavar='FOLDER',
        help='of a package, or one that files may be in; may be repeated',
    )  # fmt: skip
    parser.add_argument('--out', type=Path, metavar='FOLDER', help='default: the name')
    parser.add_argument('--force', action='store_true', help='replace files that exist')


def _import(arguments: argparse.Namespace, show: Show) -> int:
    from rich.markup import escape

    from fluid_sim_ros.new_vehicle.importing.answers import answers_of
    from fluid_sim_ros.new_vehicle.importing.questions import UndecidedError
    from fluid_sim_ros.new_vehicle.importing.vehicle import import_vehicle
    from fluid_sim_ros.new_vehicle.importing.writing import write_imported

    options = {key: getattr(arguments, key) for key in _ANSWERS}
    answers = answers_of(arguments.answers, options)
    try:
        vehicle = import_vehicle(arguments.file, answers, arguments.package_path, _progress)
    except UndecidedError as undecided:
        lines = [f'{undecided.path}: decide, then import again:']
        lines += [f'  * {question}' for question in undecided.questions]
        result = {'file': str(undecided.path), 'questions': undecided.questions}
        show(arguments.json, escape('\n'.join(lines)), result)
        return WRONG_INPUT
    folder = arguments.out or Path(vehicle.contents.skeleton.source.name)
    written = write_imported(vehicle, folder, overwrite=arguments.force)
    show(arguments.json, escape('\n'.join(_lines(vehicle, written))), _result(vehicle, written))
    return 0


def _progress(line: str) -> None:
    if sys.stderr.isatty():
        sys.stderr.write(f'{line} ...\n')


def _lines(vehicle: 'Imported', written: 'Written') -> list[str]:
    from fluid_sim_ros.new_vehicle.importing.writing import TRIAL, hover_share

    contents = vehicle.contents
    lines = [*map(str, written.files), *vehicle.said]
    if contents.medium == 'water':
        lines.append(f'net buoyancy {vehicle.buoyancy:+.4g} N')
    elif share := hover_share(vehicle):
        lines.append(f'hovers on {100 * share:.0f} % of its thrust at most')
    lines.append(f'after {TRIAL:g} s it is {written.drift:.2g} m from where it began')
    return [*lines, f'next: fluid_sim run {written.scene}']


def _result(vehicle: 'Imported', written: 'Written') -> dict[str, Any]:
    contents = vehicle.contents
    return {
        'scene': str(written.scene),
        'files': [str(path) for path in written.files],
        'said': vehicle.said,
        'thrusters': [thruster.name for thruster in contents.thrusters],
        'thrust_range_n': [list(thruster.limits) for thruster in contents.thrusters],
        'joints': list(contents.skeleton.servos),
        'hover_n': contents.hover.tolist(),
        'mass_kg': contents.mass.total,
        'center_of_mass_m': contents.mass.total_center.tolist(),
        'buoyancy_n': vehicle.buoyancy if contents.medium == 'water' else None,
        'drift_m': written.drift,
    }
