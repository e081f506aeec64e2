# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Parameters of a model by name: where they stand in its MJCF, and what tells them apart."""

from collections.abc import Callable, Iterable, Sequence
from typing import Any

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError, did_you_mean, listed
from fluid_sim_ros.plugins.config import THRUSTER
from fluid_sim_ros.reality.driven import Edit
from fluid_sim_ros.reality.fitting.delays import delay_parameters
from fluid_sim_ros.reality.fitting.disturbance import slow_parameters
from fluid_sim_ros.reality.fluid_parameters import body_parameters, flow_parameters
from fluid_sim_ros.reality.parameter import Parameter, text_of, words_of
from fluid_sim_ros.scene import Scene

#: Rotor parameters: (key of fluid_sim.thruster, its word, unit).
_ROTOR = {
    'thrust_coefficient': ('thrust_coefficient', 0, 'N/(rad/s)^2'),
    'torque_ratio': ('torque_ratio', 0, 'm'),
    'time_constant': ('time_constant', 0, 's'),
    'time_constant_down': ('time_constant', 1, 's'),
    'rotor_drag': ('rotor_drag', 0, 'N/((rad/s)(m/s))'),
    'rotor_drag_along': ('rotor_drag', 1, 'N/((rad/s)(m/s))'),
    'rolling_moment': ('rolling_moment', 0, 'N m/((rad/s)(m/s))'),
    'zero_thrust_advance': ('zero_thrust_advance', 0, '-'),
}  # fmt: skip


def find_parameters(scene: Scene, names: Sequence[str]) -> list[Parameter]:
    """
    Return parameters of a scene's one vehicle by name.

    Parameters
    ----------
    scene
        Whose model it is.
    names
        Of the parameters.

    Returns
    -------
    list
        In the order of the names.

    Raises
    ------
    ConfigError
        For a name that the model has not, with those that it has.

    """
    known = {each.name: each for each in all_parameters(scene)}
    for name in names:
        if name not in known:
            raise ConfigError(
                f"parameter '{name}' is not one of {scene.name}{did_you_mean(name, known)} "
                f'it has: {listed(known)}'
            )
    if len(set(names)) != len(names):
        raise ConfigError('--parameters: one stands twice')
    return [known[name] for name in names]


def all_parameters(scene: Scene) -> list[Parameter]:
    """
    Return every parameter that a scene's vehicle has.

    Parameters
    ----------
    scene
        With one vehicle that has thrusters.

    """
    compiled = scene.compile()
    vehicle = next((v for v in compiled.vehicles.values() if v.thrusters), None)
    if vehicle is None:
        raise ConfigError(f"scene '{scene.name}' has no vehicle with thrusters to fit")
    spec = scene.read_model()
    base = compiled.model.body(vehicle.body_id).name
    found = [
        *_rotors(spec, vehicle.thrusters),
        *_inertial(spec, base),
        *body_parameters(spec, base),
    ]
    found += flow_parameters(spec, compiled.streams)
    return [*found, *slow_parameters(compiled.streams), *delay_parameters()]


def edit_of(parameters: Sequence[Parameter], values: Iterable[float]) -> Edit:
    """
    Return what writes values of parameters into a spec.

    Parameters
    ----------
    parameters
        They.
    values
        Each in its unit.

    """
    pairs = list(zip(parameters, map(float, values), strict=True))

    def edit(spec: mujoco.MjSpec) -> None:
        for parameter, value in pairs:
            parameter.put(spec, value)

    return edit


def _instances(spec: mujoco.MjSpec, thrusters: Sequence[str]) -> dict[str, Any]:
    by_name = {p.name: p for p in spec.plugins if p.plugin_name == THRUSTER}
    found = {name: by_name.get(spec.actuator(name).plugin.name) for name in thrusters}
    return {name: plugin for name, plugin in found.items() if plugin is not None}


def _rotors(spec: mujoco.MjSpec, thrusters: tuple[str, ...]) -> list[Parameter]:
    rotors = _instances(spec, thrusters)
    found = []
    for name, (key, place, unit) in _ROTOR.items():
        given = {n: words_of(r.config, key) for n, r in rotors.items()}
        having = [n for n, words in given.items() if len(words) > place]
        if not having:
            continue
        value = float(np.mean([given[n][place] for n in having]))
        most = np.inf
        found.append(_positive(name, unit, value, most, _put_rotors(thrusters, key, place, value)))
        found += [
            _positive(f'{name}.{n}', unit, given[n][place], most, _put_rotors((n,), key, place, 0))
            for n in having
        ]
    if rotors:
        found.append(Parameter('rotor_height', 'm', 0.0, -1.0, 1.0, 0.01, _put_height(thrusters)))
    return found


def _positive(
    name: str, unit: str, value: float, most: float, put: Callable[[mujoco.MjSpec, float], None]
) -> Parameter:
    return Parameter(name, unit, value, 0.0 if value == 0 else 1e-3 * value, most,
                     abs(value) or 1.0, put)  # fmt: skip


def _put_rotors(
    names: tuple[str, ...], key: str, place: int, common: float
) -> Callable[[mujoco.MjSpec, float], None]:
    """Set a word of rotors; with ``common`` above 0 all are scaled and stay different."""

    def put(spec: mujoco.MjSpec, value: float) -> None:
        for plugin in _instances(spec, names).values():
            words = words_of(plugin.config, key)
            if len(words) > place:
                words[place] = words[place] * value / common if common > 0 else value
                plugin.config = {**plugin.config, key: text_of(words)}

    return put


def _put_height(thrusters: tuple[str, ...]) -> Callable[[mujoco.MjSpec, float], None]:
    def put(spec: mujoco.MjSpec, value: float) -> None:
        for name in thrusters:
            site = spec.site(spec.actuator(name).target)
            site.pos = site.pos + np.array([0.0, 0.0, value])

    return put


def _inertial(spec: mujoco.MjSpec, base: str) -> list[Parameter]:
    body = spec.body(base)
    if not body.explicitinertial:
        return []

    def put_mass(spec: mujoco.MjSpec, value: float) -> None:
        spec.body(base).mass = value

    def put_at(field: str, axis: int) -> Callable[[mujoco.MjSpec, float], None]:
        def put(spec: mujoco.MjSpec, value: float) -> None:
            numbers = np.array(getattr(spec.body(base), field))
            numbers[axis] = value
            setattr(spec.body(base), field, numbers)

        return put

    def put_xy(spec: mujoco.MjSpec, value: float) -> None:
        numbers = np.array(spec.body(base).inertia)
        numbers[0], numbers[1] = value, value * numbers[1] / numbers[0]
        spec.body(base).inertia = numbers

    mass, size = float(body.mass), float(np.sqrt(max(body.inertia) / body.mass))
    found = [Parameter('mass', 'kg', mass, 0.2 * mass, 5 * mass, mass, put_mass)]
    both = float(body.inertia[0])  # of x; that of y keeps its ratio
    found.append(Parameter('inertia.xy', 'kg m^2', both, 0.1 * both, 10 * both, both, put_xy))
    for i, axis in enumerate('xyz'):
        value = float(body.inertia[i])
        found.append(Parameter(f'inertia.{axis}', 'kg m^2', value, 0.1 * value, 10 * value, value,
                               put_at('inertia', i)))  # fmt: skip
        place = float(body.ipos[i])
        found.append(Parameter(f'com.{axis}', 'm', place, place - size, place + size, 0.1 * size,
                               put_at('ipos', i)))  # fmt: skip
    return found
