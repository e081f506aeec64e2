# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The subcommand of ``fluid_sim`` that writes a vehicle's URDF."""

import argparse
import sys
from pathlib import Path
from typing import Any

from fluid_sim_ros.cli.shared import Show, add_command, add_scene
from fluid_sim_ros.errors import ConfigError, listed


def add_parser(commands: Any, show: Show) -> None:
    """
    Add ``urdf`` to the parser of ``fluid_sim``.

    Parameters
    ----------
    commands
        Subparsers of ``fluid_sim``.
    show
        Shows table and JSON.

    """
    text = "print a vehicle's URDF: links, joints, shapes and inertias of its model"
    urdf = add_command(commands, 'urdf', text, _urdf, show)
    add_scene(urdf)
    urdf.add_argument('--vehicle', metavar='NAME', help='default: the only one')
    urdf.add_argument('--out', metavar='FILE', type=Path, help='write it here instead')
    urdf.add_argument(
        '--files', action='store_true',
        help='name meshes of this package by their files; without it by package://, which tools '
        'find where the package is installed for ROS',
    )  # fmt: skip


def _urdf(arguments: argparse.Namespace, show: Show) -> int:
    from rich.text import Text

    from fluid_sim_ros.messages.description_topics import descriptions
    from fluid_sim_ros.output.new_file import new_file
    from fluid_sim_ros.resources import SHARE, share_folder
    from fluid_sim_ros.sensors import SensorSuite
    from fluid_sim_ros.simulation import Simulation

    simulation = Simulation(arguments.scene)
    names = list(simulation.vehicles)
    name = arguments.vehicle or names[0]
    if name not in names or (arguments.vehicle is None and len(names) > 1):
        given = f"'{name}' is none of" if arguments.vehicle else 'names one of'
        raise ConfigError(f'--vehicle: {given} the vehicles of {arguments.scene}: {listed(names)}')
    suites = {each: SensorSuite(simulation, each) for each in names}
    made = descriptions(simulation, suites)[name]
    text = made.urdf
    if arguments.files:
        text = text.replace(f'package://{SHARE}/', f'{share_folder().as_uri()}/')
    sys.stderr.writelines(f'fluid_sim: {line}\n' for line in made.notes)
    if arguments.out is not None:
        with new_file(arguments.out) as path:
            path.write_text(text, encoding='utf-8')
    elif arguments.json != '-':
        sys.stdout.write(text)
    result = {'vehicle': name, 'urdf': text, 'notes': made.notes}
    if arguments.json is not None:
        show(arguments.json, Text(''), result)
    return 0
