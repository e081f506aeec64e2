# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What of a flight drives which thruster, and how its numbers become controls."""

from collections.abc import Callable

import mujoco
import numpy as np

from fluid_sim_ros.errors import listed
from fluid_sim_ros.flights.flight import Flight, FlightError, Signal
from fluid_sim_ros.flights.mapping import Output
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins.config import THRUSTER, plugin_of_actuator
from fluid_sim_ros.reality.commanded import speed_for_thrust
from fluid_sim_ros.scene.vehicle import Vehicle

#: A measured speed may be this much above the model's limit, before it is no speed of this rotor.
_ABOVE_LIMIT = 3.0
#: Where a pulse width means nothing else: no thrust, full thrust [us].
_PULSES = (1000.0, 2000.0)


def columns_of_thrusters(
    signal: Signal, vehicle: Vehicle, flight: Flight, outputs: tuple[Output, ...]
) -> tuple[int, ...]:
    """
    Return the column of each thruster.

    Parameters
    ----------
    signal
        Of the actuators.
    vehicle
        That is driven.
    flight
        For errors.
    outputs
        What the outputs of an autopilot drive.

    Raises
    ------
    FlightError
        If a thruster has none, or columns are left.

    """
    names = signal.names
    if outputs:
        by_thruster = {
            o.thruster: i for i, o in enumerate(sorted(outputs, key=lambda o: o.output))
        }
        names = tuple(by_thruster)
        if not signal.names:  # columns by the number of the output
            places = {o.thruster: o.output - 1 for o in outputs}
            return tuple(_place(places, t, vehicle, flight, signal) for t in vehicle.thrusters)
    if names:
        places = {name: i for i, name in enumerate(names)}
        return tuple(_place(places, t, vehicle, flight, signal) for t in vehicle.thrusters)
    count, wanted = signal.values.shape[1], len(vehicle.thrusters)
    if count != wanted:
        raise FlightError(
            f'{flight.raw.path}: {signal.quantity} has {count} columns in use, the vehicle '
            f"'{vehicle.name}' {wanted} thrusters ({listed(vehicle.thrusters)}): another "
            'airframe? If not, name the thruster of each column in the mapping, thrusters: [...]'
        )
    return tuple(range(wanted))


def _place(
    places: dict[str, int], thruster: str, vehicle: Vehicle, flight: Flight, signal: Signal
) -> int:
    place = places.get(thruster, -1)
    if not 0 <= place < signal.values.shape[1]:
        raise FlightError(
            f"{flight.raw.path}: thruster '{thruster}' of '{vehicle.name}' has no column in "
            f'{signal.source}; the log and the mapping name: {listed(places)}'
        )
    return place


def kind_of_drive(
    model: mujoco.MjModel, vehicle: Vehicle, signal: Signal, outputs: tuple[Output, ...],
    flight: Flight,
) -> tuple[str, tuple[str, ...]]:  # fmt: skip
    """
    Return what drives the thrusters, and what was assumed for it, a line each.

    Parameters
    ----------
    model
        The compiled model.
    vehicle
        That is driven.
    signal
        Of the actuators.
    outputs
        What the outputs of an autopilot drive.
    flight
        For errors.

    Raises
    ------
    FlightError
        If the thrusters cannot be driven by it.

    """
    rotors = [plugin_of_actuator(model, int(i), THRUSTER) for i in vehicle.thruster_ids]
    curves = {rotor.text('curve') if rotor else '' for rotor in rotors}
    if signal.quantity == 'thrust':
        return 'thrust', ()
    if '' in curves:
        raise FlightError(
            f"{flight.raw.path}: has {signal.quantity}, but the thrusters of '{vehicle.name}' "
            'have no curve from it to thrust; they need fluid_sim.thruster, or a log of thrusts'
        )
    if signal.quantity == 'rotor_speed':
        return 'rotor_speed', ()
    if outputs:
        kinds = {output.curve for output in outputs}
        if len(kinds) > 1:
            raise FlightError('actuators: one curve for all of them, please')
        return {'rotor_speed': 'speed_share', 'thrust': 'thrust_share', 'pwm': 'pwm'}[
            kinds.pop()
        ], ()
    if signal.quantity == 'pulse' and curves == {'table'}:
        return 'pwm', ()
    span = '1000 to 2000 us' if signal.quantity == 'pulse' else 'the full command'
    return 'speed_share', (
        f'{signal.quantity}: taken as rotor speed from nothing to its limit over {span}; say '
        'otherwise in the mapping, actuators: [{output, thruster, input, curve}, ...]',
    )


def speed_limits(
    model: mujoco.MjModel, vehicle: Vehicle, signal: Signal, kind: str,
    columns: tuple[int, ...], flight: Flight,
) -> list[tuple[float, ...]]:  # fmt: skip
    """
    Return the largest speed of each rotor, ahead and in reverse [rad/s].

    Parameters
    ----------
    model
        The compiled model.
    vehicle
        That is driven.
    signal
        Of the actuators.
    kind
        As ``kind_of_drive`` returns it.
    columns
        Of the thrusters.
    flight
        For errors.

    Raises
    ------
    FlightError
        If the log has speeds far beyond them.

    """
    limits = []
    for place, actuator in zip(columns, vehicle.thruster_ids, strict=True):
        rotor = plugin_of_actuator(model, int(actuator), THRUSTER)
        words = [float(w) for w in (rotor.text('rad_s_max') if rotor else '').split()]
        if kind == 'rotor_speed' and words:
            seen = signal.values[:, place]
            if np.percentile(np.abs(seen), 99) > _ABOVE_LIMIT * words[0]:
                raise FlightError(
                    f'{flight.raw.path}: rotor_speed reaches {np.abs(seen).max():.4g} rad/s, the '
                    f"rotors of '{vehicle.name}' {words[0]:.4g}: see its unit in the mapping"
                )
            words[0] = max(words[0], float(seen.max()) * 1.01)
        limits.append(tuple(words))
    return limits


def take_commands(
    spec: mujoco.MjSpec, vehicle: Vehicle, kind: str, limits: list[tuple[float, ...]]
) -> None:
    """
    Let the thrusters of a spec take what the flight has.

    Parameters
    ----------
    spec
        Changed.
    vehicle
        That is driven.
    kind
        As ``kind_of_drive`` returns it.
    limits
        As ``speed_limits`` returns them [rad/s].

    """
    if kind == 'thrust':
        return
    command = {
        'rotor_speed': 'rad_s', 'speed_share': 'rad_s', 'thrust_speed': 'rad_s', 'pwm': 'pwm_us',
    }.get(kind, 'newton')  # fmt: skip
    for name, limit in zip(vehicle.thrusters, limits, strict=True):
        actuator = spec.actuator(name)
        instance = actuator.plugin.name
        for plugin in spec.plugins:
            if plugin.plugin_name != THRUSTER or plugin.name != instance:
                continue
            config = {**plugin.config, 'command': command}
            if kind == 'rotor_speed':
                config.pop('time_constant', None)
            if command == 'rad_s' and limit:
                config['rad_s_max'] = ' '.join(f'{number:.9g}' for number in limit)
            plugin.config = config
        if kind == 'rotor_speed':
            actuator.actdim = 0
        if command != 'newton':
            actuator.ctrllimited = False


def controls_of(
    model: mujoco.MjModel, vehicle: Vehicle, kind: str, outputs: tuple[Output, ...],
    limits: list[tuple[float, ...]], coefficients: Array,
) -> Callable[[Array], Array]:  # fmt: skip
    """
    Return what turns actuator values, shape (..., n), into controls.

    Parameters
    ----------
    model
        The compiled model.
    vehicle
        That is driven.
    kind
        As ``kind_of_drive`` returns it.
    outputs
        What the outputs of an autopilot drive.
    limits
        As ``speed_limits`` returns them [rad/s].
    coefficients
        As ``commanded_coefficients`` returns them.

    """
    if kind in ('rotor_speed', 'pwm'):
        return lambda values: values
    if kind == 'thrust':
        return lambda values: values / vehicle.thrust_scale
    if kind == 'thrust_speed':
        return speed_for_thrust(vehicle, coefficients)
    named = {output.thruster: output.input for output in outputs}
    ranges = [named.get(name, []) for name in vehicle.thrusters]
    if kind == 'thrust_share':
        ahead, back = vehicle.thrust_range[:, 1], -vehicle.thrust_range[:, 0]
    else:
        ahead = np.array([limit[0] if limit else np.nan for limit in limits])
        back = np.array([limit[1] if len(limit) > 1 else 0.0 for limit in limits])

    def controls(values: Array) -> Array:
        out = np.empty_like(values)
        for i, span in enumerate(ranges):
            value = np.nan_to_num(values[..., i])
            points = span or (list(_PULSES) if value.max(initial=0.0) > 100 else [0.0, 1.0])
            rest, full = points[-2:]
            share = np.clip((value - rest) / (full - rest), 0, 1)
            out[..., i] = share * ahead[i]
            reverse = points[0] if len(points) == 3 else (-1.0 if rest == 0 else rest)
            if back[i] > 0 and reverse < rest:
                out[..., i] -= np.clip((rest - value) / (rest - reverse), 0, 1) * back[i]
        return out

    return controls
