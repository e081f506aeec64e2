# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What a simulation notices by itself: blow-ups, silent resets, energy out of nowhere."""

import numpy as np
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.errors import DivergedError


def test_a_blow_up_is_reported_at_its_step_with_body_and_hint(boat):
    boat.step(10)
    boat.data.qvel[6] = 1e12
    with pytest.raises(
        DivergedError, match=r"t = 0\.02\d* s in body '\w+' .*try a timestep below"
    ) as e:
        boat.step(1000)
    assert boat.step_count < 20
    assert e.value.body in ('fin', 'boat')
    assert e.value.time < 0.04
    boat.reset()
    boat.step(10)
    assert np.isfinite(boat.data.qpos).all()


def test_a_silent_reset_of_the_engine_is_noticed(boat):
    boat.data.qpos[0] = np.nan
    with pytest.raises(DivergedError):
        boat.step(1)


def test_a_fast_light_sphere_diverges_with_euler_and_says_so(tmp_path):
    path = tmp_path / 'light.xml'
    path.write_text(
        '<mujoco><option density="1000" timestep=".02" integrator="Euler"/><worldbody>'
        '<body name="ball"><freejoint/><geom size=".1" density="50"/></body></worldbody></mujoco>'
    )
    simulation = Simulation(path)
    simulation.data.qvel[0] = 50.0
    with pytest.raises(DivergedError, match=r"body 'ball' .*implicitfast"):
        simulation.step(5000)


def test_a_blow_up_is_reported_by_the_error_alone(buoy, capfd, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    buoy.data.qvel[0] = np.nan
    with pytest.raises(DivergedError):
        buoy.step(3)
    assert capfd.readouterr() == ('', '')
    assert not (tmp_path / 'MUJOCO_LOG.TXT').exists()


KIRCHHOFF = """
<mujoco><option density="1000" timestep=".01" gravity="0 0 0"/>
  <extension><plugin plugin="fluid_sim.body"/></extension>
  <worldbody><body name="hull" simple="false"><freejoint/>
    <geom type="ellipsoid" size=".5 .2 .1" density="1000" fluidshape="ellipsoid"
          fluidcoef="{coef}"/>
    <plugin plugin="fluid_sim.body"><config key="added_mass" value="auto"/></plugin>
  </body></worldbody>
</mujoco>
"""


def energy_after(path, coef, integrator, steps, **options):
    path.write_text(KIRCHHOFF.format(coef=coef))
    simulation = Simulation(path, integrator=integrator, **options)
    simulation.data.qvel[:] = [1, 0.5, 0.3, 1, 2, 1.5]
    simulation.step(steps)
    return simulation.energy_balance()


@pytest.mark.parametrize('coef', ['0 0 0 0 0', '.5 .25 1.5 1 1'])
@pytest.mark.parametrize('integrator', ['euler', 'implicit', 'implicitfast', 'rk4'])
def test_energy_feed_is_what_the_integrator_adds(tmp_path, integrator, coef):
    """Without drag every change of energy is the integrator's; with drag the work is accounted."""
    path = tmp_path / 'hull.xml'
    feeds = [energy_after(path, coef, integrator, n, timestep=0.001) for n in range(11)]
    gain = (feeds[10].kinetic - feeds[0].kinetic) / 0.01
    fed = sum(balance.feed for balance in feeds[:10]) / 10
    taken = np.trapezoid([b.dissipation for b in feeds]) / 10
    assert (taken == 0) == (coef == '0 0 0 0 0')
    assert gain == pytest.approx(fed - taken, rel=0.02, abs=1e-6 * feeds[0].kinetic)
    if integrator == 'rk4':
        assert abs(fed) < 1e-4 * feeds[0].kinetic + 1e-3 * taken  # the mean power is a trapezoid


@pytest.mark.parametrize('scene', ['sphere', 'quadrotor', 'rov', 'swimmer'])
def test_a_body_at_rest_gives_no_warning(scene):
    assert Simulation(scene).energy_balance().warning == ''


def test_growth_without_drag_is_warned_about_and_rk4_or_drag_ends_the_warning(tmp_path):
    path = tmp_path / 'hull.xml'
    assert 'use RK4' in energy_after(path, '0 0 0 0 0', 'euler', 5).warning
    assert energy_after(path, '0 0 0 0 0', 'rk4', 5).warning == ''
    assert energy_after(path, '.5 .25 1.5 1 1', 'euler', 5).warning == ''
