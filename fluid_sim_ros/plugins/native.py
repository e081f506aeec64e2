# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""ctypes binding of the C functions in the plugin library (plugins/src/api/)."""

import ctypes
from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING, Any

from fluid_sim_ros.plugins import functions_of

# What the library says of itself; read from it on first use (``__getattr__`` below), so that each
# name and number stands once, in plugins/src/shared/terms.h and plugins/src/api/.

#: Names of the published wrench terms, in their order.
TERMS: tuple[str, ...]
# Columns of an observation row; units and frames stand at ``enum Column`` in api/api.h.
POSITION: slice
QUATERNION: slice
LINEAR_VELOCITY: slice
ANGULAR_VELOCITY: slice
SPECIFIC_FORCE: slice
ANGULAR_ACCELERATION: slice
MEDIUM_VELOCITY: slice
TOTAL: slice
THRUST: slice
ROW_WIDTH: int
#: What ``Native.thruster`` writes; units stand at ``kThrusterValues`` in api/thruster.cc.
THRUSTER_VALUES: tuple[str, ...]


def term_columns(term: str) -> slice:
    """
    Return the columns of a term's wrench in an observation row.

    Parameters
    ----------
    term
        One of ``TERMS``.

    Returns
    -------
    columns
        Six: force [N], then torque [N m], base_link axes, about the base_link origin.

    Raises
    ------
    ValueError
        If there is no such term.

    """
    terms = native().columns['terms']
    index = native().terms.index(term)
    return slice(terms.start + 6 * index, terms.start + 6 * (index + 1))


class Native:
    """
    The library's C functions with argument types set.

    ``step(model, data, n, report) -> int`` and ``observe(model, data, scratch, bases, count,
    forces, rows)`` take addresses (``MjModel._address``, ``ndarray.ctypes.data``), ``forces`` is
    0, 1 (accelerations) or 2 (wrenches, too); both release the interpreter lock while they run,
    as all do. ``lean(model, data, report) -> int`` makes what ``lean_step(lean, n, tick) -> int``
    steps as ``step`` does, to the bit, without work that cannot change the state; ``lean_free``
    frees it, and ``lean_about(lean, out)`` tells what is left out (``simulation.stages``).
    ``lean_add_gait(lean, beat, wave, count, controls, joints)``, ``lean_forget_gaits(lean)`` and
    ``lean_hold_wrenches(lean, count, addresses, numbers)`` set what is written before each step.
    ``look(model, data, scratch, bases, count, start, largest, rows)`` raises the
    largest speed, tilt and distance from the start of each base; ``runs`` takes many runs in one
    call (``simulation.batch.BatchRuns``).
    ``set_medium(model, data, wind, current) -> int`` takes addresses of three numbers or 0,
    ``get_medium`` the same; ``enable_medium(model, data, on)``; ``seed_medium(model, data,
    seed)``; ``flow(model, data, body, point, out)``.
    ``explicit_force`` and ``kinetic_energy`` take (model, data, scratch, out).
    ``thruster(model, data, actuator, out) -> int`` writes THRUSTER_VALUES and returns 1 for the
    thrust of a fluid_sim.thruster, 2 for its reaction torque, 0 for any other actuator.
    ``surface(model, data, points, n, heights) -> int`` writes the height [m] of the free surface
    over n points and returns 2 where it has waves.
    ``beyond_grids(model, data, point, out) -> int`` writes how far a point lies beyond the ends of
    the current's and the wind's grid (t, x, y, z each) and returns 1 if it does.
    ``acting_terms(model, data, body, out)`` writes 1 for each of ``terms`` that can act on a body
    into 32-bit integers; see ``plugins.acting``. ``limits(model, data, i, out) -> int`` writes
    how far a body has left what its forces are good for; see ``plugins.limits``;
    ``forget_limits(model, data)`` begins anew. ``energy_take(model, data, scratch, seconds,
    sums)`` adds up what an integrator does to the energy; see ``loop.energy_watch``. See
    plugins/src/api/ for their meaning.

    Parameters
    ----------
    library
        The loaded plugin library.

    Attributes
    ----------
    terms, thruster_values
        See ``TERMS`` and ``THRUSTER_VALUES``.
    columns
        Blocks of an observation row by name; ``terms`` holds six columns for each term.

    """

    def __init__(self, library: ctypes.CDLL) -> None:
        pointer, integer, bind = ctypes.c_void_p, ctypes.c_int, _bound
        self.step: Callable[[int, int, int, int], int] = bind(
            library.fsr_step, [pointer, pointer, integer, pointer], integer
        )
        self.lean: Callable[[int, int, int], int] = bind(library.fsr_lean, [pointer] * 3, pointer)
        self.lean_free: Callable[[int], None] = bind(library.fsr_lean_free, [pointer])
        self.lean_step: Callable[[int, int, int], int] = bind(
            library.fsr_lean_step, [pointer, integer, ctypes.c_longlong], integer
        )
        self.lean_add_gait: Callable[[int, int, int, int, int, int], None] = bind(
            library.fsr_lean_add_gait, [pointer] * 3 + [integer] + [pointer] * 2
        )
        self.lean_forget_gaits: Callable[[int], None] = bind(
            library.fsr_lean_forget_gaits, [pointer]
        )
        self.lean_hold_wrenches: Callable[[int, int, int, int], None] = bind(
            library.fsr_lean_hold_wrenches, [pointer, integer, pointer, pointer]
        )
        self.lean_about: Callable[[int, int], None] = bind(library.fsr_lean_about, [pointer] * 2)
        self.observe: Callable[[int, int, int, int, int, int, int], None] = bind(
            library.fsr_observe, [pointer, pointer, pointer, pointer, integer, integer, pointer]
        )
        self.raise_largest: Callable[[int, int, int, int, int, int, int, int], None] = bind(
            library.fsr_raise_largest, [pointer] * 4 + [integer] + [pointer] * 3
        )
        self.runs: Callable[..., None] = bind(
            library.fsr_runs,
            [pointer] * 4 + [integer] * 4 + [pointer] * 6
            + [integer, pointer, pointer, integer, pointer],
        )  # fmt: skip
        self.set_medium: Callable[[int, int, int, int], int] = bind(
            library.fsr_set_medium, [pointer] * 4, integer
        )
        self.enable_medium: Callable[[int, int, int], int] = bind(
            library.fsr_enable_medium, [pointer, pointer, integer], integer
        )
        self.seed_medium: Callable[[int, int, float], int] = bind(
            library.fsr_seed_medium, [pointer, pointer, ctypes.c_double], integer
        )
        self.flow: Callable[[int, int, int, int, int], None] = bind(
            library.fsr_flow, [pointer, pointer, integer, pointer, pointer]
        )
        self.get_medium: Callable[[int, int, int, int], int] = bind(
            library.fsr_get_medium, [pointer] * 4, integer
        )
        self.explicit_force: Callable[[int, int, int, int], None] = bind(
            library.fsr_explicit_force, [pointer] * 4
        )
        self.kinetic_energy: Callable[[int, int, int, int], None] = bind(
            library.fsr_kinetic_energy, [pointer] * 4
        )
        self.energy_feed: Callable[[int, int, int, int], None] = bind(
            library.fsr_energy_feed, [pointer] * 4
        )
        self.energy_take: Callable[[int, int, int, float, int], None] = bind(
            library.fsr_energy_take, [pointer, pointer, pointer, ctypes.c_double, pointer]
        )
        self.forget_limits: Callable[[int, int], None] = bind(
            library.fsr_forget_limits, [pointer, pointer]
        )
        self.thruster: Callable[[int, int, int, int], int] = bind(
            library.fsr_thruster, [pointer, pointer, integer, pointer], integer
        )
        self.surface: Callable[[int, int, int, int, int], int] = bind(
            library.fsr_surface, [pointer, pointer, pointer, integer, pointer], integer
        )
        self.beyond_grids: Callable[[int, int, int, int], int] = bind(
            library.fsr_beyond_grids, [pointer] * 4, integer
        )
        self.acting_terms: Callable[[int, int, int, int], None] = bind(
            library.fsr_acting_terms, [pointer, pointer, integer, pointer]
        )
        self.limits: Callable[[int, int, int, int], int] = bind(
            library.fsr_limits, [pointer, pointer, integer, pointer], integer
        )
        self._plugin_key = bind(
            library.fsr_plugin_key, [ctypes.c_char_p, integer], ctypes.c_char_p
        )
        self._plugin_config = bind(
            library.fsr_plugin_config, [pointer, integer, ctypes.c_char_p], ctypes.c_char_p
        )
        self._plugin_name = bind(library.fsr_plugin_name, [pointer, integer], ctypes.c_char_p)
        self.terms = _names(library.fsr_term)
        self.thruster_values = _names(library.fsr_thruster_value)
        self.columns = _columns(library.fsr_columns)

    def plugin_keys(self, plugin: str) -> tuple[str, ...]:
        """
        Return the configuration keys of a plugin, empty for one that is not known.

        Parameters
        ----------
        plugin
            Name of the plugin, such as ``fluid_sim.body``.

        """
        keys: list[str] = []
        while (key := self._plugin_key(plugin.encode(), len(keys))) is not None:
            keys.append(key.decode())
        return tuple(keys)

    def plugin_name(self, model: int, instance: int) -> str:
        """
        Return the name of the plugin of an instance, '' for one that MuJoCo does not know.

        Parameters
        ----------
        model
            Address of an ``mjModel``.
        instance
            Index of the plugin instance.

        """
        name: bytes = self._plugin_name(model, instance)
        return name.decode()

    def plugin_config(self, model: int, instance: int, key: str) -> str:
        """
        Return the value of a key of a plugin instance, '' where it is not given.

        Callers outside of this room use ``plugins.config``.

        Parameters
        ----------
        model
            Address of an ``mjModel``.
        instance
            Index of the plugin instance.
        key
            Name of the key.

        """
        value = self._plugin_config(model, instance, key.encode())
        return value.decode() if value else ''


@cache
def native() -> Native:
    """
    Return the library's C functions; the library is loaded once.

    Raises
    ------
    PluginError
        If the library is missing, or does not fit MuJoCo or this module.

    """
    return functions_of(lambda path: Native(ctypes.CDLL(path)), 'native.py')


def _bound(function: Any, arguments: list[Any], result: Any = None) -> Any:
    function.argtypes, function.restype = arguments, result
    return function


def _names(function: Any) -> tuple[str, ...]:
    """Return the names that a C function gives for 0, 1, ... up to the first null."""
    function.argtypes = [ctypes.c_int]
    function.restype = ctypes.c_char_p
    names: list[str] = []
    while (name := function(len(names))) is not None:
        names.append(name.decode())
    return tuple(names)


def _columns(function: Any) -> dict[str, slice]:
    bounds = (ctypes.c_int * 2)()
    function.argtypes = [ctypes.c_int, ctypes.c_void_p]
    function.restype = ctypes.c_char_p
    columns: dict[str, slice] = {}
    while (name := function(len(columns), bounds)) is not None:
        columns[name.decode()] = slice(*bounds)
    return columns


if not TYPE_CHECKING:  # a type checker knows the names from their declarations above

    def __getattr__(name: str) -> object:
        if name not in __annotations__:
            raise AttributeError(f'module {__name__!r} has no attribute {name!r}')
        library = native()
        columns = {name.upper(): columns for name, columns in library.columns.items()}
        width = columns.pop('TERMS').stop
        globals().update(
            columns,
            TERMS=library.terms,
            ROW_WIDTH=width,
            THRUSTER_VALUES=library.thruster_values,
        )
        return globals()[name]
