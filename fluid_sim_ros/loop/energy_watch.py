"""Watches whether the integrator makes or takes energy by itself, over a run."""

import mujoco
import numpy as np

from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.simulation.energy import EnergyBalance

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
    fed, lost
        What the integrator added, and what drag and damping took out, so far [J].
    largest
        Largest kinetic energy of bodies and flow [J].

    """

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        # one more than a multiple of ten: looks fall on every phase of a control at a usual rate
        self.period = 10 * round(max(_FEWEST_STEPS, _PERIOD / simulation.timestep) / 10) + 1
        mass = float(simulation.model.body_mass[1:].sum())
        self._least = 0.5 * mass * _LEAST_SPEED**2
        self._restart()

    def _restart(self) -> None:
        self.fed = self.lost = self.largest = 0.0
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
        balance = simulation.energy_balance()
        feed = self._refined(balance) if balance.warning else balance.feed
        if simulation.data.ncon or simulation.observed.ncon:  # before the step, or after it
            return ''
        self.fed += feed * passed
        self.lost += max(balance.dissipation, 0.0) * passed
        self.largest = max(self.largest, balance.kinetic)
        return self.judge() if simulation.time >= _FIRST_JUDGED else ''

    def _refined(self, balance: EnergyBalance) -> float:
        """
        Return the feed [W] without the error of its measurement.

        The work of the forces is taken from both ends of a step. Where they change within it, as
        those of a stiff servo, that is off by the square of the timestep h, in which the feed of
        an integrator is of the first order (RK4: of the fourth). So a look at h/2 parts the two.
        """
        option, half = self._simulation.model.opt, balance.feed
        timestep = option.timestep
        option.timestep = 0.5 * timestep
        try:
            half = self._simulation.energy_balance().feed
        finally:
            option.timestep = timestep
        if self._is_rk4():
            return (balance.feed - 4.0 * half) * 4.0 / 3.0
        return 4.0 * half - balance.feed

    def _is_rk4(self) -> bool:
        return bool(self._simulation.model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4)

    def judge(self) -> str:
        """
        Judge the run so far.

        Returns
        -------
        str
            One line when the integrator outweighs drag, else ''.

        """
        share = abs(self.fed)
        if self.largest < self._least or not np.isfinite(share):
            return ''
        if share <= max(self.lost, _NOTABLE * self.largest):
            return ''
        verb = 'added' if self.fed > 0 else 'taken'
        return (
            f'energy watchdog: by t = {self._simulation.time:g} s the integrator has {verb} '
            f'{share / self.largest:.0%} of the largest kinetic energy by itself, more than drag '
            f'took out; use {"" if self._is_rk4() else "RK4 or "}a smaller timestep'
        )
