# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The subcommands of ``fluid_sim`` that write files for a vehicle."""

import argparse
import json
from pathlib import Path
from typing import Any

import yaml

from fluid_sim_ros.cli.shared import Show, add_command, add_scene
from fluid_sim_ros.output.new_file import new_file


def add_parsers(commands: Any, show: Show) -> None:
    """
    Add ``new-vehicle`` and ``layout`` to the parser of ``fluid_sim``.

    Parameters
    ----------
    commands
        Subparsers of ``fluid_sim``.
    show
        Shows table and JSON.

    """
    text = 'write model, vehicle file and scene of a vehicle from its mass, size and thrusters'
    new = add_command(commands, 'new-vehicle', text, _new_vehicle, show)
    new.add_argument('name', metavar='NAME', help='letters, digits and _, a letter first')
    new.add_argument('--medium', choices=('air', 'water'), required=True)
    new.add_argument('--mass', type=float, required=True, metavar='KG')
    new.add_argument(
        '--size', type=float, nargs=3, required=True, metavar=('L', 'W', 'H'),
        help='length, width, height of the box around it [m]',
    )  # fmt: skip
    new.add_argument(
        '--thrusters', required=True, metavar='LAYOUT',
        help='quad, hexa, octo (air), vectored6, vectored8, torpedo (water), or a YAML file',
    )  # fmt: skip
    new.add_argument(
        '--max-thrust', type=float, metavar='N',
        help='of each thruster of a preset [N] (default: twice the weight in all; or 1 m/s ahead)',
    )  # fmt: skip
    new.add_argument(
        '--buoyancy', type=float, default=0.0, metavar='N',
        help='net force upward under water [N] (default 0: neutral)',
    )  # fmt: skip
    new.add_argument(
        '--sensors', nargs='*', metavar='KIND',
        help='default: imu, magnetometer, and barometer with gnss (air) or pressure (water); none '
        'behind it: no sensors',
    )  # fmt: skip
    new.add_argument('--out', type=Path, metavar='FOLDER', help='default: NAME')
    new.add_argument('--force', action='store_true', help='replace files that exist')

    text = 'write a layout for Foxglove and Lichtblick, or for RViz, that shows a vehicle'
    layout = add_command(commands, 'layout', text, _layout, show)
    add_scene(layout)
    layout.add_argument(
        '--vehicle', metavar='NAME', help='default: the first of the scene; for RViz all'
    )
    layout.add_argument('--rviz', action='store_true', help='for RViz: rviz2 -d FILE')
    layout.add_argument(
        '--namespace', default='', metavar='NS', help="of the simulator's node; for RViz"
    )
    layout.add_argument('--out', type=Path, metavar='FILE', help='default: NAME.json, NAME.rviz')


def _new_vehicle(arguments: argparse.Namespace, show: Show) -> int:
    from rich.markup import escape

    from fluid_sim_ros.new_vehicle.files import TRIAL, design_vehicle, write_vehicle
    from fluid_sim_ros.new_vehicle.fins import JOINTS

    design = design_vehicle(
        arguments.name,
        arguments.medium,
        arguments.mass,
        tuple(arguments.size),
        arguments.thrusters,
        buoyancy=arguments.buoyancy,
        max_thrust=arguments.max_thrust,
        sensors=arguments.sensors,
    )
    made = write_vehicle(design, arguments.out or Path(arguments.name), overwrite=arguments.force)
    result = {
        'scene': str(made.scene),
        'files': [str(path) for path in made.files],
        'thrusters': [thruster.name for thruster in design.thrusters],
        'thrust_range_n': [list(thruster.limits) for thruster in design.thrusters],
        'hover_n': design.hover.tolist(),
        'joints': list(JOINTS) if design.fins else [],
        'sensors': list(design.sensors),
        'inertia_kg_m2': design.inertia.tolist(),
        'volume_m3': design.volume if arguments.medium == 'water' else None,
        'drift_m': made.drift,
        'trial_s': TRIAL,
    }
    lines = [*result['files'], f'after {TRIAL:g} s it is {made.drift:.2g} m from where it began']
    if arguments.medium == 'air':
        share = design.hover / [thruster.limits[1] for thruster in design.thrusters]
        lines.append(f'hovers on {100 * share.max():.0f} % of its thrust at most')
    lines.append(f'next: fluid_sim run {made.scene}')
    show(arguments.json, escape('\n'.join(lines)), result)
    return 0


def _layout(arguments: argparse.Namespace, show: Show) -> int:
    from rich.markup import escape

    from fluid_sim_ros.messages.foxglove import vehicle_layout
    from fluid_sim_ros.messages.rviz import rviz_config
    from fluid_sim_ros.messages.state_topics import DEFAULTS, StateTopics
    from fluid_sim_ros.simulation import Simulation

    simulation = Simulation(arguments.scene)
    name = arguments.vehicle or next(iter(simulation.vehicles))
    simulation.vehicle(name)  # says which there are
    path = arguments.out or Path(f'{name}.{"rviz" if arguments.rviz else "json"}')
    if arguments.rviz:
        names = [name] if arguments.vehicle else list(simulation.vehicles)
        config = rviz_config(names, arguments.namespace)
        text = yaml.safe_dump(config, sort_keys=False)
        parts = [display['Name'] for display in config['Visualization Manager']['Displays']]
        use = f'rviz2 -d {path} --ros-args -p use_sim_time:=true'
    else:
        layout = vehicle_layout(StateTopics(simulation, DEFAULTS), name)
        text = json.dumps(layout, indent=1) + '\n'
        parts = list(layout['configById'])
        use = 'in Foxglove: Import layout'
    with new_file(path) as file:
        file.write_text(text, encoding='utf-8')
    result = {'path': str(path), 'vehicle': name, 'panels': parts}
    show(arguments.json, escape(f'{path}: {", ".join(parts)}; {use}'), result)
    return 0
