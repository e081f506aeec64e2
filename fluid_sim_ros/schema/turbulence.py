# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Random winds and currents; the seed is that of the simulation."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from fluid_sim_ros.schema.base import NotNegative, Number, Positive, Vector
from fluid_sim_ros.schema.flow_model import FlowModel, words


class GaussMarkov(FlowModel):
    """Covariance sigma^2 exp(-t/time_constant), ``sigma`` [m/s] per axis, times in [s]."""

    model: Literal['gauss_markov']
    one_of = 'Gauss-Markov process'
    sigma: Annotated[list[NotNegative], Field(min_length=3, max_length=3)]
    time_constant: Positive
    tick: Positive = 0.1

    def _keys(self, stream: str) -> dict[str, str]:
        return {
            f'{stream}_gauss_markov': words([*self.sigma, self.time_constant]),
            f'{stream}_tick': words([self.tick]),
        }


class Turbulence(FlowModel):
    """
    Continuous turbulence of MIL-F-8785C, own to each vehicle; see doc/weather.md.

    Intensity by ``wind_6m`` [m/s] (of the mean wind, 20 ft above ground) and, above 1000 ft, by
    the probability ``exceedance``; or by ``sigma`` [m/s] (u, v, w). Length scales at ``height``
    [m], or ``length`` [m] (u, v, w). ``airspeed`` [m/s] turns lengths into times. ``direction`` is
    that in which the mean relative wind passes the vehicle (default: the mean wind's). ``span``
    [m] adds the angular rates p, q, r. ``follow_vehicle`` takes height and airspeed of the vehicle
    at each ``tick`` [s] instead: the gusts then depend on the flight.
    """

    one_of = 'turbulence'
    wind_6m: NotNegative | None = None
    exceedance: Literal['2e-1', '1e-1', '1e-2', '1e-3', '1e-4', '1e-5', '1e-6'] = '1e-2'
    sigma: Annotated[list[NotNegative], Field(min_length=3, max_length=3)] | None = None
    length: Annotated[list[Positive], Field(min_length=3, max_length=3)] | None = None
    height: Positive | None = None
    airspeed: Positive
    direction: Vector | None = None
    span: Positive | None = None
    ground: Number = 0.0
    follow_vehicle: bool = False
    tick: Positive = 0.01

    @model_validator(mode='after')
    def _one_intensity(self) -> Self:
        if (self.wind_6m is None) == (self.sigma is None):
            raise ValueError('needs either wind_6m [m/s] or sigma [m/s]')
        if (self.height is None) == (self.length is None):
            raise ValueError('needs either height [m] or length [m]')
        if self.follow_vehicle and self.length is not None:
            raise ValueError('follow_vehicle takes the lengths from the height; remove length')
        return self

    def _keys(self, stream: str) -> dict[str, str]:
        keys = {
            'turbulence': self.model,
            'turbulence_airspeed': words([self.airspeed]),
            'turbulence_ground': words([self.ground]),
            'turbulence_tick': words([self.tick]),
            'turbulence_follow': 'vehicle' if self.follow_vehicle else 'none',
        }
        if self.sigma is not None:
            keys['turbulence_sigma'] = words(self.sigma)
        if self.wind_6m is not None:
            keys['turbulence_wind_6m'] = words([self.wind_6m])
            keys['turbulence_exceedance'] = self.exceedance
        if self.length is not None:
            keys['turbulence_length'] = words(self.length)
        if self.height is not None:
            keys['turbulence_height'] = words([self.height])
        if self.direction is not None:
            keys['turbulence_direction'] = words(self.direction)
        if self.span is not None:
            keys['turbulence_span'] = words([self.span])
        return keys


class Dryden(Turbulence):
    """Turbulence with the spectra of Dryden."""

    model: Literal['dryden']


class VonKarman(Turbulence):
    """Turbulence with the spectra of von Karman."""

    model: Literal['von_karman']
