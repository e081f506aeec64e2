"""
A model that the actuator signals of a flight drive.

Measured rotor speeds are what the rotors of the model then have, without lag. Commands go through
the model's own curves and lag. What is only seen is taken away, so that a model compiles fast.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import mujoco
import numpy as np

from fluid_sim_ros.errors import ConfigError, did_you_mean, listed
from fluid_sim_ros.flights.flight import Flight, FlightError, Signal
from fluid_sim_ros.flights.mapping import Output
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins.config import MEDIUM, THRUSTER, plugin_of_actuator
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.scene.media import streams_of
from fluid_sim_ros.scene.vehicle import Vehicle
from fluid_sim_ros.schema.settings import RunSettings

Edit = Callable[[mujoco.MjSpec], None]

#: A measured speed may be this much above the model's limit, before it is no speed of this rotor.
_ABOVE_LIMIT = 3.0
#: Where a pulse width means nothing else: no thrust, full thrust [us].
_PULSES = (1000.0, 2000.0)
#: Rate at which a wind may change, in place of the medium's own [m/s^2].
_AT_ONCE = '1e9'
#: Keys of fluid_sim.thruster that a rigid body has not.
_AERODYNAMIC = ('rotor_drag', 'rolling_moment', 'ground_effect', 'ground', 'fluid')


@dataclass(frozen=True)
class Driven:
    """
    A compiled model, and how a flight drives it.

    Attributes
    ----------
    model, vehicle
        Without pictures and contacts.
    kind
        The quantity that drives it.
    columns
        Column of the actuator signal of each thruster of the vehicle.
    controls
        Turns actuator values, shape (..., n), into controls of the vehicle's thrusters.
    lag
        Longest time constant of a rotor [s]; 0: a speed is there at once.
    notes
        What was assumed, a line each.

    """

    model: mujoco.MjModel
    vehicle: Vehicle
    kind: str
    columns: tuple[int, ...]
    controls: Callable[[Array], Array]
    lag: float
    notes: tuple[str, ...] = ()


def comparable_scene(name: str) -> Scene:
    """
    Return a scene as flights are compared in: without schedule, gait and weather of its own.

    Parameters
    ----------
    name
        Of the scene, or the path of a file.

    """
    scene = Scene.load(name)
    return replace(scene, schedule=(), gait={}, wind=(), current=(), keyframe=None)


def drive(
    scene: Scene, flight: Flight, outputs: tuple[Output, ...] = (), *,
    settings: RunSettings | None = None, edit: Edit | None = None,
) -> Driven:  # fmt: skip
    """
    Compile a scene so that a flight drives it.

    Parameters
    ----------
    scene
        As ``comparable_scene`` returns it.
    flight
        With an actuator signal.
    outputs
        What the columns of an autopilot drive; empty: by names, or in the model's order.
    settings
        Timestep, integrator and fluid in place of the scene's.
    edit
        Changes the model, such as its parameters.

    Returns
    -------
    Driven
        The model.

    Raises
    ------
    ConfigError, FlightError
        If the vehicle is not in the scene, or the flight cannot drive its thrusters.

    """
    signal = flight.actuators
    if signal is None:
        raise FlightError(f'{flight.raw.path}: no actuator signal; nothing drives the model')
    plain = scene.compile()
    vehicle = _vehicle(plain.vehicles, flight.vehicle, scene.name)
    columns = _columns(signal, vehicle, flight, outputs)
    kind, notes = _kind(plain.model, vehicle, signal, outputs, flight)
    limits = _limits(plain.model, vehicle, signal, kind, columns, flight)

    def change(spec: mujoco.MjSpec) -> None:
        strip(spec)
        if edit is not None:
            edit(spec)
        _command(spec, vehicle, kind, limits)

    compiled = scene.compile(settings or RunSettings(), change)
    model = compiled.model
    vehicle = compiled.vehicles[vehicle.name]
    controls = _controls(model, vehicle, kind, outputs, limits)
    return Driven(model, vehicle, kind, columns, controls, _longest_lag(model, vehicle), notes)


def strip(spec: mujoco.MjSpec) -> None:
    """
    Take away what a model shows and touches.

    Parameters
    ----------
    spec
        Changed: no textures, no materials, no contacts, no keyframes.

    """
    for geom in spec.geoms:
        geom.material = ''
    for plugin in spec.plugins:
        if plugin.plugin_name == MEDIUM:  # a measured wind is there at once
            plugin.config = {**plugin.config, 'wind_slew': _AT_ONCE, 'current_slew': _AT_ONCE}
    for each in [*spec.textures, *spec.materials, *spec.keys]:
        spec.delete(each)
    spec.option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT)


def without_air(spec: mujoco.MjSpec) -> None:
    """
    Take away what rotors feel of the air: their static thrust and torque stay.

    Parameters
    ----------
    spec
        Changed.

    """
    for plugin in spec.plugins:
        if plugin.plugin_name == THRUSTER:
            kept = {k: v for k, v in plugin.config.items() if k not in _AERODYNAMIC}
            if kept.get('curve') != 'coefficients':
                kept.pop('density', None)
            plugin.config = kept


def medium_stream(model: mujoco.MjModel, scene: Scene) -> str:
    """
    Return what moves a vehicle in a scene: ``wind`` or ``current``.

    Parameters
    ----------
    model
        The compiled model.
    scene
        It is of.

    """
    streams = streams_of(model, scene.medium)
    return 'current' if 'current' in streams else 'wind'


def _vehicle(vehicles: dict[str, Vehicle], wanted: str, scene: str) -> Vehicle:
    driven = [v for v in vehicles.values() if v.thrusters and v.qpos_address >= 0]
    names = [v.name for v in driven]
    if wanted:
        if wanted not in names:
            raise ConfigError(
                f"vehicle '{wanted}' of the mapping is not in scene '{scene}'"
                f'{did_you_mean(wanted, names)} it has: {listed(names)}'
            )
        return vehicles[wanted]
    if len(driven) != 1:
        raise ConfigError(
            f"scene '{scene}' has {len(driven)} vehicles with thrusters ({listed(names)}); name "
            'one in the mapping, vehicle: NAME'
        )
    return driven[0]


def _columns(
    signal: Signal, vehicle: Vehicle, flight: Flight, outputs: tuple[Output, ...]
) -> tuple[int, ...]:
    """Return the column of each thruster."""
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


def _kind(
    model: mujoco.MjModel, vehicle: Vehicle, signal: Signal, outputs: tuple[Output, ...],
    flight: Flight,
) -> tuple[str, tuple[str, ...]]:  # fmt: skip
    """Return what drives the thrusters: ``rad_s``, ``newton`` or ``pwm_us``; and assumptions."""
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


def _limits(
    model: mujoco.MjModel, vehicle: Vehicle, signal: Signal, kind: str,
    columns: tuple[int, ...], flight: Flight,
) -> list[tuple[float, ...]]:  # fmt: skip
    """Return the largest speed of each rotor, ahead and in reverse [rad/s]."""
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


def _command(
    spec: mujoco.MjSpec, vehicle: Vehicle, kind: str, limits: list[tuple[float, ...]]
) -> None:
    """Let the thrusters of a spec take what the flight has."""
    if kind == 'thrust':
        return
    command = {'rotor_speed': 'rad_s', 'speed_share': 'rad_s', 'pwm': 'pwm_us'}.get(kind, 'newton')
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


def _controls(
    model: mujoco.MjModel, vehicle: Vehicle, kind: str, outputs: tuple[Output, ...],
    limits: list[tuple[float, ...]],
) -> Callable[[Array], Array]:  # fmt: skip
    """Return what turns actuator values into controls."""
    if kind in ('rotor_speed', 'pwm'):
        return lambda values: values
    if kind == 'thrust':
        return lambda values: values / vehicle.thrust_scale
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


def _longest_lag(model: mujoco.MjModel, vehicle: Vehicle) -> float:
    longest = 0.0
    for actuator in vehicle.thruster_ids:
        rotor = plugin_of_actuator(model, int(actuator), THRUSTER)
        if rotor is not None and model.actuator_actnum[actuator] > 0:
            longest = max(longest, *(float(w) for w in rotor.text('time_constant').split()))
    return longest
