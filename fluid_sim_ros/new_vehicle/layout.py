# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Where the thrusters of a new vehicle are: preset layouts, or a list in a YAML file."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from fluid_sim_ros.errors import ConfigError, did_you_mean, listed
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.schema.base import Name, NotNegative, Positive, Strict, Vector, parse
from fluid_sim_ros.schema.yaml_file import read_yaml

Medium = Literal['air', 'water']

#: Density of a new vehicle's medium [kg/m^3]: air at sea level, 15 degC (ISA); fresh water,
#: rounded (IAPWS, 25 degC: 997).
DENSITY: dict[Medium, float] = {'air': 1.225, 'water': 1000.0}
#: Preset -> its medium and what it is.
PRESETS: dict[str, tuple[Medium, str]] = {
    'quad': ('air', 'four rotors at the corners, in the order of PX4'),
    'hexa': ('air', 'six rotors around'),
    'octo': ('air', 'eight rotors around'),
    'vectored6': ('water', 'four thrusters at 45 deg and two vertical ones, as a BlueROV2'),
    'vectored8': ('water', 'four at 45 deg and four vertical ones, as a BlueROV2 Heavy'),
    'torpedo': ('water', 'a propeller behind, with rudder and planes'),
}
#: That have fins, too.
WITH_FINS = ('torpedo',)

# Guesses for what a list leaves out; doc/new_vehicle.md tells how to measure each.
#: Rotor in air: thrust in hover over the disc [N/m^2]; Crazyflie 39, x500 100.
_DISC_LOADING = 80.0
#: C_T = T/(rho n^2 D^4) at rest; 0.08 to 0.12 of common small propellers (UIUC propeller data).
_CT_AIR = 0.1
#: Torque over thrust and diameter [-]; x500 .016/.254.
_TORQUE_SHARE = 0.063
#: Lag speeding up and slowing down [s]; x500.
_LAG_AIR = (0.0125, 0.025)
#: T200 at 16 V (Blue Robotics 2019): 51.4 N on a disc of 76 mm [N/m^2]; 3533 rpm: K_T; reverse.
_THRUST_PER_DISC = 51.4 / (np.pi / 4 * 0.076**2)
_KT_WATER = 51.4 / (1000.0 * (3533 / 60) ** 2 * 0.076**4)
_REVERSE = 39.9 / 51.4
#: Lag of the T200 in the BlueROV2 models [s].
_LAG_WATER = (0.029, 0.029)


class ThrusterPlace(Strict):
    """
    One thruster of a list; what is left out is guessed.

    ``position`` from the centre of mass [m] and ``direction`` of positive thrust, body axes;
    ``max_thrust``, ``max_reverse`` [N]; ``spin`` seen against the thrust, with ``torque_ratio``
    [m]; ``time_constant`` [s]; ``diameter`` [m].
    """

    name: Name
    position: Vector
    direction: Vector
    max_thrust: Positive
    max_reverse: NotNegative | None = None
    spin: Literal['ccw', 'cw', 'none'] = 'none'
    torque_ratio: NotNegative | None = None
    time_constant: NotNegative | None = None
    diameter: Positive | None = None


class ThrusterList(Strict):
    """The thrusters of a new vehicle, in command order."""

    thrusters: Annotated[list[ThrusterPlace], Field(min_length=1)]


@dataclass(frozen=True)
class Thruster:
    """
    One thruster with every number that its model needs.

    ``position`` from the centre of mass [m], body axes (forward, left, up); unit ``direction`` of
    positive thrust; ``limits`` [N], lowest (<= 0) and highest; ``diameter`` [m]; ``k``
    [N/(rad/s)^2]; ``spin`` +1 counter-clockwise, -1 clockwise, 0 without shaft torque;
    ``torque_ratio`` [m]; ``lag`` [s] up, down.
    """

    name: str
    position: Array
    direction: Array
    limits: tuple[float, float]
    diameter: float
    k: float
    spin: int
    torque_ratio: float
    lag: tuple[float, float]

    def wrench(self) -> Array:
        """Return force [N] and torque [N m] about the centre of mass at 1 N, shape (6,)."""
        reaction = -self.spin * self.torque_ratio * self.direction
        wrench: Array = np.r_[self.direction, np.cross(self.position, self.direction) + reaction]
        return wrench

    def speed(self, thrust: float) -> float:
        """
        Return the rotor speed that gives a thrust at rest.

        Parameters
        ----------
        thrust
            [N].

        Returns
        -------
        float
            [rad/s], with the sign of the thrust.

        """
        return float(np.copysign(np.sqrt(abs(thrust) / self.k), thrust))


def thrusters_of(
    source: str, medium: Medium, size: Array, weight: float, max_thrust: float | None
) -> list[Thruster]:
    """
    Return the thrusters of a preset, or of a YAML file.

    Parameters
    ----------
    source
        One of ``PRESETS``, or the path of a YAML file (doc/new_vehicle.md).
    medium, size, weight
        Of the vehicle; size length, width, height [m], weight [N]. A preset scales with them.
    max_thrust
        Of each thruster of a preset [N]; None: twice the weight together in air, enough for 1 m/s
        ahead in water.

    Raises
    ------
    ConfigError
        If the preset is unknown or for the other medium, or the file has a fault.

    """
    if source in PRESETS:
        if PRESETS[source][0] != medium:
            fitting = listed(name for name, (where, _) in PRESETS.items() if where == medium)
            raise ConfigError(
                f'--thrusters {source}: is for {PRESETS[source][0]}; for {medium}: {fitting}, '
                'or a YAML file'
            )
        places = _preset(source, size, weight, max_thrust)
    elif Path(source).suffix in ('.yaml', '.yml'):
        if max_thrust is not None:
            raise ConfigError(f'--max-thrust goes with a preset; {source} states each max_thrust')
        path = Path(source)
        places = parse(ThrusterList, read_yaml(path), path).thrusters
        _check(places, path)
    else:
        raise ConfigError(
            f"--thrusters '{source}' is no preset{did_you_mean(source, PRESETS)} "
            f'allowed: {listed(PRESETS)}, or a YAML file'
        )
    return [complete_thruster(place, medium) for place in places]


def _check(places: list[ThrusterPlace], path: Path) -> None:
    names = [place.name for place in places]
    for name in names:
        if names.count(name) > 1:
            raise ConfigError(f"{path}: key 'thrusters': the name '{name}' stands twice")
        if name == 'imu' or name.endswith('_torque'):
            raise ConfigError(
                f"{path}: key 'thrusters': the name '{name}' is taken; allowed: any but imu and "
                '..._torque'
            )
    for i, place in enumerate(places):
        if not any(place.direction):
            raise ConfigError(
                f"{path}: key 'thrusters.{i}.direction': is 0 0 0; give the direction of positive "
                f"thrust of '{place.name}' (forward, left, up)"
            )


def complete_thruster(place: ThrusterPlace, medium: Medium) -> Thruster:
    """
    Return a thruster with every number; what its place leaves out is guessed.

    Parameters
    ----------
    place
        Of a list.
    medium
        ``air`` or ``water``.

    Returns
    -------
    Thruster
        Its position as of the place.

    """
    water = medium == 'water'
    highest = place.max_thrust
    reverse = place.max_reverse
    if reverse is None:
        reverse = _REVERSE * highest if water else 0.0
    diameter = _disc(highest, medium) if place.diameter is None else place.diameter
    coefficient = _KT_WATER if water else _CT_AIR
    ratio = place.torque_ratio
    if ratio is None:
        ratio = _TORQUE_SHARE * diameter
    lag = _LAG_WATER if water else _LAG_AIR
    if place.time_constant is not None:
        lag = (place.time_constant, place.time_constant)
    direction = np.array(place.direction)
    spin = {'ccw': 1, 'cw': -1, 'none': 0}[place.spin]
    k = coefficient * DENSITY[medium] * diameter**4 / (2 * np.pi) ** 2
    return Thruster(
        name=place.name,
        position=np.array([_rounded(x) for x in place.position]),
        direction=direction / np.linalg.norm(direction),
        limits=(0.0 - _rounded(reverse), _rounded(highest)),
        diameter=_rounded(diameter),
        k=_rounded(k),
        spin=spin if ratio > 0 else 0,
        torque_ratio=_rounded(ratio) if spin else 0.0,
        lag=lag,
    )


def _disc(max_thrust: float, medium: Medium) -> float:
    """Return a likely diameter [m]; in air hover is half of the largest thrust."""
    per_disc = _THRUST_PER_DISC if medium == 'water' else 2 * _DISC_LOADING
    return float(np.sqrt(4 * max_thrust / (np.pi * per_disc)))


def _rounded(value: float) -> float:
    """Return a number as the files have it, with six digits."""
    return float(f'{value:.6g}')


def _preset(
    name: str, size: Array, weight: float, max_thrust: float | None
) -> list[ThrusterPlace]:
    length, width, height = size
    if PRESETS[name][0] == 'air':
        return _rotors(name, size, weight, max_thrust)
    guessed = max_thrust is None
    if max_thrust is None:  # rho/2 C_d A v^2 = 4 T cos 45 at 1 m/s, C_d 1
        max_thrust = 0.5 * DENSITY['water'] * width * height / (4 * np.sqrt(0.5))
    if name == 'torpedo':  # its drag coefficient is a quarter: 2 m/s ahead
        thrust = 4 * np.sqrt(0.5) * max_thrust if guessed else max_thrust
        return [
            ThrusterPlace(
                name='propeller', position=[-0.5 * length, 0.0, 0.0], direction=[1.0, 0.0, 0.0],
                max_thrust=thrust,
            )
        ]  # fmt: skip
    # ArduSub's order and signs: front right, front left, rear right, rear left; vertical down
    front = [(1.0, -1.0), (1.0, 1.0), (-1.0, -1.0), (-1.0, 1.0)]
    places = [((0.35 * x * length, 0.3 * y * width, 0.0), (-x, y, 0.0)) for x, y in front]
    above = [(0.0, -1.0), (0.0, 1.0)] if name == 'vectored6' else front
    places += [((0.3 * x * length, 0.4 * y * width, 0.0), (0.0, 0.0, -1.0)) for x, y in above]
    return [
        ThrusterPlace(
            name=f't{i + 1}', position=list(position), direction=list(direction),
            max_thrust=max_thrust,
        )
        for i, (position, direction) in enumerate(places)
    ]  # fmt: skip


def _rotors(
    name: str, size: Array, weight: float, max_thrust: float | None
) -> list[ThrusterPlace]:
    """Return rotors on the ellipse through the corners, neighbours turning opposite ways."""
    length, width, height = size
    count = {'quad': 4, 'hexa': 6, 'octo': 8}[name]
    if max_thrust is None:
        max_thrust = 2 * weight / count
    # azimuth from ahead to the left; a quad in PX4's order: front right, rear left, ...
    order = [3, 1, 0, 2] if name == 'quad' else list(range(count))
    azimuths = 2 * np.pi / count * (np.arange(count) + 0.5)
    around = np.sqrt(0.5) * np.c_[length * np.cos(azimuths), width * np.sin(azimuths)]
    gap = float(np.linalg.norm(around - np.roll(around, 1, axis=0), axis=1).min())
    diameter = min(_disc(max_thrust, 'air'), 0.95 * gap)  # neighbours do not overlap
    return [
        ThrusterPlace(
            name=f'm{i + 1}',
            position=[*around[place].tolist(), float(0.5 * height)],
            direction=[0.0, 0.0, 1.0],
            max_thrust=max_thrust,
            spin='ccw' if place % 2 else 'cw',
            diameter=diameter,
        )
        for i, place in enumerate(order)
    ]
