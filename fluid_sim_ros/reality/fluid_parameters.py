# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Parameters of what a fluid does to a body, and of how the fluid flows."""

from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np

from fluid_sim_ros.plugins.config import BODY, MEDIUM
from fluid_sim_ros.reality.parameter import Parameter, text_of, words_of

_DOFS = ('surge', 'sway', 'heave', 'roll', 'pitch', 'yaw')
#: Body parameters of six: (unit of the first three, of the last).
_SIX = {
    'added_mass': ('kg', 'kg m^2'),
    'linear_damping': ('N s/m', 'N m s'),
    'quadratic_damping': ('N s^2/m^2', 'N m s^2'),
}


def _plugin(spec: mujoco.MjSpec, base: str) -> Any:
    # taken away (fluid 'none'): MuJoCo crashes on what the body still says of it
    if all(p.plugin_name not in ('', BODY) for p in spec.plugins):
        return None
    reference = spec.body(base).plugin
    if not reference.active:
        return None
    if reference.plugin_name != BODY:
        return None
    if reference.id >= 0:  # configured on the body itself, without a name
        return list(spec.plugins)[reference.id]
    return next((p for p in spec.plugins if p.name == reference.name), None)


def body_parameters(spec: mujoco.MjSpec, base: str) -> list[Parameter]:
    """
    Return the parameters of the fluid_sim.body of a vehicle.

    Parameters
    ----------
    spec
        The model.
    base
        Name of the vehicle's body.

    """
    plugin = _plugin(spec, base)
    if plugin is None:
        return []

    def put_at(key: str, place: int) -> Callable[[mujoco.MjSpec, float], None]:
        def put(spec: mujoco.MjSpec, value: float) -> None:
            plugin = _plugin(spec, base)
            if plugin is None:  # a rigid body has none of it
                return
            words = words_of(plugin.config, key)
            words[place] = value
            plugin.config = {**plugin.config, key: text_of(words)}

        return put

    found = []
    for key, units in _SIX.items():
        words = plugin.config.get(key, '').split()
        if len(words) == 36 and key == 'linear_damping':
            found += _matrix(words, put_at)
        if len(words) != 6 or words[0] == 'auto':
            continue
        numbers = [float(word) for word in words]
        for i, dof in enumerate(_DOFS):
            scale = abs(numbers[i]) or 0.1 * max(map(abs, numbers[i // 3 * 3 : i // 3 * 3 + 3]))
            found.append(Parameter(f'{key}.{dof}', units[i // 3], numbers[i], 0.0, np.inf,
                                   scale or 1.0, put_at(key, i)))  # fmt: skip
    fades = words_of(plugin.config, 'moment_fade')
    for i, axis in enumerate(('roll', 'pitch')):
        if len(fades) == 2 and fades[i] > 0:
            found.append(Parameter(f'moment_fade.{axis}', 'm/s', fades[i], 0.05, np.inf, fades[i],
                                   put_at('moment_fade', i)))  # fmt: skip
    words = plugin.config.get('volume', '').split()
    if words and words[0] != 'auto':
        value = float(words[0])
        found.append(Parameter('volume', 'm^3', value, 0.2 * value, 5 * value, value,
                               put_at('volume', 0)))  # fmt: skip
    center = words_of(plugin.config, 'center_of_buoyancy')
    if len(center) == 3:
        found += [
            Parameter(f'center_of_buoyancy.{axis}', 'm', center[i], center[i] - 1, center[i] + 1,
                      0.01, put_at('center_of_buoyancy', i))
            for i, axis in enumerate('xyz')
        ]  # fmt: skip
    return found


def _matrix(
    words: list[str], put_at: Callable[[str, int], Callable[[mujoco.MjSpec, float], None]]
) -> list[Parameter]:
    """Return the entries of a damping of 36 numbers: the diagonal, and those that are not 0."""
    numbers = [float(word) for word in words]
    found = []
    for i, number in enumerate(numbers):
        row, column = divmod(i, 6)
        if row != column and number == 0:
            continue
        name = _DOFS[row] if row == column else f'{_DOFS[row]}_{_DOFS[column]}'
        unit = 'N s/m' if i < 18 and column < 3 else ('N m s' if row > 2 < column else 'N s')
        low = 0.0 if row == column else -np.inf
        found.append(Parameter(f'linear_damping.{name}', unit, number, low, np.inf,
                               abs(number) or 1e-3 * max(map(abs, numbers)),
                               put_at('linear_damping', i)))  # fmt: skip
    return found


def _put_flow(name: str, axis: int) -> Callable[[mujoco.MjSpec, float], None]:
    def put(spec: mujoco.MjSpec, value: float) -> None:
        media = [p for p in spec.plugins if p.plugin_name == MEDIUM]
        if not media:
            spec.option.wind[axis] = value
            return
        words = words_of(media[0].config, name) or [0.0, 0.0, 0.0]
        words[axis] = value
        media[0].config = {**media[0].config, name: text_of(words)}

    return put


def flow_parameters(spec: mujoco.MjSpec, streams: tuple[str, ...]) -> list[Parameter]:
    """
    Return a constant wind and current as parameters.

    Parameters
    ----------
    spec
        The model.
    streams
        Which of them the scene has.

    """
    found = []
    for stream in streams:
        medium = any(p.plugin_name == MEDIUM for p in spec.plugins)

        for i, axis in enumerate('xyz'):
            value = 0.0 if medium else float(spec.option.wind[i])
            found.append(
                Parameter(f'{stream}.{axis}', 'm/s', value, -50.0, 50.0, 0.5, _put_flow(stream, i))
            )
    return found
