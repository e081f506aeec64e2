# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What a manoeuvre would tell: standard errors of parameters before it is flown."""

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np

from fluid_sim_ros.flights.flight import Flight
from fluid_sim_ros.reality.driven import comparable_scene
from fluid_sim_ros.reality.fit import cut_shots
from fluid_sim_ros.reality.fitting.normal import sandwich
from fluid_sim_ros.reality.fitting.solver import Solver, Task
from fluid_sim_ros.reality.parameters import find_parameters

#: Noise of position, attitude, velocity and rates that is assumed [m], [rad], [m/s], [rad/s].
NOISE = (0.002, 0.002, 0.01, 0.005)
#: A parameter is not told beyond this share of its value.
_TOLD = 0.1


def foreseen(flight: Flight, model: str, names: Sequence[str]) -> dict[str, Any]:
    """
    Return the standard errors that parameters would have, at the model's own values.

    Parameters
    ----------
    flight
        As a model flew it, with its commands.
    model
        Name or path of the scene.
    names
        Of the parameters.

    Returns
    -------
    dict
        Name -> ``value``, ``unit``, ``standard_error``, ``told`` (below a tenth of the value,
        or of its scale), for white noise of ``NOISE``.

    """
    task = Task(model, tuple(names))
    chosen = find_parameters(comparable_scene(model), task.parameters)
    shots, _ = cut_shots([flight], task)
    solver = Solver([flight], task, chosen, shots, np.array(NOISE))
    chosen = solver.chosen
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        linear = solver.linear(np.array([p.value for p in chosen]), True, pool)
    curved, _, _ = sandwich(linear, solver.scales, solver.walked())
    inverse = np.linalg.pinv(curved, rcond=1e-14, hermitian=True)
    touched = np.diag(curved) > 1e-12 * np.diag(curved).max()
    errors = np.where(touched, np.sqrt(np.maximum(np.diag(inverse), 0)) * solver.scales, np.inf)
    return {
        p.name: {
            'value': p.value, 'unit': p.unit,
            'standard_error': float(e) if np.isfinite(e) else None,
            'told': bool(e < _TOLD * (abs(p.value) or p.scale)),
        }
        for p, e in zip(chosen, errors, strict=True)
    }  # fmt: skip
