# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What the tests and the benchmark of fluid_sim.thruster share: models, readings."""

from collections.abc import Mapping
from typing import Any

import mujoco
import numpy as np

from fluid_sim_ros.plugins.native import THRUSTER_VALUES, native
from test.support.plugin_models import config, text

# The rotor of an x500 quadrotor (PX4-gazebo-models): k, torque/thrust, lag up and down, limit.
X500: dict[str, Any] = {
    'curve': 'quadratic', 'thrust_coefficient': 8.54858e-6, 'torque_ratio': 0.016,
    'time_constant': [0.0125, 0.025], 'rad_s_max': 1000, 'command': 'rad_s',
}  # fmt: skip
T200: dict[str, Any] = {'curve': 'table', 'table': 't200', 'command': 'pwm_us'}
# Propeller of the Aerosonde (Beard and McLain 2012, mavsim_public): CT(J), CQ(J), diameter.
AEROSONDE: dict[str, Any] = {
    'curve': 'coefficients', 'thrust_coefficients': [0.09357, -0.06044, -0.1079],
    'torque_coefficients': [0.00523, 0.00497, -0.01664], 'diameter': 0.508, 'density': 1.2682,
    'rad_s_max': [800, 800], 'command': 'rad_s',
}  # fmt: skip


def rotor_world(
    values: Mapping[str, Any],
    *,
    axis: str = '0 0 1',
    site: str = 'pos="0 0 0"',
    body: str = '<freejoint/><inertial pos="0 0 0" mass="2" diaginertia=".02 .03 .04"/>',
    option: str = 'timestep="0.01" integrator="implicitfast" gravity="0 0 0"',
    medium: Mapping[str, Any] | None = None,
    torque: bool | None = None,
    actuator: str = '',
    extra: str = '',
) -> str:
    """Return MJCF of one body with one thruster; ``torque`` None adds what the values call for."""
    if torque is None:
        torque = bool({'torque_ratio', 'torque_coefficients', 'rotor_inertia'} & set(values))
    lagged = np.any(np.asarray(values.get('time_constant', 0), dtype=float) > 0)
    actdim = 'actdim="2"' if lagged else ''
    instance = '<plugin plugin="fluid_sim.thruster" instance="t" site="rotor"'
    second = f'{instance} gear="0 0 0 {axis}"/>' if torque else ''
    fluid = '' if medium is None else (
        f'<plugin plugin="fluid_sim.medium"><instance name="fluid">{config(medium)}</instance>'
        '</plugin>'
    )  # fmt: skip
    return f"""<mujoco><option {option}/><extension>{fluid}<plugin plugin="fluid_sim.thruster">
<instance name="t">{config(values)}</instance></plugin></extension>
<worldbody><body name="hull">{body}<site name="rotor" {site}/></body>{extra}</worldbody>
<actuator>{instance} name="thrust" gear="{axis} 0 0 0" {actdim} {actuator}/>{second}</actuator>
</mujoco>"""


def read(model: mujoco.MjModel, data: mujoco.MjData, actuator: int = 0) -> dict[str, float]:
    """Return THRUSTER_VALUES of a thrust actuator by name."""
    out = np.zeros(len(THRUSTER_VALUES))
    kind = native().thruster(model._address, data._address, actuator, out.ctypes.data)
    if kind != 1:
        raise ValueError(f'actuator {actuator} is not the thrust of a fluid_sim.thruster')
    return dict(zip(THRUSTER_VALUES, out.tolist(), strict=True))


def settle(model: mujoco.MjModel, data: mujoco.MjData, command: float) -> dict[str, float]:
    """Return the readings at the present state with the lag run out."""
    data.ctrl[0] = command
    if model.na:
        data.act[0] = read(model, data)['rad_s_commanded']
    mujoco.mj_forward(model, data)
    return read(model, data)


__all__ = ['AEROSONDE', 'T200', 'X500', 'read', 'rotor_world', 'settle', 'text']
