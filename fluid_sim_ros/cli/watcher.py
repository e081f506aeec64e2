# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What ``fluid_sim run`` sees of a run while it goes on, and the line that it shows."""

import time

import numpy as np
from rich.progress import Progress

from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.simulation import Simulation

#: Simulated time between two looks at the forces [s].
SAMPLE_PERIOD = 0.01
#: Wall time between two updates of what is shown [s].
_SHOW_PERIOD = 0.1
#: So many vehicles have a place in the line.
_SHOWN = 2


class Watcher:
    """
    A sink that keeps the largest fluid force on each vehicle, and shows the progress.

    Parameters
    ----------
    simulation
        What is watched.
    progress
        Where the progress is shown.
    live
        Whether the progress is a line with the state of the vehicles.

    Attributes
    ----------
    period
        Steps between two looks.
    largest, largest_at
        Largest fluid force per vehicle [N] in scene order, and its time [s], shape (n,).

    """

    def __init__(self, simulation: Simulation, progress: Progress, live: bool = False) -> None:
        self.period = max(1, round(SAMPLE_PERIOD / simulation.timestep))
        self.largest = np.zeros(len(simulation.vehicles))
        self.largest_at = np.zeros(len(simulation.vehicles))
        self._progress = progress
        self._live, self._begin, self._shown_at = live, time.perf_counter(), 0.0

    def write(self, simulation: Simulation) -> None:
        """
        Look at the forces at this step boundary.

        Parameters
        ----------
        simulation
            At a step boundary.

        """
        rows = simulation.observe(forces=True)
        force = np.linalg.norm(rows[:, nat.TOTAL][:, :3], axis=1)
        self.largest_at[force > self.largest] = simulation.time
        np.maximum(self.largest, force, out=self.largest)
        now = time.perf_counter()
        if now - self._shown_at > _SHOW_PERIOD:
            self._shown_at = now
            line = self._status(simulation, now) if self._live else simulation.scene.name
            for task in self._progress.task_ids:
                self._progress.update(task, completed=simulation.time, description=line)

    def _status(self, simulation: Simulation, now: float) -> str:
        """Return time, speed of the run and where the first vehicles are."""
        words = [f'{simulation.time:.1f} s', f'{simulation.time / (now - self._begin):.2f} x']
        states = list(simulation.snapshot().vehicles.items())
        for name, state in states[:_SHOWN]:
            place = ' '.join(f'{value:.2f}' for value in state.position_w)
            words.append(f'{name} at {place} m, {np.linalg.norm(state.velocity_b):.2f} m/s')
        if len(states) > _SHOWN:
            words.append(f'and {len(states) - _SHOWN} more')
        return '  '.join(words)
