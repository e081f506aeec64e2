# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Vehicles of the validation: BlueROV2, REMUS 100, Aerosonde, and the T200 on its own."""

from typing import Any

import mujoco
import numpy as np

from benchmarks.vehicles.validation_row import MEMORY, Row
from fluid_sim_ros import Simulation
from test.support import remus_runs
from test.support import vehicle_runs as runs
from test.support.aircraft_runs import Aircraft
from test.support.plugin_models import Array, load
from test.support.thruster_models import T200, read, rotor_world

MAKER = 'Blue Robotics, BlueROV2: 1.5 m/s (3 knots), without voltage or ballast; ' + MEMORY
#: The vehicle as another tank identified it (ViktorNfa/bluerov2_dynamics, parameters.py): mass,
#: added mass [kg], quadratic damping [N s^2/m^2] of surge, sway, heave; linear below 0.3.
TANK = {'mass': 11.4, 'added': (2.6, 18.5, 13.3), 'quadratic': (34.96, 103.25, 74.23)}
TANK_SOURCE = 'tank-identified set of another laboratory (ViktorNfa/bluerov2_dynamics)'
#: Thrust of four T200 at 45 degrees, two of them in reverse, at 16 V [N].
AHEAD = (2 * 51.4 + 2 * 39.9) * np.sqrt(0.5)
DECAY = 0.5  # [m/s]
HALF = 'time of free decay in heave from 0.5 to 0.25 m/s'
#: Advance ratio at which a ducted propeller (Ka 4-70 in nozzle 19A) with the T200's K_T at rest
#: gives no thrust.
DUCTED_J0 = 0.73
INFLOW = '--fluid inflow'


def half_life(times: Array, speed: Array) -> float:
    """Return when a velocity is down to half of its start [s]."""
    return float(np.interp(-0.5, -speed / speed[0], times))


def ahead_in_inflow(scene: str) -> float:
    """Return the top speed ahead [m/s], held level, with the rung ``inflow``."""
    simulation = Simulation(scene, fluid='inflow')
    simulation.enable_wind(False)
    simulation.data.qpos[2] = -50.0
    count = len(simulation.vehicles[scene].thrusters)
    runs.set_all(simulation, scene, runs.top_command('surge', count))
    return float(runs.held(simulation, np.array([1.0, 0, 0, 0]), 8.0)[-1, 0])


def bluerov2() -> list[Row]:
    """Return top speeds and free decay of both BlueROV2."""
    heavy = {name: abs(runs.top_speed('bluerov2_heavy', name)) for name in runs.TOP_SPEEDS}
    times, speed = runs.decay('bluerov2_heavy', 2, DECAY, 6.0)
    # purely quadratic: t = (m + A)/D (1/v - 1/v0)
    tank = (TANK['mass'] + TANK['added'][2]) / (TANK['quadratic'][2] * DECAY)
    by_tank = [float(np.sqrt(AHEAD / d)) for d in TANK['quadratic'][:2]]
    light = float(runs.top_speed('bluerov2', 'surge'))
    surge = 'its quadratic drag, 141 N s2/m2, is four times that of the other published sets'
    return [
        Row('bluerov2_heavy', 'top speed ahead', 'm/s', 1.5, MAKER, heavy['surge'], surge,
            ahead_in_inflow('bluerov2_heavy'), INFLOW),
        Row('bluerov2_heavy', 'top speed ahead', 'm/s', by_tank[0],
            f'{TANK_SOURCE}, 172 N without inflow loss', heavy['surge'], surge),
        Row('bluerov2_heavy', 'top speed sideways', 'm/s', by_tank[1],
            f'{TANK_SOURCE}, 172 N without inflow loss', heavy['sway'],
            'drag 217 against 103 N s2/m2'),
        Row('bluerov2_heavy', HALF, 's', tank, TANK_SOURCE, half_life(times, speed),
            'the sets differ in drag, 190 and 74 N s2/m2, and added mass, 18.7 and 13.3 kg'),
        Row('bluerov2', 'top speed ahead', 'm/s', 1.5, MAKER, light,
            'the thrusters lose nothing by the inflow, and no tether drags',
            ahead_in_inflow('bluerov2'), INFLOW),
    ]  # fmt: skip


def turn(rudder: float, thrust: float = 3.86, seconds: float = 60.0) -> tuple[float, float]:
    """Return yaw rate [deg/s] and radius [m] of a steady turn, W = B, depth free."""
    simulation = remus_runs.variant({'volume': f'{remus_runs.NEUTRAL:.12g}'})
    simulation.data.qvel[0] = 1.54
    simulation.data.act[0] = 157.08
    runs.set_all(simulation, 'remus100', thrust)
    simulation.set_joints('remus100', [rudder, 0.0])
    simulation.step(round(seconds / simulation.timestep))
    state = simulation.snapshot().vehicles['remus100']
    rate, speed = abs(state.omega_b[2]), np.linalg.norm(state.velocity_b[:2])
    return float(np.degrees(rate)), float(speed / rate)


def remus() -> list[Row]:
    """Return speed and turn of the REMUS 100."""
    rate, radius = turn(np.radians(4.0))
    return [
        Row('remus100', 'speed at 1500 rpm (3.86 N)', 'm/s', 1.54, 'Prestero 2001, app. C',
            remus_runs.straight_speed(3.86), 'his axial drag was chosen for it'),
        Row('remus100', 'top speed (2500 rpm)', 'm/s', 2.57, f'5 knots, its maker; {MEMORY}',
            remus_runs.straight_speed(10.7), 'the limit of the propeller was chosen for it'),
        Row('remus100', 'yaw rate at 4 deg of rudder, 3.86 N', 'deg/s', None,
            'drawn in Prestero 2001, no number in the transcriptions', rate,
            f'radius {radius:.1f} m'),
    ]  # fmt: skip


def aerosonde() -> list[Row]:
    """Return level flight of the Aerosonde."""
    aircraft = Aircraft()
    speeds = np.array([30.0, 31.0, 32.0])  # the propeller's limit is just beyond
    throttle = [aircraft.trim(float(speed))['throttle'] for speed in speeds]
    fastest = float(np.polyval(np.polyfit(throttle, speeds, 2), 1.0))
    return [
        Row('aerosonde', 'fastest level flight', 'm/s', 32.0,
            f'data sheet of the Aerosonde, 18 to 32 m/s; {MEMORY}', fastest,
            'motor and mass are of the book, not of that aircraft'),
        Row('aerosonde', 'angle of attack at 25 m/s', 'deg', None,
            'no flight test of this set is public',
            float(np.degrees(aircraft.trim(25.0)['alpha'])), 'with SciPy to 1.4e-5'),
    ]  # fmt: skip


def t200_thrust(advance: float, **more: Any) -> float:
    """Return the thrust [N] at full command, 16 V, in a speed of advance [m/s]."""
    model, data = load(rotor_world({**T200, **more}, axis='1 0 0'))
    data.ctrl[0], data.qvel[0] = 1900.0, advance
    mujoco.mj_forward(model, data)
    return read(model, data)['thrust']


def t200() -> list[Row]:
    """Return the thrust of a T200, at rest and at 1 m/s of inflow, full command at 16 V."""
    full, turns, diameter = 51.4, 3533 / 60, 0.076  # [N], [1/s], [m]: the maker's sheet
    ducted = full * (1 - 1.0 / (turns * diameter * DUCTED_J0))
    return [
        Row('T200', 'thrust at rest, 16 V', 'N', full, 'Blue Robotics, September 2019',
            t200_thrust(0.0), 'the table is the sheet'),
        Row('T200', 'thrust at 1 m/s of inflow', 'N', None,
            f'none found; {ducted:.1f} N by the ducted series Ka 4-70, nozzle 19A (Oosterveld '
            f'1970) with its K_T at rest; {MEMORY}',
            t200_thrust(1.0), 'the sheet is at rest; the option takes the series',
            t200_thrust(1.0, inflow='true', zero_thrust_advance=DUCTED_J0, diameter=diameter),
            INFLOW),
    ]  # fmt: skip


def vehicles() -> list[Row]:
    """Return all rows."""
    return [*bluerov2(), *remus(), *aerosonde(), *t200()]
