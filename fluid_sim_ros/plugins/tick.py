# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""ctypes binding of the compiled tick: messages filled and published (plugins/src/tick/)."""

import ctypes
import weakref
from collections.abc import Callable
from functools import cache
from typing import ClassVar

from fluid_sim_ros.plugins import functions_of

_double, _integer, _pointer = ctypes.c_double, ctypes.c_int64, ctypes.c_void_p


class Copy(ctypes.Structure):
    """Bytes that go from one place to another."""

    _fields_: ClassVar = [('target', _pointer), ('source', _pointer), ('size', _integer)]


class Number(ctypes.Structure):
    """A number that is made from another one; the fields are told of in tick/tick.cc."""

    _fields_: ClassVar = [
        ('target', _pointer), ('source', _pointer), ('scale', _double), ('actuator', _integer),
    ]  # fmt: skip


class TickTopic(ctypes.Structure):
    """One topic; the fields are told of in tick/tick.cc."""

    _fields_: ClassVar = [
        ('period', _integer), ('needs_forces', _integer), ('asks', _integer),
        ('numbers', _pointer), ('number_count', _integer),
        ('copies', _pointer), ('copy_count', _integer),
        ('message', _pointer), ('size', _integer),
        ('publisher', _pointer), ('published', _integer),
    ]  # fmt: skip


class Tick(ctypes.Structure):
    """All topics, and what they are made from; the fields are told of in tick/tick.cc."""

    _fields_: ClassVar = [
        ('model', _pointer), ('data', _pointer), ('observed_data', _pointer), ('bases', _pointer),
        ('count', _integer), ('rows', _pointer), ('stamp', _pointer), ('topics', _pointer),
        ('chosen', _pointer), ('chosen_count', _integer),
        ('made', _pointer), ('made_count', _integer),
        ('publishing', _pointer), ('observed', _integer),
    ]  # fmt: skip


class TickLibrary:
    """
    The functions of tick/ with argument types set; each tells of itself at its definition.

    Parameters
    ----------
    library
        The loaded plugin library.

    """

    def __init__(self, library: ctypes.CDLL) -> None:
        number, whole = ctypes.c_int, ctypes.c_longlong
        self.tick: Callable[[int, int, int, int, int], int] = library.fsr_tick
        library.fsr_tick.argtypes = [_pointer, whole, whole, whole, number]
        library.fsr_tick.restype = whole
        self.publishing: Callable[[int, int, int, int], int] = library.fsr_publishing
        library.fsr_publishing.argtypes = [_pointer, _pointer, _pointer, whole]
        library.fsr_publishing.restype = _pointer
        self.free: Callable[[int], None] = library.fsr_publishing_free
        library.fsr_publishing_free.argtypes = [_pointer]
        library.fsr_publishing_free.restype = None
        self.start: Callable[[int], None] = library.fsr_publishing_start
        library.fsr_publishing_start.argtypes = [_pointer]
        library.fsr_publishing_start.restype = None
        self.stop: Callable[[int, float], int] = library.fsr_publishing_stop
        library.fsr_publishing_stop.argtypes = [_pointer, _double]
        self.send: Callable[[int, int, bytes, int], None] = library.fsr_publishing_send
        library.fsr_publishing_send.argtypes = [_pointer, _pointer, ctypes.c_char_p, whole]
        library.fsr_publishing_send.restype = None
        self.fault: Callable[..., int] = library.fsr_publishing_fault
        library.fsr_publishing_fault.argtypes = [_pointer, _pointer, ctypes.c_char_p, number]


@cache
def tick_library() -> TickLibrary:
    """
    Return the functions; the library is loaded once, and releases the interpreter lock.

    Raises
    ------
    PluginError
        If the library is missing, or does not fit MuJoCo or this module.

    """
    return functions_of(lambda path: TickLibrary(ctypes.CDLL(path)), 'tick.py')


class PublishQueue:
    """
    Hands messages to a middleware: in the calling thread, or in one of its own.

    Messages go out in the order in which they were sent. Where the thread cannot keep up, who
    sends waits: nothing is left out. Used by one thread.

    Parameters
    ----------
    functions
        Addresses of ``rcl_publish_serialized_message``, ``rcutils_get_error_string`` and
        ``rcutils_reset_error``, or of functions like them.
    size
        Of the queue [bytes].

    Attributes
    ----------
    address
        Of the library's ``Publishing``.
    threaded
        Whether messages go out in a thread of their own.

    """

    def __init__(self, functions: tuple[int, int, int], size: int) -> None:
        self._library = tick_library()
        self.address = self._library.publishing(*functions, size)
        self._free = weakref.finalize(self, self._library.free, self.address)
        self.threaded = False

    def start(self) -> None:
        """Publish in a thread of its own from now on."""
        self._library.start(self.address)
        self.threaded = True

    def stop(self, timeout: float) -> int:
        """
        Publish what waits, and from now on in the calling thread.

        Parameters
        ----------
        timeout
            Longest wait [s]; a message that is being published is always waited for.

        Returns
        -------
        int
            How many messages were left out because the time was over.

        """
        self.threaded = False
        return self._library.stop(self.address, timeout)

    def send(self, publisher: int, data: bytes) -> None:
        """
        Publish a message.

        Parameters
        ----------
        publisher
            Address of the middleware's publisher (``rcl_publisher_t``).
        data
            The message (CDR).

        """
        self._library.send(self.address, publisher, data, len(data))

    def fault(self) -> tuple[int, str]:
        """
        Return the first fault since the last call.

        Returns
        -------
        publisher, text
            Address of its publisher, and what the middleware said; 0 where there was none.

        """
        publisher, text = ctypes.c_void_p(), ctypes.create_string_buffer(1024)
        code = self._library.fault(self.address, ctypes.byref(publisher), text, len(text))
        if not code:
            return 0, ''
        return publisher.value or 0, f'{text.value.decode(errors="replace")} (code {code})'

    def free(self) -> None:
        """Release it; whoever holds its address must not use it any more."""
        self._free()
        self.address, self.threaded = 0, False
