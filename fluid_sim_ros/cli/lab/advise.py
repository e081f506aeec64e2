# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``fluid_sim advise``: the cheapest settings for a scene within a tolerance."""

import argparse
from typing import Any

from fluid_sim_ros.cli.lab.tables import advice_table
from fluid_sim_ros.cli.shared import Show, add_command, add_scene, fraction
from fluid_sim_ros.output.progress import progress_of_parts

#: Exit code where nothing meets the tolerance.
NOTHING_FITS = 1


def add_parser(commands: Any, show: Show) -> None:
    """
    Add ``advise`` to the parser of ``fluid_sim``.

    Parameters
    ----------
    commands
        Subparsers of ``fluid_sim``.
    show
        Shows table and JSON.

    """
    text = 'find the cheapest fluid model, integrator and timestep for a scene'
    advise = add_command(commands, 'advise', text, _advise, show)
    add_scene(advise)
    advise.add_argument(
        '--tolerance', type=fraction, required=True, metavar='X',
        help='largest relative error against the converged run of the full model (0.01 or 1%%)',
    )  # fmt: skip
    advise.add_argument('--duration', type=float, metavar='S', help='default: of the scene [s]')
    advise.add_argument(
        '--metric', default='pose', help='pose, position, attitude, velocity or regime'
    )
    advise.add_argument(
        '--rate', type=float, default=100.0, metavar='HZ',
        help='the timestep must divide the period of control and outputs (default 100 Hz)',
    )  # fmt: skip
    advise.add_argument(
        '--budget', type=float, default=50.0, metavar='S',
        help='time for the runs (default 50 s); what it leaves out is said',
    )  # fmt: skip
    advise.add_argument(
        '--apply', action='store_true', help="put the choice in force in the scene's YAML file"
    )
    advise.add_argument(
        '--keep', action='store_true',
        help="write the choice into the scene's YAML file, for fluid_sim run --advised",
    )  # fmt: skip


def _advise(arguments: argparse.Namespace, show: Show) -> int:
    from fluid_sim_ros.lab.advisor import advice as lab
    from fluid_sim_ros.lab.advisor.advise import advise
    from fluid_sim_ros.lab.advisor.scene_settings import apply, keep, scene_file

    if arguments.apply or arguments.keep:
        scene_file(arguments.scene)
    with progress_of_parts() as report:
        advice = advise(
            arguments.scene, arguments.tolerance, duration=arguments.duration,
            metric_name=arguments.metric, rate=arguments.rate, budget=arguments.budget,
            report=report,
        )  # fmt: skip
    written = []
    if arguments.keep and advice['choice']:
        written.append(keep(arguments.scene, lab.advised(advice)))
    if arguments.apply and advice['choice']:
        written.append(apply(arguments.scene, lab.settings(advice), lab.comment(advice)))
    advice['written'] = [str(path) for path in written]
    show(arguments.json, advice_table(advice, arguments.metric), advice)
    return 0 if advice['choice'] else NOTHING_FITS
