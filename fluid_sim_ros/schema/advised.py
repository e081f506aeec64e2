"""The settings that a scene file keeps beside its own, for whoever asks for them."""

from typing import Annotated

from pydantic import AfterValidator

from fluid_sim_ros.errors import listed
from fluid_sim_ros.schema.base import NotNegative, Positive, Strict
from fluid_sim_ros.schema.settings import FLUID_RUNGS, INTEGRATORS


def _integrator(name: str) -> str:
    if name.lower() not in INTEGRATORS:
        raise ValueError(f'is not known; allowed: {listed(INTEGRATORS)}')
    return name


def _fluid(name: str) -> str:
    if name not in FLUID_RUNGS:
        raise ValueError(f'is not known; allowed: {listed(FLUID_RUNGS)}')
    return name


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
    integrator: Annotated[str, AfterValidator(_integrator)]
    fluid: Annotated[str, AfterValidator(_fluid)] | None = None
