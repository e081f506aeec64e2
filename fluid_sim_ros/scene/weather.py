"""Brings a scene's wind and current into its model: ``opt.wind``, or keys of fluid_sim.medium."""

import math
from collections.abc import Iterable, Sequence
from typing import Any

import mujoco

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.scene.grid_files import unpack
from fluid_sim_ros.scene.media import MEDIUM
from fluid_sim_ros.schema.weather import (
    MEANS,
    TIDES,
    GaussMarkov,
    GridFile,
    Gust,
    Logarithmic,
    PowerLaw,
    Ramp,
    Series,
    Sheared,
    Sine,
    Steady,
    Stratified,
    Tide,
    Turbulence,
    VonKarman,
)

_AT_MOST_ONE: dict[str, tuple[type[Any], ...]] = {
    'mean flow': MEANS,
    'series': (Series,),
    'Gauss-Markov process': (GaussMarkov,),
    'turbulence': (Turbulence,),
    'grid': (GridFile,),
}


def apply_weather(
    spec: mujoco.MjSpec, wind: Sequence[Any], current: Sequence[Any], seed: int, where: str
) -> None:
    """
    Write wind and current into a model before it is compiled.

    One steady velocity for everything goes to ``opt.wind`` where the model has no medium: then
    MuJoCo's own forces need no plugin. Everything else goes to ``fluid_sim.medium``, which is
    added where there is none; every vehicle then meets its own local flow.

    Parameters
    ----------
    spec
        The model; changed.
    wind, current
        Models of ``schema.weather`` that add up.
    seed
        Of the random ones.
    where
        What an error begins with.

    Raises
    ------
    ConfigError
        If the models cannot stand together.

    """
    if not wind and not current:
        return
    keys = {**_keys('wind', wind, where), **_keys('current', current, where)}
    plugin = next((p for p in spec.plugins if p.plugin_name == MEDIUM and p.name), None)
    if plugin is None:
        models = [*wind, *current]
        if len(models) == 1 and isinstance(models[0], Steady):
            spec.option.wind = models[0].velocity
            return
        spec.activate_plugin(MEDIUM)
        plugin = spec.add_plugin(name='weather', plugin_name=MEDIUM, active=True)
    plugin.config = {**plugin.config, **keys, 'seed': str(seed)}
    _add_grids(spec, 'wind', wind)
    _add_grids(spec, 'current', current)


def _add_grids(spec: mujoco.MjSpec, stream: str, models: Sequence[Any]) -> None:
    for model in models:
        if isinstance(model, GridFile):
            numbers = unpack(str(model.data))
            spec.add_numeric(name=f'{stream}_grid', data=numbers, size=len(numbers))


def _keys(stream: str, models: Sequence[Any], where: str) -> dict[str, str]:
    """Return the keys of fluid_sim.medium that say what the models of one stream do."""
    _check_together(stream, models, where)
    keys: dict[str, str] = {}
    signals: list[str] = []
    for model in models:
        if isinstance(model, MEANS):
            keys |= _mean(stream, model)
        elif isinstance(model, Series):
            keys[f'{stream}_series'] = _series(model)
        elif isinstance(model, GridFile):
            keys[f'{stream}_grid'] = f'{stream}_grid'
        elif isinstance(model, GaussMarkov):
            keys[f'{stream}_gauss_markov'] = _words([*model.sigma, model.time_constant])
            keys[f'{stream}_tick'] = _words([model.tick])
        elif isinstance(model, Turbulence):
            keys |= _turbulence(model)
        else:
            signals += _signals(model)
        if isinstance(model, Sheared) and model.rotational:
            keys['rotational_gust'] = 'curl'
    if signals:
        keys[f'{stream}_signal'] = ' '.join(signals)
    return keys


def _check_together(stream: str, models: Sequence[Any], where: str) -> None:
    for what, kinds in _AT_MOST_ONE.items():
        found = [str(model.model) for model in models if isinstance(model, kinds)]
        if len(found) > 1:
            raise ConfigError(
                f"{where}: key '{stream}': {' and '.join(found)}; one {what} at most"
            )


def _words(numbers: Iterable[float]) -> str:
    """Return numbers with all their digits."""
    return ' '.join(repr(float(number)) for number in numbers)


def _mean(stream: str, model: Any) -> dict[str, str]:
    keys = {stream: _words(model.velocity)}
    if isinstance(model, Steady):
        return keys
    if isinstance(model, Stratified):
        pairs = [
            number
            for depth, factor in reversed(list(zip(model.depths, model.factors, strict=True)))
            for number in (-depth, factor)
        ]
        return keys | {f'{stream}_profile': f'table {_words(pairs)}'}
    assert isinstance(model, PowerLaw | Logarithmic)
    word, shape = 'power', getattr(model, 'exponent', 0.0)
    if isinstance(model, Logarithmic):
        word, shape = 'log', model.roughness
    profile = f'{word} {_words([shape, model.reference_height])}'
    return keys | {f'{stream}_profile': profile, f'{stream}_datum': _words([model.ground])}


def _signals(model: Any) -> list[str]:
    if isinstance(model, Ramp):
        return [f'ramp {_words([*model.amplitude, model.start, model.duration])}']
    if isinstance(model, Sine):
        return [f'sine {_words([*model.amplitude, model.period, model.phase])}']
    if isinstance(model, Gust):
        rise = model.length / model.airspeed
        hold = [] if model.hold is None else [model.hold]
        return [f'gust {_words([*model.amplitude, model.start, rise, *hold])}']
    assert isinstance(model, Tide)
    return [_constituent(part) for part in model.constituents]


def _constituent(part: Any) -> str:
    """Return A cos(omega t - g) as the sine it is."""
    hours = part.period_hours if part.name is None else 360.0 / TIDES[part.name]
    phase = math.pi / 2 - math.radians(part.phase_deg)
    return f'sine {_words([*part.amplitude, 3600.0 * hours, phase])}'


def _series(model: Series) -> str:
    assert model.times is not None
    assert model.velocities is not None
    rows = zip(model.times, model.velocities, strict=True)
    return _words(number for time, velocity in rows for number in (time, *velocity))


def _turbulence(model: Turbulence) -> dict[str, str]:
    keys = {
        'turbulence': 'von_karman' if isinstance(model, VonKarman) else 'dryden',
        'turbulence_airspeed': _words([model.airspeed]),
        'turbulence_ground': _words([model.ground]),
        'turbulence_tick': _words([model.tick]),
        'turbulence_follow': 'vehicle' if model.follow_vehicle else 'none',
    }
    if model.sigma is not None:
        keys['turbulence_sigma'] = _words(model.sigma)
    if model.wind_6m is not None:
        keys['turbulence_wind_6m'] = _words([model.wind_6m])
        keys['turbulence_exceedance'] = model.exceedance
    if model.length is not None:
        keys['turbulence_length'] = _words(model.length)
    if model.height is not None:
        keys['turbulence_height'] = _words([model.height])
    if model.direction is not None:
        keys['turbulence_direction'] = _words(model.direction)
    if model.span is not None:
        keys['turbulence_span'] = _words([model.span])
    return keys
