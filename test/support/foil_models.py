# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What the tests and the benchmark of fluid_sim.foil share: one foil in a flow, its wrench."""

from collections.abc import Mapping, Sequence
from typing import Any

import mujoco
import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.physics.foil import WingParams
from test.support.plugin_models import Array, config

AIR = 1.2682  # [kg/m^3], of the Aerosonde's set

# Wing of Dickinson et al. (1999), Science 284:1954, at Re 136: a plate whose leading-edge vortex
# stays, so stalled at once, with a normal force that grows with sin alpha. Fitted to their CL and
# CD curves together (least worst rms) over 0 to 90 deg.
DICKINSON: dict[str, Any] = {
    'plate': 'sine', 'plate_normal': 3.4, 'drag_0': 0.21, 'lift_slope': 3.7,
    'stall_angle': 0.06, 'stall_sharpness': 50,
}  # fmt: skip

# Aerosonde (Beard and McLain 2012, App. E; mavsim_public).
AEROSONDE: dict[str, Any] = {
    'kind': 'aircraft', 'area': 0.55, 'span': 2.8956, 'chord': 0.18994,
    'stall_angle': 0.47, 'stall_sharpness': 50,
    'lift_0': 0.23, 'lift_alpha': 5.61, 'lift_q': 7.95, 'lift_elevator': 0.13,
    'drag_0': 0.043, 'drag_alpha': 0.03, 'drag_q': 0.0, 'drag_elevator': 0.0135,
    'pitch_0': 0.0135, 'pitch_alpha': -2.74, 'pitch_q': -38.21, 'pitch_elevator': -0.99,
    'side_0': 0.0, 'side_beta': -0.98, 'side_p': 0.0, 'side_r': 0.0,
    'side_aileron': 0.075, 'side_rudder': 0.19,
    'roll_0': 0.0, 'roll_beta': -0.13, 'roll_p': -0.51, 'roll_r': 0.25,
    'roll_aileron': 0.17, 'roll_rudder': 0.0024,
    'yaw_0': 0.0, 'yaw_beta': 0.073, 'yaw_p': 0.069, 'yaw_r': -0.095,
    'yaw_aileron': -0.011, 'yaw_rudder': -0.069,
}  # fmt: skip


def foil_world(
    values: Mapping[str, Any],
    *,
    site: str = '',
    medium: Mapping[str, Any] | None = None,
    inside: str = '',
    option: str = 'timestep=".01" integrator="RK4" gravity="0 0 0"',
    extra: str = '',
    extension: str = '',
) -> str:
    """Return MJCF of a free body with a foil at the site ``wing``."""
    fluid = config({'density': AIR} if medium is None else medium)
    return f"""<mujoco><option {option}/><extension>
<plugin plugin="fluid_sim.medium"><instance name="fluid">{fluid}</instance></plugin>
<plugin plugin="fluid_sim.foil"><instance name="foil">{config({'site': 'wing', **values})}
</instance></plugin>{extension}</extension><worldbody><body name="hull"><freejoint/>
<inertial pos="0 0 0" mass="2" diaginertia=".02 .03 .04"/>
<site name="wing" {site}/>{inside}</body></worldbody>{extra}</mujoco>"""


def generalized(model: mujoco.MjModel, data: mujoco.MjData) -> Array:
    """Return the passive force of the free body: force in world axes, torque in body axes."""
    mujoco.mj_forward(model, data)
    return np.array(data.qfrc_passive[:6])


def in_flow(alpha: float, speed: float = 1.0, sideslip: float = 0.0) -> Array:
    """Return the velocity of a body that meets the flow at an angle of attack (FLU) [m/s]."""
    plane = speed * np.cos(sideslip)
    return np.array([plane * np.cos(alpha), -speed * np.sin(sideslip), -plane * np.sin(alpha)])


def lift_drag(
    model: mujoco.MjModel, data: mujoco.MjData, alphas: Sequence[float] | Array, area: ArrayLike
) -> Array:
    """Return rows (C_L, C_D) measured on the plugin's force at speed 1 m/s, shape (n, 2)."""
    rows = []
    for alpha in alphas:
        v = in_flow(float(alpha))
        data.qvel[:3] = v
        force = generalized(model, data)[:3]
        lift_axis = np.array([-v[2], 0.0, v[0]])
        rows.append(np.array([force @ lift_axis, -force @ v]) / (0.5 * AIR * np.asarray(area)))
    return np.array(rows)


def wing_params(values: Mapping[str, Any]) -> WingParams:
    """Return the numpy twin's constants for configuration values of a wing."""
    names = {
        'plate': ('plate_power', lambda word: 1 if word == 'sine' else 2),
        'center_of_pressure': ('moving_center', lambda word: word == 'moving'),
    }
    out: dict[str, Any] = {'area': values['span'] * values['chord']}
    for key, value in values.items():
        name, convert = names.get(key, (key, lambda same: same))
        out[name] = convert(value)
    return WingParams(**out)
