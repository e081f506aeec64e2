# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Two vehicles in a sea with every kind of weather at once."""

import numpy as np

from test.support.plugin_models import body_plugin, ellipsoid, free_body, set_medium, world

SEA = {
    'density': 1025, 'viscosity': 1e-3, 'density_above': 1.2, 'viscosity_above': 1.8e-5,
    'surface': 0.1, 'current': [0.3, -0.1, 0.0], 'wind': [3, 1, 0],
    'turbulence': 'von_karman', 'turbulence_wind_6m': [3], 'turbulence_height': [5],
    'turbulence_airspeed': [3], 'turbulence_span': [0.5], 'turbulence_tick': [0.02],
    'wind_gauss_markov': [0.1, 0.1, 0, 5], 'current_signal': 'sine 0 .1 0 3 0',
    'waves': 'jonswap .3 3', 'wave_components': 8, 'wave_spreading': 10, 'water_depth': 5,
}  # fmt: skip


def part(name, order):
    """Return MJCF of a vehicle at sea; ``order`` 1 has a fin."""
    values = {
        'added_mass': 'auto', 'volume': 'auto', 'drag': 'ellipsoid',
        'quadratic_damping': [9, 8, 7, 1, 1, 1], 'reference_point': [0.02, 0, 0.01],
    }  # fmt: skip
    fin = (
        f'<body name="fin_{name}" pos="-.4 0 0"><joint name="j_{name}" axis="0 1 0"/>'
        f'{ellipsoid([0.1, 0.08, 0.01], 900, (0.5, 0.25, 1.5, 1, 1))}{body_plugin(**values)}'
        '</body>'
    )
    hull = ellipsoid([0.3, 0.2, 0.1], 800, (0.5, 0.25, 1.5, 1, 1)) + body_plugin(**values)
    return free_body(hull + (fin if order else ''), name=name, position=[2 * order, 0, 0.05])


def sea_xml(names='ab', integrator='implicitfast'):
    """Return MJCF of two vehicles, one with a fin and one alone, in any order of declaration."""
    bodies = ''.join(part(name, 'ab'.index(name)) for name in names)
    motor = '<actuator><motor joint="j_b"/></actuator>'
    return world(
        bodies, gravity=[0, 0, -9.81], medium=SEA, integrator=integrator, timestep=0.002,
        extra=motor,
    )  # fmt: skip


def start(model, data):
    """Set the two vehicles, the current and the motor in motion."""
    rng = np.random.default_rng(4)
    for name in 'ab':
        joint = model.body(name).jntadr[0]
        data.qvel[model.jnt_dofadr[joint] :][:6] = rng.normal(size=6)
    set_medium(model, data, current=[1, 0, 0])
    data.ctrl[:] = 0.3
