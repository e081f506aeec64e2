# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The settings of a run: timestep, integrator, fluid model and seed, checked in one place."""

import operator
from typing import Annotated, Any

import mujoco
from pydantic import AfterValidator, BeforeValidator

from fluid_sim_ros.errors import did_you_mean, listed
from fluid_sim_ros.schema.base import Positive, Strict, validated

INTEGRATORS = {
    name.removeprefix('mjINT_').lower(): getattr(mujoco.mjtIntegrator, name)
    for name in mujoco.mjtIntegrator.__members__
}

#: Fluid rungs that a run can force on a scene; see ``scene.fluid_models``.
FLUID_RUNGS = ('none', 'inertia', 'ellipsoid', 'no_added_mass', 'inflow')


def _integrator(name: str) -> str:
    if name.lower() not in INTEGRATORS:
        hint = did_you_mean(name, INTEGRATORS)
        raise ValueError(f"'{name}' is not known{hint} allowed: {listed(INTEGRATORS)}")
    return name


def _fluid(name: str) -> str:
    if name not in FLUID_RUNGS:
        hint = did_you_mean(name, FLUID_RUNGS)
        raise ValueError(f"'{name}' is not known{hint} allowed: {listed(FLUID_RUNGS)}")
    return name


def _whole(value: Any) -> Any:
    """Take whole numbers of any type, such as numpy's; leave the rest for the check to refuse."""
    try:
        return operator.index(value)
    except TypeError:
        return value


#: The types of the settings, for every file that states some of them.
Integrator = Annotated[str, AfterValidator(_integrator)]
Fluid = Annotated[str, AfterValidator(_fluid)]
Seed = Annotated[int, BeforeValidator(_whole)]


class RunSettings(Strict):
    """
    What a run has in place of what its model states.

    Attributes
    ----------
    timestep
        [s]; None: the model's.
    integrator
        One of ``INTEGRATORS``, in any case; None: the model's.
    fluid
        One of ``FLUID_RUNGS``; None: the fluid forces that the model states.
    seed
        Of everything random: any whole number.

    """

    timestep: Positive | None = None
    integrator: Integrator | None = None
    fluid: Fluid | None = None
    seed: Seed = 0

    @classmethod
    def checked(cls, named: str = '{}', **settings: Any) -> 'RunSettings':
        """
        Return settings, or the one error that names the faulty one as the user wrote it.

        Parameters
        ----------
        named
            How the user wrote a setting, with ``{}`` for its name, such as ``--{}``.
        **settings
            Some of the attributes.

        Returns
        -------
        RunSettings
            The settings; what was not given is None, the seed 0.

        Raises
        ------
        ConfigError
            For the first setting that is not allowed, with what is.

        """
        return validated(cls, settings, named=named)

    def over(self, stated: 'RunSettings') -> 'RunSettings':
        """
        Return these settings, with those of another for what is None; the seed stays.

        Parameters
        ----------
        stated
            What holds where these say nothing.

        Returns
        -------
        RunSettings
            Both together.

        """
        own = self.model_dump(exclude_none=True)
        return self.model_copy(update=stated.model_dump(exclude_none=True) | own)

    @property
    def integrator_id(self) -> mujoco.mjtIntegrator | None:
        """The integrator as MuJoCo has it; None: the model's."""
        return None if self.integrator is None else INTEGRATORS[self.integrator.lower()]
