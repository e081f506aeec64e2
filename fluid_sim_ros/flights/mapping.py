# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Which columns of a log are which quantity: the mapping files of ``config/flights``."""

from pathlib import Path
from typing import Annotated, Any

from pydantic import BeforeValidator, Field, model_validator

from fluid_sim_ros.errors import did_you_mean, listed
from fluid_sim_ros.flights.flight import ACTUATORS, QUANTITIES
from fluid_sim_ros.flights.units import ATTITUDES, BODY, ORDERS, UNITS, WORLD
from fluid_sim_ros.resources import config_folder
from fluid_sim_ros.schema.base import Number, Strict, parse
from fluid_sim_ros.schema.yaml_file import read_yaml

_AXES: dict[str, tuple[str, ...]] = {'world': WORLD, 'body': BODY, 'attitude': ATTITUDES}
#: Outputs that one log has at most.
_MOST = 64


class SignalMap(Strict):
    """
    One quantity in a log.

    Attributes
    ----------
    stream
        Name of the stream (topic, message type, ``table``); ``type:NAME`` is the first ROS topic
        of that type, ``*END`` the first stream whose name ends so.
    columns
        Their names, in the order of the quantity; for actuators ``NAME[*]`` is all of them.
    unit
        Of the numbers in the log; None: that of the quantity, if it looks right.
    axes
        ``enu`` or ``ned``, ``flu`` or ``frd``, ``enu_flu`` or ``ned_frd``; None: ours.
    order
        Of an attitude: ``wxyz``, ``xyzw`` or ``rpy``.
    offset
        Added to the stream's times [s].
    truth
        Whether a simulator wrote it.
    command
        Of an actuator: whether a model is driven by it, through its own curves and lag, in place
        of measured rotor speeds; these then are what the rotors have at a window's begin.

    """

    stream: str
    columns: Annotated[list[str], Field(min_length=1, max_length=_MOST)]
    unit: str | None = None
    axes: str | None = None
    order: str = 'wxyz'
    offset: Number = 0.0
    truth: bool = False
    command: bool = False


def _alternatives(value: Any) -> Any:
    return [value] if isinstance(value, dict) else value


class TimeColumn(Strict):
    """The column of time of a table, and its unit."""

    column: str = ''
    unit: str = ''

    @model_validator(mode='after')
    def _known(self) -> 'TimeColumn':
        if self.unit and self.unit not in UNITS['s']:
            raise ValueError(f"unit: '{self.unit}' is not known; allowed: {listed(UNITS['s'])}")
        return self


class Output(Strict):
    """
    What an output of an autopilot drives, as in ``config/autopilots``.

    Attributes
    ----------
    output
        Its number, from 1: the place of its column in the actuator signal.
    thruster
        That it drives.
    input
        Value at no thrust (in the middle: at full reverse, none, full ahead) and at full thrust.
    curve
        ``rotor_speed`` or ``thrust``: what goes with the value; ``pwm``: what the thruster makes
        of a pulse width.

    """

    output: Annotated[int, Field(ge=1, le=_MOST)]
    thruster: str
    input: Annotated[list[Number], Field(min_length=2, max_length=3)] = [0.0, 1.0]
    curve: str = 'rotor_speed'

    @model_validator(mode='after')
    def _known(self) -> 'Output':
        allowed = ('rotor_speed', 'thrust', 'pwm')
        if self.curve not in allowed:
            raise ValueError(f"curve: '{self.curve}' is not known; allowed: {listed(allowed)}")
        if sorted(self.input) != self.input or len(set(self.input)) != len(self.input):
            raise ValueError('input: must rise')
        return self


class FlightMap(Strict):
    """
    A mapping file.

    Attributes
    ----------
    signals
        Quantity -> where it is; of several, the first that the log has.
    time
        Of a table.
    vehicle
        Of the scene that is compared; '' where it has only one.
    thrusters
        The thruster of each actuator column; empty: by the names in the log, or the order of the
        model.
    actuators
        In place of ``thrusters``, for outputs of an autopilot.

    """

    signals: dict[
        str, Annotated[list[SignalMap], BeforeValidator(_alternatives), Field(max_length=_MOST)]
    ] = {}
    time: TimeColumn = TimeColumn()
    vehicle: str = ''
    thrusters: list[str] = []
    actuators: list[Output] = []

    @model_validator(mode='after')
    def _known(self) -> 'FlightMap':
        for quantity, places in self.signals.items():
            if quantity not in QUANTITIES:
                hint = did_you_mean(quantity, QUANTITIES)
                raise ValueError(
                    f"signals: '{quantity}' is not known{hint} allowed: {listed(QUANTITIES)}"
                )
            for place in places:
                _check(quantity, place)
        return self


def _check(quantity: str, place: SignalMap) -> None:
    facts = QUANTITIES[quantity]
    units = UNITS[facts.unit]
    if quantity == 'attitude':
        units = UNITS['rad'] if place.order == 'rpy' else UNITS['-']
    axes = _AXES.get(facts.axes, ())
    if quantity == 'velocity':
        axes = (*WORLD, *BODY)
    size = 3 if place.order == 'rpy' and quantity == 'attitude' else facts.size
    for key, value, allowed in (
        ('unit', place.unit, units), ('axes', place.axes, axes), ('order', place.order, ORDERS),
    ):  # fmt: skip
        if value is not None and value not in allowed:
            raise ValueError(
                f"signals.{quantity}.{key}: '{value}' is not known"
                f'{did_you_mean(value, allowed)} allowed: {listed(allowed)}'
            )
    if size and len(place.columns) != size:
        raise ValueError(f'signals.{quantity}.columns: needs {size}, got {len(place.columns)}')
    if place.command and (quantity not in ACTUATORS or quantity == 'rotor_speed'):
        raise ValueError(f'signals.{quantity}.command: only for thrust, normalized or pulse')
    if '*' in ''.join(place.columns) and quantity not in ACTUATORS:
        raise ValueError(f'signals.{quantity}.columns: name each column')


def read_mapping(path: Path) -> FlightMap:
    """
    Read a mapping file.

    Parameters
    ----------
    path
        Of the YAML file.

    Returns
    -------
    FlightMap
        Checked.

    Raises
    ------
    ConfigError
        One line with file, key, value and what is allowed.

    """
    return parse(FlightMap, read_yaml(path), path)


def over_default(mapping: FlightMap | None, kind: str) -> FlightMap:
    """
    Return a user's mapping over that of a format: what it does not say is as there.

    Parameters
    ----------
    mapping
        The user's; a quantity without a place (``wind: []``) is left out.
    kind
        ``RawLog.format``.

    """
    default = default_mapping(kind)
    if mapping is None:
        return default
    stated = {key: getattr(mapping, key) for key in mapping.model_fields_set}
    stated['signals'] = {**default.signals, **mapping.signals}
    if mapping.actuators:
        stated.setdefault('thrusters', [])
    return default.model_copy(update=stated)


def default_mapping(kind: str) -> FlightMap:
    """
    Return the mapping of a format, ``config/flights/FORMAT.yaml``.

    Parameters
    ----------
    kind
        ``RawLog.format``.

    """
    return read_mapping(config_folder() / 'flights' / f'{kind}.yaml')
