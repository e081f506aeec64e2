# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""ctypes binding of what an exchange with an autopilot repeats (plugins/src/exchange/)."""

import ctypes
from collections.abc import Callable
from functools import cache
from typing import ClassVar

from fluid_sim_ros.plugins import functions_of

#: Numbers of the widest reading, constants of an instrument, and channels of a radio control.
WIDEST, CONSTANTS, CHANNELS = 6, 5, 18
#: Whole frames of MAVLink are not longer [bytes]; nor are replies to ArduPilot, its packets, and
#: what is read at once of PX4.
LONGEST_FRAME, LONGEST_REPLY, LONGEST_PACKET, PORTION = 280, 4096, 72, 65536
#: Outputs of an autopilot.
MOST_OUTPUTS = 32
#: What an exchange has found, and what it does: ``Found`` and ``Phase`` of exchange/peer.h.
SILENT, ANSWERED, OTHER, GONE, HELD, BEFORE = range(6)
ASK, HEAR, OBSERVED = 1, 2, 4
#: Parts of an exchange whose processor time ``Peer.spent`` keeps.
PARTS = ('observing', 'writing', 'sending', 'waiting', 'receiving', 'driving')
#: Kinds of curves, in the order of ``CurveKind`` in exchange/outputs.cc.
CURVES = ('thrust', 'rotor_speed', 't200')

_double, _integer, _pointer = ctypes.c_double, ctypes.c_int64, ctypes.c_void_p


class Carrier(ctypes.Structure):
    """What instruments sit on: addresses of a row, of the model and of its data; base body."""

    _fields_: ClassVar = [
        ('row', _pointer), ('model', _pointer), ('observed', _pointer), ('base', _integer),
    ]  # fmt: skip


class Axis(ctypes.Structure):
    """Rounding and range of a number of a reading."""

    _fields_: ClassVar = [(name, _double) for name in ('quantum', 'low', 'high', 'below', 'above')]


class Instrument(ctypes.Structure):
    """A sensor; the fields are told of in exchange/instruments.h."""

    _fields_: ClassVar = [
        *((name, _integer) for name in (
            'kind', 'period', 'width', 'tick', 'fresh', 'beyond', 'block',
        )),
        ('added', _pointer), ('axes', Axis * WIDEST), ('position_b', _double * 3),
        ('rotation_sb', _double * 9), ('turned', _integer), ('constants', _double * CONSTANTS),
        ('values', _double * WIDEST), ('passed', _pointer),
    ]  # fmt: skip


class Px4Sensors(ctypes.Structure):
    """What HIL_SENSOR is made from."""

    _fields_: ClassVar = [
        ('carrier', Carrier), ('instruments', _pointer * 4), ('given', _integer),
        ('pressure', _double * 3),
    ]  # fmt: skip


class Px4Answer(ctypes.Structure):
    """What one HIL_ACTUATOR_CONTROLS says."""

    _fields_: ClassVar = [
        ('time_us', ctypes.c_uint64), ('flags', ctypes.c_uint64), ('controls', _double * 16),
        ('mode', _integer),
    ]  # fmt: skip


class ArduPilotState(ctypes.Structure):
    """What a reply to ArduPilot is made from."""

    _fields_: ClassVar = [
        ('carrier', Carrier), ('instruments', _pointer * 2), ('aerial', _integer),
        *((name, _double) for name in ('sea_density', 'indicated', 'distance')),
        ('channels', _integer), ('pulses', _integer * CHANNELS), ('metered', _integer),
        ('voltage', _double), ('current', _double),
    ]  # fmt: skip


class OutputCurve(ctypes.Structure):
    """How an output becomes a command; the fields are told of in exchange/outputs.cc."""

    _fields_: ClassVar = [
        *((name, _integer) for name in ('place', 'kind', 'reversed', 'silent')),
        *((name, _double) for name in ('rest', 'ahead', 'back', 'low', 'high')),
        ('pulses', _pointer), ('thrusts', _pointer), ('points', _integer),
    ]  # fmt: skip


class Observer(ctypes.Structure):
    """What ``fsr_observe`` takes: addresses, and the number of vehicles."""

    _fields_: ClassVar = [
        *((name, _pointer) for name in ('model', 'data', 'scratch', 'bases')),
        ('count', _integer), ('rows', _pointer),
    ]  # fmt: skip


class ControlPorts(ctypes.Structure):
    """Where the commands of some actuators go; the fields are told of in exchange/outputs.h."""

    _fields_: ClassVar = [
        ('count', _integer), *((name, _pointer) for name in ('limits', 'scale', 'ids', 'control')),
    ]  # fmt: skip


class Driven(ctypes.Structure):
    """What an autopilot drives; the fields are told of in exchange/outputs.h."""

    _fields_: ClassVar = [
        ('curves', _pointer), ('thrusters', ControlPorts), ('joints', ControlPorts),
        ('commands', _pointer), ('known', _integer), ('outputs', _double * MOST_OUTPUTS),
        ('beyond', _integer),
    ]  # fmt: skip


class BatteryState(ctypes.Structure):
    """A battery; the fields are told of in exchange/battery.h."""

    _fields_: ClassVar = [
        *((name, _double) for name in (
            'voltage', 'current', 'used', 'left', 'full', 'empty', 'capacity', 'resistance',
            'idle', 'full_current',
        )),
        ('thrusters', _integer), ('limits', _pointer),
    ]  # fmt: skip


class Peer(ctypes.Structure):
    """The other end of a socket; the fields are told of in exchange/peer.h."""

    _fields_: ClassVar = [
        *((name, _integer) for name in ('socket', 'alone', 'quick', 'clocked')),
        ('spent', _double * len(PARTS)),
    ]  # fmt: skip


class Px4Exchange(ctypes.Structure):
    """A usual exchange with PX4; the fields are told of in exchange/px4_exchange.cc."""

    _fields_: ClassVar = [
        ('observer', Observer), *((name, _pointer) for name in ('sensors', 'driven', 'battery')),
        ('period', _double), ('system', _integer), ('component', _integer), ('peer', Peer),
        *((name, _integer) for name in ('frame_size', 'sent', 'size')), ('answer', Px4Answer),
        ('frame', ctypes.c_uint8 * LONGEST_FRAME), ('portion', ctypes.c_uint8 * PORTION),
    ]  # fmt: skip


class Sender(ctypes.Structure):
    """The address of who has sent something: a ``sockaddr`` of ``size`` bytes."""

    _fields_: ClassVar = [('size', _integer), ('address', ctypes.c_uint8 * 128)]


class ArduPilotExchange(ctypes.Structure):
    """A usual exchange with ArduPilot; the fields are told of in ardupilot_exchange.cc."""

    _fields_: ClassVar = [
        ('observer', Observer), *((name, _pointer) for name in ('state', 'driven', 'battery')),
        ('rate', _integer), ('seconds', _double), ('reply_size', _integer), ('size', _integer),
        ('peer', Peer), ('autopilot', Sender), ('sender', Sender),
        ('reply', ctypes.c_uint8 * LONGEST_REPLY),
        ('packet', ctypes.c_uint8 * (LONGEST_PACKET + 1)),
    ]  # fmt: skip


class ExchangeLibrary:
    """
    The functions of exchange/ with argument types set; each tells of itself at its definition.

    Parameters
    ----------
    library
        The loaded plugin library; its functions take a few microseconds.
    waiting
        The same one, whose functions let other threads run meanwhile.

    """

    def __init__(self, library: ctypes.PyDLL, waiting: ctypes.CDLL) -> None:
        number = ctypes.c_int
        self.look: Callable[[int, int, int], int] = library.fsr_look
        library.fsr_look.argtypes = [_pointer, _pointer, _integer]
        self.px4_sensors: Callable[..., int] = library.fsr_px4_sensors
        library.fsr_px4_sensors.argtypes = [
            _pointer, _integer, ctypes.c_uint64, number, number, number, _pointer,
        ]  # fmt: skip
        self.checksum: Callable[[bytes, int, int], int] = library.fsr_checksum
        library.fsr_checksum.argtypes = [ctypes.c_char_p, number, number]
        self.px4_answer: Callable[[bytes, int, int], int] = library.fsr_px4_answer
        library.fsr_px4_answer.argtypes = [ctypes.c_char_p, _integer, _pointer]
        self.ardupilot_state: Callable[..., int] = library.fsr_ardupilot_state
        library.fsr_ardupilot_state.argtypes = [_pointer, _integer, _double, _pointer, _integer]
        self.outputs: Callable[[int, int, int, int], None] = library.fsr_outputs
        library.fsr_outputs.argtypes = [_pointer, number, _pointer, _pointer]
        library.fsr_outputs.restype = None
        self.command: Callable[[int, int, int, int | None, int, int], int] = library.fsr_command
        library.fsr_command.argtypes = [_pointer, number, *[_pointer] * 4]
        self.draw: Callable[[int, int, float], None] = library.fsr_draw
        library.fsr_draw.argtypes = [_pointer, _pointer, _double]
        library.fsr_draw.restype = None
        self.ardupilot_connected: Callable[[int], int] = library.fsr_ardupilot_connected
        library.fsr_ardupilot_connected.argtypes = [_pointer]
        self.px4_exchange: Callable[..., int] = waiting.fsr_px4_exchange
        waiting.fsr_px4_exchange.argtypes = [
            _pointer, _integer, _integer, ctypes.c_uint64, number, ctypes.c_char_p, _integer,
            _double,
        ]  # fmt: skip
        self.ardupilot_exchange: Callable[..., int] = waiting.fsr_ardupilot_exchange
        waiting.fsr_ardupilot_exchange.argtypes = [
            _pointer, _integer, _integer, _double, _integer, _double,
        ]  # fmt: skip


@cache
def exchange_library() -> ExchangeLibrary:
    """
    Return the functions; the library is loaded once.

    Raises
    ------
    PluginError
        If the library is missing, or does not fit MuJoCo or this module.

    """
    return functions_of(
        lambda path: ExchangeLibrary(ctypes.PyDLL(path), ctypes.CDLL(path)), 'exchange.py'
    )
