# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Whether a poorer model leaves out forces that act where a scene can be taken."""

import math

from fluid_sim_ros.lab.advisor.budgeted_runs import BudgetedRuns
from fluid_sim_ros.lab.advisor.reference import Reference
from fluid_sim_ros.lab.manoeuvre import envelope
from fluid_sim_ros.lab.metrics import metric


class Envelope:
    """
    Compares models in a scene's envelope: the standard excitation, beside its own manoeuvre.

    A controller or a user drives a scene to where its own manoeuvre does not go. A model that
    does well in the latter only would answer a wind or a current with nothing.

    Parameters
    ----------
    budgeted
        Whose problem and time it is.
    reference
        By whose setting and metric models are compared.

    """

    def __init__(self, budgeted: BudgetedRuns, reference: Reference) -> None:
        self._budgeted = budgeted
        self._reference = reference
        self._runs: BudgetedRuns | None = None

    def fault(self, rung: str, tolerance: float) -> str:
        """
        Return why a model may not be chosen, or nothing.

        Parameters
        ----------
        rung
            Name of the model.
        tolerance
            Largest relative error [-].

        Returns
        -------
        str
            One line.

        """
        problem = self._budgeted.problem
        if problem.excitation:  # the reference is in the envelope already
            return ''
        if self._runs is None:
            moved = envelope(problem)
            if moved is None:
                return ''
            self._runs = BudgetedRuns(moved, self._budgeted.left)
        runs, setting = self._runs, self._reference.setting
        rich, poor = runs.run(setting), runs.run(setting._replace(rung=rung))
        if rich is None or poor is None:
            return 'the time budget ends before its run in the envelope of the scene'
        where = f'in the envelope of the scene ({runs.problem.excitation})'
        if rich.fault or poor.fault:
            return f"the model's own error cannot be told {where}: {rich.fault or poor.fault}"
        judge = metric(self._reference.metric_name, runs.problem, rich.states)
        error = judge(poor.states, rich.states)
        if math.isfinite(error) and error <= tolerance:
            return ''
        return f"the model's own error is {error:.2g} {where}"
