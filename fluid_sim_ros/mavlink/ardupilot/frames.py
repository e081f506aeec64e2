# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""ArduPilot's frames: how long each is, and the steps that it is split into."""

from fractions import Fraction

from fluid_sim_ros.loop.autopilot_port import CommandLog
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import exact


class Frames:
    """
    One frame after another: equal steps, no longer than the scene's.

    Parameters
    ----------
    timestep
        Of the scene [s].
    log
        Is told of each new timestep; or None.

    Attributes
    ----------
    rate
        Frames per second of the present one [Hz]; 0 before the first.
    end_ns
        Simulated time at which the present one ends [ns].
    shared
        Others are waited for too, so that somebody else sets the timestep.

    """

    def __init__(self, timestep: float, log: CommandLog | None) -> None:
        self._longest = exact(timestep)
        self._log = log
        self._steps = 0  # of a frame
        self._end = 0  # step at which the present one ends
        self.rate = self.end_ns = 0
        self.shared = False

    def over(self, simulation: Simulation) -> bool:
        """
        Return whether the present one has ended.

        Parameters
        ----------
        simulation
            At a step boundary.

        """
        if self.shared:
            return simulation.time_ns >= self.end_ns
        return simulation.step_count >= self._end

    def steps_left(self, simulation: Simulation) -> int:
        """
        Return the steps to its end.

        Parameters
        ----------
        simulation
            At a step boundary.

        """
        return max(1, self._end - simulation.step_count)

    def begin(self, simulation: Simulation, rate: int) -> None:
        """
        Begin a frame.

        Parameters
        ----------
        simulation
            At a step boundary; gets its timestep.
        rate
            Frames per second [Hz].

        """
        changed, self.rate = rate != self.rate, rate
        if self.shared:
            self.end_ns = simulation.time_ns + 1000 * frame_us(rate)
            return
        if changed:
            frame = Fraction(frame_us(rate), 1_000_000)
            self._steps = -int(-frame // self._longest)  # rounded up
            timestep = frame / self._steps
            simulation.set_timestep(timestep)
            if self._log is not None:
                self._log.event(timestep=str(timestep))
        self._end = simulation.step_count + self._steps

    def go_on(self, simulation: Simulation, seconds: float) -> None:
        """
        Let a while pass without the autopilot.

        Parameters
        ----------
        simulation
            At a step boundary.
        seconds
            How long [s].

        """
        steps = max(1, round(seconds / simulation.timestep))
        self._end = simulation.step_count + steps
        self.end_ns = simulation.time_ns + round(steps * simulation.timestep * 1e9)

    def end_here(self, simulation: Simulation) -> None:
        """
        End the present one.

        Parameters
        ----------
        simulation
            At a step boundary.

        """
        self._end, self.end_ns = simulation.step_count, simulation.time_ns

    def forget(self) -> None:
        """Begin anew, as after a reset: the simulation has the scene's timestep again."""
        self.rate = self._end = self.end_ns = 0


def frame_us(rate: int) -> int:
    """
    Return the length of a frame.

    Parameters
    ----------
    rate
        Frames per second that ArduPilot states [Hz].

    Returns
    -------
    int
        [us], rounded down, as ArduPilot's own clock does.

    """
    return 1_000_000 // rate
