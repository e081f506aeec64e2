# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
JSBSim at the tasks in air: an aircraft and a planet of our own, written to a temporary folder.

The planet is a sphere of 6378 km that does not turn, with g = 9.81 m/s^2 at the start: JSBSim
cannot have a flat one, so its reference is a solution of its own equations, gravity GM/r^2
towards the centre of the planet (DOP853 at 1e-13). The drag is a function of the velocity in body
axes, the thrust an external reaction; both stated per slug, so that no conversion of units counts.
"""

from collections.abc import Callable, Iterable
from pathlib import Path
from tempfile import TemporaryDirectory

import jsbsim
import numpy as np
from scipy.integrate import solve_ivp

from benchmarks.peers.peer_tasks import (
    MASS,
    SAMPLE,
    TIMES,
    AirTask,
    Array,
    G,
    Run,
    air_rates,
    air_start,
    milliseconds,
)

_FOOT = 0.3048  # [m]
_RADIUS, _HEIGHT = 6.378e6, 1000.0  # of the planet, and of the start above it [m]
#: Integrators by JSBSim's numbers: rates and positions, translation and rotation.
INTEGRATORS = {
    'JSBSim default': (3, 4, 1, 1),  # Adams-Bashforth 2 and 3, trapezoidal in rotation
    'JSBSim AB4': (5, 5, 5, 8),  # Adams-Bashforth 4, local linearization of the attitude
}
_KEYS = ('rate/translational', 'position/translational', 'rate/rotational', 'position/rotational')

_PLANET = """<?xml version="1.0"?>
<planet name="sphere">
  <equatorial_radius unit="FT">{radius!r}</equatorial_radius>
  <polar_radius unit="FT">{radius!r}</polar_radius>
  <rotation_rate unit="RAD/SEC">0</rotation_rate>
  <GM unit="FT3/SEC2">{gm!r}</GM>
  <J2>0</J2>
</planet>
"""
_POINT = '<x>0</x><y>0</y><z>0</z>'
_LENGTHS = ''.join(
    f'<{name} unit="{unit}">{size}</{name}>'
    for name, unit, size in (
        ('wingarea', 'FT2', 1), ('wingspan', 'FT', 1), ('chord', 'FT', 1),
        ('htailarea', 'FT2', 0), ('htailarm', 'FT', 0), ('vtailarea', 'FT2', 0),
        ('vtailarm', 'FT', 0),
    )
)  # fmt: skip
_AXIS = """<axis name="{axis}"><function name="aero/force/{axis}"><product>
  <value>-1</value><property>velocities/{letter}-aero-fps</property>{coefficient}
</product></function></axis>"""
_QUADRATIC = (
    '<product><property>task/drag</property><property>velocities/vt-fps</property></product>'
)
_AIRCRAFT = f"""<?xml version="1.0"?>
<fdm_config name="task" version="2.0" release="BETA">
  <metrics>{_LENGTHS}<location name="AERORP" unit="IN">{_POINT}</location></metrics>
  <mass_balance>
    <ixx unit="SLUG*FT2">1</ixx><iyy unit="SLUG*FT2">1</iyy><izz unit="SLUG*FT2">2</izz>
    <emptywt unit="KG">{MASS}</emptywt>
    <location name="CG" unit="IN">{_POINT}</location>
  </mass_balance>
  <ground_reactions/>
  <external_reactions>
    <property value="0">task/thrust</property>
    <property value="0">task/drag</property>
    <property value="0">task/rotor-drag</property>
    <force name="thrust" frame="BODY">
      <function><property>task/thrust</property></function>
      <location unit="IN">{_POINT}</location>
      <direction><x>0</x><y>0</y><z>-1</z></direction>
    </force>
  </external_reactions>
  <aerodynamics>
    {{axes}}
    <axis name="ROLL"/><axis name="PITCH"/><axis name="YAW"/>
  </aerodynamics>
</fdm_config>
"""


def aircraft() -> str:
    """Return the aircraft: drag along each body axis, that of the rotors in their plane."""
    in_plane = f'<sum>{_QUADRATIC}<property>task/rotor-drag</property></sum>'
    axes = (('X', 'u', in_plane), ('Y', 'v', in_plane), ('Z', 'w', _QUADRATIC))
    return _AIRCRAFT.format(
        axes=''.join(_AXIS.format(axis=a, letter=u, coefficient=c) for a, u, c in axes)
    )


def executive(folder: Path) -> jsbsim.FGFDMExec:
    """Return JSBSim with the aircraft on the planet, both written to ``folder``."""
    home = folder / 'aircraft' / 'task'
    home.mkdir(parents=True)
    (home / 'task.xml').write_text(aircraft(), encoding='utf-8')
    radius, surface = _RADIUS / _FOOT, (_RADIUS + _HEIGHT) / _FOOT
    planet = _PLANET.format(radius=radius, gm=G / _FOOT * surface**2)
    (folder / 'planet.xml').write_text(planet, encoding='utf-8')
    jsbsim.FGJSBBase().debug_lvl = 0
    fdm = jsbsim.FGFDMExec(str(folder), None)
    fdm.set_debug_level(0)
    if not fdm.load_planet(str(folder / 'planet.xml'), False) or not fdm.load_model('task'):
        raise RuntimeError('JSBSim does not load the planet or the aircraft')
    fdm['simulation/gravity-model'] = 0  # GM/r^2
    return fdm


def round_planet_reference(task: AirTask) -> Array:
    """Return the positions on JSBSim's planet, in the frame of the tasks."""
    flat, center = air_rates(task), np.array([0, 0, _RADIUS + _HEIGHT])

    def rates(time: float, y: Array) -> Array:
        out = flat(time, y)
        r = y[:3] + center
        out[7:10] -= G * center[2] ** 2 * r / np.linalg.norm(r) ** 3
        out[9] += G
        return out

    solved = solve_ivp(
        rates, (0, TIMES[-1]), air_start(task), method='DOP853', t_eval=TIMES,
        rtol=1e-13, atol=1e-13,
    )  # fmt: skip
    positions: Array = solved.y[:3].T
    return positions


def jsbsim_runs(task: AirTask, timesteps: Iterable[float]) -> list[Run]:
    """Return runs by ``FGFDMExec.run``, one call a timestep."""
    with TemporaryDirectory() as folder:
        fdm = executive(Path(folder))
    reference = round_planet_reference(task)

    def prepare(kinds: tuple[int, ...], timestep: float) -> Callable[[], Callable[[], Array]]:
        steps = round(SAMPLE / timestep)

        def simulate() -> Array:
            out, run = np.empty((len(TIMES), 3)), fdm.run
            for row in out:
                for _ in range(steps):
                    run()
                row[:] = position(fdm)
            return out

        def start() -> Callable[[], Array]:
            begin(fdm, task, kinds, timestep)
            return simulate

        return start

    return [
        Run(name, milliseconds(h), prepare(kinds, h), reference)
        for name, kinds in INTEGRATORS.items()
        for h in timesteps
    ]


def begin(fdm: jsbsim.FGFDMExec, task: AirTask, kinds: tuple[int, ...], timestep: float) -> None:
    """Put the aircraft at the start: heading north, which is x of the tasks."""
    fdm.set_dt(timestep)
    for key, kind in zip(_KEYS, kinds, strict=True):
        fdm[f'simulation/integrator/{key}'] = kind
    start = {
        'h-sl-ft': _HEIGHT / _FOOT, 'lat-geod-deg': 0, 'long-gc-deg': 0, 'u-fps': 0, 'v-fps': 0,
        'w-fps': 0, 'p-rad_sec': task.spin, 'q-rad_sec': 0, 'r-rad_sec': 0, 'phi-rad': 0,
        'theta-rad': -task.tilt, 'psi-true-rad': 0,
    }  # fmt: skip
    for key, value in start.items():
        fdm[f'ic/{key}'] = value
    slugs = fdm['inertia/mass-slugs']
    fdm['task/thrust'] = slugs * task.thrust / _FOOT  # [lbf]
    fdm['task/drag'] = slugs * task.drag * _FOOT  # [lbf/(ft/s)^2]
    fdm['task/rotor-drag'] = slugs * task.rotor_drag  # [lbf/(ft/s)]
    if not fdm.run_ic():
        raise RuntimeError('JSBSim does not start')


def position(fdm: jsbsim.FGFDMExec) -> tuple[float, float, float]:
    """Return the position from the start [m]: north, west, up (the planet does not turn)."""
    up, east, north = (_FOOT * fdm[f'position/eci-{axis}-ft'] for axis in 'xyz')
    return north, -east, up - _RADIUS - _HEIGHT
