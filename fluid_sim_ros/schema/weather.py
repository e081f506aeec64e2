# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The YAML schema of ``wind:`` and ``current:``: one model or a list of models that add up.

Vectors are in world axes (ENU), the direction that the fluid moves to; heights are world z [m].
"""

from typing import Annotated, Any

from pydantic import BeforeValidator, Field

from fluid_sim_ros.schema.flow_data import GridFile, Series
from fluid_sim_ros.schema.flow_signals import Gust, Ramp, Sine, Tide
from fluid_sim_ros.schema.mean_flow import Logarithmic, PowerLaw, Steady, Stratified
from fluid_sim_ros.schema.turbulence import Dryden, GaussMarkov, VonKarman

WindModel = Annotated[
    Steady
    | PowerLaw
    | Logarithmic
    | Ramp
    | Sine
    | Gust
    | Series
    | GridFile
    | GaussMarkov
    | Dryden
    | VonKarman,
    Field(discriminator='model'),
]
CurrentModel = Annotated[
    Steady
    | PowerLaw
    | Logarithmic
    | Stratified
    | Ramp
    | Sine
    | Tide
    | Series
    | GridFile
    | GaussMarkov,
    Field(discriminator='model'),
]


def _as_list(value: Any) -> Any:
    return [value] if isinstance(value, dict) else value


Wind = Annotated[list[WindModel], BeforeValidator(_as_list)]
Current = Annotated[list[CurrentModel], BeforeValidator(_as_list)]
