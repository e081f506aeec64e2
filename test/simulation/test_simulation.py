"""Simulation: stepping under watch, commands, wrench terms, determinism."""

import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fluid_sim_ros import Simulation
from fluid_sim_ros.errors import CommandError, DivergedError, FluidSimError
from fluid_sim_ros.plugins.native import TERMS

TWO_PARTS = """
<mujoco>
  <option density="1000" viscosity="1e-3" timestep="0.002" integrator="implicitfast"
          wind=".3 -.2 .1"/>
  <worldbody>
    <body name="boat"><freejoint/>
      <geom type="ellipsoid" size=".3 .2 .1" density="900" fluidshape="ellipsoid"
            pos=".02 .01 0" euler="10 20 30"/>
      <site name="s" pos=".1 0 0"/>
      <body name="fin" pos=".4 0 0"><joint name="hinge" axis="0 0 1"/>
        <geom type="box" size=".1 .01 .05"/></body>
    </body>
  </worldbody>
  <actuator>
    <motor name="push" site="s" gear="0 0 1 0 0 .1" ctrllimited="true" ctrlrange="-2 3"/>
    <motor name="turn" joint="hinge"/>
  </actuator>
</mujoco>
"""


@pytest.fixture
def boat(tmp_path):
    path = tmp_path / 'boat.xml'
    path.write_text(TWO_PARTS)
    return Simulation(path)


def test_wrench_terms_add_up_to_what_the_engine_applies(boat):
    rng = np.random.default_rng(1)
    for _ in range(20):
        boat.data.qpos[3:7] = rng.normal(size=4)
        mujoco.mj_normalizeQuat(boat.model, boat.data.qpos)
        boat.data.qvel[:] = rng.normal(size=boat.model.nv)
        terms = boat.wrench('boat')
        force = sum(f for f, _ in terms.values())
        torque = sum(t for _, t in terms.values())
        mujoco.mj_forward(boat.model, boat.data)
        R = boat.data.body('boat').xmat.reshape(3, 3)
        expected_force = R.T @ boat.data.qfrc_fluid[:3]
        scale = np.linalg.norm(expected_force) + np.linalg.norm(boat.data.qfrc_fluid[3:6])
        np.testing.assert_allclose(force, expected_force, atol=1e-12 * scale)
        np.testing.assert_allclose(torque, boat.data.qfrc_fluid[3:6], atol=1e-12 * scale)
    assert list(terms) == list(TERMS)


def test_reading_never_changes_the_trajectory(boat):
    boat.data.qvel[:] = 0.5
    start = boat.save_state()
    boat.step(200)
    plain = boat.data.qpos.copy()
    boat.load_state(start)
    for _ in range(200):
        boat.step()
        boat.wrench('boat')
        boat.snapshot()
    np.testing.assert_array_equal(boat.data.qpos, plain)


def test_stepping_equals_a_bare_mujoco_loop(boat):
    data = mujoco.MjData(boat.model)
    data.qvel[:] = boat.data.qvel[:] = 0.3
    mujoco.mj_step(boat.model, data, 500)
    boat.step(500)
    np.testing.assert_array_equal(boat.data.qpos, data.qpos)
    np.testing.assert_array_equal(boat.data.qvel, data.qvel)


@settings(max_examples=20, deadline=None)
@given(cut=st.integers(1, 99), seed=st.integers(0, 2**31))
def test_a_saved_state_goes_on_bit_for_bit(cut, seed):
    simulation = Simulation('rov')
    rng = np.random.default_rng(seed)
    thrust = rng.uniform(-20, 20, 8)
    simulation.set_thrust('bluerov2_heavy', thrust)
    simulation.set_wrench('bluerov2_heavy', [1, 2, 3], [0.1, 0, 0])
    simulation.set_current([0.2, 0, 0])
    simulation.step(cut)
    state = simulation.save_state()
    simulation.step(100)
    expected = simulation.data.qpos.copy()
    simulation.reset()
    simulation.load_state(state)
    assert simulation.step_count == cut
    simulation.step(100)
    np.testing.assert_array_equal(simulation.data.qpos, expected)


def test_a_state_of_another_model_is_refused(boat):
    with pytest.raises(FluidSimError, match='another model'):
        boat.load_state(Simulation('sphere').save_state())


def test_snapshot_velocity_is_in_body_axes(boat):
    half = np.sqrt(0.5)
    boat.data.qpos[:7] = [1, 2, 3, half, 0, 0, half]  # yaw 90 degrees: body x is world y
    boat.data.qvel[:6] = [0, 2, 0, 0.1, 0.2, 0.3]
    state = boat.snapshot().vehicles['boat']
    np.testing.assert_allclose(state.velocity_b, [2, 0, 0], atol=1e-15)
    np.testing.assert_allclose(state.omega_b, [0.1, 0.2, 0.3])
    np.testing.assert_allclose(state.position_w, [1, 2, 3])


def test_specific_force_of_a_body_at_rest_is_plus_g(tmp_path):
    path = tmp_path / 'rest.xml'
    path.write_text(
        '<mujoco><worldbody><geom type="plane" size="1 1 1"/><body name="b" pos="0 0 .1">'
        '<freejoint/><geom size=".1"/></body></worldbody></mujoco>'
    )
    simulation = Simulation(path)
    simulation.step(2000)
    row = simulation.observe(forces=True)[0]
    np.testing.assert_allclose(row[13:16], [0, 0, 9.81], atol=1e-6)


# ---- commands ----------------------------------------------------------------------------------


def test_thrust_saturates_and_counts(boat):
    assert boat.set_thrust('boat', [9.0]) == 1
    assert boat.data.ctrl[0] == 3
    assert boat.set_thrust('boat', [-1.5]) == 0


@pytest.mark.parametrize(
    ('call', 'line'),
    [
        (lambda s: s.set_thrust('ship', [1]), "vehicle 'ship' is not in the scene; it has: boat"),
        (lambda s: s.set_thrust('boat', [1, 2]), r'got 2 values, needs 1 \(push\)'),
        (lambda s: s.set_thrust('boat', [np.nan]), 'not finite'),
        (lambda s: s.set_thrust('boat', [np.inf]), 'not finite'),
        (lambda s: s.set_thrust('boat', ['x']), 'are not numbers'),
        (lambda s: s.set_joints('boat', {'rudder': 1}), "'rudder' is not one of them: turn"),
        (lambda s: s.set_wind([1, 0, 0]), 'is in water only; command the current'),
        (lambda s: s.set_current([1, 0]), 'got 2 values, needs 3'),
        (lambda s: s.set_wrench('boat', [1, 0, 0], [0, 0, 0], 'odom'), 'allowed: base_link, map'),
        (lambda s: s.reset('up'), "keyframe 'up' is not in the model"),
        (lambda s: s.wrench('ship'), "vehicle 'ship'"),
    ],
)
def test_a_wrong_command_is_refused_and_leaves_the_state_alone(boat, call, line):
    control, wind = boat.data.ctrl.copy(), boat.model.opt.wind.copy()
    with pytest.raises(CommandError, match=line):
        call(boat)
    np.testing.assert_array_equal(boat.data.ctrl, control)
    np.testing.assert_array_equal(boat.model.opt.wind, wind)


@pytest.mark.parametrize('frame', ['base_link', 'map'])
def test_a_commanded_wrench_acts_at_the_base_origin_in_its_frame(tmp_path, frame):
    path = tmp_path / 'free.xml'
    path.write_text(
        '<mujoco><option gravity="0 0 0" timestep="1e-4"/><worldbody><body name="b"><freejoint/>'
        '<geom type="box" size=".3 .2 .1"/></body></worldbody></mujoco>'
    )
    simulation = Simulation(path)
    simulation.data.qpos[3:7] = [np.sqrt(0.5), 0, 0, np.sqrt(0.5)]  # body x is world y
    simulation.set_wrench('b', [10, 0, 0], [0, 0, 0], frame)
    simulation.step()
    mass = simulation.model.body('b').mass[0]
    expected = [0, 10, 0] if frame == 'base_link' else [10, 0, 0]
    np.testing.assert_allclose(simulation.data.qvel[:3] / 1e-4 * mass, expected, atol=1e-9)
    simulation.set_wrench('b', [0, 0, 0], [0, 0, 0])
    before = simulation.data.qvel.copy()
    simulation.step()
    np.testing.assert_allclose(simulation.data.qvel, before, atol=1e-12)


def test_wind_can_be_switched_off_and_on():
    simulation = Simulation('quadrotor')
    simulation.set_wind([4, 0, 0])
    simulation.enable_wind(False)
    assert not simulation.model.opt.wind.any()
    simulation.enable_wind(True)
    np.testing.assert_array_equal(simulation.model.opt.wind, [4, 0, 0])


def test_scheduled_events_act_at_their_step_however_steps_are_batched(tmp_path):
    (tmp_path / 'boat.xml').write_text(TWO_PARTS)
    scene = tmp_path / 'scene.yaml'
    scene.write_text(
        'model: boat.xml\nschedule:\n- {at: 0.1, current: [1, 0, 0]}\n'
        '- {at: 0.05, thrust: {boat: [2]}}\n'
    )
    ends = []
    for batch in (1, 7, 200):
        simulation = Simulation(scene)
        while simulation.step_count < 200:
            simulation.step(min(batch, 200 - simulation.step_count))
        ends.append(simulation.data.qpos.copy())
        assert simulation.model.opt.wind[0] == 1
    np.testing.assert_array_equal(ends[0], ends[1])
    np.testing.assert_array_equal(ends[0], ends[2])
    simulation.reset()
    assert simulation.model.opt.wind[0] == 0.3  # the model's own, before the event


def test_time_is_exact_from_the_step_count():
    simulation = Simulation('sphere', timestep=0.001)
    simulation.step(1000)
    assert simulation.time_ns == 1_000_000_000
    assert simulation.time == 1.0


# ---- the watchdog ------------------------------------------------------------------------------


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


# ---- models with plugins -----------------------------------------------------------------------

AMPHIBIOUS = """
<mujoco>
  <option timestep="0.002" integrator="implicitfast"/>
  <extension>
    <plugin plugin="fluid_sim.body"/>
    <plugin plugin="fluid_sim.medium"><instance name="sea">
      <config key="surface" value="0"/><config key="density" value="1000"/>
      <config key="viscosity" value="1e-3"/><config key="density_above" value="1.2"/>
      <config key="viscosity_above" value="1.8e-5"/><config key="current" value=".1 0 0"/>
    </instance></plugin>
  </extension>
  <worldbody><body name="buoy" pos="0 0 -1" simple="false"><freejoint/>
    <geom type="ellipsoid" size=".3 .2 .1" density="500" fluidshape="ellipsoid"/>
    <plugin plugin="fluid_sim.body"><config key="added_mass" value="auto"/>
      <config key="volume" value="auto"/><config key="drag" value="ellipsoid"/></plugin>
  </body></worldbody>
</mujoco>
"""


@pytest.fixture
def buoy(tmp_path):
    path = tmp_path / 'buoy.xml'
    path.write_text(AMPHIBIOUS)
    return Simulation(path)


def test_a_scene_with_a_surface_has_wind_and_current_with_limited_slew(buoy):
    assert buoy.streams == ('wind', 'current')
    buoy.set_current([1.1, 0, 0])
    buoy.set_wind([3, 0, 0])
    buoy.step(50)
    current = buoy.snapshot().vehicles['buoy'].medium_velocity_w[0]
    assert current == pytest.approx(0.1 + 0.1, abs=1e-12)  # 1 m/s^2 by default, 0.1 s
    buoy.reset()
    assert buoy.snapshot().vehicles['buoy'].medium_velocity_w[0] == 0.1


def test_a_plugin_scene_is_saved_and_loaded_bit_for_bit(buoy):
    buoy.set_current([1, 0.5, 0])
    buoy.step(30)
    state = buoy.save_state()
    buoy.step(100)
    expected = buoy.data.qpos.copy()
    buoy.reset()
    buoy.load_state(state)
    buoy.step(100)
    np.testing.assert_array_equal(buoy.data.qpos, expected)


def test_published_terms_of_a_plugin_body_hold_buoyancy_and_added_mass(buoy):
    buoy.step(10)
    terms = buoy.wrench('buoy')
    volume = 4 / 3 * np.pi * 0.3 * 0.2 * 0.1
    np.testing.assert_allclose(np.linalg.norm(terms['buoyancy'][0]), 1000 * volume * 9.81)
    assert terms['added_mass'][0][2] < 0  # it accelerates upward


@pytest.mark.parametrize(
    ('fluid', 'terms'), [('none', set()), ('ellipsoid', {'drag', 'viscous', 'added_mass'})]
)
def test_a_lower_rung_takes_the_plugins_away_and_keeps_the_body_afloat(tmp_path, fluid, terms):
    path = tmp_path / 'buoy.xml'
    path.write_text(AMPHIBIOUS)
    simulation = Simulation(path, fluid=fluid)
    assert simulation.model.nplugin == 0
    assert simulation.model.opt.density == (0 if fluid == 'none' else 1000)
    simulation.data.qvel[:6] = [0.3, 0.2, 0.1, 0.3, 0.1, 0.2]
    found = {name for name, (force, _) in simulation.wrench('buoy').items() if force.any()}
    assert terms <= found
    assert 'buoyancy' not in found
    before = simulation.data.qvel[2]
    simulation.step(1)
    if fluid == 'none':
        assert simulation.data.qvel[2] == pytest.approx(before, abs=1e-12)


@pytest.mark.parametrize('fluid', ['none', 'inertia', 'ellipsoid'])
def test_a_foil_on_a_body_goes_with_the_rung(tmp_path, fluid):
    path = tmp_path / 'glider.xml'
    path.write_text(
        '<mujoco><option density="1.2" viscosity="1.8e-5"/><extension>'
        '<plugin plugin="fluid_sim.foil"><instance name="wing"><config key="kind" value="wing"/>'
        '<config key="span" value="2"/><config key="chord" value=".3"/>'
        '<config key="stock_drag" value="keep"/></instance></plugin>'
        '</extension><worldbody><body name="glider" simple="false"><freejoint/>'
        '<geom type="box" size=".3 1 .01"/><plugin instance="wing"/></body></worldbody></mujoco>'
    )
    assert Simulation(path, fluid=fluid).model.nplugin == 0


def test_a_plugin_that_refuses_its_configuration_is_one_line(tmp_path):
    path = tmp_path / 'buoy.xml'
    path.write_text(AMPHIBIOUS.replace('key="volume" value="auto"', 'key="volume" value="-1"'))
    with pytest.raises(FluidSimError, match=r'buoy\.xml: fluid_sim\.body: .*volume') as caught:
        Simulation(path)
    assert '\n' not in str(caught.value)


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


# ---- gaits -------------------------------------------------------------------------------------


def test_a_gait_swims_is_the_same_in_any_batch_and_ends_with_a_command():
    ends = []
    for batch in (1, 7, 500):
        simulation = Simulation('swimmer')
        while simulation.step_count < 1000:
            simulation.step(min(batch, 1000 - simulation.step_count))
        ends.append(simulation.data.qpos.copy())
    np.testing.assert_array_equal(ends[0], ends[1])
    np.testing.assert_array_equal(ends[0], ends[2])
    assert ends[0][0] > 0.1
    state = simulation.save_state()
    simulation.step(123)
    expected = simulation.data.qpos.copy()
    simulation.load_state(state)
    simulation.step(123)
    np.testing.assert_array_equal(simulation.data.qpos, expected)
    simulation.set_joints('swimmer', [0.1] * 5)
    simulation.step(200)
    np.testing.assert_array_equal(simulation.data.ctrl, [0.1] * 5)
    simulation.reset()
    simulation.step(200)
    assert np.ptp(simulation.data.ctrl) > 0.1


def test_the_fly_flies_by_its_gait():
    simulation = Simulation('fly_wing')
    start = simulation.snapshot().vehicles['fly'].position_w[2]
    simulation.step(round(0.5 / simulation.timestep))
    rise = simulation.snapshot().vehicles['fly'].position_w[2] - start
    assert abs(rise) < 0.15  # without wings it would have fallen 1.2 m
