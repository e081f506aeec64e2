# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``fluid_sim excite``: a manoeuvre that makes the parameters of a vehicle identifiable."""

import argparse
from pathlib import Path
from typing import Any

from fluid_sim_ros.cli import completion
from fluid_sim_ros.cli.parser import above
from fluid_sim_ros.cli.shared import Show, add_command, made_folder, plain_text, unbroken


def add_parser(commands: Any, show: Show) -> None:
    """
    Add ``excite`` to the parser of ``fluid_sim``.

    Parameters
    ----------
    commands
        Subparsers of ``fluid_sim``.
    show
        Shows table and JSON.

    """
    text = 'write a manoeuvre that makes the parameters of a vehicle identifiable'
    parser = add_command(commands, 'excite', text, _excite, show)
    scene = parser.add_argument('model', metavar='SCENE', help='name, MJCF or YAML file')
    completion.completed_by(scene, completion.scenes)
    parser.add_argument('--vehicle', metavar='NAME', default='', help='default the only one')
    parser.add_argument('--duration', type=above(0), default=60.0, metavar='S', help='[s]')
    parser.add_argument('--seed', type=int, default=0, help='of all draws (default 0)')
    parser.add_argument('--space', type=above(0), default=6.0, metavar='M',
                        help='edge of the space around the begin [m] (default 6)')  # fmt: skip
    parser.add_argument('--speed', type=above(0), default=2.0, metavar='M/S', help='[m/s]')
    parser.add_argument('--tilt', type=above(0), default=30.0, metavar='DEG', help='[deg]')
    parser.add_argument(
        '--share', type=above(0), default=0.15, metavar='X',
        help="of the thrusters' reach, for the multisines (default .15)",
    )  # fmt: skip
    parser.add_argument('--parameters', metavar='NAME', nargs='+', default=[],
                        help='say how well each would be told (names: fluid_sim fit)')  # fmt: skip
    parser.add_argument('--out', metavar='FOLDER', type=Path, default=Path('out/excite'))


def _excite(arguments: argparse.Namespace, show: Show) -> int:
    import numpy as np

    from fluid_sim_ros.reality.exciting.excitation import Limits
    from fluid_sim_ros.reality.exciting.excite_files import write_csv, write_schedule
    from fluid_sim_ros.reality.exciting.excited_flight import excite
    from fluid_sim_ros.reality.exciting.foreseen import foreseen

    limits = Limits(
        arguments.space, arguments.speed, float(np.radians(arguments.tilt)), arguments.share
    )
    found = excite(arguments.model, arguments.duration, arguments.seed, limits, arguments.vehicle)
    told = (
        foreseen(found.flight, arguments.model, arguments.parameters)
        if arguments.parameters else {}
    )  # fmt: skip
    settings = (
        f'fluid_sim excite {found.scene.name}: {found.plan.words}; seed {arguments.seed}, '
        f'{arguments.duration:g} s, space {limits.space:g} m, {limits.speed:g} m/s, '
        f'{arguments.tilt:g} deg, share {limits.share:g} x {found.scale:.3g}'
    )
    with made_folder(arguments.out) as folder:
        stem = f'{found.scene.name}_excited'
        files = [
            write_schedule(found, folder / f'{stem}.yaml', settings),
            write_csv(found, folder / f'{stem}.csv', settings),
        ]
    result = {
        'scene': found.scene.name, 'vehicle': found.vehicle, 'seed': arguments.seed,
        'duration_s': arguments.duration, 'parts': found.plan.words, 'scale': found.scale,
        'largest': {'distance_m': found.seen['distance_m'], 'speed_m_s': found.seen['speed_m_s'],
                    'tilt_deg': float(np.degrees(found.seen['tilt_rad']))},
        'limits': {'space_m': limits.space, 'speed_m_s': limits.speed, 'tilt_deg': arguments.tilt,
                   'share': limits.share},
        'parameters': told, 'files': [str(file) for file in files],
    }  # fmt: skip
    show(arguments.json, _table(result, files), result)
    return 0


def _table(result: dict[str, Any], files: list[Path]) -> Any:
    from rich.console import Group
    from rich.table import Table

    seen = result['largest']
    lines = [
        f'{result["vehicle"]}: {result["parts"]}, {result["duration_s"]:g} s',
        f'goes {seen["distance_m"]:.2g} m far, {seen["speed_m_s"]:.2g} m/s, tilts '
        f'{seen["tilt_deg"]:.2g} deg',
        'thrusts are those of this model under its control law: a vehicle that is unstable by '
        'itself repeats them in the model alone; give its controller the targets of the CSV',
    ]
    parts: list[Any] = [plain_text(lines)]
    if result['parameters']:
        table = Table('parameter', 'value', 'standard error', 'unit')
        for name, p in result['parameters'].items():
            error = p['standard_error']
            shown = 'not touched' if error is None else f'{error:.2g}'
            table.add_row(name, f'{p["value"]:.5g}', shown + ('' if p['told'] else ' (!)'),
                          p['unit'])  # fmt: skip
        parts.append(table)
        untold = [name for name, p in result['parameters'].items() if not p['told']]
        if untold:
            parts.append(plain_text([f'not told: {", ".join(untold)}; give more time or space']))
    return Group(*parts, unbroken(files))
