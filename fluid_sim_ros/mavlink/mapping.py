# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Which output of an autopilot drives which thruster or joint: config/autopilots."""

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, model_validator

from fluid_sim_ros.errors import ConfigError, did_you_mean, listed
from fluid_sim_ros.resources import config_folder
from fluid_sim_ros.schema.base import NotNegative, Number, Positive, Strict, parse
from fluid_sim_ros.schema.yaml_file import read_yaml

Pulse = Annotated[int, Field(ge=800, le=2200)]


class ParameterFile(Strict):
    """
    A parameter of the autopilot: ``value``, and the ``reason`` why the vehicle needs it.

    In a file a number alone is a value.
    """

    value: Number
    reason: str = ''


def _parameter(content: Any) -> Any:
    return content if isinstance(content, dict | ParameterFile) else {'value': content}


Parameter = Annotated[ParameterFile, BeforeValidator(_parameter)]
ParameterName = Annotated[str, Field(pattern='^[A-Z][A-Z0-9_]*$')]


class BatteryFile(Strict):
    """
    A battery that all thrusters draw on.

    Attributes
    ----------
    full, empty
        Voltage without load when it is full and when it is empty [V], and linear between.
    capacity
        [Ah].
    resistance
        Inside [ohm].
    idle
        Current of everything but the thrusters [A].
    full_current
        Current of all thrusters at full thrust [A]; it goes with thrust to the power of 1.5, as
        the power of an actuator disk.

    """

    full: Positive
    empty: Positive
    capacity: Positive
    resistance: NotNegative = 0.0
    idle: NotNegative = 0.0
    full_current: Positive
    source: str = ''


class ActuatorFile(Strict):
    """
    One output of the autopilot.

    Attributes
    ----------
    output
        Its number, from 1.
    thruster, joint
        What it drives: one of the two, by its name in the vehicle.
    input
        Control values or pulse widths [us] at rest and at full command; three numbers where the
        actuator works both ways: full reverse, rest, full ahead.
    curve
        Of a thruster: ``thrust``, command in proportion to thrust; ``rotor_speed``, to rotor speed
        (thrust goes with its square); ``t200``, the pulse curve of that thruster.
    voltage
        Supply of the T200 [V].
    reversed
        Positive commands act backwards.

    """

    output: Annotated[int, Field(ge=1, le=32)]
    thruster: str = ''
    joint: str = ''
    input: Annotated[list[Number], Field(min_length=2, max_length=3)]
    curve: Literal['thrust', 'rotor_speed', 't200'] = 'thrust'
    voltage: Positive = 16.0
    reversed: bool = False

    @model_validator(mode='after')
    def _is_whole(self) -> 'ActuatorFile':
        if bool(self.thruster) == bool(self.joint):
            raise ValueError('names either a thruster or a joint')
        if sorted(self.input) != self.input or len(set(self.input)) != len(self.input):
            raise ValueError('input: the numbers must grow')
        if self.reversed and len(self.input) != 3:
            raise ValueError('reversed: needs an input of three numbers')
        return self


class AutopilotFile(Strict):
    """
    One file of config/autopilots.

    Attributes
    ----------
    protocol
        ``px4`` or ``ardupilot``.
    airframe
        What the autopilot calls this vehicle: SYS_AUTOSTART of PX4, the program of ArduPilot.
    parameters
        What the autopilot must be set to for this vehicle, by name; given to a program that is
        started with the run.
    actuators
        What drives each thruster and joint.
    vision
        PX4: send the true pose and velocity as a vision system would (vehicles without GNSS).
    gnss_delay
        PX4: age that it takes a fix of its receiver for [s], its EKF2_GPS_DELAY.
    optical_flow
        PX4: send what a downward camera sees, by the true motion; needs a rangefinder.
    battery
        What its battery monitor measures; without one, PX4 has a battery of its own.
    rc
        Sticks of a radio control [us], sent all the time; empty: none.
    ignored
        Outputs that may move without driving anything.

    """

    protocol: Literal['px4', 'ardupilot']
    airframe: str
    source: str = ''
    parameters: dict[ParameterName, Parameter] = Field(default_factory=dict)
    actuators: list[ActuatorFile]
    vision: bool = False
    gnss_delay: Annotated[Number, Field(ge=0, le=0.3)] = 0.01
    optical_flow: bool = False
    battery: BatteryFile | None = None
    rc: Annotated[tuple[Pulse, ...], Field(max_length=18)] = ()
    ignored: tuple[int, ...] = ()


def load_mapping(protocol: str, vehicle: str, name: str = '') -> tuple[AutopilotFile, Path]:
    """
    Read a mapping by name or path; by default that of the protocol and the vehicle.

    Parameters
    ----------
    protocol
        ``px4`` or ``ardupilot``.
    vehicle
        Name of the vehicle, for the default mapping.
    name
        Name of a file of config/autopilots, or a path that ends in .yaml; '' for the default.

    Returns
    -------
    file, path
        The mapping, and where it was read.

    Raises
    ------
    ConfigError
        If there is none, it has a fault, or it is of another protocol.

    """
    folder = config_folder() / 'autopilots'
    path = Path(name)
    if path.suffix not in ('.yaml', '.yml'):
        path = folder / f'{name or f"{protocol}_{vehicle}"}.yaml'
        if not path.is_file():
            known = sorted(p.stem for p in folder.glob('*.yaml'))
            raise ConfigError(
                f"autopilot mapping '{path.stem}' is not known{did_you_mean(path.stem, known)} "
                f'mappings: {listed(known)}; or give the path of one (.yaml)'
            )
    file = parse(AutopilotFile, read_yaml(path), path)
    if file.protocol != protocol:
        raise ConfigError(f"{path}: key 'protocol': is {file.protocol}, not {protocol}")
    return file, path
