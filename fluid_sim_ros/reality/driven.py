# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
A model that the actuator signals of a flight drive.

Measured rotor speeds are what the rotors of the model then have, without lag. Commands go through
the model's own curves and lag. What is only seen is taken away, so that a model compiles fast.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import mujoco
import numpy as np
from numpy.typing import NDArray

from fluid_sim_ros.errors import ConfigError, did_you_mean, listed
from fluid_sim_ros.flights.flight import Flight, FlightError
from fluid_sim_ros.flights.mapping import Output
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins.config import (
    BODY,
    MEDIUM,
    THRUSTER,
    plugin_of_actuator,
    plugin_of_body,
)
from fluid_sim_ros.reality.actuators import (
    columns_of_thrusters,
    controls_of,
    kind_of_drive,
    speed_limits,
    take_commands,
)
from fluid_sim_ros.reality.commanded import commanded_coefficients
from fluid_sim_ros.reality.flow import recorded_flow
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.scene.media import streams_of
from fluid_sim_ros.scene.vehicle import Vehicle
from fluid_sim_ros.schema.settings import RunSettings

Edit = Callable[[mujoco.MjSpec], None]

#: Slew of wind and current in place of the medium's own: no limit, no acceleration of the fluid.
_AT_ONCE = '0'
#: What is said of a scene with waves.
CALM = (
    'waves: a log does not say which they were; the surface is calm here, and the water moves as '
    'recorded, if it was'
)
#: Keys of fluid_sim.thruster that a rigid body has not.
_AERODYNAMIC = (
    'rotor_drag', 'rolling_moment', 'ground_effect', 'ground', 'fluid',
    'inflow', 'inflow_law', 'zero_thrust_advance', 'measured_advance',
)  # fmt: skip


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
    speed_columns
        Column of the measured rotor speeds of each thruster that has a lag; empty: not measured.
    notes
        What was assumed, a line each.

    """

    model: mujoco.MjModel
    vehicle: Vehicle
    kind: str
    columns: tuple[int, ...]
    controls: Callable[[Array], Array]
    lag: float
    speed_columns: tuple[int, ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def has_parts(self) -> bool:
        """Whether the model has degrees of freedom besides those of the vehicle."""
        return bool(self.model.nv > 6)

    @property
    def other_positions(self) -> NDArray[np.int64]:
        """Places in qpos of all that is not the vehicle's own."""
        at = self.vehicle.qpos_address
        return np.delete(np.arange(self.model.nq), np.arange(at, at + 7))

    @property
    def other_velocities(self) -> NDArray[np.int64]:
        """Places in qvel of all that is not the vehicle's own."""
        at = self.vehicle.dof_address
        return np.delete(np.arange(self.model.nv), np.arange(at, at + 6))


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
    waves = scene.waves is not None
    scene = replace(scene, waves=None)
    plain = scene.compile()
    vehicle = _vehicle(plain.vehicles, flight.vehicle, scene.name)
    columns = columns_of_thrusters(signal, vehicle, flight, outputs)
    kind, notes = kind_of_drive(plain.model, vehicle, signal, outputs, flight)
    coefficients = commanded_coefficients(plain.model, vehicle)
    if kind == 'thrust' and len(coefficients):
        kind = 'thrust_speed'
    limits = speed_limits(plain.model, vehicle, signal, kind, columns, flight)
    notes += (CALM,) * waves
    settings = settings or RunSettings()
    flow, thinned = recorded_flow(flight, streams_of(plain.model, scene.medium)[0])

    def change(spec: mujoco.MjSpec) -> None:
        strip(spec)
        if flow is not None and settings.fluid != 'none':
            flow(spec)
        if edit is not None:
            edit(spec)
        take_commands(spec, vehicle, kind, limits)

    compiled = scene.compile(settings, change)
    model = compiled.model
    vehicle = compiled.vehicles[vehicle.name]
    controls = controls_of(model, vehicle, kind, outputs, limits, coefficients)
    kind = 'thrust' if kind == 'thrust_speed' else kind
    lag = _longest_lag(model, vehicle)
    speeds = _speed_columns(model, vehicle, flight) if lag else ()
    found = Driven(model, vehicle, kind, columns, controls, lag, speeds, (*notes, *thinned))
    return replace(found, notes=(*found.notes, *_about_parts(found)))


def strip(spec: mujoco.MjSpec) -> None:
    """
    Take away what a model shows and touches.

    Parameters
    ----------
    spec
        Changed: no pictures, no contacts, keyframes without activations.

    """
    # nothing is deleted: after fluid 'none' MuJoCo 3.x crashes on a second deletion
    for geom in spec.geoms:
        geom.material = ''
    for texture in spec.textures:
        if texture.builtin:
            texture.width = 1
            texture.height = 6 if texture.type == mujoco.mjtTexture.mjTEXTURE_SKYBOX else 1
    for key in spec.keys:
        key.act = np.zeros(0)
    for plugin in spec.plugins:
        if plugin.plugin_name == MEDIUM:  # a wind that is fitted is there at once
            plugin.config = {**plugin.config, 'wind_slew': _AT_ONCE, 'current_slew': _AT_ONCE}
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


def floats(driven: Driven) -> bool:
    """
    Return whether the water carries the weight of a vehicle.

    Parameters
    ----------
    driven
        The model; one that displaces water floats.

    """
    body = plugin_of_body(driven.model, driven.vehicle.body_id, BODY)
    return body is not None and bool(body.text('volume'))


def _about_parts(driven: Driven) -> tuple[str, ...]:
    """Return what a reader must know of parts that no log has."""
    if not driven.has_parts:
        return ()
    model = driven.model
    names = list(dict.fromkeys(
        model.body(int(model.dof_bodyid[dof])).name or 'unnamed'
        for dof in driven.other_velocities
    ))  # fmt: skip
    shown = ', '.join(names[:3]) + (f' and {len(names) - 3} more' if len(names) > 3 else '')
    return (
        f'{shown}: in no log; at rest at the begin of the flight, carried along its measured '
        'motion, and flown from there',
    )


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


def _longest_lag(model: mujoco.MjModel, vehicle: Vehicle) -> float:
    longest = 0.0
    for actuator in vehicle.thruster_ids:
        rotor = plugin_of_actuator(model, int(actuator), THRUSTER)
        if rotor is not None and model.actuator_actnum[actuator] > 0:
            longest = max(longest, *(float(w) for w in rotor.text('time_constant').split()))
    return longest


def _speed_columns(model: mujoco.MjModel, vehicle: Vehicle, flight: Flight) -> tuple[int, ...]:
    """Return where the measured speeds of the lagged rotors stand; nothing where one has none."""
    signal = flight.signals.get('rotor_speed')
    if signal is None or signal.command:
        return ()
    try:
        columns = columns_of_thrusters(signal, vehicle, flight, ())
    except FlightError:  # of some rotors only
        return ()
    lagged = model.actuator_actnum[vehicle.thruster_ids] > 0
    return tuple(c for c, has in zip(columns, lagged, strict=True) if has)
