"""
The YAML schema of ``wind:`` and ``current:``: one model or a list of models that add up.

Vectors are in world axes (ENU), the direction that the fluid moves to; heights are world z [m].
"""

from itertools import pairwise
from typing import Annotated, Any, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from fluid_sim_ros.schema.base import NotNegative, Number, Positive, Strict, Vector

Increasing = Annotated[list[Number], Field(min_length=2)]


def _rising(values: list[float], key: str) -> None:
    for before, after in pairwise(values):
        if after <= before:
            raise ValueError(f'{key} must rise strictly (got {after:g} after {before:g})')


# ---- the mean: one of them, replaced by the topic and by the schedule ---------------------------


class Steady(Strict):
    """One ``velocity`` [m/s] at every height."""

    model: Literal['steady']
    velocity: Vector


class Sheared(Strict):
    """
    A flow that changes over the height.

    With ``rotational`` drag and damping see the air turn with half the curl, for large bodies.
    """

    rotational: bool = False


class PowerLaw(Sheared):
    """``velocity`` [m/s] at ``reference_height`` [m] over ``ground``, times (z/z_ref)^exponent."""

    model: Literal['power_law']
    velocity: Vector
    exponent: Positive = 1 / 7  # open land; physics/medium.py names the sources
    reference_height: Positive = 10.0
    ground: Number = 0.0


class Logarithmic(Sheared):
    """``velocity`` [m/s] at ``reference_height`` [m] of the law of the wall, ``roughness`` [m]."""

    model: Literal['logarithmic']
    velocity: Vector
    roughness: Positive
    reference_height: Positive = 10.0
    ground: Number = 0.0

    @model_validator(mode='after')
    def _above_roughness(self) -> Self:
        if self.reference_height <= self.roughness:
            raise ValueError(f'reference_height must be above the roughness {self.roughness:g} m')
        return self


class Stratified(Sheared):
    """``velocity`` [m/s] times ``factors`` at ``depths`` [m] below the surface (else z = 0)."""

    model: Literal['stratified']
    velocity: Vector
    depths: Increasing
    factors: Increasing

    @model_validator(mode='after')
    def _one_factor_each(self) -> Self:
        _rising(self.depths, 'depths')
        if len(self.factors) != len(self.depths):
            raise ValueError(f'{len(self.depths)} depths need as many factors')
        return self


# ---- signals in time, the same everywhere but for the profile of the mean -----------------------


class Ramp(Strict):
    """From 0 to ``amplitude`` [m/s] between ``start`` [s] and ``start + duration``."""

    model: Literal['ramp']
    amplitude: Vector
    start: NotNegative = 0.0
    duration: Positive


class Sine(Strict):
    """``amplitude`` [m/s] times sin(2 pi t/period + phase), ``period`` [s], ``phase`` [rad]."""

    model: Literal['sine']
    amplitude: Vector
    period: Positive
    phase: Number = 0.0


class Gust(Strict):
    """
    The 1-cosine gust of MIL-F-8785C, 3.7.2.3: ``amplitude`` [m/s], ``length`` [m] of its rise.

    It rises over ``length / airspeed`` [s] from ``start`` [s] and stays; with ``hold`` [s] it
    falls again as it rose.
    """

    model: Literal['gust']
    amplitude: Vector
    start: NotNegative = 0.0
    length: Positive
    airspeed: Positive
    hold: NotNegative | None = None


#: Speed of the main tidal constituents [deg/h]; Pugh (1987), Tides, Surges and Mean Sea-Level.
TIDES = {
    'M2': 28.9841042, 'S2': 30.0, 'N2': 28.4397295, 'K2': 30.0821373,
    'K1': 15.0410686, 'O1': 13.9430356, 'P1': 14.9589314, 'M4': 57.9682084,
}  # fmt: skip


class Constituent(Strict):
    """
    One harmonic of a tide: ``amplitude`` [m/s] times cos(omega t - phase_deg).

    ``name`` is one of ``TIDES``, or ``period_hours`` stands instead.
    """

    name: str | None = None
    period_hours: Positive | None = None
    amplitude: Vector
    phase_deg: Number = 0.0

    @model_validator(mode='after')
    def _one_period(self) -> Self:
        if (self.name is None) == (self.period_hours is None):
            raise ValueError('needs either name or period_hours')
        if self.name is not None and self.name not in TIDES:
            raise ValueError(f"constituent '{self.name}' is not known; known: {', '.join(TIDES)}")
        return self


class Tide(Strict):
    """A sum of harmonics."""

    model: Literal['tide']
    constituents: Annotated[list[Constituent], Field(min_length=1)]


class Series(Strict):
    """
    A time series: a CSV ``file`` with the columns t, x, y, z ([s], [m/s]), or both lists here.

    Cubic Hermite between the rows; before the first and after the last row their values hold.
    """

    model: Literal['series']
    file: str | None = None
    times: Increasing | None = None
    velocities: list[Vector] | None = None

    @model_validator(mode='after')
    def _rows(self) -> Self:
        if (self.times is None) != (self.velocities is None):
            raise ValueError('times and velocities belong together')
        if self.times is None and self.file is None:
            raise ValueError('needs a file, or times and velocities')
        if self.times is not None and self.velocities is not None:
            _rising(self.times, 'times')
            if len(self.velocities) != len(self.times):
                raise ValueError(f'{len(self.times)} times need as many velocities')
        return self


class GridFile(Sheared):
    """
    A flow u(t, x, y, z) on a rectilinear grid: an NPZ or NetCDF ``file`` (grid_files.py).

    Linear between the points; beyond the grid the value at its edge holds. ``data`` is the packed
    content of the file, which a log holds instead of it.
    """

    model: Literal['grid']
    file: str = ''
    data: str | None = None

    @model_validator(mode='after')
    def _some_source(self) -> Self:
        if not self.file and self.data is None:
            raise ValueError('needs a file')
        return self


# ---- random processes; the seed is the simulation's ---------------------------------------------


class GaussMarkov(Strict):
    """Covariance sigma^2 exp(-t/time_constant), ``sigma`` [m/s] per axis, times in [s]."""

    model: Literal['gauss_markov']
    sigma: Annotated[list[NotNegative], Field(min_length=3, max_length=3)]
    time_constant: Positive
    tick: Positive = 0.1


class Turbulence(Strict):
    """
    Continuous turbulence of MIL-F-8785C, own to each vehicle; see doc/weather.md.

    Intensity by ``wind_6m`` [m/s] (of the mean wind, 20 ft above ground) and, above 1000 ft, by
    the probability ``exceedance``; or by ``sigma`` [m/s] (u, v, w). Length scales at ``height``
    [m], or ``length`` [m] (u, v, w). ``airspeed`` [m/s] turns lengths into times. ``direction`` is
    that in which the mean relative wind passes the vehicle (default: the mean wind's). ``span``
    [m] adds the angular rates p, q, r. ``follow_vehicle`` takes height and airspeed of the vehicle
    at each ``tick`` [s] instead: the gusts then depend on the flight.
    """

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


class Dryden(Turbulence):
    """Turbulence with the spectra of Dryden."""

    model: Literal['dryden']


class VonKarman(Turbulence):
    """Turbulence with the spectra of von Karman."""

    model: Literal['von_karman']


MEANS = (Steady, PowerLaw, Logarithmic, Stratified)
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
