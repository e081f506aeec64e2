# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What the watchdog takes for the integrator's doing: nothing that the surface or a flow does."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.plugins.native import native
from test.support.plugin_models import body_plugin, ellipsoid, free_body, load, world

SEA = {'density': 1000, 'surface': 0}
SPHERE = free_body(ellipsoid([0.1] * 3, 1000) + body_plugin(added_mass='auto', volume='auto'))


def balance(model, data):
    """Return kinetic energy [J], feed and dissipation [W]."""
    out, scratch = np.zeros(3), mujoco.MjData(model)
    native().energy_feed(model._address, data._address, scratch._address, out.ctypes.data)
    return out


@pytest.mark.parametrize('speed', [-1.0, 1.0])
@pytest.mark.parametrize('height', [-0.05, 0.0, 0.06])
def test_entry_and_exit_are_losses_at_the_surface(speed, height):
    """|ds/dt| m_A v^2/2 leaves by closed form; RK4 feeds nothing."""
    model, data = load(world(SPHERE, medium=SEA, timestep=1e-4))
    data.qpos[2], data.qvel[2] = height, speed
    kinetic, feed, loss = balance(model, data)
    area, volume = np.pi * (0.01 - height**2), 4 / 3 * np.pi * 1e-3
    share = (2 / 3 - height / 0.1 + (height / 0.1) ** 3 / 3) * 3 / 4
    mass = 500 * volume  # the added mass of a whole sphere
    assert kinetic == pytest.approx(0.5 * (1000 * volume + share * mass) * speed**2, rel=1e-5)
    assert loss == pytest.approx(area / volume * mass * abs(speed) ** 3 / 2, rel=1e-5)
    assert abs(feed) < 1e-4 * loss


@pytest.mark.parametrize(
    'flow', [{'current': [1, 0.5, 0]}, {'waves': 'regular 1 4'}, {'waves': 'jonswap 1 4'}]
)
def test_a_flow_around_the_body_is_not_the_integrators_doing(flow):
    found = []
    for medium in (SEA, SEA | flow):
        model, data = load(
            world(SPHERE, medium=medium, gravity=[0, 0, -9.81], integrator='implicitfast')
        )
        data.qpos[2], data.qvel[:] = -2, [0.3, 0.2, 0.1, 1, 2, 3]
        found.append(balance(model, data))
        again = mujoco.MjData(model)  # and the data itself still moves in the flow
        again.qpos[:], again.qvel[:] = data.qpos, data.qvel
        for d in (data, again):
            mujoco.mj_step(model, d)
        np.testing.assert_array_equal(data.qvel, again.qvel)
    np.testing.assert_array_equal(found[0], found[1])


@pytest.mark.parametrize('scene', ['wave_buoy', 'bluerov2_waves', 'bluerov2'])
def test_scenes_with_moving_water_give_no_warning(scene):
    simulation = Simulation(scene)
    simulation.set_current([0.5, 0, 0])
    for _ in range(20):
        simulation.step(100)
        assert simulation.energy_balance().warning == ''
