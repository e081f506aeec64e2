# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Mean winds and currents: one of them, replaced by the topic and by the schedule."""

from typing import Literal, Self

from pydantic import model_validator

from fluid_sim_ros.schema.base import Number, Positive, Vector
from fluid_sim_ros.schema.flow_model import FlowModel, Increasing, Sheared, check_rising, words

_MEAN = 'mean flow'


class Steady(FlowModel):
    """One ``velocity`` [m/s] at every height."""

    model: Literal['steady']
    one_of = _MEAN
    velocity: Vector

    def _keys(self, stream: str) -> dict[str, str]:
        return {stream: words(self.velocity)}


class PowerLaw(Sheared):
    """``velocity`` [m/s] at ``reference_height`` [m] over ``ground``, times (z/z_ref)^exponent."""

    model: Literal['power_law']
    one_of = _MEAN
    velocity: Vector
    exponent: Positive = 1 / 7  # open land; physics/medium.py names the sources
    reference_height: Positive = 10.0
    ground: Number = 0.0

    def _keys(self, stream: str) -> dict[str, str]:
        return super()._keys(stream) | {
            stream: words(self.velocity),
            f'{stream}_profile': f'power {words([self.exponent, self.reference_height])}',
            f'{stream}_datum': words([self.ground]),
        }


class Logarithmic(Sheared):
    """``velocity`` [m/s] at ``reference_height`` [m] of the law of the wall, ``roughness`` [m]."""

    model: Literal['logarithmic']
    one_of = _MEAN
    velocity: Vector
    roughness: Positive
    reference_height: Positive = 10.0
    ground: Number = 0.0

    @model_validator(mode='after')
    def _above_roughness(self) -> Self:
        if self.reference_height <= self.roughness:
            raise ValueError(f'reference_height must be above the roughness {self.roughness:g} m')
        return self

    def _keys(self, stream: str) -> dict[str, str]:
        return super()._keys(stream) | {
            stream: words(self.velocity),
            f'{stream}_profile': f'log {words([self.roughness, self.reference_height])}',
            f'{stream}_datum': words([self.ground]),
        }


class Stratified(Sheared):
    """``velocity`` [m/s] times ``factors`` at ``depths`` [m] below the surface (else z = 0)."""

    model: Literal['stratified']
    one_of = _MEAN
    velocity: Vector
    depths: Increasing
    factors: Increasing

    @model_validator(mode='after')
    def _one_factor_each(self) -> Self:
        check_rising(self.depths, 'depths')
        if len(self.factors) != len(self.depths):
            raise ValueError(f'{len(self.depths)} depths need as many factors')
        return self

    def _keys(self, stream: str) -> dict[str, str]:
        pairs = reversed(list(zip(self.depths, self.factors, strict=True)))
        table = words(number for depth, factor in pairs for number in (-depth, factor))
        return super()._keys(stream) | {
            stream: words(self.velocity),
            f'{stream}_profile': f'table {table}',
        }
