# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Whether real-time pacing keeps its pace, and what takes the time where it does not."""

import time
from collections.abc import Callable

from fluid_sim_ros.loop.pacing import KEPT_PACE, RealTime
from fluid_sim_ros.loop.runner import Runner
from fluid_sim_ros.ros.inputs import Inputs
from fluid_sim_ros.ros.outputs import Outputs
from fluid_sim_ros.simulation import Simulation

#: Wall time over which the speed is measured at least [s].
_SHORTEST = 0.5
#: Least wall time between two lines in the log [s].
_LOG_PERIOD = 10.0
#: Share of the time with a processor below which others are to blame.
_STARVED = 0.7


class SpeedWatch:
    """
    Measures the real-time factor between two calls, in the stepping thread.

    Parameters
    ----------
    simulation, inputs, outputs
        What takes the time.
    warn
        Takes the line while the pace is lost, every 10 s.

    Attributes
    ----------
    factor
        Simulated seconds per wall second.
    line
        What to say of it, or empty.
    shares
        Share of the wall time by what it was spent on.

    """

    def __init__(
        self,
        simulation: Simulation,
        inputs: Inputs,
        outputs: Outputs,
        warn: Callable[[str], None],
    ) -> None:
        self._simulation, self._inputs, self._outputs = simulation, inputs, outputs
        self._warn = warn
        self.factor = 0.0
        self.line = ''
        self.shares: dict[str, str] = {}
        self._ran = False
        self._warned_at = -_LOG_PERIOD
        self._before = self._now()

    def _now(self) -> tuple[float, ...]:
        outputs = self._outputs
        return (
            time.monotonic(), self._simulation.time, time.thread_time(), self._inputs.busy_s,
            outputs.busy_s - outputs.recording_s, outputs.recording_s,
        )  # fmt: skip

    def measure(self, runner: Runner, diverged: str) -> None:
        """
        Measure the time since the last call.

        Parameters
        ----------
        runner
            The loop, for its pacing and whether it runs.
        diverged
            Why the run ended, or empty.

        """
        now = self._now()
        wall, simulated, thread, *spent = (a - b for a, b in zip(now, self._before, strict=True))
        runs = not (runner.paused or runner.stopped or diverged)
        ran, self._ran = self._ran and runs, runs
        if wall > 0:
            self.factor = simulated / wall
        self._before = now
        pacing, line = runner.pacing, ''
        self.shares = {}
        if isinstance(pacing, RealTime) and ran and wall > _SHORTEST and simulated > 0:
            parts = dict(zip(('commands', 'messages', 'recording'), spent, strict=True))
            parts = {'steps': max(0.0, wall - sum(spent)), **parts}
            if self.factor < KEPT_PACE * pacing.factor:
                line = self._words(pacing.factor, parts, wall, thread)
                self.shares = {f'{part}_share': f'{s / wall:.2f}' for part, s in parts.items()}
                self.shares['processor_share'] = f'{thread / wall:.2f}'
        if line and time.monotonic() - self._warned_at > _LOG_PERIOD:
            self._warned_at = time.monotonic()
            self._warn(line)
        self.line = line

    def _words(self, wanted: float, parts: dict[str, float], wall: float, thread: float) -> str:
        shares = ', '.join(
            f'{part} {seconds / wall:.0%}'
            for part, seconds in sorted(parts.items(), key=lambda item: -item[1])
            if seconds >= 0.005 * wall
        )
        text = f'real-time factor {self.factor:.2f} instead of {wanted:g}; time goes to: {shares}'
        if thread < _STARVED * wall and parts['recording'] < 0.2 * wall:
            return (
                f'{text}; this thread had a processor for only {thread / wall:.0%} of it: other '
                'processes take the rest'
            )
        if parts['recording'] > 0.2 * wall:
            return f"{text}; the disk is too slow for the log (see 'record.topics')"
        return f'{text}; a larger timestep or a cheaper fluid model (fluid_sim advise) would help'
