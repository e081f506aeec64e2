# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Watches whether the integrator makes or takes energy by itself, over a run."""

import mujoco
import numpy as np

from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.simulation import Simulation

#: Simulated time between two looks [s], and their least distance in steps: a look takes as long
#: as four steps, and eight where something is to be seen.
_PERIOD, _FEWEST_STEPS = 0.1, 100
#: Judged after this simulated time [s], and at the end: while a motion begins, its energy is small
#: beside that of a moment later.
_FIRST_JUDGED = 1.0
#: Share of the largest kinetic energy that is worth a warning.
_NOTABLE = 0.1
#: Root mean square speed below which a motion is none [m/s].
_LEAST_SPEED = 1e-3


class EnergyWatch:
    """
    Adds up what the integrator feeds into the motion (``Simulation.energy_balance``).

    Single looks mislead: near rest, at a turning point or where a servo sets in, the feed is large
    beside the kinetic energy of that moment. Over a run it must stay below what drag takes out, or
    below a tenth of the largest kinetic energy. Looks with contacts are left out, since the work
    of an impact is not known from its ends.

    Parameters
    ----------
    simulation
        What is watched.

    Attributes
    ----------
    period
        Ticks between two looks.

    """

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self.period = energy_period(simulation.timestep)
        self._sums = np.zeros(3)
        self._addresses = (
            simulation.model._address, simulation.data._address, simulation.observed._address,
        )  # fmt: skip
        self._restart()

    def _restart(self) -> None:
        self._sums[:] = 0.0
        self._looked_at = self._simulation.time

    def take(self) -> str:
        """
        Take the present state into account.

        Returns
        -------
        str
            A warning that holds for the run so far, or ''.

        """
        simulation = self._simulation
        passed = simulation.time - self._looked_at
        if passed < 0:  # a reset
            self._restart()
            return ''
        self._looked_at = simulation.time
        if not passed:
            return ''
        nat.native().energy_take(*self._addresses, passed, self._sums.ctypes.data)
        return self.judge() if simulation.time >= _FIRST_JUDGED else ''

    def judge(self) -> str:
        """
        Judge the run so far.

        Returns
        -------
        str
            One line when the integrator outweighs drag, else ''.

        """
        return energy_line(self._simulation.model, self._simulation.time, *self._sums.tolist())


def energy_period(timestep: float) -> int:
    """
    Return the steps between two looks at the energy.

    Parameters
    ----------
    timestep
        [s].

    Returns
    -------
    int
        One more than a multiple of ten: looks fall on every phase of a control at a usual rate.

    """
    return 10 * round(max(_FEWEST_STEPS, _PERIOD / timestep) / 10) + 1


def energy_line(
    model: mujoco.MjModel, time: float, fed: float, lost: float, largest: float
) -> str:
    """
    Judge what an integrator has done to the energy of a run.

    Parameters
    ----------
    model
        What was run.
    time
        So far [s].
    fed, lost
        What the integrator added, and what drag and damping took out [J].
    largest
        Largest kinetic energy of bodies and flow [J].

    Returns
    -------
    str
        One line when the integrator outweighs drag, else ''.

    """
    share = abs(fed)
    least = 0.5 * float(model.body_mass[1:].sum()) * _LEAST_SPEED**2
    if largest < least or not np.isfinite(share) or share <= max(lost, _NOTABLE * largest):
        return ''
    verb = 'added' if fed > 0 else 'taken'
    rk4 = model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4
    return (
        f'energy watchdog: by t = {time:g} s the integrator has {verb} {share / largest:.0%} of '
        'the largest kinetic energy by itself, more than drag took out; use '
        f'{"" if rk4 else "RK4 or "}a smaller timestep'
    )
