# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Brings a scene's weather into its model: ``opt.wind``, or keys of fluid_sim.medium."""

from collections.abc import Mapping, Sequence

import mujoco

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.plugins.config import MEDIUM
from fluid_sim_ros.scene.grid_files import unpack
from fluid_sim_ros.scene.media import MOST_SEEDS
from fluid_sim_ros.schema.flow_model import FlowModel
from fluid_sim_ros.schema.mean_flow import Steady


def apply_weather(
    spec: mujoco.MjSpec,
    wind: Sequence[FlowModel],
    current: Sequence[FlowModel],
    seed: int,
    where: str,
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
    plugin.config = {**plugin.config, **keys, 'seed': str(seed % MOST_SEEDS)}
    _add_grids(spec, 'wind', wind)
    _add_grids(spec, 'current', current)


def _add_grids(spec: mujoco.MjSpec, stream: str, models: Sequence[FlowModel]) -> None:
    for model in models:
        packed = model.packed_grid()
        if packed is not None:
            numbers = unpack(packed)
            spec.add_numeric(name=f'{stream}_grid', data=numbers, size=len(numbers))


def _keys(stream: str, models: Sequence[FlowModel], where: str) -> dict[str, str]:
    """Return the keys of fluid_sim.medium that say what the models of one stream do."""
    _check_together(stream, models, where)
    signals = f'{stream}_signal'
    keys: dict[str, str] = {}
    for model in models:
        added = model.keys(stream)
        if signals in keys and signals in added:  # signals add up
            added[signals] = f'{keys[signals]} {added[signals]}'
        keys |= added
    return keys


def _check_together(stream: str, models: Sequence[FlowModel], where: str) -> None:
    found: dict[str, list[str]] = {}
    for model in models:
        found.setdefault(model.one_of, []).append(model.model)
    for what, names in found.items():
        if what and len(names) > 1:
            raise ConfigError(
                f"{where}: key '{stream}': {' and '.join(names[:5])}; one {what} at most"
            )


def add_waves(spec: mujoco.MjSpec, keys: Mapping[str, str], where: str) -> None:
    """
    Write waves into a model before it is compiled.

    Parameters
    ----------
    spec
        The model; changed.
    keys
        Of fluid_sim.medium; see ``schema.waves``.
    where
        What an error begins with.

    Raises
    ------
    ConfigError
        If the model has no free surface.

    """
    media = [p for p in spec.plugins if p.plugin_name == MEDIUM and p.name]
    if not media:
        raise ConfigError(
            f"{where}: key 'waves': the model has no free surface; "
            'give it a fluid_sim.medium with surface'
        )
    media[0].config = {**media[0].config, **keys}
