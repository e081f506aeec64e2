"""ctypes binding of the C functions in the plugin library (plugins/src/api.cc)."""

import ctypes
from collections.abc import Callable
from functools import cache

from fluid_sim_ros.errors import PluginError
from fluid_sim_ros.plugins import load_plugins, plugin_library

#: Names of the published wrench terms, in the order of the C enum ``Term``.
TERMS = (
    'drag', 'viscous', 'added_mass', 'magnus', 'kutta', 'buoyancy', 'damping', 'foil',
)  # fmt: skip

# Columns of an observation row (C enum ``Column``).
POSITION = slice(0, 3)
QUATERNION = slice(3, 7)
LINEAR_VELOCITY = slice(7, 10)
ANGULAR_VELOCITY = slice(10, 13)
SPECIFIC_FORCE = slice(13, 16)
ANGULAR_ACCELERATION = slice(16, 19)
MEDIUM_VELOCITY = slice(19, 22)
TOTAL = slice(22, 28)
THRUST = slice(28, 34)
FIRST_TERM = 34
ROW_WIDTH = FIRST_TERM + 6 * len(TERMS)

#: What ``Native.thruster`` writes: speed and commanded speed [rad/s], thrust [N], shaft torque
#: [N m], inflow along the thrust axis [m/s], and 1 where the command saturates.
THRUSTER_VALUES = ('rad_s', 'rad_s_commanded', 'thrust', 'torque', 'inflow', 'saturated')


def term_columns(term: str) -> slice:
    """Return the columns of a term's force and torque in an observation row."""
    start = FIRST_TERM + 6 * TERMS.index(term)
    return slice(start, start + 6)


class Native:
    """
    The library's C functions with argument types set.

    ``step(model, data, n, report) -> int`` and ``observe(model, data, scratch, bases, count,
    forces, rows)`` take addresses (``MjModel._address``, ``ndarray.ctypes.data``), ``forces`` is
    0, 1 (accelerations) or 2 (wrenches, too); both release the interpreter lock while they run,
    as all do. ``look(model, data, scratch, bases, count, start, largest, rows)`` raises the
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
    the current's and the wind's grid (t, x, y, z each) and returns 1 if it does. See
    plugins/src/api*.cc for their meaning.
    """

    def __init__(self, library: ctypes.CDLL) -> None:
        pointer, integer = ctypes.c_void_p, ctypes.c_int
        self.step: Callable[[int, int, int, int], int] = library.fsr_step
        library.fsr_step.argtypes = [pointer, pointer, integer, pointer]
        library.fsr_step.restype = integer
        self.observe: Callable[[int, int, int, int, int, int, int], None] = library.fsr_observe
        library.fsr_observe.argtypes = [
            pointer, pointer, pointer, pointer, integer, integer, pointer,
        ]  # fmt: skip
        library.fsr_observe.restype = None
        self.look: Callable[[int, int, int, int, int, int, int, int], None] = library.fsr_look
        library.fsr_look.argtypes = [
            pointer, pointer, pointer, pointer, integer, pointer, pointer, pointer,
        ]  # fmt: skip
        library.fsr_look.restype = None
        self.runs: Callable[..., None] = library.fsr_runs
        library.fsr_runs.argtypes = [
            *[pointer] * 4, *[integer] * 4, *[pointer] * 6,
        ]  # fmt: skip
        library.fsr_runs.restype = None
        self.set_medium: Callable[[int, int, int, int], int] = library.fsr_set_medium
        library.fsr_set_medium.argtypes = [pointer] * 4
        library.fsr_set_medium.restype = integer
        self.enable_medium: Callable[[int, int, int], int] = library.fsr_enable_medium
        library.fsr_enable_medium.argtypes = [pointer, pointer, integer]
        library.fsr_enable_medium.restype = integer
        self.seed_medium: Callable[[int, int, float], int] = library.fsr_seed_medium
        library.fsr_seed_medium.argtypes = [pointer, pointer, ctypes.c_double]
        library.fsr_seed_medium.restype = integer
        self.flow: Callable[[int, int, int, int, int], None] = library.fsr_flow
        library.fsr_flow.argtypes = [pointer, pointer, integer, pointer, pointer]
        library.fsr_flow.restype = None
        self.get_medium: Callable[[int, int, int, int], int] = library.fsr_get_medium
        library.fsr_get_medium.argtypes = [pointer] * 4
        library.fsr_get_medium.restype = integer
        self.explicit_force: Callable[[int, int, int, int], None] = library.fsr_explicit_force
        library.fsr_explicit_force.argtypes = [pointer] * 4
        library.fsr_explicit_force.restype = None
        self.kinetic_energy: Callable[[int, int, int, int], None] = library.fsr_kinetic_energy
        library.fsr_kinetic_energy.argtypes = [pointer] * 4
        library.fsr_kinetic_energy.restype = None
        self.energy_feed: Callable[[int, int, int, int], None] = library.fsr_energy_feed
        library.fsr_energy_feed.argtypes = [pointer] * 4
        library.fsr_energy_feed.restype = None
        self.thruster: Callable[[int, int, int, int], int] = library.fsr_thruster
        library.fsr_thruster.argtypes = [pointer, pointer, integer, pointer]
        library.fsr_thruster.restype = integer
        self.surface: Callable[[int, int, int, int, int], int] = library.fsr_surface
        library.fsr_surface.argtypes = [pointer, pointer, pointer, integer, pointer]
        library.fsr_surface.restype = integer
        self.beyond_grids: Callable[[int, int, int, int], int] = library.fsr_beyond_grids
        library.fsr_beyond_grids.argtypes = [pointer] * 4
        library.fsr_beyond_grids.restype = integer
        self._plugin_key = library.fsr_plugin_key
        library.fsr_plugin_key.argtypes = [ctypes.c_char_p, integer]
        library.fsr_plugin_key.restype = ctypes.c_char_p
        self._plugin_config = library.fsr_plugin_config
        library.fsr_plugin_config.argtypes = [pointer, integer, ctypes.c_char_p, ctypes.c_char_p]
        library.fsr_plugin_config.restype = ctypes.c_char_p
        if library.fsr_row_width() != ROW_WIDTH or library.fsr_term_count() != len(TERMS):
            raise PluginError(
                f'{plugin_library()} and native.py are of different versions; '
                'reinstall the package'
            )

    def plugin_keys(self, plugin: str) -> tuple[str, ...]:
        """Return the configuration keys of a plugin, empty for one that is not known."""
        keys: list[str] = []
        while (key := self._plugin_key(plugin.encode(), len(keys))) is not None:
            keys.append(key.decode())
        return tuple(keys)

    def plugin_config(self, model: int, instance: int, plugin: str, key: str) -> str:
        """Return a key's value in a plugin instance of a model (its address), or ''."""
        value = self._plugin_config(model, instance, plugin.encode(), key.encode())
        return value.decode() if value else ''


@cache
def native() -> Native:
    """Load the plugin library (once) and return its C functions."""
    load_plugins()
    return Native(ctypes.CDLL(str(plugin_library())))
