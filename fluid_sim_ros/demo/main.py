# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The command ``fluid_sim demo``: fly, evaluate the log, print a table, write plots."""

import argparse
import math
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console

from fluid_sim_ros.demo import plots
from fluid_sim_ros.demo.flight import fly_demo
from fluid_sim_ros.demo.flight_log import check_again, read_recording, still
from fluid_sim_ros.demo.summary import summary, table, targets
from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.output.json_file import write_json


def main(argv: Sequence[str] | None = None) -> int:
    """
    Run the demo.

    Parameters
    ----------
    argv
        Arguments of the command; None means those of the process.

    Returns
    -------
    int
        Exit code.

    Raises
    ------
    FluidSimError
        If an option is wrong, or a process of the demo fails.

    """
    options = _parser().parse_args(argv)
    if not (math.isfinite(options.duration) and options.duration > 0):
        raise FluidSimError(f'--duration {options.duration:g}: must be finite and above 0 s')
    console = Console(stderr=options.json == '-')
    out: Path = options.out
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FluidSimError(f'--out {out}: {error.strerror}') from None
    console.print(
        f'Simulator and controller as two ROS 2 processes, {options.duration:g} simulated seconds '
        '...'
    )
    log = out / 'flight.mcap'
    log.unlink(missing_ok=True)
    heard = fly_demo(out, options.duration, log)
    recording = read_recording(log)
    again = check_again(log)
    picture, fault = still(log)
    result = {
        **summary(recording, heard.odometry, heard.wall),
        'log': {**again, 'still': None if fault else str(picture)},
    }
    pictures = [
        plots.trajectory(recording, targets(recording), out / 'trajectory.png'),
        plots.wrench(recording, out / 'wrench.png'),
    ]
    write_json(str(out / 'summary.json'), result)
    console.print(table(result))
    for line in (
        f'Plots: {", ".join(map(str, pictures))}',
        f'Log: {log} ({again["bytes"] / 1e6:.1f} MB); flown again from its '
        f'{again["commands"]} commands, {again["states_resimulated"]} states are the same to the '
        'last bit',
        f'Still: not rendered ({fault})' if fault else f'Still: {picture}',
        f'Summary: {out / "summary.json"}; what the processes wrote: {out}/*.log',
    ):
        console.print(line, soft_wrap=True, markup=False)
    if options.json:
        write_json(options.json, result)
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='fluid_sim demo',
        description='A quadrotor holds its place in a gust, over real ROS 2: simulator and '
        'controller are two processes in lockstep.',
    )
    parser.add_argument(
        '--out', type=Path, default=Path('out/demo'), help='folder of the results (%(default)s)'
    )
    parser.add_argument(
        '--duration', type=float, default=30.0, metavar='S', help='simulated time (%(default)s s)'
    )
    parser.add_argument('--json', metavar='PATH', help='also write the summary; - = stdout')
    return parser
