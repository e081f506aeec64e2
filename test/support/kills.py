# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Programs that are ended by a signal at a moment of their life, and what is left of them."""

import os
import signal
import subprocess
import sys
import time
import uuid
from dataclasses import dataclass, field
from pathlib import Path

from fluid_sim_ros.cli.main import main
from fluid_sim_ros.recording.reader import open_log
from test.support.recorded_flights import record_flight

#: As a console script does it. The first line tells that Python itself has started, whose own
#: handling of signals nobody can change.
COMMAND = (
    'import os, sys; from fluid_sim_ros.interruption import begin; begin("fluid_sim"); '
    'os.write(1, b"loading\\n"); sys.argv[0] = "/bin/fluid_sim"; '
    'from fluid_sim_ros.cli import main; sys.exit(main())'
)
NODE = (
    'import os; from fluid_sim_ros.ros.executables import fluid_sim_node; '
    'from fluid_sim_ros.ros.process.signals import end_quietly; end_quietly(); '
    'os.write(1, b"loading\\n"); fluid_sim_node()'
)
#: Longest time that a program, and all that it has started, may take to end [s].
PATIENCE = 10.0
#: What a kill -9 may cost [s].
MOST_LOST = 1.0
_MARK = 'FLUID_SIM_TEST_KILL'

SWEEP = """
scene: rov
duration: 0.2
runs: 200
seed: 3
vary: {current.x: {normal: [0, 1]}}
"""


@dataclass
class Kill:
    """One program that was ended: when, how, and what was wrong with its end (nothing)."""

    program: str
    number: int
    after_s: float
    code: int | None = None
    phase: str = ''
    wrong: list[str] = field(default_factory=list)
    lost_s: float = 0.0
    end_s: float = 0.0


class Killer:
    """Starts the programs in a folder, and ends them."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._flown = folder / 'flown.mcap'
        record_flight(self._flown, 'rov', seconds=0.5, seed=1)
        (folder / 'sweep.yaml').write_text(SWEEP)
        self._count = 0

    def command(self, program: str, log: Path) -> list[str]:
        """Return the command of a program, with the file or folder that it writes."""
        words = {
            'run': ['run', 'rov', '--duration', '60', '--record', log],
            'run_realtime': [
                'run', 'rov', '--duration', '2', '--pacing', 'realtime', '--record', log
            ],
            'demo': ['demo', '--duration', '6', '--out', log],
            'sweep': ['sweep', self._folder / 'sweep.yaml', '--out', log, '--workers', '2'],
            'replay': ['replay', self._flown, '--rate', '0.5'],
            'resimulate': ['replay', self._flown, '--resimulate'],
            'chart': [
                'chart', 'stokes', '--timesteps', '.01', '.005', '--rounds', '1', '--out', log
            ],
            'advise': ['advise', 'sphere', '--tolerance', '.1', '--budget', '5'],
        }  # fmt: skip
        if program == 'node':
            parameters = {
                'scene': 'rov', 'pacing': 'realtime', 'duration': 1.5, 'record.path': log
            }  # fmt: skip
            given = [
                word for pair in parameters.items() for word in ('-p', '{}:={}'.format(*pair))
            ]
            return [sys.executable, '-c', NODE, '--ros-args', *given]
        return [sys.executable, '-c', COMMAND, *map(str, words[program])]

    def _place(self, program: str) -> Path:
        self._count += 1
        ending = '.mcap' if program in ('run', 'run_realtime', 'node') else ''
        return self._folder / f'{program}_{self._count}{ending}'

    def length(self, program: str) -> float:
        """Return how long a program takes if nobody ends it [s]."""
        begin = time.monotonic()
        done = subprocess.run(
            self.command(program, self._place(program)), capture_output=True, text=True,
            cwd=self._folder, check=False,
        )  # fmt: skip
        assert done.returncode == 0, done.stderr
        return time.monotonic() - begin

    def kill(self, program: str, number: int, after: float) -> Kill:
        """End a program so many seconds after its first line, or its start if negative."""
        place, mark = self._place(program), uuid.uuid4().hex
        kill = Kill(program, number, after)
        process = subprocess.Popen(
            self.command(program, place), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            cwd=self._folder, env=os.environ | {_MARK: mark}, process_group=0,
        )  # fmt: skip
        if after >= 0:
            assert process.stdout.readline() == b'loading\n'
        time.sleep(abs(after))
        ended = process.poll() is not None
        began = place.exists()
        at_ns, at = time.time_ns(), time.monotonic()
        if number == signal.SIGINT and not ended:  # as a terminal does
            os.killpg(process.pid, number)
        else:
            process.send_signal(number)
        try:
            _, errors = process.communicate(timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            kill.wrong.append(f'did not end within {PATIENCE:g} s')
            process.kill()
            _, errors = process.communicate()
        kill.end_s, kill.code = time.monotonic() - at, process.returncode
        kill.phase = 'ended' if ended else 'begun' if began else 'loading'
        self._judge(kill, ended, errors.decode(errors='replace'))
        self._judge_children(kill, mark)
        if place.suffix == '.mcap' and place.exists():
            self._judge_log(kill, place, at_ns)
        if program == 'sweep' and main(['sweep', str(self._folder / 'sweep.yaml'), '--out',
                                        str(place), '--json', os.devnull]):  # fmt: skip
            kill.wrong.append('the sweep does not go on')
        if open_log(self._flown).faults:
            kill.wrong.append('a log that was read is damaged')
        return kill

    def _judge(self, kill: Kill, ended: bool, errors: str) -> None:
        if 'Traceback' in errors or 'Exception ignored' in errors or 'Error' in errors:
            kill.wrong.append(f'it said: {errors[-400:]}')
        allowed = {0} if kill.program == 'node' else {0, 128 + kill.number}
        if kill.number == signal.SIGKILL:
            allowed = {0, -signal.SIGKILL}
        if kill.code not in ({0} if ended else allowed):
            kill.wrong.append(f'exit code {kill.code}: {errors[-200:]}')

    def _judge_children(self, kill: Kill, mark: str) -> None:
        deadline = time.monotonic() + PATIENCE
        while left := _marked(mark):
            if time.monotonic() > deadline:
                kill.wrong.append(f'left behind: {left}')
                for number in left:
                    os.kill(number, signal.SIGKILL)
                return
            time.sleep(0.05)

    def _judge_log(self, kill: Kill, path: Path, at_ns: int) -> None:
        kill9 = kill.number == signal.SIGKILL
        if kill9 and not path.stat().st_size:
            return  # nothing had been written
        log = open_log(path)
        if log.faults:
            kill.wrong.append(f'log: {log.faults}')
        written = [message.publish_ns for message in log.messages()]
        # at the end of its flight the program has nothing more to write
        steps = {message.log_ns for message in log.messages()}
        last = 60e9 if kill.program == 'run' else 1.5e9 if kill.program == 'node' else 2e9
        if kill9 and written and max(steps) < last:
            # on a busy machine the program stands still for a while, and so loses nothing
            still = max(map(int.__sub__, written[1:], written), default=0)
            kill.lost_s = max(0.0, (at_ns - max(written) - still) * 1e-9)
            if kill.lost_s > MOST_LOST:
                kill.wrong.append(f'{kill.lost_s:.2f} s lost')


def _marked(mark: str) -> list[int]:
    """Return the processes that a killed program has left."""
    found = []
    wanted = f'{_MARK}={mark}'.encode()
    for folder in Path('/proc').iterdir():
        if not folder.name.isdigit():
            continue
        try:
            if wanted in (folder / 'environ').read_bytes().split(b'\0'):
                found.append(int(folder.name))
        except OSError:  # it has ended, or is another user's
            continue
    return found
