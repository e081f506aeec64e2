# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The type tf2_msgs/msg/TFMessage for publishers where ROS here lacks the package tf2_msgs.

The wheels of ROS 2 have no tf2_msgs, so without this ``/tf`` would be in logs only. A publisher of
messages that are bytes already needs of a type only its name, its hash, its description, and that
its size is not bounded. The hash is that of ROS 2 Jazzy (``messages/definitions.json``), the
description a TransformStamped's with one type more, so both equal those of the real package, and
any subscriber with tf2_msgs fits. The structures are those of the headers of ROS 2 Jazzy:
``rosidl_runtime_c`` 4.6, ``rosidl_typesupport_introspection_c`` 4.6 (from which Fast DDS makes its
own description of a type) and ``rosidl_typesupport_fastrtps_cpp`` 3.6.
"""

import ctypes
from collections.abc import Sequence
from functools import cache
from typing import Any

from geometry_msgs.msg import TransformStamped
from rclpy.type_support import check_for_type_support
from rclpy.utilities import get_rmw_implementation_identifier

from fluid_sim_ros.messages.definitions import definition
from fluid_sim_ros.messages.transform_topics import TRANSFORMS

_MIDDLEWARE = 'rmw_fastrtps_cpp'
_FASTDDS = b'rosidl_typesupport_fastrtps_c'
_INTROSPECTION = b'rosidl_typesupport_introspection_c'
_MESSAGE = 18  # rosidl_typesupport_introspection_c/field_types.h
_UNBOUNDED_SEQUENCE_OF_NESTED = 145  # type_description_interfaces/msg/FieldType
_HASH_PREFIX, _HASH_VERSION = 'RIHS01_', 1

#: What C code points to: a type, once registered, stays for the life of the process.
_kept: list[Any] = []


class _String(ctypes.Structure):
    _fields_ = (
        ('data', ctypes.c_char_p),
        ('size', ctypes.c_size_t),
        ('capacity', ctypes.c_size_t),
    )

    @classmethod
    def of(cls, text: str) -> '_String':
        data = text.encode()
        return cls(data, len(data), len(data) + 1)


class _Sequence(ctypes.Structure):
    _fields_ = (
        ('data', ctypes.c_void_p),
        ('size', ctypes.c_size_t),
        ('capacity', ctypes.c_size_t),
    )

    @classmethod
    def of(cls, items: 'ctypes.Array[Any]') -> '_Sequence':
        return cls(_address(items), len(items), len(items))


class _FieldType(ctypes.Structure):
    _fields_ = (
        ('type_id', ctypes.c_uint8),
        ('capacity', ctypes.c_uint64),
        ('string_capacity', ctypes.c_uint64),
        ('nested_type_name', _String),
    )


class _Field(ctypes.Structure):
    _fields_ = (('name', _String), ('type', _FieldType), ('default_value', _String))


class _OneType(ctypes.Structure):
    _fields_ = (('type_name', _String), ('fields', _Sequence))


class _Description(ctypes.Structure):
    _fields_ = (('type', _OneType), ('referenced', _Sequence))


class _Source(ctypes.Structure):
    _fields_ = (('type_name', _String), ('encoding', _String), ('contents', _String))


class _Hash(ctypes.Structure):
    _fields_ = (('version', ctypes.c_uint8), ('value', ctypes.c_uint8 * 32))


_ADDRESS_OF = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_void_p)
_BY_NAME = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_void_p, ctypes.c_char_p)
_REFUSE = ctypes.CFUNCTYPE(ctypes.c_bool, ctypes.c_void_p, ctypes.c_void_p)


class _TypeSupport(ctypes.Structure):
    _fields_ = (
        ('identifier', ctypes.c_void_p),  # an address: some code compares no more than that
        ('data', ctypes.c_void_p),
        ('find', _BY_NAME),
        ('get_hash', _ADDRESS_OF),
        ('get_description', _ADDRESS_OF),
        ('get_sources', _ADDRESS_OF),
    )


class _Callbacks(ctypes.Structure):
    _fields_ = (
        ('message_namespace', ctypes.c_char_p),
        ('message_name', ctypes.c_char_p),
        ('serialize', _REFUSE),
        ('deserialize', _REFUSE),
        ('serialized_size', ctypes.c_void_p),
        ('max_serialized_size', ctypes.c_void_p),
        ('key_callbacks', ctypes.c_void_p),
    )


class _Member(ctypes.Structure):
    _fields_ = (
        ('name', ctypes.c_char_p),
        ('type_id', ctypes.c_uint8),
        ('string_upper_bound', ctypes.c_size_t),
        ('members', ctypes.c_void_p),
        ('is_key', ctypes.c_bool),
        ('is_array', ctypes.c_bool),
        ('array_size', ctypes.c_size_t),
        ('is_upper_bound', ctypes.c_bool),
        ('offset', ctypes.c_uint32),
        ('default_value', ctypes.c_void_p),
        ('functions', ctypes.c_void_p * 6),  # on messages as objects
    )


class _Members(ctypes.Structure):
    _fields_ = (
        ('message_namespace', ctypes.c_char_p),
        ('message_name', ctypes.c_char_p),
        ('count', ctypes.c_uint32),
        ('size_of', ctypes.c_size_t),
        ('has_any_key_member', ctypes.c_bool),
        ('members', ctypes.c_void_p),
        ('functions', ctypes.c_void_p * 2),  # on messages as objects
    )


@cache
def transforms_type() -> type | None:
    """
    Return a class with which rclpy makes publishers and subscriptions of TFMessage bytes.

    Returns
    -------
    type or None
        Without members: messages pass as bytes (``ros.raw``). None where the middleware is
        another one than that of the wheels.

    """
    if get_rmw_implementation_identifier() != _MIDDLEWARE:
        return None
    check_for_type_support(TransformStamped)
    element = _support_at(_pointer(vars(type(TransformStamped))['_TYPE_SUPPORT'], None))
    place = element.find(ctypes.addressof(element), _FASTDDS)
    introspected = element.find(ctypes.addressof(element), _INTROSPECTION)
    if not (place and introspected):
        return None
    support = _type_support(element, _support_at(place), _support_at(introspected))
    # of messages as objects, which there are not
    none = ('_CREATE_ROS_MESSAGE', '_CONVERT_FROM_PY', '_CONVERT_TO_PY', '_DESTROY_ROS_MESSAGE')
    capsule = _new_capsule(_address(support), None, None)
    members = {**dict.fromkeys(none, False), '_TYPE_SUPPORT': capsule}
    metaclass = type('Metaclass_TFMessage', (type,), members)
    made: type = metaclass('TFMessage', (), {'__doc__': TRANSFORMS, '__slots__': ()})
    return made


def _type_support(
    element: _TypeSupport, fastdds: _TypeSupport, introspection: _TypeSupport
) -> _TypeSupport:
    """Return the support of a message that is a sequence of others, from the three of these."""
    number, description, sources = map(
        _address, (_hash(), _description(element), _sources(element))
    )
    facts = (
        _ADDRESS_OF(lambda _: number),
        _ADDRESS_OF(lambda _: description),
        _ADDRESS_OF(lambda _: sources),
    )
    named = {}
    for name, theirs, data in (
        (_FASTDDS, fastdds, _callbacks(fastdds)),
        (_INTROSPECTION, introspection, _members(introspection)),
    ):
        ours = _TypeSupport(theirs.identifier, _address(data), theirs.find, *facts)
        named[name] = _address(ours)
    return _TypeSupport(
        element.identifier, None, _BY_NAME(lambda _, name: named.get(name)), *facts
    )


def _callbacks(element: _TypeSupport) -> _Callbacks:
    theirs = ctypes.cast(element.data, ctypes.POINTER(_Callbacks)).contents
    refuse = _REFUSE(lambda *_: False)
    return _Callbacks(
        b'tf2_msgs::msg', b'TFMessage', refuse, refuse, theirs.serialized_size,
        theirs.max_serialized_size,  # says that the size has no bound, as is true of ours
        None,
    )  # fmt: skip


def _members(element: _TypeSupport) -> _Members:
    member = _Member(b'transforms', _MESSAGE, 0, ctypes.addressof(element), is_array=True)
    size = ctypes.sizeof(_Sequence)
    return _Members(b'tf2_msgs__msg', b'TFMessage', 1, size, members=_address(member))


def _hash() -> _Hash:
    text = definition(TRANSFORMS).hash.removeprefix(_HASH_PREFIX)
    return _Hash(_HASH_VERSION, (ctypes.c_uint8 * 32)(*bytes.fromhex(text)))


def _description(element: _TypeSupport) -> _Description:
    place = element.get_description(ctypes.addressof(element))
    theirs = ctypes.cast(place, ctypes.POINTER(_Description)).contents
    name = theirs.type.type_name
    kind = _FieldType(
        _UNBOUNDED_SEQUENCE_OF_NESTED, 0, 0, _String(name.data, name.size, name.capacity)
    )
    fields = (_Field * 1)(_Field(_String.of('transforms'), kind, _String.of('')))
    ours = _OneType(_String.of(TRANSFORMS), _Sequence.of(fields))
    known = [theirs.type, *_items(theirs.referenced, _OneType)]
    known.sort(key=lambda one: bytes(one.type_name.data))
    return _Description(ours, _Sequence.of((_OneType * len(known))(*known)))


def _sources(element: _TypeSupport) -> _Sequence:
    place = element.get_sources(ctypes.addressof(element))
    theirs = _items(ctypes.cast(place, ctypes.POINTER(_Sequence)).contents, _Source)
    text = definition(TRANSFORMS).text.partition('=' * 80)[0]
    ours = _Source(_String.of(TRANSFORMS), _String.of('msg'), _String.of(text))
    return _Sequence.of((_Source * (len(theirs) + 1))(ours, *theirs))


def _items(sequence: _Sequence, kind: type[ctypes.Structure]) -> Sequence[Any]:
    return list((kind * sequence.size).from_address(sequence.data)) if sequence.size else []


def _support_at(place: int) -> _TypeSupport:
    return ctypes.cast(place, ctypes.POINTER(_TypeSupport)).contents


def _address(made: Any) -> int:
    """Return where a structure lies, which stays there."""
    _kept.append(made)
    return ctypes.addressof(made)


_pointer = ctypes.PYFUNCTYPE(ctypes.c_void_p, ctypes.py_object, ctypes.c_char_p)(
    ('PyCapsule_GetPointer', ctypes.pythonapi)
)
_new_capsule = ctypes.PYFUNCTYPE(
    ctypes.py_object, ctypes.c_void_p, ctypes.c_char_p, ctypes.c_void_p
)(('PyCapsule_New', ctypes.pythonapi))
