# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The commands that open a log, on a hostile one."""

from collections.abc import Callable
from pathlib import Path
from random import Random

from fluid_sim_ros.cli.main import main
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.recording.replay.resimulate import resimulate
from test.support.hostile.judge import Verdict, judged

#: Name -> (share of the volume, what is done with the log and a folder for what comes out).
#: Those with a trial of the model, or pictures, take a second each.
COMMANDS: dict[str, tuple[float, Callable[[Path, Path], object]]] = {
    'info': (0.26, lambda log, out: main(['info', str(log), '--json', str(out / 'i.json')])),
    'export --csv': (0.24, lambda log, out: main(['export', str(log), '--csv', str(out)])),
    'export --parquet': (0.1, lambda log, out: main(['export', str(log), '--parquet', str(out)])),
    'repair': (0.1, lambda log, out: main(['repair', str(log), str(out / 'bag')])),
    'scene': (0.1, lambda log, out: open_log(log).description().scene()),
    'resimulate': (0.16, lambda log, out: resimulate(open_log(log))),
    'plot': (0.02, lambda log, out: main(['plot', str(log), '--out', str(out)])),
    'replay --with': (0.01, lambda log, out: main([
        'replay', str(log), '--with', 'timestep=0.001', '--out', str(out / 'w.png')
    ])),
    'render': (0.01, lambda log, out: main(['render', str(log), '--out', str(out / 'r.png')])),
}  # fmt: skip


def command_of(seed: int) -> str:
    """Return the command that the log of a seed is opened with."""
    names = list(COMMANDS)
    return Random(f'command {seed}').choices(names, [COMMANDS[name][0] for name in names])[0]


def judged_log(content: bytes, command: str, folder: Path) -> Verdict:
    """Return what became of a log; everything that is written goes below a folder."""
    log, out = folder / 'a.mcap', folder / 'out'
    log.write_bytes(content)
    out.mkdir(exist_ok=True)
    action = COMMANDS[command][1]
    return judged(lambda: action(log, out), len(content))
