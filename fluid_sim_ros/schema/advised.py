# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The settings that a scene file keeps beside its own, for whoever asks for them."""

from fluid_sim_ros.schema.base import NotNegative, Positive, Strict
from fluid_sim_ros.schema.settings import Fluid, Integrator, RunSettings


class Advised(Strict):
    """
    What ``fluid_sim advise`` chose for a scene.

    ``command`` found it: within ``tolerance`` (relative, of ``metric``), with this ``error``.
    Without ``fluid`` the scene's own fluid forces hold.
    """

    command: str
    tolerance: Positive
    metric: str
    error: NotNegative
    timestep: Positive
    integrator: Integrator
    fluid: Fluid | None = None

    @property
    def settings(self) -> RunSettings:
        """Timestep, integrator and fluid as settings of a run."""
        return RunSettings(timestep=self.timestep, integrator=self.integrator, fluid=self.fluid)
